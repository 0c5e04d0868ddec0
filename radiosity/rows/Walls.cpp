#include "radiosity/rows/Walls.h"

#include "radiosity/rays/Margins.h"
#include "radiosity/rays/Shaft.h"

#include <algorithm>
#include <array>

namespace penumbra {

namespace {

using Heights = std::array<float, 8>;

/// Of a box's corners above a plane [m].
Heights heightsOf(const Bounds& box, const Walls::Plane& plane) {
    Heights heights;
    for (std::size_t i = 0; i < 8; ++i) {
        const glm::vec3 corner{i & 1 ? box.upper.x : box.lower.x, i & 2 ? box.upper.y : box.lower.y,
                               i & 4 ? box.upper.z : box.lower.z};
        heights[i] = glm::dot(plane.normal, corner) - plane.offset;
    }
    return heights;
}

float lowest(const Heights& heights) {
    return *std::min_element(heights.begin(), heights.end());
}
float highest(const Heights& heights) {
    return *std::max_element(heights.begin(), heights.end());
}

} // namespace

Walls::Walls(const PatchSet& set) : set_(set), walls_(set.walls.size()) {
    boxes_.assign(std::vector<Bounds>(walls_.size()));
    for (std::uint32_t o = 0; o < set.objects.size(); ++o) place({o});
}

void Walls::grow() {
    for (std::size_t i = walls_.size(); i < set_.walls.size(); ++i) boxes_.append({});
    walls_.resize(set_.walls.size());
}

Walls::Sides Walls::sidesOf(const Wall& wall) {
    Sides sides{wall.object, {wall.normal, glm::dot(wall.normal, wall.outline[0])}, {}, {}};
    for (std::size_t i = 0; i < wall.outline.size(); ++i) {
        const glm::vec3 from = wall.outline[i];
        const glm::vec3 along = wall.outline[(i + 1) % wall.outline.size()] - from;
        if (along == glm::vec3(0)) continue;
        const glm::vec3 inwards = glm::normalize(glm::cross(wall.normal, along));
        sides.edges.push_back({inwards, glm::dot(inwards, from)});
        sides.box.add(from);
    }
    return sides;
}

void Walls::place(ObjectId object) {
    const ObjectPart& part = set_.objects[object.value];
    for (std::uint32_t i = part.walls.first; i < part.walls.end(); ++i) {
        walls_[i] = sidesOf(set_.walls[i]);
        boxes_.set(i, part.present ? walls_[i].box : Bounds());
    }
}

bool Walls::hides(const Sides& wall, const Bounds& a, const Bounds& b) const {
    const float margin =
        clearanceAt(set_.skin, std::max({magnitude(wall.box), magnitude(a), magnitude(b)}));
    Heights ha = heightsOf(a, wall.plane), hb = heightsOf(b, wall.plane);
    const float sign = ha[0] > 0 ? 1.0f : -1.0f;
    for (std::size_t i = 0; i < 8; ++i) ha[i] *= sign, hb[i] *= -sign;
    if (lowest(ha) < margin || lowest(hb) < margin) return false;
    // The segment between corners i and j meets the plane at (hb_j a_i + ha_i b_j) / (ha_i + hb_j).
    for (const Plane& edge : wall.edges) {
        const Plane inside{edge.normal, edge.offset + margin};
        const Heights ea = heightsOf(a, inside), eb = heightsOf(b, inside);
        float least = 0;
        for (std::size_t i = 0; i < 8; ++i)
            for (std::size_t j = 0; j < 8; ++j)
                least = std::min(least, hb[j] * ea[i] + ha[i] * eb[j]);
        if (least < 0) return false;
    }
    return true;
}

ObjectId Walls::between(const Bounds& a, const Bounds& b) const {
    ObjectId found;
    if (walls_.empty() || a.empty() || b.empty()) return found;
    boxes_.query([&](std::size_t n) { return !found.valid() && shaftMeets(a, b, boxes_.node(n)); },
                 [&](std::size_t i) {
                     if (!found.valid() && hides(walls_[i], a, b)) found = walls_[i].object;
                 });
    return found;
}

std::vector<std::uint32_t> Walls::beside(const Bounds& a, const Bounds& b) const {
    std::vector<std::uint32_t> walls;
    if (a.empty() || b.empty()) return walls;
    boxes_.query([&](std::size_t n) { return shaftMeets(a, b, boxes_.node(n)); },
                 [&](std::size_t i) {
                     const Heights ha = heightsOf(a, walls_[i].plane),
                                   hb = heightsOf(b, walls_[i].plane);
                     if ((lowest(ha) > 0 && lowest(hb) < 0) || (highest(ha) < 0 && highest(hb) > 0))
                         walls.push_back(std::uint32_t(i));
                 });
    return walls;
}

bool Walls::areAmong(std::span<const MovedObject> objects) const {
    return std::ranges::any_of(objects, [&](const MovedObject& object) {
        return object.present && set_.objects[object.object].walls.count > 0;
    });
}

} // namespace penumbra
