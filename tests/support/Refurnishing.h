// Random edits of what a scene is made of.
#pragma once

#include "scenegraph/Scene.h"
#include "scenegraph/Transform.h"

#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace penumbra {

/// Brings things into a room of 3 x 2.5 x 2 m and takes them out: blocks,
/// partitions, lights, hollow boxes around lights, blocks that shine; resizes, mirrors and moves
/// them, shrinks them to nothing, gives them another mesh, says that they begin an object or not.
class Refurnishing {
public:
    Refurnishing(const Scene& scene, std::uint32_t seed) : scene_(scene), random_(seed) {}

    /// One random edit, or a few at once. \return what was done, for people
    std::string edit();
    /// Takes out all that is left of what was brought in.
    void clear();

private:
    std::string add();
    std::string change(std::size_t which);
    std::vector<NodePtr> content();
    glm::dmat4 anywhere();
    float uniform(float low, float high);
    std::size_t below(std::size_t count) { return random_() % count; }

    const Scene& scene_;
    std::mt19937 random_;
    std::vector<std::shared_ptr<Transform>> added_;
};

} // namespace penumbra
