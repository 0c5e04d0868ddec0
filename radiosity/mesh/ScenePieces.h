// What the objects of a scene are made of.
#pragma once

#include "scenegraph/Objects.h"

#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace penumbra {

/// The meshes and lights of each object of a scene that was meshed. Keeps them alive, if they are
/// held by shared pointers: another one is never taken for one of them.
class ScenePieces {
public:
    /// Notes what the objects of a scene are made of, in place of what is known of them. What they
    /// were made of before is kept alive as well.
    void note(const PlacedScene& scene);

    /// Objects of `now`, by their numbers there, that are not made of what was noted of them, or of
    /// which nothing was.
    std::vector<ObjectId> others(const PlacedScene& now) const;

private:
    /// One mesh or light of an object: what may not change.
    struct Piece {
        const void* node = nullptr;
        std::shared_ptr<const Node> kept; ///< it, with its materials, though the scene may drop it
        std::string path;
        glm::dmat4 frame{1.0}; ///< in its object's frame
    };
    std::unordered_map<std::string, std::vector<Piece>> pieces_; ///< by the object's path
    std::vector<Piece> before_; ///< of objects that are made of others now
};

/// The part of a scene that some of its objects are, in this order.
PlacedScene partOf(const PlacedScene& scene, std::span<const ObjectId> objects);

} // namespace penumbra
