// The open work of the direct light, as the viewer would have it done.
#pragma once

#include "importance/OrderOfWork.h"
#include "radiosity/DirectLight.h"
#include "radiosity/RayScene.h"
#include "radiosity/VertexPlaces.h"

#include <cstdint>
#include <memory>
#include <span>

namespace penumbra {

/// Orders blocks of vertices by what a viewer gains from them. What hides them from the eye is
/// found by a few rays to each place when it is asked for; so it costs nothing where nothing is
/// open.
class SeenWork {
public:
    /// All must outlive this and the order.
    SeenWork(const PatchSet& patches, const RayScene& rays, const DirectLight& light,
             const Attention& attention);

    /// Objects were placed anew, hidden or shown.
    void follow(std::span<const ObjectId> objects) { places_.follow(objects); }
    /// What the viewer sees now. To take effect, the queue is to be keyed anew.
    void attend(const Attention& attention) { order_->attend(attention); }

    std::shared_ptr<const OrderOfWork> order() const { return order_; }
    std::uint64_t rays() const { return rayCount_; } ///< to the eye, so far

private:
    ImportanceOrder::Sight look(std::uint32_t place);

    const RayScene& rays_;
    const DirectLight& light_;
    VertexPlaces places_;
    std::shared_ptr<ImportanceOrder> order_;
    std::uint64_t rayCount_ = 0;
};

} // namespace penumbra
