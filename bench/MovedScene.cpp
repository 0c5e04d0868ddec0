#include "bench/MovedScene.h"

#include "base/Error.h"
#include "bench/BenchScene.h"

#include <glm/gtc/matrix_transform.hpp>

#include <sstream>

namespace penumbra {

namespace {

std::shared_ptr<Transform> findTransform(const Scene& scene, const std::string& path) {
    std::istringstream names(path.substr(1));
    std::shared_ptr<Group> at = scene.root;
    for (std::string name; std::getline(names, name, '/');) {
        std::shared_ptr<Group> next;
        for (const NodePtr& child : at->children())
            if (!next && child->name() == name) next = std::dynamic_pointer_cast<Group>(child);
        if (!next) throw Error("no '" + path + "' in the scene");
        at = next;
    }
    auto transform = std::dynamic_pointer_cast<Transform>(at);
    if (!transform) throw Error("'" + path + "' is no transform");
    return transform;
}

/// Position of a copy in a building: 2 x 2 on each storey.
glm::dvec3 offsetOf(int copy, const Bounds& one) {
    const glm::dvec3 pitch = glm::dvec3(one.size()) + 0.5;
    return pitch * glm::dvec3(copy % 2, copy / 2 % 2, copy / 4);
}

} // namespace

MovedScene::MovedScene(const Move& move, int copies) {
    const LoadedScene loaded = loadScene(move.layer);
    scene_ = loaded.scene;
    asked_ = loaded.asked;
    object_ = findTransform(*scene_, move.object);
    const auto setTime = [&](double time) {
        if (loaded.animation) loaded.animation->setTime(time);
        return object_->matrix();
    };
    const glm::dmat4 there = setTime(move.there);
    poses_ = {setTime(move.home), glm::translate(glm::dmat4(1.0), move.shift) * there};

    const Bounds one = placed().bounds;
    for (int copy = 1; copy < copies; ++copy) { // read anew: nodes that are shared move together
        auto frame = std::make_shared<Transform>("copy" + std::to_string(copy));
        frame->setMatrix(glm::translate(glm::dmat4(1.0), offsetOf(copy, one)));
        const LoadedScene another = loadScene(move.layer);
        if (another.animation) another.animation->setTime(move.home);
        frame->add(another.scene->root);
        scene_->root->add(frame);
    }
}

} // namespace penumbra
