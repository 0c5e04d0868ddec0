// The patches of a scene, posed: with its objects where they are, for rays and with their contacts.
#pragma once

#include "base/Progress.h"
#include "radiosity/mesh/Coverage.h"
#include "radiosity/mesh/PatchSet.h"
#include "radiosity/rays/RayScene.h"

#include <span>
#include <vector>

namespace penumbra {

/// Rays through what is there of a set, in its poses.
RayScene raysThrough(const PatchSet& set);

/// Keeps a PatchSet, the rays through it and what its objects cover of each other true to where
/// they stand. All three depend on the poses alone and not on how things came there, apart from
/// which private vertices replace which corners.
class PosedPatches {
public:
    /// Everything has the pose that the set says. \param set must outlive this
    explicit PosedPatches(PatchSet& set, const Progress& progress = {});
    PosedPatches(const PosedPatches&) = delete;
    PosedPatches& operator=(const PosedPatches&) = delete;

    /// Takes in objects that came to the set. They are hidden until they are posed.
    void add(std::span<const ObjectId> objects);

    /// The pose that an object is to have.
    struct ObjectPose {
        ObjectId object;
        Pose pose;
        bool present = true;
    };
    struct Change {
        std::vector<ObjectId> objects; ///< of which the pose changed
        Coverage::Change covered;
    };
    /// Puts objects elsewhere, hides or shows them; costs what changes.
    Change pose(std::span<const ObjectPose> wanted);

    /// Rays can be traced against each of these alone.
    void setAlone(std::span<const ObjectId> objects);

    const RayScene& rays() const { return rays_; }
    /// See Parting.
    bool exhausted() const { return coverage_.exhausted(); }

private:
    PatchSet& set_;
    RayScene rays_;
    Coverage coverage_;
};

} // namespace penumbra
