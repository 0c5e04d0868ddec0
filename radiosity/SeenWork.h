// The open work of the direct light, as the viewer would have it done.
#pragma once

#include "importance/OrderOfWork.h"
#include "radiosity/DirectLight.h"
#include "radiosity/RayScene.h"
#include "radiosity/VertexPlaces.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

namespace penumbra {

/// Orders blocks of vertices by what a viewer gains from them. What hides them from the eye is
/// found by a few rays to each place when it is asked for, and by one to each vertex of which the
/// light may change; so it costs nothing where nothing is open.
class SeenWork {
public:
    /// All must outlive this and the order.
    SeenWork(const PatchSet& patches, const RayScene& rays, const DirectLight& light);

    /// Objects were placed anew, hidden or shown.
    void follow(std::span<const ObjectId> objects);
    /// What the viewer sees now. To take effect, the queue is to be keyed anew.
    /// \param attention an adaptation of 0 is found from what is in view
    /// \param ambient about what indirect light adds everywhere [lux]
    void attend(const Attention& attention, double ambient);

    std::shared_ptr<const OrderOfWork> order() const { return order_; }
    std::uint64_t rays() const { return rayCount_; } ///< to the eye, so far

private:
    ImportanceOrder::Sight look(std::uint32_t place);
    void lookClosely(std::uint32_t block, std::uint64_t which, std::span<PlaceValue> values);
    std::uint64_t seenOf(std::uint32_t block, std::uint64_t which, const glm::vec3& eye);
    WorkPlace placeNow(std::uint32_t place) const;
    double adaptationTo(const Viewpoint& viewpoint) const;

    const RayScene& rays_;
    const DirectLight& light_;
    VertexPlaces places_;
    std::shared_ptr<ImportanceOrder> order_;
    double ambient_ = 0; ///< [lux]
    /// Vertices of a block, in this view.
    struct CloseView {
        std::uint64_t known = 0; ///< bits
        std::array<PlaceValue, 64> values;
    };
    std::unordered_map<std::uint32_t, CloseView> close_; ///< by block
    std::uint64_t rayCount_ = 0;
};

} // namespace penumbra
