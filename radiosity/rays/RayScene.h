// Rays, by Embree.
#pragma once

#include "base/Bounds.h"
#include "base/BoundsTree.h"
#include "base/ObjectId.h"
#include "radiosity/rays/NearestHit.h"
#include "radiosity/rays/RayMesh.h"
#include "radiosity/rays/ShadowRays.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace penumbra {

/// Whether triangles with a corner there can be traced: in single precision, and without Embree's
/// ending the program because it can't build its hierarchy. \param p [m]
bool canBeTraced(glm::vec3 p);

/// The objects of a scene, each one geometry of its own in one flat Embree scene, so that an object
/// can be moved by refitting, and traced alone. Tracing is thread-safe, changes are not.
///
/// A triangle that has shrunk to a point is not met, nor does a ray meet anything that is not
/// finite (see Traceable.h): whatever comes, Embree does not end the program.
class RayScene {
public:
    /// A segment is tested up to a hair before its end, for the target's own surface is no
    /// obstacle: 1e-4 of its length, or clearanceAt() of its ends if that is more.
    /// \param skin how far a point may be off the triangles that represent its surface, see
    ///             skinOf() [m]
    explicit RayScene(std::span<const RayMesh> objects, float skin = 0);
    ~RayScene();
    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;

    /// Adds an object, which is seen by rays after commit(). Its number follows on the others'.
    void add(const RayMesh& object);
    /// Moves an object to new vertices, as many as it has, or hides it. Seen by rays after
    /// commit().
    void move(ObjectId object, std::span<const glm::vec3> vertices);
    void show(ObjectId object, bool visible);
    /// Can be traced alone from the next commit() on, as what was moved or shown can.
    void setAlone(ObjectId object);
    void commit();

    /// Finds for each segment an object that blocks it, if any.
    void occluded(ShadowRays& rays) const;
    bool occluded(glm::vec3 origin, glm::vec3 target) const;
    /// The same against one object alone. For a segment that nothing else blocks, the answer is
    /// that of the whole scene, bit for bit: what passes by an edge up to rounding is judged by the
    /// triangles alone.
    void occludedBy(ObjectId object, ShadowRays& rays) const;
    /// Which triangles are met: all, those that show their front, or a side that is lit.
    enum class Faces { both, front, lit };
    /// The nearest triangle, up to `reach` times the length of `direction`. The same however the
    /// scene came to be, as NearestHit says.
    RayHit nearest(glm::vec3 origin, glm::vec3 direction, float reach,
                   Faces faces = Faces::both) const;
    /// The same for several rays from one point. \param directions up to ShadowRays::kMost
    /// \param hits is filled, as many
    void nearest(glm::vec3 origin, std::span<const glm::vec3> directions, float reach, Faces faces,
                 std::span<RayHit> hits) const;

    /// All triangles on a ray up to `reach` times the length of `direction`, in no order; `hits` is
    /// emptied first.
    void all(glm::vec3 origin, glm::vec3 direction, float reach, std::vector<RayHit>& hits) const;
    /// How far a ray must go to leave every object with solid triangles (see RayMesh) that may hold
    /// its origin, in lengths of `direction`: out of their boxes. 0: none may.
    float solidsEnd(glm::vec3 origin, glm::vec3 direction) const;

private:
    float reach(glm::vec3 origin, glm::vec3 direction) const;
    void placeSolid(ObjectId object, std::span<const glm::vec3> vertices);
    void trace(void* scene, ShadowRays& rays) const;
    RayHit nearestIn(void* scene, glm::vec3 origin, glm::vec3 direction, float reach,
                     Faces faces) const;

    struct Impl;
    std::unique_ptr<Impl> impl_;
    float skin_ = 0;    ///< [m]
    BoundsTree solids_; ///< around objects with solid triangles; of others and hidden ones empty
};

} // namespace penumbra
