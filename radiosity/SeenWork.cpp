#include "radiosity/SeenWork.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

namespace penumbra {

SeenWork::SeenWork(const PatchSet& patches, const RayScene& rays, const DirectLight& light)
    : rays_(rays), light_(light), places_(patches),
      order_(std::make_shared<ImportanceOrder>(
          places_.placeOf(), [this](std::uint32_t place) { return look(place); },
          [this](std::uint32_t block, std::uint64_t which, std::span<PlaceValue> values) {
              lookClosely(block, which, values);
          })) {}

void SeenWork::follow(std::span<const ObjectId> objects) {
    places_.follow(objects);
    close_.clear();
    if (order_->view() > 0) order_->attend(order_->attention()); // what moves hides other things
}

void SeenWork::attend(const Attention& attention, double ambient) {
    ambient_ = ambient;
    Attention now = attention;
    if (!(now.adaptation > 0)) now.adaptation = adaptationTo(now.viewpoint);
    order_->attend(now);
    close_.clear();
}

WorkPlace SeenWork::placeNow(std::uint32_t index) const {
    WorkPlace place = places_.at(index, light_.vertices());
    place.luminance += place.reflectance * float(ambient_ * std::numbers::inv_pi);
    return place;
}

/// Geometric mean over what is in the picture, as if nothing were in front of it.
double SeenWork::adaptationTo(const Viewpoint& viewpoint) const {
    double sum = 0, pixels = 0;
    for (std::uint32_t p = 0; p < places_.size(); ++p) {
        const WorkPlace& known = places_.known(p);
        if (viewpoint.regionOf(known.box) != Viewpoint::Region::picture) continue;
        const double shown = viewpoint.pixelsOf(known.box, known.normal, known.area);
        if (!(shown > 0)) continue;
        sum += shown * std::log(std::max(1e-4, double(placeNow(p).luminance)));
        pixels += shown;
    }
    return pixels > 0 ? std::exp(sum / pixels) : 1e-4;
}

void SeenWork::lookClosely(std::uint32_t block, std::uint64_t which, std::span<PlaceValue> values) {
    CloseView& close = close_[block];
    const Attention& attention = order_->attention();
    const bool looks = attention.factors.occlusion && attention.viewpoint.eye();
    std::uint64_t open = which & ~close.known;
    const std::uint64_t seen =
        looks && open != 0 ? seenOf(block, open, glm::vec3(*attention.viewpoint.eye())) : 0;
    for (; open != 0; open &= open - 1) {
        const auto r = std::size_t(std::countr_zero(open));
        const std::size_t v = std::size_t(block) * PatchSet::kBlock + r;
        WorkPlace place = places_.atVertex(v, light_.vertices()[v]);
        place.luminance += place.reflectance * float(ambient_ * std::numbers::inv_pi);
        std::optional<float> pixels;
        if (looks) pixels = 0.0f;
        if (seen >> r & 1)
            pixels = float(attention.viewpoint.pixelsOf(place.box, place.normal, place.area));
        close.values[r] = place.box.empty() ? PlaceValue() : placeValue(place, attention, pixels);
    }
    close.known |= which;
    std::copy(close.values.begin(), close.values.end(), values.begin());
}

/// Which of some vertices of a block face the eye, are in the picture, and not hidden by anything.
std::uint64_t SeenWork::seenOf(std::uint32_t block, std::uint64_t which, const glm::vec3& eye) {
    std::uint64_t seen = 0;
    ShadowRays rays;
    std::array<std::uint32_t, ShadowRays::kMost> of{};
    int count = 0;
    const auto trace = [&] {
        if (count == 0) return;
        rays_.occluded(rays);
        rayCount_ += std::uint64_t(count);
        for (int i = 0; i < count; ++i)
            seen |= std::uint64_t(rays.blocker[i] == ObjectId::kNone) << of[std::size_t(i)];
        rays.used = 0;
        count = 0;
    };
    for (; which != 0; which &= which - 1) {
        const auto r = std::uint32_t(std::countr_zero(which));
        const Receiver& receiver = places_.receiver(std::size_t(block) * PatchSet::kBlock + r);
        const Bounds point{receiver.position, receiver.position};
        if (glm::dot(eye - receiver.position, receiver.normal) <= 0) continue; // also padding
        if (order_->attention().viewpoint.regionOf(point) != Viewpoint::Region::picture) continue;
        of[std::size_t(count)] = r;
        rays.set(count++, receiver.position, eye);
        if (count == ShadowRays::kMost) trace();
    }
    trace();
    return seen;
}

ImportanceOrder::Sight SeenWork::look(std::uint32_t index) {
    const Attention& attention = order_->attention();
    const Viewpoint& viewpoint = attention.viewpoint;
    ImportanceOrder::Sight sight{placeNow(index), {}};
    const WorkPlace& place = sight.place;
    if (!attention.factors.occlusion || !viewpoint.eye() ||
        viewpoint.regionOf(place.box) != Viewpoint::Region::picture)
        return sight;
    const VertexPlaces::Sight seen = places_.sight(index, rays_, viewpoint);
    rayCount_ += std::uint64_t(seen.rays);
    sight.seen = seen.pixels;
    return sight;
}

} // namespace penumbra
