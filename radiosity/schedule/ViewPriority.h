// The dirty blocks of the direct light, as the viewer would have them done.
#pragma once

#include "importance/SchedulingPolicy.h"
#include "radiosity/rays/RayScene.h"
#include "radiosity/schedule/VertexClusters.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace penumbra {

/// Orders blocks of vertices by what a viewer gains from them. What hides them from the eye is
/// found by a ray to each vertex of which the light may change, and to a few of each cluster when
/// it is asked for; so it costs nothing where nothing is dirty. What was found is kept, vertex by
/// vertex, for as long as the viewer stays and nothing moves that may stand in between.
class ViewPriority final : public ImportancePolicy {
public:
    /// Direct light of the vertices as it is now [lux].
    using Light = std::function<std::span<const Rgb>()>;
    /// All must outlive this.
    ViewPriority(const PatchSet& patches, const RayScene& rays, Light light);

    /// Objects were posed anew, hidden or shown.
    void follow(std::span<const ObjectId> objects);
    /// Something reflects other light than before.
    void followColours() { clusters_.measure(); }
    /// What the viewer sees now. To take effect, the queue is to be keyed anew.
    /// \param attention an adaptation of 0 is found from what is in view
    /// \param ambient about what indirect light adds everywhere [lux]
    void attend(const Attention& attention, double ambient);

    std::uint64_t rays() const { return rayCount_; } ///< to the eye, so far

private:
    ViewPriority(const PatchSet& patches, const RayScene& rays, Light light,
                 VertexClusters clusters);
    /// What rays found of the vertices of a block.
    struct SeenVertices {
        Bounds box; ///< around those that were asked for [m, world]
        std::uint64_t asked = 0, seen = 0, behind = 0; ///< bits
    };
    /// The priorities of vertices of a block.
    struct Values {
        std::uint64_t known = 0; ///< bits, in the policy's view
        std::uint32_t view = 0;
        std::array<ClusterPriority, 64> of;
    };
    ViewSample sample(std::uint32_t index) override;
    void sampleClosely(std::uint32_t block, std::uint64_t which,
                       std::span<ClusterPriority> values) override;
    void evaluate(std::uint32_t block, std::uint64_t which, Values& values);
    const SeenVertices& seenVerticesOf(std::uint32_t block, std::uint64_t which);
    float pixelsSeen(std::uint32_t cluster);
    void ask(std::uint32_t block, std::uint64_t which, SeenVertices& sample);
    void forgetSeen(std::span<const ObjectId> objects, const Bounds& before, const Bounds& now);
    ReceiverCluster clusterNow(std::uint32_t index) const;
    double adaptationTo(const Viewpoint& viewpoint) const;

    const PatchSet& patches_;
    const RayScene& rays_;
    Light light_;
    VertexClusters clusters_;
    double ambient_ = 0;                                           ///< [lux]
    std::unordered_map<std::uint32_t, SeenVertices> seenVertices_; ///< by block
    std::unordered_map<std::uint32_t, Values> values_;             ///< by block
    std::unordered_map<std::uint32_t, float> clusterPixels_; ///< by cluster: those that are seen
    std::optional<Viewpoint> from_;                          ///< where all of that was found
    std::uint64_t rayCount_ = 0;
};

} // namespace penumbra
