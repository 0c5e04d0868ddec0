#include "viewer/input/Selection.h"

#include "scenegraph/Find.h"

#include <algorithm>

namespace penumbra {

Selection selectionOf(const Scene& scene, const PlacedScene& placed, const Touch& touch) {
    Selection selection;
    selection.object = touch.object;
    selection.objectPath = placed.objects[touch.object.value].path;
    selection.path = touch.path;
    selection.position = touch.position;
    selection.normal = touch.normal;
    selection.material = touch.material;
    selection.node = findAt<Transform>(*scene.root, selection.objectPath);
    if (!selection.node) { // of what belongs to no object, only the light that was touched
        if (const auto light = findAt<Light>(*scene.root, touch.path))
            selection.lights.push_back(light);
        return selection;
    }
    selection.lights = lightsOf(scene, placed, touch.object);
    return selection;
}

std::vector<std::shared_ptr<Light>> lightsOf(const Scene& scene, const PlacedScene& placed,
                                             ObjectId object) {
    std::vector<std::shared_ptr<Light>> lights;
    for (const auto& light : placed.lights)
        if (light.object == object)
            if (const auto node = findAt<Light>(*scene.root, light.path)) lights.push_back(node);
    return lights;
}

std::vector<std::shared_ptr<Light>> allLights(const Scene& scene, const PlacedScene& placed) {
    std::vector<std::shared_ptr<Light>> lights;
    for (const auto& light : placed.lights)
        if (const auto node = findAt<Light>(*scene.root, light.path))
            if (std::find(lights.begin(), lights.end(), node) == lights.end())
                lights.push_back(node);
    return lights;
}

glm::dmat4 matrixFor(const Transform& node, const glm::dmat4& objectToWorld,
                     const glm::dmat4& wanted) {
    // objectToWorld = parent * matrix
    const glm::dmat4 parent = objectToWorld * glm::inverse(node.matrix());
    const glm::dmat4 toParent = glm::inverse(parent);
    glm::dmat4 matrix = node.matrix();
    if (glm::dmat3(wanted) == glm::dmat3(objectToWorld)) {
        matrix[3] += toParent * (wanted[3] - objectToWorld[3]);
        return matrix;
    }
    return toParent * wanted;
}

} // namespace penumbra
