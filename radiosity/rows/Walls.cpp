#include "radiosity/rows/Walls.h"

#include "radiosity/rays/Margins.h"
#include "radiosity/rays/Shaft.h"

#include <algorithm>
#include <array>

namespace penumbra {

namespace {

/// Of a box's corners, or of a point, above a plane [m].
template <std::size_t kCount>
using Heights = std::array<float, kCount>;

float heightOf(glm::vec3 point, const Walls::Plane& plane) {
    return glm::dot(plane.normal, point) - plane.offset;
}

Heights<8> heightsOf(const Bounds& box, const Walls::Plane& plane) {
    Heights<8> heights;
    for (std::size_t i = 0; i < 8; ++i)
        heights[i] = heightOf({i & 1 ? box.upper.x : box.lower.x, i & 2 ? box.upper.y : box.lower.y,
                               i & 4 ? box.upper.z : box.lower.z},
                              plane);
    return heights;
}

Heights<1> heightsOf(glm::vec3 point, const Walls::Plane& plane) {
    return {heightOf(point, plane)};
}

float magnitudeOf(const Bounds& box) {
    return magnitude(box);
}
float magnitudeOf(glm::vec3 point) {
    return magnitude({point, point});
}

template <std::size_t kCount>
float lowest(const Heights<kCount>& heights) {
    return *std::min_element(heights.begin(), heights.end());
}
template <std::size_t kCount>
float highest(const Heights<kCount>& heights) {
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

/// \param b a box or a point
template <class There>
bool Walls::hides(const Sides& wall, const Bounds& a, const There& b) const {
    const float margin =
        clearanceAt(set_.skin, std::max({magnitude(wall.box), magnitude(a), magnitudeOf(b)}));
    auto ha = heightsOf(a, wall.plane);
    auto hb = heightsOf(b, wall.plane);
    const float sign = ha[0] > 0 ? 1.0f : -1.0f;
    for (float& height : ha) height *= sign;
    for (float& height : hb) height *= -sign;
    if (lowest(ha) < margin || lowest(hb) < margin) return false;
    // The segment between corners i and j meets the plane at (hb_j a_i + ha_i b_j) / (ha_i + hb_j).
    for (const Plane& edge : wall.edges) {
        const Plane inside{edge.normal, edge.offset + margin};
        const auto ea = heightsOf(a, inside);
        const auto eb = heightsOf(b, inside);
        unsigned outside = 0; // counted, not compared: so a compiler takes eight at a time
        for (std::size_t j = 0; j < eb.size(); ++j)
            for (std::size_t i = 0; i < ea.size(); ++i)
                outside += hb[j] * ea[i] + ha[i] * eb[j] < 0 ? 1u : 0u;
        if (outside > 0) return false;
    }
    return true;
}

bool Walls::isHidden(std::uint32_t wall, const Bounds& from, glm::vec3 point) const {
    return hides(walls_[wall], from, point);
}

bool Walls::isHidden(std::uint32_t wall, const Bounds& from, const Bounds& box) const {
    return hides(walls_[wall], from, box);
}

ObjectId Walls::between(const Bounds& a, const Bounds& b) const {
    ObjectId found;
    if (walls_.empty() || a.empty() || b.empty()) return found;
    // What crosses all segments crosses that between the middles, inside of its edges by a margin.
    const float pad = clearanceAt(set_.skin, std::max(magnitude(a), magnitude(b)));
    const Bounds middle{a.centre() - pad, a.centre() + pad};
    const glm::vec3 way = b.centre() - a.centre();
    const auto crosses = [&](std::size_t n) {
        return !found.valid() && sweepMeets(middle, way, way, 1, boxes_.node(n));
    };
    boxes_.query(crosses, [&](std::size_t i) {
        if (hides(walls_[i], a, b)) found = walls_[i].object;
    });
    return found;
}

bool Walls::isBeside(std::size_t wall, const Bounds& a, const Bounds& b) const {
    const auto ha = heightsOf(a, walls_[wall].plane);
    const auto hb = heightsOf(b, walls_[wall].plane);
    return (lowest(ha) > 0 && lowest(hb) < 0) || (highest(ha) < 0 && highest(hb) > 0);
}

std::vector<std::uint32_t> Walls::beside(const Bounds& a, const Bounds& b) const {
    std::vector<std::uint32_t> walls;
    if (a.empty() || b.empty()) return walls;
    boxes_.query([&](std::size_t n) { return shaftMeets(a, b, boxes_.node(n)); },
                 [&](std::size_t i) {
                     if (isBeside(i, a, b)) walls.push_back(std::uint32_t(i));
                 });
    return walls;
}

std::vector<std::uint32_t> Walls::beside(const Bounds& a, const Bounds& b,
                                         std::span<const MovedObject> objects) const {
    std::vector<std::uint32_t> walls;
    if (a.empty() || b.empty()) return walls;
    for (const MovedObject& object : objects) {
        if (!object.present) continue;
        const Range all = set_.objects[object.object].walls;
        for (std::uint32_t i = all.first; i < all.end(); ++i)
            if (shaftMeets(a, b, boxes_[i]) && isBeside(i, a, b)) walls.push_back(i);
    }
    return walls;
}

bool Walls::areAmong(std::span<const MovedObject> objects) const {
    return std::ranges::any_of(objects, [&](const MovedObject& object) {
        return object.present && set_.objects[object.object].walls.count > 0;
    });
}

} // namespace penumbra
