// Small pieces that the scene graph's tests build scenes from.
#pragma once

#include "scenegraph/Camera.h"
#include "scenegraph/Light.h"
#include "scenegraph/Mesh.h"
#include "scenegraph/Scene.h"
#include "scenegraph/Transform.h"

#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <initializer_list>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

namespace penumbra {

/// A mesh of one face.
inline std::shared_ptr<Mesh> polygon(std::string name, std::vector<glm::vec3> points) {
    MeshData data;
    data.faceVertexCounts = {std::int32_t(points.size())};
    data.faceVertexIndices.resize(points.size());
    std::iota(data.faceVertexIndices.begin(), data.faceVertexIndices.end(), 0);
    data.points = std::move(points);
    data.materials = {std::make_shared<Material>("paint")};
    return std::make_shared<Mesh>(std::move(name), std::move(data));
}

/// The square [-1, 1] x [-1, 1] in the plane z = 0, facing +Z.
inline std::shared_ptr<Mesh> square(std::string name) {
    return polygon(std::move(name), {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
}

inline std::shared_ptr<Light> light(std::string name, LightShape shape = RectShape{}) {
    return std::make_shared<Light>(std::move(name), shape, Rgb(100));
}

/// A group of any kind with its children.
template <class T = Group>
std::shared_ptr<T> make(std::string name, std::initializer_list<NodePtr> children) {
    auto group = std::make_shared<T>(std::move(name));
    for (const NodePtr& child : children) group->add(child);
    return group;
}

inline std::shared_ptr<Transform> placed(std::string name, const glm::dmat4& matrix,
                                         std::initializer_list<NodePtr> children) {
    auto transform = make<Transform>(std::move(name), children);
    transform->setMatrix(matrix);
    return transform;
}

inline std::shared_ptr<Transform> objectOf(std::string name,
                                           std::initializer_list<NodePtr> children) {
    auto transform = make<Transform>(std::move(name), children);
    transform->setBeginsObject(true);
    return transform;
}

inline Scene sceneOf(std::initializer_list<NodePtr> children) {
    Scene scene;
    for (const NodePtr& child : children) scene.root->add(child);
    return scene;
}

inline glm::dmat4 moved(double x, double y, double z) {
    return glm::translate(glm::dmat4(1.0), glm::dvec3(x, y, z));
}

inline glm::dmat4 scaled(double factor) {
    return glm::scale(glm::dmat4(1.0), glm::dvec3(factor));
}

} // namespace penumbra
