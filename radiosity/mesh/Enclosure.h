// Which closed surfaces have a light inside.
#pragma once

#include "radiosity/mesh/PatchSet.h"
#include "radiosity/surface/SurfaceMesh.h"
#include "scenegraph/Material.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
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
    /// \param material of a mesh: counts while it shines; null: of a light, which counts always
    void addLight(glm::vec3 point, ObjectId object, std::shared_ptr<const Material> material);

    /// Decides for each closed surface whether it has a light inside, as the objects stand now.
    /// Lights that are dark or hidden count as well, those that were removed do not; nor do meshes
    /// whose material does not shine.
    /// \param others lights of objects that are not in the set [m, world]
    void decide(const PatchSet& set, std::span<const glm::vec3> others);
    /// Objects with a surface of which that is no longer so, now that some were moved or removed,
    /// or came, or began or ceased to shine. Only what may stand in or around these is checked.
    std::vector<ObjectId> changed(const PatchSet& set, std::span<const ObjectId> objects) const;

    std::size_t litCount() const; ///< of closed surfaces, as it was decided

    /// Points in front of what emits, of objects that are in the scene [m, world].
    /// \param poseOf an object's pose, or null: it is not to count
    std::vector<glm::vec3> lights(const std::function<const Pose*(ObjectId)>& poseOf) const;
    /// Takes in the surfaces and lights of another set. \param firstObject what its first object is
    /// here; others follow
    void add(const Enclosures& others, std::uint32_t firstObject);
    /// An object is not in the scene any more.
    void remove(ObjectId object);

private:
    struct Closed {
        ObjectId object;
        ClosedPart part;
        bool lit = false; ///< as it was decided
    };
    struct Light {
        ObjectId object;
        glm::vec3 point;
        std::shared_ptr<const Material> material;
    };
    bool holds(const PatchSet& set, const Closed& closed, std::span<const glm::vec3> lights) const;

    std::vector<Closed> closed_;
    std::vector<Light> lights_;
};

} // namespace penumbra
