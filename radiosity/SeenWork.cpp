#include "radiosity/SeenWork.h"

namespace penumbra {

SeenWork::SeenWork(const PatchSet& patches, const RayScene& rays, const DirectLight& light,
                   const Attention& attention)
    : rays_(rays), light_(light), places_(patches),
      order_(std::make_shared<ImportanceOrder>(
          places_.placeOf(), [this](std::uint32_t place) { return look(place); }, attention)) {}

ImportanceOrder::Sight SeenWork::look(std::uint32_t index) {
    const Attention& attention = order_->attention();
    const Viewpoint& viewpoint = attention.viewpoint;
    ImportanceOrder::Sight sight{places_.at(index, light_.vertices()), {}};
    const WorkPlace& place = sight.place;
    if (!attention.factors.occlusion || !viewpoint.eye() ||
        viewpoint.regionOf(place.box) != Viewpoint::Region::picture)
        return sight;
    const VertexPlaces::Sight seen = places_.sight(index, rays_, glm::vec3(*viewpoint.eye()));
    rayCount_ += seen.rays;
    sight.seen = float(seen.share * viewpoint.pixelsOf(place.box, glm::vec3(0), 4 * place.area));
    return sight;
}

} // namespace penumbra
