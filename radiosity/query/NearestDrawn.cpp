#include "radiosity/query/NearestDrawn.h"

#include "radiosity/rays/Margins.h"

#include <algorithm>

namespace penumbra {

namespace {

using Corners = std::array<glm::vec3, 3>;
using Weights = std::array<float, 3>;

glm::vec3 mix(const Corners& corners, const Weights& w) {
    return w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2];
}

/// Barycentric weights of the point of a triangle that is nearest to another point.
Weights nearestWeights(const Corners& corners, glm::vec3 point) {
    const glm::vec3 normal =
        glm::cross(corners[1] - corners[0], corners[2] - corners[0]); // twice the area long
    const float size = glm::dot(normal, normal);
    Weights inside{-1, -1, -1};
    for (std::size_t k = 0; k < 3 && size > 0; ++k) {
        const glm::vec3 a = corners[(k + 1) % 3], b = corners[(k + 2) % 3];
        inside[k] = glm::dot(glm::cross(b - a, point - a), normal) / size;
    }
    if (inside[0] >= 0 && inside[1] >= 0 && inside[2] >= 0) return inside;
    Weights best{1, 0, 0}; // else it lies on an edge
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec3 a = corners[k], edge = corners[(k + 1) % 3] - a;
        const float length2 = glm::dot(edge, edge);
        const float t =
            length2 > 0 ? std::clamp(glm::dot(point - a, edge) / length2, 0.0f, 1.0f) : 0.0f;
        const glm::vec3 away = point - (a + t * edge);
        if (glm::dot(away, away) >= least) continue;
        least = glm::dot(away, away);
        best = {};
        best[k] = 1 - t;
        best[(k + 1) % 3] = t;
    }
    return best;
}

} // namespace

DrawnHit nearestDrawn(const PatchSet& patches, glm::vec3 point, float reach) {
    DrawnHit best;
    float least = std::numeric_limits<float>::infinity();
    const float hover = hoverAt(patches.skin, point);
    const auto tryTriangle = [&](std::uint32_t e, std::array<std::uint32_t, 3> vertices,
                                 bool second) {
        Corners corners;
        for (std::size_t k = 0; k < 3; ++k) corners[k] = patches.vertices[vertices[k]].position;
        const Weights weights = nearestWeights(corners, point);
        const glm::vec3 away = point - mix(corners, weights);
        const float distance = glm::length(away);
        if (!(distance <= reach)) return;
        const bool behind =
            glm::dot(away, glm::cross(corners[1] - corners[0], corners[2] - corners[0])) < 0;
        // Rounding decides between surfaces that coincide.
        const float rank = distance + (behind ? hover : 0) + (patches.receives(e) ? 0 : 2 * hover);
        if (rank >= least) return;
        least = rank;
        best = {e, vertices, weights, distance, second};
    };
    for (std::uint32_t e = 0; e < patches.elements.size(); ++e) {
        if (!patches.objects[patches.elementObject[e].value].present) continue;
        const auto& v = patches.elements[e].vertices;
        tryTriangle(e, {v[0], v[1], v[2]}, false); // cut as they are drawn
        if (!patches.elements[e].isTriangle()) tryTriangle(e, {v[0], v[2], v[3]}, true);
    }
    return best;
}

glm::vec3 positionOf(const PatchSet& patches, const DrawnHit& hit) {
    glm::vec3 position(0);
    for (std::size_t k = 0; k < 3; ++k)
        position += hit.weights[k] * patches.vertices[hit.vertices[k]].position;
    return position;
}

glm::vec3 normalOf(const PatchSet& patches, const DrawnHit& hit) {
    glm::vec3 normal(0);
    for (std::size_t k = 0; k < 3; ++k)
        normal += hit.weights[k] * patches.vertices[hit.vertices[k]].receiver.normal;
    // Corners that nothing lights have no normal.
    const glm::vec3 a = patches.vertices[hit.vertices[0]].position,
                    b = patches.vertices[hit.vertices[1]].position,
                    c = patches.vertices[hit.vertices[2]].position;
    return glm::normalize(normal == glm::vec3(0) ? glm::cross(b - a, c - a) : normal);
}

} // namespace penumbra
