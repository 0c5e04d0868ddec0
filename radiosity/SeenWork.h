// The open work of the direct light, as the viewer would have it done.
#pragma once

#include "importance/OrderOfWork.h"
#include "radiosity/DirectLight.h"
#include "radiosity/RayScene.h"
#include "radiosity/VertexPlaces.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace penumbra {

/// Orders blocks of vertices by what a viewer gains from them. What hides them from the eye is
/// found by a ray to each vertex of which the light may change, and to a few of each place when it
/// is asked for; so it costs nothing where nothing is open. What was found is kept, vertex by
/// vertex, for as long as the viewer stays and nothing moves that may stand in between.
class SeenWork {
public:
    /// All must outlive this and the order.
    SeenWork(const PatchSet& patches, const RayScene& rays, const DirectLight& light);

    /// Objects were placed anew, hidden or shown.
    void follow(std::span<const ObjectId> objects);
    /// Something reflects other light than before.
    void followColours() { places_.measure(); }
    /// What the viewer sees now. To take effect, the queue is to be keyed anew.
    /// \param attention an adaptation of 0 is found from what is in view
    /// \param ambient about what indirect light adds everywhere [lux]
    void attend(const Attention& attention, double ambient);

    std::shared_ptr<const OrderOfWork> order() const { return order_; }
    std::uint64_t rays() const { return rayCount_; } ///< to the eye, so far

private:
    /// What rays found of the vertices of a block.
    struct Sight {
        Bounds box; ///< around those that were asked for [m, world]
        std::uint64_t asked = 0, seen = 0, behindMovable = 0; ///< bits
    };
    /// What vertices of a block are worth.
    struct Values {
        std::uint64_t known = 0; ///< bits, in the order's view
        std::uint32_t view = 0;
        std::array<PlaceValue, 64> of;
    };
    ImportanceOrder::Sight look(std::uint32_t place);
    void lookClosely(std::uint32_t block, std::uint64_t which, std::span<PlaceValue> values);
    void evaluate(std::uint32_t block, std::uint64_t which, Values& values);
    const Sight& sightOf(std::uint32_t block, std::uint64_t which);
    float pixelsSeen(std::uint32_t place);
    void ask(std::uint32_t block, std::uint64_t which, Sight& sight);
    void forgetSights(std::span<const ObjectId> objects, const Bounds& before, const Bounds& now);
    WorkPlace placeNow(std::uint32_t place) const;
    double adaptationTo(const Viewpoint& viewpoint) const;

    const PatchSet& patches_;
    const RayScene& rays_;
    const DirectLight& light_;
    VertexPlaces places_;
    std::shared_ptr<ImportanceOrder> order_;
    double ambient_ = 0;                                   ///< [lux]
    std::unordered_map<std::uint32_t, Sight> sights_;      ///< by block
    std::unordered_map<std::uint32_t, Values> values_;     ///< by block
    std::unordered_map<std::uint32_t, float> placePixels_; ///< by place: those that are seen
    std::optional<Viewpoint> from_;                        ///< where all of that was found
    std::uint64_t rayCount_ = 0;
};

} // namespace penumbra
