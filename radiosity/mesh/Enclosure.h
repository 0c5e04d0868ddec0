// Which closed surfaces have a light inside.
#pragma once

#include "radiosity/mesh/PatchSet.h"
#include "radiosity/surface/SurfaceMesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// A surface with a light inside is lit from within and meshed on both sides, another is solid (see
/// chooseSides()). Lights and boxes move: this tells when that has to be decided anew.
class Enclosures {
public:
    /// \param mesh in its object's stretched frame
    /// \param siblings the meshes of the same object
    void addSurface(const SurfaceMesh& mesh, std::span<const SurfaceMesh* const> siblings,
                    ObjectId object);
    /// \param point a hair in front of an emitting face [m, stretched frame of its object]
    void addLight(glm::vec3 point, ObjectId object);

    /// For each closed surface whether it has a light inside, as the objects stand now. Lights that
    /// are dark or hidden count as well, those that were removed do not.
    std::vector<bool> lit(const PatchSet& set) const;
    /// Whether that is no longer so, now that some objects were moved or removed. Only what may
    /// stand in or around these is checked.
    /// \param lit of lit(), before
    bool changed(const PatchSet& set, std::span<const ObjectId> objects,
                 const std::vector<bool>& lit) const;

private:
    struct Closed {
        ObjectId object;
        ClosedPart part;
    };
    struct Light {
        ObjectId object;
        glm::vec3 point;
    };
    template <class Counts>
    std::vector<glm::vec3> places(const PatchSet& set, const Counts& counts) const;
    bool holds(const PatchSet& set, const Closed& closed, std::span<const glm::vec3> lights) const;

    std::vector<Closed> closed_;
    std::vector<Light> lights_;
};

} // namespace penumbra
