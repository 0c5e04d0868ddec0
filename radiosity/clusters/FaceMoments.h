// Integrals over faces: area, vector area, where they are and how thick.
#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

namespace penumbra {

/// Integrals over a set of faces. Those of two sets that share no face add up; so that equal sets
/// have equal sums, add in an order that follows from where the faces are.
struct FaceMoments {
    double area = 0;                ///< integral of  dA [m^2]
    glm::dvec3 vectorArea{0};       ///< integral of n dA [m^2]
    glm::dvec3 first{0};            ///< integral of  p dA [m^3]
    std::array<double, 6> second{}; ///< integral of xx, yy, zz, xy, yz, zx dA [m^4]

    void add(const FaceMoments& other) {
        area += other.area;
        vectorArea += other.vectorArea;
        first += other.first;
        for (std::size_t i = 0; i < second.size(); ++i) second[i] += other.second[i];
    }
    glm::dvec3 centroid() const { return area > 0 ? first / area : glm::dvec3(0); }

    /// Unit mean normal; 0 where front and back cancel.
    glm::dvec3 normal() const {
        const double length = glm::length(vectorArea);
        return length > 0 ? vectorArea / length : glm::dvec3(0);
    }
    /// Mean square distance [m^2] from the plane through the centroid with normal n.
    double variance(glm::dvec3 n) const {
        const double mean = glm::dot(n, first) / area;
        const double square =
            n.x * n.x * second[0] + n.y * n.y * second[1] + n.z * n.z * second[2] +
            2 * (n.x * n.y * second[3] + n.y * n.z * second[4] + n.z * n.x * second[5]);
        return std::max(0.0, square / area - mean * mean);
    }
};

/// Of one polygon, convex and as good as flat. Its bits depend on which corner comes first.
FaceMoments momentsOf(std::span<const glm::vec3> points, std::span<const std::uint32_t> corners);

} // namespace penumbra
