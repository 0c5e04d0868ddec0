#include "radiosity/rows/SenderSamples.h"

#include "base/Frame.h"
#include "radiosity/mesh/Emitters.h"
#include "radiosity/rays/Margins.h"
#include "radiosity/rows/ClusterParts.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

namespace penumbra {

namespace {

/// A triangle of an emitter and where its share of the area ends.
struct Part {
    std::array<glm::vec3, 3> corner;
    glm::vec3 normal;
    double upTo = 0;
};

/// Square to triangle, keeping areas (Shirley & Chiu use the same folding for the disk).
glm::vec3 inTriangle(const std::array<glm::vec3, 3>& t, glm::vec2 u) {
    const float root = std::sqrt(u.x);
    return t[0] + root * (1 - u.y) * (t[1] - t[0]) + root * u.y * (t[2] - t[0]);
}

bool isParallelogram(const std::vector<glm::vec3>& p) {
    return p.size() == 4 && glm::length(p[0] - p[1] + p[2] - p[3]) <=
                                1e-5f * (glm::distance(p[0], p[2]) + glm::distance(p[1], p[3]));
}

/// Of what has no area, be it that an animation shrinks it beyond what floats can tell apart.
constexpr glm::vec3 kAnyNormal(0, 0, 1);

glm::vec3 unitOrAny(glm::vec3 vector) {
    const float length = glm::length(vector);
    return length > 0 ? vector / length : kAnyNormal;
}

void samplePolygons(const Emitter& emitter, std::size_t count, EmitterSamples& out) {
    if (emitter.polygons.size() == 1 && isParallelogram(emitter.polygons[0])) {
        const auto& p = emitter.polygons[0];
        const glm::vec3 normal = unitOrAny(glm::cross(p[1] - p[0], p[3] - p[0]));
        for (std::uint32_t i = 0; i < count; ++i) {
            const glm::vec2 u = sobol02(i, count);
            out.points.push_back({p[0] + u.x * (p[1] - p[0]) + u.y * (p[3] - p[0]), normal});
        }
        return;
    }
    std::vector<Part> parts;
    double area = 0;
    for (const auto& polygon : emitter.polygons)
        for (std::size_t i = 2; i < polygon.size(); ++i) {
            const std::array<glm::vec3, 3> corner{polygon[0], polygon[i - 1], polygon[i]};
            const glm::vec3 vector = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
            const double size = glm::length(glm::dvec3(vector));
            if (size == 0) continue;
            area += size;
            parts.push_back({corner, vector / float(size), area});
        }
    if (parts.empty()) { // it sends nothing, so it may do so from anywhere
        out.points.assign(count, {emitter.polygons[0][0], kAnyNormal});
        return;
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        glm::vec2 u = sobol02(i, count);
        const double at = u.x * area;
        const auto part = std::ranges::upper_bound(parts.begin(), parts.end() - 1, at, {},
                                                   [](const Part& p) { return p.upTo; });
        const double from = part == parts.begin() ? 0 : (part - 1)->upTo;
        u.x =
            float(std::clamp((at - from) / (part->upTo - from), 0.0, 1.0)); // the same number again
        out.points.push_back({inTriangle(part->corner, u), part->normal});
    }
}

} // namespace

glm::vec2 sobol02(std::uint32_t index, std::size_t count) {
    std::uint32_t x = 0, y = 0;
    std::uint32_t v = 0x80000000u;
    for (std::uint32_t i = index, a = 0x80000000u; i != 0; i >>= 1, a >>= 1, v ^= v >> 1)
        if (i & 1) x ^= a, y ^= v;
    const float half = 0.5f / float(std::bit_ceil(std::max<std::size_t>(count, 64)));
    const auto centred = [&](std::uint32_t bits) { return float(bits >> 8) * 0x1p-24f + half; };
    return {centred(x), centred(y)};
}

glm::vec2 squareToDisk(glm::vec2 u) {
    const glm::vec2 p = 2.0f * u - 1.0f;
    if (p.x == 0 && p.y == 0) return p;
    constexpr float kQuarter = std::numbers::pi_v<float> / 4;
    const bool wide = std::abs(p.x) > std::abs(p.y);
    const float radius = wide ? p.x : p.y;
    const float angle = wide ? kQuarter * p.y / p.x : 2 * kQuarter - kQuarter * p.x / p.y;
    return radius * glm::vec2(std::cos(angle), std::sin(angle));
}

EmitterSamples sampleEmitter(const Emitter& emitter, std::size_t count) {
    EmitterSamples samples;
    samples.points.reserve(count);
    if (emitter.kind == Emitter::Kind::polygons) {
        samplePolygons(emitter, count, samples);
        return samples;
    }
    glm::vec3 u(1, 0, 0), v(0, 1, 0);
    if (emitter.kind == Emitter::Kind::disk) {
        u = emitter.radius * Frame(emitter.axis).u;
        v = glm::cross(emitter.axis, u);
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec2 p = squareToDisk(sobol02(i, count));
        const glm::vec3 onDisk = p.x * u + p.y * v;
        samples.points.push_back(emitter.kind == Emitter::Kind::disk
                                     ? EmitterSamples::Point{emitter.centre + onDisk, emitter.axis}
                                     : EmitterSamples::Point{onDisk, glm::vec3(0)});
    }
    return samples;
}

namespace {

/// Column and row of a patch's cell among 4 x 4, quarter by quarter.
glm::uvec2 cellOf(std::size_t index) {
    const std::size_t quarter = index / 4, within = index % 4;
    return {quarter % 2 * 2 + within % 2, quarter / 2 * 2 + within / 2};
}

/// Where sample i of 4 x 4 lies, in coordinates from 0 to 1. Not in the very middle of its cell:
/// people build with round numbers, and rays from there run along the faces of things, where
/// rounding decides what is in the way.
glm::vec2 stratum(std::size_t i) {
    const glm::uvec2 cell = cellOf(i);
    const float aside = (cell.x + cell.y) % 2 == 0 ? 1.0f : -1.0f;
    return {(float(cell.x) + 0.5f + 0.0137f * aside) / 4,
            (float(cell.y) + 0.5f - 0.0211f * aside) / 4};
}

glm::vec3 pointOfOutline(std::span<const glm::vec3> corners, glm::vec3 centre, glm::vec2 st) {
    if (corners.size() == 4)
        return glm::mix(glm::mix(corners[0], corners[1], st.x),
                        glm::mix(corners[3], corners[2], st.x), st.y);
    // a fan of triangles around the middle, gone round once for the 16 samples
    const std::size_t n = corners.size();
    const float around = st.x * float(n);
    const std::size_t k = std::min(std::size_t(around), n - 1);
    const glm::vec3 edge = glm::mix(corners[k], corners[(k + 1) % n], around - float(k));
    return glm::mix(centre, edge, std::sqrt(st.y));
}

/// A curved patch bulges over its outline: moves a point onto the plane of the nearest element.
/// \return that element's normal
glm::vec3 moveOntoNearest(const PatchSet& set, std::span<const std::uint32_t> elements,
                          glm::vec3& point) {
    float nearest = 1e30f;
    glm::vec3 best = point, up(0);
    for (std::uint32_t e : elements) {
        const Element& element = set.elements[e];
        const std::size_t count = element.isTriangle() ? 3 : 4;
        glm::vec3 middle(0), normal(0);
        for (std::size_t k = 0; k < count; ++k) {
            middle += set.vertices[element.vertices[k]].position / float(count);
            normal += set.vertices[element.vertices[k]].receiver.normal;
        }
        const glm::vec3 d = point - middle;
        if (glm::dot(d, d) >= nearest) continue;
        nearest = glm::dot(d, d);
        up = glm::normalize(normal);
        best = point - glm::dot(d, up) * up;
    }
    point = best;
    return up;
}

} // namespace

glm::vec2 cellMiddle(std::size_t index) {
    const glm::uvec2 cell = cellOf(index);
    return {(float(cell.x) + 0.5f) / 4, (float(cell.y) + 0.5f) / 4};
}

void samplePatch(const PatchSet& set, const Patch& patch, glm::vec3* points) {
    if (patch.cluster) {
        std::ranges::copy(partsOf(set, patch).samples, points);
        return;
    }
    const auto corners = std::span(set.corners).subspan(patch.firstCorner, patch.cornerCount);
    const auto elements =
        std::span(set.patchElements).subspan(patch.firstElement, patch.elementCount);
    for (std::size_t i = 0; i < kPatchSamples; ++i) {
        glm::vec3 p = pointOfOutline(corners, patch.centre, stratum(i));
        const glm::vec3 up = elements.size() > 1 ? moveOntoNearest(set, elements, p) : patch.normal;
        // A point that rounding puts behind the surface is hidden by it from all that lies near its
        // plane, as the foot of a wall far from the origin does.
        points[i] = p + roundingAt(magnitude(p)) * up;
    }
}

} // namespace penumbra
