// Large faces that hide one region from another altogether.
#pragma once

#include "base/BoundsTree.h"
#include "radiosity/mesh/PatchSet.h"
#include "radiosity/rows/MovedObject.h"

#include <span>
#include <vector>

namespace penumbra {

/// The large faces of the objects that are there: walls, floors, partitions. Where one of them
/// stands between an emitter and a receiver no ray is needed to know that it is in its shadow; most
/// blocks of receivers lie in it as a whole, and the light of a building's other rooms costs
/// nothing here.
class Walls {
public:
    /// Points p with normal . p = offset.
    struct Plane {
        glm::vec3 normal; ///< unit
        float offset;     ///< [m]
    };
    /// \param set must outlive this
    explicit Walls(const PatchSet& set);

    /// Takes in walls that came to the set.
    void grow();
    /// Follows an object that was posed anew, hidden or shown.
    void place(ObjectId object);

    /// An object with a face that every segment between the two boxes crosses, if there is one.
    /// Between convex regions all crossings lie within the hull of those of the 8 x 8 segments
    /// between corners, so these decide. Exact up to clearanceAt(), on the side of not hiding.
    ObjectId between(const Bounds& a, const Bounds& b) const;
    /// Faces that may stand between all of one box and some of another: part of that lies beyond
    /// them. By number, see isHidden().
    std::vector<std::uint32_t> beside(const Bounds& a, const Bounds& b) const;
    /// Those of them of some objects.
    std::vector<std::uint32_t> beside(const Bounds& a, const Bounds& b,
                                      std::span<const MovedObject> objects) const;
    /// Whether a face hides a point, or all of another box, from all of a box.
    bool isHidden(std::uint32_t wall, const Bounds& from, glm::vec3 point) const;
    bool isHidden(std::uint32_t wall, const Bounds& from, const Bounds& box) const;
    ObjectId objectOf(std::uint32_t wall) const { return walls_[wall].object; }
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
    bool isBeside(std::size_t wall, const Bounds& a, const Bounds& b) const;
    template <class There>
    bool hides(const Sides& wall, const Bounds& a, const There& b) const;

    const PatchSet& set_;
    std::vector<Sides> walls_; ///< one a wall of the set
    BoundsTree boxes_;         ///< likewise; empty: it is not there [m, world]
};

} // namespace penumbra
