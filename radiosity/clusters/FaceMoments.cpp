#include "radiosity/clusters/FaceMoments.h"

namespace penumbra {

namespace {

/// Adds a triangle of area `area`. The integral of xy over it is area/12 (sum of x_i y_i + sum of
/// x_i times sum of y_i).
void addTriangle(FaceMoments& moments, double area, const std::array<glm::dvec3, 3>& p) {
    const glm::dvec3 sum = p[0] + p[1] + p[2];
    const auto second = [&](int i, int j) {
        return area / 12 *
               (p[0][i] * p[0][j] + p[1][i] * p[1][j] + p[2][i] * p[2][j] + sum[i] * sum[j]);
    };
    moments.area += area;
    moments.first += sum * (area / 3);
    for (int i = 0; i < 3; ++i) {
        moments.second[std::size_t(i)] += second(i, i);
        moments.second[std::size_t(i) + 3] += second(i, (i + 1) % 3);
    }
}

} // namespace

FaceMoments momentsOf(std::span<const glm::vec3> points, std::span<const std::uint32_t> corners) {
    FaceMoments moments;
    const auto at = [&](std::size_t i) { return glm::dvec3(points[corners[i]]); };
    const auto half = [&](std::size_t i) {
        return 0.5 * glm::cross(at(i) - at(0), at(i + 1) - at(0));
    };
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) moments.vectorArea += half(i);
    const glm::dvec3 normal = moments.normal();
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        addTriangle(moments, glm::dot(normal, half(i)), {at(0), at(i), at(i + 1)});
    return moments;
}

} // namespace penumbra
