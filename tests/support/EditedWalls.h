// Random edits of what hides rooms from each other.
#pragma once

#include "scenegraph/Group.h"
#include "scenegraph/Scene.h"
#include "scenegraph/Transform.h"

#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace penumbra {

/// Puts partitions into an EditableRoom, some of them hidden or not there at first, and moves,
/// hides, shows, resizes, takes out and brings back these, the table and the room itself. Two
/// partitions are movable, so that moves of them are followed.
class EditedWalls {
public:
    EditedWalls(const Scene& scene, std::uint32_t seed);

    /// One random edit. \return what was done, for people
    std::string edit();

private:
    struct Partition {
        std::shared_ptr<Transform> node;
        std::shared_ptr<Switch> choice; ///< hides it
        bool isThere = true;
    };
    void add(const std::string& name);
    std::string editPartition(Partition& partition);
    glm::dmat4 anywhere();
    double uniform(double low, double high);
    std::size_t below(std::size_t count) { return random_() % count; }

    const Scene& scene_;
    std::mt19937 random_;
    std::vector<Partition> partitions_;
    std::vector<std::shared_ptr<Transform>> others_; ///< stand where they are meshed
};

} // namespace penumbra
