// What a ray meets first, whatever the order in which triangles are tried.
#pragma once

#include "base/ObjectId.h"
#include "radiosity/rays/RayMesh.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <limits>
#include <span>

namespace penumbra {

/// What a ray met first.
struct RayHit {
    float distance = 0; ///< in units of the ray's direction
    ObjectId object;    ///< not valid: nothing was met
    std::uint32_t triangle = 0;
    std::uint64_t key = 0; ///< of the object, see RayMesh
    bool back = false;     ///< the ray met the triangle's back
    float u = 0, v = 0;    ///< barycentric, of the triangle's second and third corner
    glm::vec3 normal{};    ///< of the triangle's front, not unit

    bool met() const { return object.valid(); }
};

/// Whether a ray without end passes through a triangle, judged in double precision: of two
/// triangles that share an edge, it passes one. Not if it runs along the triangle.
bool passes(glm::dvec3 origin, glm::dvec3 direction, std::span<const glm::vec3, 3> corners);

/// Judges the triangles that Embree offers for a ray, in any order. At an edge it offers one
/// triangle or the other, both or none, by rounding and by what else lies in the same leaf of its
/// hierarchy; here the answer depends on the triangles alone. Edges are judged in double precision,
/// and of several triangles at the same distance the first one of the object with the least key is
/// met. Where the ray
/// passes beside a triangle that was offered, those around are to be offered as well, by rays a
/// hair beside it: where they share their corners, one of them is met. Where they do not, the ray
/// itself has to be asked again, a hair farther aside: there it meets the neighbour if there is
/// one, and else what lies behind.
class NearestHit {
public:
    /// \param origin, direction of the ray [m, world; the direction need not be unit]
    NearestHit(glm::vec3 origin, glm::vec3 direction) : origin_(origin), direction_(direction) {
        doubt_.distance = std::numeric_limits<float>::infinity();
    }

    /// \param corners of the triangle, its front is where they go round counter-clockwise
    /// \param hit     what it is called, where Embree thinks that it is met, and its normal
    /// \param sides   that can be met, see Sides
    /// \return whether the ray meets it, nearer than all before or as near
    bool take(std::span<const glm::vec3, 3> corners, const RayHit& hit, std::uint8_t sides);

    double distance() const { return distance_; } ///< of what is met first; infinity: nothing
    const RayHit& hit() const { return hit_; }

    /// How far Embree has to go on once something is met: a hair farther, many times what it rounds
    /// [in units of the direction].
    float searchEnd() const;
    /// Whether the ray passes by a triangle that was offered, with nothing close behind it.
    bool inDoubt() const;
    /// What rounding may make of a point as far away as that triangle [m]. \pre inDoubt()
    float hair() const { return hairAt(doubt_.distance); }
    const RayHit& doubt() const { return doubt_; } ///< the triangle that was offered
    /// How far beside this ray, on all its sides, the i-th of kAround rays of the same direction
    /// begins: a hair [m].
    glm::vec3 beside(float hair, int i) const;
    static constexpr int kAround = 8;
    /// How far beside this ray one of the same direction begins that passes the triangle a hair
    /// farther aside [m].
    glm::vec3 aside(float hair) const;

private:
    float hairAt(double distance) const;

    glm::dvec3 origin_, direction_;
    double distance_ = std::numeric_limits<double>::infinity();
    RayHit hit_;
    RayHit doubt_;
    glm::dvec3 middle_{}; ///< of that triangle, as seen from the origin
};

} // namespace penumbra
