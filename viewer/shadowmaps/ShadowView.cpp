#include "viewer/shadowmaps/ShadowView.h"

#include "radiosity/rows/SenderSamples.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

namespace {

constexpr float kMargin = 0.02f; // of a window, so that the outline is not on its edge
constexpr float kSteepest = 6;   // tangent: further aside nothing is drawn

void setAxes(ShadowView& view, glm::vec3 axis) {
    const glm::vec3 helper = std::abs(axis.z) < 0.8f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0);
    view.axis = axis;
    view.right = glm::normalize(glm::cross(axis, helper));
    view.up = glm::cross(view.right, axis);
}

glm::vec3 corner(const Bounds& box, int i) {
    return {i & 1 ? box.upper.x : box.lower.x, i & 2 ? box.upper.y : box.lower.y,
            i & 4 ? box.upper.z : box.lower.z};
}

/// The window of a point; widens the view's range of depths.
ShadowPoint window(ShadowView& view, glm::vec3 origin, const Bounds& box, float nearest) {
    glm::vec2 lower(kSteepest), upper(-kSteepest);
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 d = corner(box, i) - origin;
        const float z = glm::dot(d, view.axis);
        const float safe = std::max(z, nearest);
        const glm::vec2 at(glm::dot(d, view.right) / safe, glm::dot(d, view.up) / safe);
        lower = glm::min(lower, at);
        upper = glm::max(upper, at);
        view.near = std::min(view.near, safe);
        view.far = std::max(view.far, safe);
    }
    lower = glm::clamp(lower, -kSteepest, kSteepest);
    upper = glm::max(glm::clamp(upper, -kSteepest, kSteepest), lower + 1e-4f);
    const glm::vec2 scale = (1 - 2 * kMargin) / (upper - lower);
    view.width = std::max({view.width, 1 / scale.x, 1 / scale.y});
    return {origin, scale, kMargin - lower * scale};
}

} // namespace

std::vector<glm::vec3> shadowPoints(const Emitter& source, std::size_t count, glm::vec3 towards) {
    std::vector<glm::vec3> points;
    const EmitterSamples samples = sampleEmitter(source, count);
    if (source.kind != Emitter::Kind::sphere) {
        for (const auto& sample : samples.points) points.push_back(sample.position);
        return points;
    }
    ShadowView facing;
    setAxes(facing, glm::normalize(towards - source.centre));
    for (const auto& sample : samples.points)
        points.push_back(source.centre + source.radius * (sample.position.x * facing.right +
                                                          sample.position.y * facing.up));
    return points;
}

ShadowView fitView(std::span<const glm::vec3> points, const Bounds& box) {
    ShadowView view;
    glm::vec3 mean(0);
    for (const glm::vec3 p : points) mean += p / float(points.size());
    const glm::vec3 way = box.centre() - mean;
    const float distance = glm::length(way);
    setAxes(view, distance > 0 ? way / distance : glm::vec3(0, 0, -1));
    const float nearest = std::max(1e-3f, 0.02f * distance);
    view.near = std::numeric_limits<float>::infinity();
    for (const glm::vec3 p : points) view.points.push_back(window(view, p, box, nearest));
    view.near *= 0.99f;
    view.far *= 1.01f;
    return view;
}

ShadowView cubeView(std::span<const glm::vec3> points, int face) {
    ShadowView view;
    const int i = face / 2;
    const float sign = face % 2 == 0 ? 1.0f : -1.0f;
    view.axis = view.right = view.up = glm::vec3(0);
    view.axis[i] = sign;
    view.right[(i + 1) % 3] = 1;
    view.up[(i + 2) % 3] = 1;
    for (const glm::vec3 p : points) view.points.push_back({p, glm::vec2(0.5f), glm::vec2(0.5f)});
    view.width = 2;
    return view;
}

// x_clip / z = 2 (x scale + offset) - 1 with x = (right . d) / z; depth = (z_clip / z + 1) / 2.
glm::mat4 toClip(const ShadowView& view, const ShadowPoint& point, DepthRange depth) {
    const glm::vec2 along = 2.0f * point.scale, shift = 2.0f * point.offset - 1.0f;
    const glm::vec3 x = along.x * view.right + shift.x * view.axis;
    const glm::vec3 y = along.y * view.up + shift.y * view.axis;
    const glm::vec3 z = (2 * depth.a - 1) * view.axis;
    const auto row = [&](glm::vec3 v, float constant) {
        return glm::vec4(v, constant - glm::dot(v, point.origin));
    };
    return glm::transpose(glm::mat4(row(x, 0), row(y, 0), row(z, -2 * depth.b), row(view.axis, 0)));
}

} // namespace penumbra
