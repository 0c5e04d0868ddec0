#include "radiosity/mesh/PatchGeometry.h"

#include <algorithm>

namespace penumbra {

bool measurePatch(const PatchSet& set, std::span<const std::uint32_t> elements, Patch& patch) {
    glm::vec3 areaVector(0), centre(0);
    patch.area = 0;
    for (std::uint32_t e : elements) {
        const Element& element = set.elements[e];
        std::array<glm::vec3, 4> p;
        for (std::size_t k = 0; k < 4; ++k) p[k] = set.vertices[element.vertices[k]].position;
        const glm::vec3 vector = 0.5f * glm::cross(p[2] - p[0], p[3] - p[1]);
        const float area = glm::length(vector);
        patch.area += area;
        areaVector += vector;
        centre += area * (element.isTriangle() ? (p[0] + p[1] + p[2]) / 3.0f
                                               : 0.25f * (p[0] + p[1] + p[2] + p[3]));
    }
    if (!(patch.area > 0)) return false;
    patch.centre = centre / patch.area;
    patch.normal = glm::length(areaVector) > 0 // not if it folds back on itself
                       ? glm::normalize(areaVector)
                       : set.vertices[set.elements[elements[0]].vertices[0]].receiver.normal;
    return true;
}

NodePlaces findNodePlaces(const PatchSet& set, const Patch& patch,
                          std::span<const std::uint32_t> elements, const PatchRectangle& spans) {
    const glm::vec2 low = spans.low, high = spans.high, middle = 0.5f * (low + high);
    const std::array<glm::vec2, 4> corner{low, glm::vec2(high.x, low.y), high,
                                          glm::vec2(low.x, high.y)};
    NodePlaces places;
    std::array<float, 4> nearest;
    nearest.fill(1e30f);
    float nearestMiddle = 1e30f, extent = 0;
    for (std::uint32_t e : elements) {
        const Element& element = set.elements[e];
        const auto& coordinates = set.parts.elementCoordinates[e];
        const std::uint32_t count = element.isTriangle() ? 3 : 4;
        glm::vec2 st(0);
        glm::vec3 position(0), normal(0);
        for (std::uint32_t k = 0; k < count; ++k) {
            const Receiver& receiver = set.vertices[element.vertices[k]].receiver;
            extent = std::max(extent, glm::distance(receiver.position, patch.centre));
            st += coordinates[k] / float(count);
            position += receiver.position / float(count);
            normal += receiver.normal;
            for (std::size_t c = 0; c < 4; ++c) {
                const glm::vec2 d = coordinates[k] - corner[c];
                if (glm::dot(d, d) >= nearest[c]) continue;
                nearest[c] = glm::dot(d, d);
                places.vertices[c] = element.vertices[k];
                places.corners[c] = 4 * e + k;
            }
        }
        const float distance = glm::dot(st - middle, st - middle);
        if (distance < nearestMiddle) {
            nearestMiddle = distance;
            places.centre = {position, glm::normalize(normal)};
            places.centreElement = e;
        }
    }
    places.small = 2 * extent < 0.6f * set.patchSize && !patch.smooth;
    return places;
}

} // namespace penumbra
