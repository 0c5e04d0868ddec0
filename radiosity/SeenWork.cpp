#include "radiosity/SeenWork.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace penumbra {

SeenWork::SeenWork(const PatchSet& patches, const RayScene& rays, const DirectLight& light)
    : rays_(rays), light_(light), places_(patches),
      order_(std::make_shared<ImportanceOrder>(
          places_.placeOf(), [this](std::uint32_t place) { return look(place); })) {}

void SeenWork::attend(const Attention& attention, double ambient) {
    ambient_ = ambient;
    Attention now = attention;
    if (!(now.adaptation > 0)) now.adaptation = adaptationTo(now.viewpoint);
    order_->attend(now);
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
