#include "radiosity/mesh/Enclosure.h"

#include <algorithm>
#include <utility>

namespace penumbra {

void Enclosures::addSurface(const SurfaceMesh& mesh, std::span<const SurfaceMesh* const> siblings,
                            ObjectId object) {
    for (ClosedPart& part : closedParts(mesh, siblings))
        closed_.push_back({object, std::move(part), false});
}

void Enclosures::addLight(glm::vec3 point, ObjectId object,
                          std::shared_ptr<const Material> material) {
    lights_.push_back({object, point, std::move(material)});
}

std::vector<glm::vec3>
Enclosures::lights(const std::function<const Pose*(ObjectId)>& poseOf) const {
    std::vector<glm::vec3> places;
    for (const Light& light : lights_) {
        if (light.material && !light.material->emissive()) continue;
        if (const Pose* const pose = poseOf(light.object))
            places.push_back(pose->point(light.point));
    }
    return places;
}

bool Enclosures::holds(const PatchSet& set, const Closed& closed,
                       std::span<const glm::vec3> lights) const {
    const Pose& pose = set.objects[closed.object.value].pose;
    std::vector<glm::vec3> inFrame;
    for (const glm::vec3 light : lights) inFrame.push_back(pose.inverse(light));
    return closed.part.containsAny(inFrame);
}

void Enclosures::decide(const PatchSet& set, std::span<const glm::vec3> others) {
    std::vector<glm::vec3> all =
        lights([&](ObjectId object) { return &set.objects[object.value].pose; });
    all.insert(all.end(), others.begin(), others.end());
    for (Closed& closed : closed_) closed.lit = holds(set, closed, all);
}

std::size_t Enclosures::litCount() const {
    return std::size_t(std::ranges::count(closed_, true, &Closed::lit));
}

std::vector<ObjectId> Enclosures::changed(const PatchSet& set,
                                          std::span<const ObjectId> objects) const {
    const auto moved = [&](ObjectId object) {
        return std::find(objects.begin(), objects.end(), object) != objects.end();
    };
    const auto there = [&](ObjectId object) {
        const ObjectPart& part = set.objects[object.value];
        return part.removed ? nullptr : &part.pose;
    };
    const std::vector<glm::vec3> all = lights(there);
    const std::vector<glm::vec3> some =
        lights([&](ObjectId object) { return moved(object) ? there(object) : nullptr; });
    std::vector<ObjectId> changed;
    for (const Closed& closed : closed_) {
        const bool isHeld = holds(set, closed, closed.lit || moved(closed.object) ? all : some);
        if (isHeld != closed.lit && (changed.empty() || changed.back() != closed.object))
            changed.push_back(closed.object);
    }
    return changed;
}

void Enclosures::add(const Enclosures& others, std::uint32_t firstObject) {
    for (Closed closed : others.closed_) {
        closed.object.value += firstObject;
        closed_.push_back(std::move(closed));
    }
    for (Light light : others.lights_) {
        light.object.value += firstObject;
        lights_.push_back(light);
    }
}

void Enclosures::remove(ObjectId object) {
    const auto isOf = [&](const auto& one) { return one.object == object; };
    std::erase_if(closed_, isOf);
    std::erase_if(lights_, isOf);
}

} // namespace penumbra
