#include "radiosity/Walls.h"

#include "radiosity/Shaft.h"

#include <array>

namespace penumbra {

namespace {

std::array<glm::vec3, 8> cornersOf(const Bounds& box) {
    std::array<glm::vec3, 8> corners;
    for (int i = 0; i < 8; ++i)
        corners[std::size_t(i)] = {i & 1 ? box.upper.x : box.lower.x,
                                   i & 2 ? box.upper.y : box.lower.y,
                                   i & 4 ? box.upper.z : box.lower.z};
    return corners;
}

bool isInside(const Wall& wall, glm::vec3 point, float margin) {
    for (std::size_t i = 0; i < wall.outline.size(); ++i) {
        const glm::vec3 from = wall.outline[i];
        const glm::vec3 along = wall.outline[(i + 1) % wall.outline.size()] - from;
        const glm::vec3 inwards = glm::cross(wall.normal, along);
        if (glm::dot(inwards, point - from) < margin * glm::length(inwards)) return false;
    }
    return true;
}

} // namespace

Walls::Walls(const PatchSet& set) : walls_(set.walls), margin_(2e-5f * set.extent) {
    std::vector<Bounds> boxes;
    for (const Wall& wall : walls_) {
        Bounds box;
        for (glm::vec3 point : wall.outline) box.add(point);
        boxes.push_back(box);
    }
    boxes_.assign(std::move(boxes));
}

bool Walls::hides(const Wall& wall, const Bounds& a, const Bounds& b) const {
    const auto ca = cornersOf(a), cb = cornersOf(b);
    std::array<float, 8> da, db; // heights over the wall's plane, both positive in the end
    const float sign = glm::dot(wall.normal, ca[0] - wall.outline[0]) > 0 ? 1.0f : -1.0f;
    for (std::size_t i = 0; i < 8; ++i) {
        da[i] = sign * glm::dot(wall.normal, ca[i] - wall.outline[0]);
        db[i] = -sign * glm::dot(wall.normal, cb[i] - wall.outline[0]);
        if (da[i] < margin_ || db[i] < margin_) return false;
    }
    for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t j = 0; j < 8; ++j)
            if (!isInside(wall, glm::mix(ca[i], cb[j], da[i] / (da[i] + db[j])), margin_))
                return false;
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

} // namespace penumbra
