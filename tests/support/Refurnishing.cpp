#include "tests/support/Refurnishing.h"

#include "tests/support/Scenes.h"

#include <algorithm>

namespace penumbra {

float Refurnishing::uniform(float low, float high) {
    return low + (high - low) * float(random_()) / float(0xffffffffu);
}

glm::dmat4 Refurnishing::anywhere() {
    const glm::dmat4 at = moved(uniform(0, 3), uniform(0, 2.5f), below(3) == 0 ? 0 : uniform(0, 2));
    return below(2) == 0 ? at : glm::rotate(at, double(uniform(0, 6.28f)), glm::dvec3(0, 0, 1));
}

std::vector<NodePtr> Refurnishing::content() {
    const glm::vec3 half(uniform(0.1f, 0.3f), uniform(0.1f, 0.3f), uniform(0.1f, 0.3f));
    const auto box = [&](glm::vec3 size, Rgb emission = {}) {
        return std::make_shared<Mesh>(
            "mesh", boxData(-size, size, false, paint(Rgb(uniform(0.1f, 0.8f)), emission)));
    };
    switch (below(6)) {
    case 0: // a partition, which hides what is behind it altogether
        return {box({0.02f, uniform(0.8f, 2), uniform(0.8f, 2)})};
    case 1:
        return {std::make_shared<Light>("light", RectShape{0.2f, 0.3f}, Rgb(uniform(5, 50)))};
    case 2: // a light in a box: perhaps it is open
        return {std::make_shared<Light>("light", SphereShape{0.05f}, Rgb(uniform(20, 90))),
                below(2) == 0 ? box(half)
                              : std::make_shared<Mesh>("mesh", floorData(-1, 1, -1, 1, 0.2f))};
    case 3:
        return {box(half, Rgb(uniform(1, 10)))};
    default:
        return {box(half)};
    }
}

std::string Refurnishing::add() {
    const auto used = [&](const std::string& name) {
        return std::ranges::any_of(added_, [&](const auto& a) { return a->name() == name; });
    };
    std::size_t number = 0; // names come again
    while (used("added" + std::to_string(number))) ++number;
    auto thing = std::make_shared<Transform>("added" + std::to_string(number));
    for (const NodePtr& node : content()) thing->add(node);
    thing->setMatrix(anywhere());
    thing->setBeginsObject(below(2) == 0);
    scene_.root->add(thing);
    added_.push_back(thing);
    return thing->name() + (thing->beginsObject() ? " (an object)" : "") + " brought in; ";
}

std::string Refurnishing::change(std::size_t which) {
    const std::shared_ptr<Transform> kept = added_[which];
    Transform& thing = *kept;
    switch (below(7)) {
    case 0:
        thing.setMatrix(
            thing.matrix() *
            glm::scale(glm::dmat4(1.0), glm::dvec3(uniform(0.5f, 1.5f), 1, uniform(0.5f, 1.5f))));
        return thing.name() + " resized; ";
    case 1:
        thing.setMatrix(thing.matrix() * glm::scale(glm::dmat4(1.0), glm::dvec3(-1, 1, 1)));
        return thing.name() + " mirrored; ";
    case 2:
        thing.setMatrix(anywhere());
        return thing.name() + " placed; ";
    case 3:
        thing.setBeginsObject(!thing.beginsObject());
        return thing.name() +
               (thing.beginsObject() ? " said to be an object; " : " not said to be one; ");
    case 4:
        for (const NodePtr& node : std::vector(thing.children())) thing.remove(node);
        for (const NodePtr& node : content()) thing.add(node);
        return thing.name() + " made of other things; ";
    case 5:
        thing.setMatrix(thing.matrix() * glm::scale(glm::dmat4(1.0), glm::dvec3(0, 1, 0)));
        return thing.name() + " shrunk to nothing; ";
    default:
        scene_.root->remove(kept);
        added_.erase(added_.begin() + std::ptrdiff_t(which));
        return thing.name() + " taken out; ";
    }
}

std::string Refurnishing::edit() {
    std::string said;
    do { // some come together
        const bool more = added_.empty() || (added_.size() < 4 && below(3) == 0);
        said += more ? add() : change(below(added_.size()));
    } while (below(3) == 0);
    return said;
}

void Refurnishing::clear() {
    for (const auto& thing : added_) scene_.root->remove(thing);
    added_.clear();
}

} // namespace penumbra
