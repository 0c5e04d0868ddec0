#include "tests/support/EditedWalls.h"

#include "tests/support/Scenes.h"

namespace penumbra {

EditedWalls::EditedWalls(const Scene& scene, std::uint32_t seed) : scene_(scene), random_(seed) {
    for (const NodePtr& node : scene.root->children())
        if (node->name() == "room" || node->name() == "table")
            others_.push_back(std::dynamic_pointer_cast<Transform>(node));
    for (const char* name : {"screen", "divider", "board"}) add(name);
}

void EditedWalls::add(const std::string& name) {
    // Large enough for a wall in EditableRoom::meshing(), and as large as a cut of the room.
    const glm::vec3 half(0.02f, float(uniform(0.95, 1.4)), float(uniform(0.9, 1.2)));
    const auto node = make<Transform>(
        name, {std::make_shared<Mesh>("mesh", boxData(-half, half, false, paint(Rgb(0.4f))))});
    node->setMatrix(anywhere());
    node->setMovable(name != "board"); // which is fixed: an edit of it meshes anew
    node->setBeginsObject(true);
    const auto choice = make<Switch>(name + "Switch", {node});
    choice->setVisible(below(4) != 0);
    scene_.root->add(choice);
    partitions_.push_back({node, choice});
}

double EditedWalls::uniform(double low, double high) {
    return low + (high - low) * double(random_()) / double(0xffffffffu);
}

/// Across the room one way or the other, at any angle, or lying.
glm::dmat4 EditedWalls::anywhere() {
    const glm::dmat4 at = moved(uniform(0.2, 2.8), uniform(0.2, 2.3), uniform(0.8, 1.2));
    switch (below(4)) {
    case 0:
        return at;
    case 1:
        return glm::rotate(at, 1.5707963267948966, glm::dvec3(0, 0, 1));
    case 2:
        return glm::rotate(at, 1.5707963267948966, glm::dvec3(0, 1, 0));
    default:
        return glm::rotate(at, uniform(0, 6.28), glm::dvec3(uniform(-0.3, 0.3), 0, 1));
    }
}

std::string EditedWalls::edit() {
    if (below(5) != 0) return editPartition(partitions_[below(partitions_.size())]);
    Transform& other = *others_[below(others_.size())];
    other.setMatrix(below(3) == 0 ? glm::dmat4(1.0)
                                  : moved(uniform(-0.3, 0.3), uniform(-0.2, 0.2), 0));
    return other.name() + " moved; ";
}

std::string EditedWalls::editPartition(Partition& partition) {
    Transform& node = *partition.node;
    switch (below(8)) {
    case 0:
        partition.choice->setVisible(!partition.choice->visible());
        return node.name() + (partition.choice->visible() ? " shown; " : " hidden; ");
    case 1:
        partition.isThere = !partition.isThere;
        if (partition.isThere)
            partition.choice->add(partition.node);
        else
            partition.choice->remove(partition.node);
        return node.name() + (partition.isThere ? " brought back; " : " taken out; ");
    case 2:
        node.setMatrix(node.matrix() * glm::scale(glm::dmat4(1.0), {1, uniform(0.6, 1.5), 1}));
        return node.name() + " resized; ";
    case 3:
    case 4:
        node.setMatrix(moved(uniform(-0.1, 0.1), uniform(-0.1, 0.1), 0) * node.matrix());
        return node.name() + " nudged; ";
    default:
        node.setMatrix(anywhere());
        return node.name() + " placed; ";
    }
}

} // namespace penumbra
