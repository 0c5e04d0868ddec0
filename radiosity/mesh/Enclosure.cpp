#include "radiosity/mesh/Enclosure.h"

#include <algorithm>

namespace penumbra {

void Enclosures::addSurface(const SurfaceMesh& mesh, std::span<const SurfaceMesh* const> siblings,
                            ObjectId object) {
    for (ClosedPart& part : closedParts(mesh, siblings))
        closed_.push_back({object, std::move(part)});
}

void Enclosures::addLight(glm::vec3 point, ObjectId object) {
    lights_.push_back({object, point});
}

/// Where lights are that were not removed [m, world]. \param counts of which objects
template <class Counts>
std::vector<glm::vec3> Enclosures::places(const PatchSet& set, const Counts& counts) const {
    std::vector<glm::vec3> places;
    for (const Light& light : lights_)
        if (counts(light.object) && !set.objects[light.object.value].removed)
            places.push_back(set.objects[light.object.value].pose.point(light.point));
    return places;
}

bool Enclosures::holds(const PatchSet& set, const Closed& closed,
                       std::span<const glm::vec3> lights) const {
    const Pose& pose = set.objects[closed.object.value].pose;
    return std::any_of(lights.begin(), lights.end(),
                       [&](glm::vec3 light) { return closed.part.contains(pose.inverse(light)); });
}

std::vector<bool> Enclosures::lit(const PatchSet& set) const {
    const std::vector<glm::vec3> lights = places(set, [](ObjectId) { return true; });
    std::vector<bool> lit;
    for (const Closed& closed : closed_) lit.push_back(holds(set, closed, lights));
    return lit;
}

bool Enclosures::changed(const PatchSet& set, std::span<const ObjectId> objects,
                         const std::vector<bool>& lit) const {
    const auto moved = [&](ObjectId object) {
        return std::find(objects.begin(), objects.end(), object) != objects.end();
    };
    const std::vector<glm::vec3> all = places(set, [](ObjectId) { return true; });
    const std::vector<glm::vec3> some = places(set, moved);
    for (std::size_t c = 0; c < closed_.size(); ++c)
        if (holds(set, closed_[c], lit[c] || moved(closed_[c].object) ? all : some) != lit[c])
            return true;
    return false;
}

} // namespace penumbra
