// The blocks of vertices, as places that a viewer may look at.
#pragma once

#include "importance/PlaceClusters.h"
#include "radiosity/PatchSet.h"
#include "scenegraph/Rgb.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// Neighbouring blocks of vertices of one object make a place. How large places are and what they
/// reflect is found once; where they are follows the objects.
class VertexPlaces {
public:
    /// \param most about how many places there are to be. `patches` must outlive this.
    explicit VertexPlaces(const PatchSet& patches, std::size_t most = 2000);

    /// Materials reflect other light than before.
    void measure();
    /// Objects were placed anew, hidden or shown.
    void follow(std::span<const ObjectId> objects);

    std::size_t size() const { return clusters_.places.size(); }
    /// The place of each block; PlaceClusters::kNowhere for blocks without a surface, and for those
    /// that came later.
    const std::vector<std::uint32_t>& placeOf() const { return clusters_.placeOf; }

    /// A place as it stands; its luminance is not known.
    const WorkPlace& known(std::uint32_t place) const { return clusters_.places[place]; }
    ObjectId objectOf(std::uint32_t place) const {
        return patches_.vertexBlockObject[firstBlock_[place]];
    }
    /// Around all places of some objects [m, world].
    Bounds boundsOf(std::span<const ObjectId> objects) const;
    /// A vertex as a place of its own; padding is one without area. \param light its illuminance
    /// [lux]
    WorkPlace atVertex(std::size_t vertex, Rgb light) const;
    /// A place as it is now. \param light illuminance of the vertices [lux]
    WorkPlace at(std::uint32_t place, std::span<const Rgb> light) const;
    /// Up to about eight vertices, spread evenly over a place.
    std::vector<std::size_t> spread(std::uint32_t place) const;

private:
    void locate(std::uint32_t place);
    template <class Visit>
    void forSome(std::uint32_t place, std::size_t most, Visit visit) const;

    const PatchSet& patches_;
    PlaceClusters clusters_;
    std::vector<float> area_, reflectance_; ///< of vertices that are not private
    std::vector<std::uint32_t> firstBlock_; ///< one a place; its blocks are consecutive
};

} // namespace penumbra
