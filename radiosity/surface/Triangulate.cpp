// After G. H. Meisters, "Polygons have ears", American Mathematical Monthly 82(6), 1975.
#include "radiosity/surface/Triangulate.h"

#include "radiosity/surface/SurfaceMesh.h"

#include <cmath>
#include <numbers>

namespace penumbra {

namespace {

/// The polygon in the plane of its normal, counter-clockwise.
std::vector<glm::dvec2> flatten(std::span<const glm::vec3> points,
                                std::span<const std::uint32_t> corners) {
    const glm::dvec3 normal = glm::normalize(newellNormal(points, corners));
    glm::dvec3 helper(0);
    const glm::dvec3 size = glm::abs(normal);
    helper[size.x < size.y ? (size.x < size.z ? 0 : 2) : (size.y < size.z ? 1 : 2)] = 1;
    const glm::dvec3 u = glm::normalize(glm::cross(helper, normal));
    const glm::dvec3 v = glm::cross(normal, u);
    std::vector<glm::dvec2> flat;
    for (std::uint32_t corner : corners) {
        const glm::dvec3 p = glm::dvec3(points[corner]) - glm::dvec3(points[corners[0]]);
        flat.emplace_back(glm::dot(u, p), glm::dot(v, p));
    }
    return flat;
}

double turn(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
    return (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
}

bool insideTriangle(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
    return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
}

} // namespace

bool isConvex(std::span<const glm::vec3> points, std::span<const std::uint32_t> corners) {
    if (corners.size() == 3) return true;
    const std::vector<glm::dvec2> flat = flatten(points, corners);
    const std::size_t n = flat.size();
    double turned = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const glm::dvec2 in = flat[(i + 1) % n] - flat[i];
        const glm::dvec2 out = flat[(i + 2) % n] - flat[(i + 1) % n];
        const double cross = in.x * out.y - in.y * out.x;
        if (cross < -1e-5 * glm::length(in) * glm::length(out)) return false;
        turned += std::atan2(cross, glm::dot(in, out));
    }
    return turned < 3 * std::numbers::pi; // once round, not twice
}

std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const glm::vec3> points,
                                                      std::span<const std::uint32_t> corners) {
    const std::vector<glm::dvec2> flat = flatten(points, corners);
    std::vector<std::uint32_t> left(corners.size());
    for (std::uint32_t i = 0; i < left.size(); ++i) left[i] = i;

    const auto isEar = [&](std::size_t i) {
        const std::size_t n = left.size();
        const std::uint32_t a = left[(i + n - 1) % n], b = left[i], c = left[(i + 1) % n];
        if (turn(flat[a], flat[b], flat[c]) <= 0) return false;
        for (std::uint32_t other : left) {
            if (other == a || other == b || other == c) continue;
            if (flat[other] == flat[a] || flat[other] == flat[b] || flat[other] == flat[c])
                continue;
            if (insideTriangle(flat[other], flat[a], flat[b], flat[c])) return false;
        }
        return true;
    };

    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::size_t i = 0, misses = 0;
    while (left.size() > 3) {
        const std::size_t n = left.size();
        i %= n;
        const bool stuck = misses > n; // crosses itself: take what there is
        if (stuck || isEar(i)) {
            triangles.push_back(
                {corners[left[(i + n - 1) % n]], corners[left[i]], corners[left[(i + 1) % n]]});
            left.erase(left.begin() + std::ptrdiff_t(i));
            misses = 0;
        } else {
            ++i;
            ++misses;
        }
    }
    triangles.push_back({corners[left[0]], corners[left[1]], corners[left[2]]});
    return triangles;
}

} // namespace penumbra
