#include "radiosity/Enclosure.h"

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

std::vector<bool> Enclosures::lit(const PatchSet& set) const {
    std::vector<glm::vec3> lights;
    for (const Light& light : lights_)
        if (!set.objects[light.object.value].removed)
            lights.push_back(set.objects[light.object.value].pose.point(light.point));
    std::vector<bool> lit;
    for (const Closed& closed : closed_) {
        const Pose& pose = set.objects[closed.object.value].pose;
        lit.push_back(std::any_of(lights.begin(), lights.end(), [&](glm::vec3 light) {
            return closed.part.contains(pose.inverse(light));
        }));
    }
    return lit;
}

} // namespace penumbra
