// What a ray meets of the scene while people walk and click.
#pragma once

#include "radiosity/rays/RayScene.h"
#include "scenegraph/Objects.h"
#include "scenegraph/Surroundings.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace penumbra {

class Material;

/// A point on a surface.
struct Touch {
    ObjectId object;
    const Mesh* mesh = nullptr;         ///< one of
    const Light* light = nullptr;       ///< the two
    std::string path;                   ///< of the mesh or light
    std::shared_ptr<Material> material; ///< of the face; none of a light
    glm::dvec3 position{0.0};           ///< [m, world]
    glm::dvec3 normal{0.0};             ///< unit, towards the ray's origin
    double distance = 0;                ///< [m]
};

/// The meshes and lights of a scene in an index for rays, which is kept up to date: subdivision
/// surfaces as their cages. Scene graphs of a million faces answer within microseconds.
class SceneRays : public Surroundings {
public:
    /// The scene's nodes must outlive this.
    explicit SceneRays(const PlacedScene& scene);

    /// Takes in the scene as it is now: moved, hidden and shown objects cost what they are,
    /// anything else builds the index anew.
    void follow(const PlacedScene& scene);

    /// The nearest visible surface, but for those of `except`. \param direction not zero
    std::optional<Touch> touch(glm::dvec3 from, glm::dvec3 direction, double reach,
                               ObjectId except = {}) const;
    /// The nearest that can be seen: of a surface with one side its front.
    std::optional<Touch> seen(glm::dvec3 from, glm::dvec3 direction, double reach) const;

    std::optional<Obstacle> ahead(glm::dvec3 from, glm::dvec3 direction,
                                  double reach) const override;

    const RayScene& rays() const { return *rays_; } ///< its objects are the scene's

    /// Box around an object in its present pose [m, world].
    Bounds bounds(ObjectId object) const;

private:
    /// A run of an object's triangles that come from one mesh or light.
    struct Piece {
        const Mesh* mesh = nullptr;
        const Light* light = nullptr;
        std::string path;
        glm::dmat4 toObject{1.0};
        std::uint32_t firstTriangle = 0;
        std::vector<std::uint16_t> materials; ///< index into the mesh's, one a triangle
    };
    struct Part {
        std::string path;
        std::vector<glm::vec3> local; ///< vertices in the object's frame [m]
        std::vector<Piece> pieces;
        glm::dmat4 toWorld{1.0};
        bool visible = true;
    };

    void build(const PlacedScene& scene);
    bool sameStructure(const PlacedScene& scene) const;
    static std::vector<glm::vec3> placed(const Part& part);
    const Piece& pieceAt(const RayHit& hit) const;
    bool isSeen(const RayHit& hit, glm::dvec3 direction) const;
    Touch describe(const RayHit& hit, glm::dvec3 from, glm::dvec3 direction) const;

    std::vector<Part> parts_; ///< one an object
    std::unique_ptr<RayScene> rays_;
};

} // namespace penumbra
