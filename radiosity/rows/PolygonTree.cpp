#include "radiosity/rows/PolygonTree.h"

#include "radiosity/mesh/Emitters.h"
#include "radiosity/rows/FormFactor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace penumbra {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;
/// Seen from this many radii away, a run of polygons may send as one: its kernel varies by 1 %.
constexpr float kFar = 10;
/// Normals that differ by less may send as one across the edge of what faces the receiver: what is
/// lost there goes by the third power.
constexpr float kNarrow = 0.09f;

} // namespace

PolygonTree::PolygonTree(std::span<const std::vector<glm::vec3>> polygons) : polygons_(polygons) {
    nodes_.reserve(2 * polygons.size());
    if (!polygons.empty()) build(0, polygons.size());
}

std::uint32_t PolygonTree::build(std::size_t first, std::size_t count) {
    const auto index = std::uint32_t(nodes_.size());
    Node node = nodes_.emplace_back();
    node.polygon = std::uint32_t(first);
    node.count = std::uint32_t(count);
    if (count == 1) {
        const std::vector<glm::vec3>& polygon = polygons_[first];
        node.vectorArea = glm::vec3(areaVector(polygon));
        node.area = glm::length(node.vectorArea);
        if (node.area > 0) node.axis = node.vectorArea / node.area;
        for (const glm::vec3 corner : polygon) node.centre += corner / float(polygon.size());
        for (const glm::vec3 corner : polygon)
            node.radius = std::max(node.radius, glm::distance(corner, node.centre));
        nodes_[index] = node;
        return index;
    }
    const std::size_t half = count / 2;
    const std::array<std::uint32_t, 2> halves{build(first, half),
                                              build(first + half, count - half)};
    node.second = halves[1];
    for (const std::uint32_t h : halves) {
        node.area += nodes_[h].area;
        node.vectorArea += nodes_[h].vectorArea;
        node.centre += nodes_[h].area * nodes_[h].centre;
    }
    node.centre = node.area > 0 ? node.centre / node.area : nodes_[halves[0]].centre;
    const float length = glm::length(node.vectorArea);
    if (length > 0) node.axis = node.vectorArea / length;
    for (const std::uint32_t h : halves) {
        const Node& part = nodes_[h];
        node.radius = std::max(node.radius, glm::distance(part.centre, node.centre) + part.radius);
        if (part.area > 0)
            node.spread = std::max(node.spread, glm::distance(part.axis, node.axis) + part.spread);
    }
    nodes_[index] = node;
    return index;
}

float PolygonTree::formFactor(glm::vec3 p, glm::vec3 n) const {
    std::array<std::uint32_t, 64> open; // as deep as 2^63 polygons
    std::size_t left = 0;
    if (!nodes_.empty()) open[left++] = 0;
    double sum = 0;
    while (left > 0) {
        const std::uint32_t index = open[--left];
        const Node& node = nodes_[index];
        const glm::vec3 d = node.centre - p;
        const float height = glm::dot(n, d);
        if (height <= -node.radius || !(node.area > 0)) continue;
        const float d2 = glm::dot(d, d), distance = std::sqrt(d2);
        // How much more or less its polygons may face the receiver than their mean does.
        const float facing = -glm::dot(node.axis, d), range = node.spread * distance + node.radius;
        if (facing <= -range) continue;
        const bool above = height >= node.radius || 2 * kFar * node.radius <= distance;
        const bool front = facing >= range || node.spread <= kNarrow;
        if (above && front && kFar * node.radius <= distance) {
            const float projected = -glm::dot(node.vectorArea, d);
            if (height > 0 && projected > 0) sum += height * projected / (kPi * d2 * d2);
        } else if (node.count == 1) {
            sum += polygonFormFactor(p, n, polygons_[node.polygon]);
        } else {
            open[left++] = node.second;
            open[left++] = index + 1;
        }
    }
    return float(sum);
}

} // namespace penumbra
