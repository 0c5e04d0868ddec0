// Large fixed faces that hide one region from another altogether.
#pragma once

#include "base/BoundsTree.h"
#include "radiosity/mesh/PatchSet.h"

#include <vector>

namespace penumbra {

/// The large faces of the fixed part: walls, floors, partitions. Where one of them stands between a
/// emitter and a block of receivers no ray is needed to know that all of them are in its shadow,
/// and the light of a building's other rooms costs nothing here.
class Walls {
public:
    /// Points p with normal . p = offset.
    struct Plane {
        glm::vec3 normal; ///< unit
        float offset;     ///< [m]
    };
    explicit Walls(const PatchSet& set);

    /// An object with a face that every segment between the two boxes crosses, if there is one.
    /// Between convex regions all crossings lie within the hull of those of the 8 x 8 segments
    /// between corners, so these decide. Exact up to clearanceAt(), on the side of not hiding.
    ObjectId between(const Bounds& a, const Bounds& b) const;

private:
    struct Sides {
        ObjectId object;
        Plane plane;
        std::vector<Plane> edges; ///< normals point inwards
        float farthest = 0;       ///< largest coordinate [m]
    };
    bool hides(const Sides& wall, const Bounds& a, const Bounds& b) const;

    std::vector<Sides> walls_;
    BoundsTree boxes_;
    float skin_ = 0; ///< how far receivers hover, at least [m]
};

} // namespace penumbra
