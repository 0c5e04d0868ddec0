// The patches of a scene where its movable objects stand, for rays and with their contacts.
#pragma once

#include "radiosity/mesh/Coverage.h"
#include "radiosity/mesh/PatchSet.h"
#include "radiosity/rays/RayScene.h"

#include <span>
#include <vector>

namespace penumbra {

/// Rays through what is there of a set, as it stands.
RayScene raysThrough(const PatchSet& set);

/// Keeps a PatchSet, the rays through it and what its objects cover of each other true to where
/// they stand. All three depend on that alone and not on how things came there, apart from which
/// private vertices stand for which corners.
class PosedPatches {
public:
    /// Everything stands as the set says. \param set must outlive this
    explicit PosedPatches(PatchSet& set);
    PosedPatches(const PosedPatches&) = delete;
    PosedPatches& operator=(const PosedPatches&) = delete;

    /// Where a movable object is to stand.
    struct ObjectPose {
        ObjectId object;
        Pose pose;
        bool present = true;
    };
    struct Change {
        std::vector<ObjectId> objects; ///< that did not stand so before
        Coverage::Change covered;
    };
    /// Puts objects elsewhere, hides or shows them; costs what changes.
    Change pose(std::span<const ObjectPose> wanted);

    const RayScene& rays() const { return rays_; }

private:
    PatchSet& set_;
    RayScene rays_;
    Coverage coverage_;
};

} // namespace penumbra
