// The poses of lit things for preview rays, and what they touch there.
#pragma once

#include "radiosity/mesh/PatchSet.h"
#include "radiosity/mesh/PosedPatches.h"
#include "viewer/preview/PreviewLighting.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace penumbra {

/// A corner of an element that something touches or covers, and where its light is taken instead
/// (see Contact.h).
struct TouchedCorner {
    std::uint32_t object = 0;
    std::uint32_t corner = 0; ///< 4 * element + corner, elements counted within the object
    Receiver at;              ///< [m, world]
};

/// Radiosity's own patches, rays and contacts, posed as in a scene state, so that light is
/// evaluated at the same points.
class PreviewScene {
public:
    /// \param set see RadiosityNode::patches()
    explicit PreviewScene(PatchSet set);

    /// Poses things as in this scene state; costs what changes: the first time, everything.
    void pose(const SceneState& sceneState);
    bool isPosedAs(const SceneState& sceneState) const;
    /// About how long pose() takes when these objects move, by how long it took the first time [s].
    double secondsToPose(const std::vector<bool>& moves) const;

    const RayScene& rays() const { return posed_.rays(); }
    /// Rays through things as they are in another scene state; what they touch there is not
    /// searched for. Costs what changes from one call to the next.
    const RayScene& raysAt(const SceneState& sceneState);
    /// The point at which a vertex of an object is evaluated when nothing touches it: with things
    /// as they are, and in a pose of the object.
    Receiver receiver(std::uint32_t object, std::size_t vertex) const;
    Receiver receiver(std::uint32_t object, std::size_t vertex, const Pose& pose) const;
    /// What is touched in the present poses, by object and corner.
    std::vector<TouchedCorner> touched() const;

    /// Vertices that an object has from the start; those behind them represent corners.
    std::size_t vertices(std::uint32_t object) const { return set_.objects[object].vertices.count; }
    /// Whether vertices of a block of an object take their light from receivers beside them.
    bool isBlended(std::uint32_t object, std::uint32_t block) const {
        const Range& own = set_.objects[object].vertices;
        return block < own.count / PatchSet::kBlock &&
               set_.isBlended(own.first / PatchSet::kBlock + block);
    }
    /// Receivers that count for a vertex only where there are no others, in the present poses:
    /// things cover or touch them. Sorted, as aside of forEachReceiver().
    std::vector<std::uint32_t> receiversAside() const;
    /// Calls visit(vertex, weight) for the vertices of an object from which one takes its light.
    template <class Visit>
    void forEachReceiver(std::uint32_t object, std::size_t vertex,
                         std::span<const std::uint32_t> aside, const Visit& visit) const {
        const std::uint32_t first = firstVertex(object);
        const auto counts = [&](std::uint32_t v) { return !std::ranges::binary_search(aside, v); };
        set_.forEachReceiver(first + std::uint32_t(vertex), counts,
                             [&](std::uint32_t v, float weight) { visit(v - first, weight); });
    }
    /// The elements of an object when nothing touches it; their vertices are the set's.
    std::span<const Element> elements(std::uint32_t object) const;
    std::uint32_t firstVertex(std::uint32_t object) const {
        return set_.objects[object].vertices.first;
    }
    /// A box with what hovers over the surfaces in it [m, world].
    Bounds withReceivers(const Bounds& box) const;

private:
    using ObjectPose = PosedPatches::ObjectPose;
    using ObjectStates = std::vector<std::optional<SceneState::ObjectState>>;
    std::vector<ObjectPose> follow(ObjectStates& states, const SceneState& sceneState);

    PatchSet set_;
    PosedPatches posed_;
    RayScene aside_;                       ///< of raysAt()
    std::vector<ObjectPose> asidePoses_;   ///< of what is in it, by object
    ObjectStates poses_, asideAs_;         ///< what was asked for last
    std::vector<std::uint32_t> receivers_; ///< of blended vertices, sorted
    std::optional<double> secondsForAll_;
};

} // namespace penumbra
