// [Lambert1760], [Baum1989], [Howell]; see docs/references.md.
#include "radiosity/rows/FormFactor.h"

#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace penumbra {

namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

/// Sutherland & Hodgman against one plane; `height` is the signed distance of each vertex.
template <class Emit>
void clipToPlane(std::span<const glm::vec3> polygon, std::span<const float> height, Emit emit) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const std::size_t j = i + 1 == polygon.size() ? 0 : i + 1;
        if (height[i] >= 0) emit(polygon[i]);
        if ((height[i] >= 0) != (height[j] >= 0)) {
            const float t = height[i] / (height[i] - height[j]);
            emit(polygon[i] + t * (polygon[j] - polygon[i]));
        }
    }
}

/// Orthonormal u, v with u x v = axis (Duff et al., JCGT 6(1), 2017).
void frameAround(glm::vec3 axis, glm::vec3& u, glm::vec3& v) {
    const float sign = std::copysign(1.0f, axis.z);
    const float a = -1.0f / (sign + axis.z);
    const float b = axis.x * axis.y * a;
    u = {1.0f + sign * axis.x * axis.x * a, sign * b, -sign * axis.x};
    v = {b, sign + axis.y * axis.y * a, -axis.y};
}

/// A regular polygon of the disk's area, counter-clockwise around `axis`.
float cutDiskFormFactor(glm::vec3 p, glm::vec3 n, glm::vec3 centre, glm::vec3 axis, float radius) {
    constexpr int kSides = 48;
    const double step = kTwoPi / kSides;
    const float reach = radius * float(std::sqrt(step / std::sin(step)));
    glm::vec3 u, v;
    frameAround(axis, u, v);
    std::array<glm::vec3, kSides> polygon;
    for (int i = 0; i < kSides; ++i)
        polygon[std::size_t(i)] =
            centre + reach * (float(std::cos(i * step)) * u + float(std::sin(i * step)) * v);
    return polygonFormFactor(p, n, polygon);
}

/// Angle between unit vectors over its sine. Up to 90 degrees as acos(c) / sqrt(1 - c^2), which
/// stays smooth where the angle vanishes, by Abramowitz & Stegun 4.4.46: acos(x) = sqrt(1 - x) p(x)
/// + e, |e| <= 2e-8. Beyond, the sine itself is needed: the cosine of an edge seen almost straight
/// says little about it.
float angleOverSine(float cosine, glm::vec3 cross) {
    if (cosine < 0) {
        const float sine = glm::length(cross);
        return sine > 0 ? std::atan2(sine, cosine) / sine : 0.0f;
    }
    float p = -0.0012624911f;
    for (const float k : {0.0066700901f, -0.0170881256f, 0.0308918810f, -0.0501743046f,
                          0.0889789874f, -0.2145988016f, 1.5707963050f})
        p = p * cosine + k;
    return p / std::sqrt(1 + cosine);
}

/// pointToPolygonFormFactor() in single precision, for polygons that are not seen too small.
float contourSum(glm::vec3 p, glm::vec3 n, std::span<const glm::vec3> polygon) {
    const auto toward = [p](glm::vec3 vertex) {
        const glm::vec3 d = vertex - p;
        const float d2 = glm::dot(d, d);
        return d2 > 0 ? d * (1 / std::sqrt(d2)) : glm::vec3(0);
    };
    const glm::vec3 first = toward(polygon[0]);
    glm::vec3 a = first;
    float sum = 0;
    for (std::size_t i = 1; i <= polygon.size(); ++i) {
        const glm::vec3 b = i == polygon.size() ? first : toward(polygon[i]);
        const glm::vec3 axis = glm::cross(b, a);
        sum += glm::dot(n, axis) * angleOverSine(glm::dot(a, b), axis);
        a = b;
    }
    return sum * (0.5f * std::numbers::inv_pi_v<float>);
}

} // namespace

double pointToPolygonFormFactor(glm::vec3 p, glm::vec3 n, std::span<const glm::vec3> polygon) {
    assert(polygon.size() >= 3);
    double sum = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 a = glm::dvec3(polygon[i]) - glm::dvec3(p);
        const glm::dvec3 b =
            glm::dvec3(polygon[i + 1 == polygon.size() ? 0 : i + 1]) - glm::dvec3(p);
        const glm::dvec3 axis = glm::cross(b, a); // length |a||b| sin beta
        const double length = glm::length(axis);
        if (length == 0.0) continue; // p is in line with the edge: it subtends no angle
        sum += std::atan2(length, glm::dot(a, b)) * glm::dot(glm::dvec3(n), axis) / length;
    }
    return sum / kTwoPi;
}

void clipToHorizon(glm::vec3 p, glm::vec3 n, std::span<const glm::vec3> polygon,
                   std::vector<glm::vec3>& clipped) {
    clipped.clear();
    std::vector<float> height;
    for (glm::vec3 vertex : polygon) height.push_back(glm::dot(n, vertex - p));
    clipToPlane(polygon, height, [&](glm::vec3 vertex) { clipped.push_back(vertex); });
}

float polygonFormFactor(glm::vec3 p, glm::vec3 n, std::span<const glm::vec3> polygon) {
    constexpr std::size_t kMost = 60;
    if (polygon.size() > kMost) {
        std::vector<glm::vec3> clipped;
        clipToHorizon(p, n, polygon, clipped);
        return clipped.size() < 3 ? 0.0f
                                  : std::max(0.0f, float(pointToPolygonFormFactor(p, n, clipped)));
    }
    std::array<float, kMost> height;
    bool above = false, below = false;
    float farthest = 0, widest = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::vec3 d = polygon[i] - p, across = polygon[i] - polygon[0];
        height[i] = glm::dot(n, d);
        (height[i] >= 0 ? above : below) = true;
        farthest = std::max(farthest, glm::dot(d, d));
        widest = std::max(widest, glm::dot(across, across));
    }
    if (!above) return 0.0f;
    // Seen under less than a thirtieth the edges' terms nearly cancel: double precision.
    const bool small = widest * 900 < farthest;
    const auto evaluate = [&](std::span<const glm::vec3> visible) {
        return std::max(0.0f, small ? float(pointToPolygonFormFactor(p, n, visible))
                                    : contourSum(p, n, visible));
    };
    if (!below) return evaluate(polygon);
    std::array<glm::vec3, 2 * kMost> clipped; // each edge may add a vertex
    std::size_t count = 0;
    clipToPlane(polygon, std::span(height).first(polygon.size()),
                [&](glm::vec3 vertex) { clipped[count++] = vertex; });
    return count < 3 ? 0.0f : evaluate(std::span(clipped).first(count));
}

// With the disk in the plane z = h around the axis through the origin of (x, y), and p at distance
// a from that axis, r(t) = (R cos t - a, R sin t, h) runs along its edge. Lambert's contour
// integral 1/(2 pi) * integral of (r x dr)/|r|^2 has the two components below, with c = R^2 + a^2 +
// h^2, d = 2 a R and integrals of (A + B cos t)/(c - d cos t).
float diskFormFactor(glm::vec3 p, glm::vec3 n, glm::vec3 centre, glm::vec3 axis, float radius) {
    const glm::dvec3 toCentre = glm::dvec3(centre) - glm::dvec3(p);
    const glm::dvec3 up = -glm::dvec3(axis); // from p towards the disk's plane
    const double h = glm::dot(toCentre, up);
    if (h <= 0) return 0.0f;
    const double cosTilt = glm::dot(glm::dvec3(n), up);
    const double reach = radius * std::sqrt(std::max(0.0, 1 - cosTilt * cosTilt));
    const double height = glm::dot(glm::dvec3(n), toCentre);
    if (height <= -reach) return 0.0f;
    if (height < reach) return cutDiskFormFactor(p, n, centre, axis, radius);

    const glm::dvec3 lateral = toCentre - h * up;
    const double a = glm::length(lateral);
    const double c = double(radius) * radius + a * a + h * h;
    const double d = 2 * a * radius;
    const double root = std::sqrt(std::max(0.0, (c - d) * (c + d)));
    const double along = 0.5 * (1 - (h * h + a * a - double(radius) * radius) / root);
    // (c/root - 1) = d^2 / (root (c + root)), which keeps its digits for small d.
    const double across = a > 0 ? h / (2 * a) * d * d / (root * (c + root)) : 0.0;
    const double lateralCos = a > 0 ? glm::dot(glm::dvec3(n), lateral) / a : 0.0;
    return float(std::max(0.0, along * cosTilt + across * lateralCos));
}

TangentDisk tangentDisk(glm::vec3 p, glm::vec3 centre, float radius) {
    const glm::dvec3 toPoint = glm::dvec3(p) - glm::dvec3(centre);
    const double distance = glm::length(toPoint);
    const glm::dvec3 axis = toPoint / distance;
    const double ratio = std::min(1.0, radius / distance);
    const double offset = radius * ratio;
    return {glm::vec3(glm::dvec3(centre) + offset * axis), glm::vec3(axis),
            float(radius * std::sqrt(std::max(0.0, 1 - ratio * ratio)))};
}

float sphereFormFactor(glm::vec3 p, glm::vec3 n, glm::vec3 centre, float radius) {
    const double distance = glm::length(glm::dvec3(centre) - glm::dvec3(p));
    if (distance <= radius) return 0.0f;
    const double height = glm::dot(glm::dvec3(n), glm::dvec3(centre) - glm::dvec3(p));
    if (height >= radius) { // wholly above the horizon: (r/d)^2 cos (Howell B-38)
        const double ratio = radius / distance;
        return float(ratio * ratio * height / distance);
    }
    const TangentDisk disk = tangentDisk(p, centre, radius);
    return diskFormFactor(p, n, disk.centre, disk.axis, disk.radius);
}

} // namespace penumbra
