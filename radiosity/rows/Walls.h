// Large faces that hide one region from another altogether.
#pragma once

#include "base/BoundsTree.h"
#include "radiosity/mesh/PatchSet.h"
#include "radiosity/rows/MovedObject.h"

#include <span>
#include <vector>

namespace penumbra {

/// The large faces of the objects that are there: walls, floors, partitions. Where one of them
/// stands between an emitter and a block of receivers no ray is needed to know that all of them are
/// in its shadow, and the light of a building's other rooms costs nothing here.
class Walls {
public:
    /// Points p with normal . p = offset.
    struct Plane {
        glm::vec3 normal; ///< unit
        float offset;     ///< [m]
    };
    /// \param set must outlive this
    explicit Walls(const PatchSet& set);

    /// Follows an object that was posed anew, hidden or shown.
    void place(ObjectId object);

    /// An object with a face that every segment between the two boxes crosses, if there is one.
    /// Between convex regions all crossings lie within the hull of those of the 8 x 8 segments
    /// between corners, so these decide. Exact up to clearanceAt(), on the side of not hiding.
    ObjectId between(const Bounds& a, const Bounds& b) const;
    /// The same, of some objects alone.
    ObjectId between(const Bounds& a, const Bounds& b, std::span<const MovedObject> objects) const;
    /// Whether any of some objects has a face that may hide anything.
    bool areAmong(std::span<const MovedObject> objects) const;

private:
    struct Sides {
        ObjectId object;
        Plane plane;
        std::vector<Plane> edges; ///< normals point inwards
        Bounds box;
    };
    static Sides sidesOf(const Wall& wall);
    bool hides(const Sides& wall, const Bounds& a, const Bounds& b) const;

    const PatchSet& set_;
    std::vector<Sides> walls_; ///< one a wall of the set
    BoundsTree boxes_;         ///< likewise; empty: it is not there [m, world]
};

} // namespace penumbra
