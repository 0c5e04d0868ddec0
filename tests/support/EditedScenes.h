// Random rooms and random edits.
#pragma once

#include "radiosity/transport/LitScene.h"
#include "tests/support/Scenes.h"

#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace penumbra {

/// A room with things that move, made from a seed: boxes and plates, an instanced pair, a
/// subdivision surface, things below scaled and mirrored parents, lights of all shapes with and
/// without housings, an emissive mesh; some hidden at first. Edits place them anywhere in the room,
/// through its walls, on the floor and on the table.
class EditableRoom {
public:
    explicit EditableRoom(std::uint32_t seed);

    /// One random edit, or several at once. \return what was done, for people
    std::string edit();

    const Scene& scene() const { return scene_; }
    static constexpr MeshingOptions meshing() { return {.patchSize = 0.9f, .elementSize = 0.3f}; }

private:
    struct Thing {
        std::shared_ptr<Transform> node;
        std::shared_ptr<Switch> choice;   ///< hides it
        glm::dmat4 frame;                 ///< of its parent, a stretch
        glm::dvec3 half;                  ///< half its size when it is upright [m]
        glm::dmat4 place{1.0}, home{1.0}; ///< rigid, in the world
        bool emits = false;
    };
    std::shared_ptr<Material> newPaint();
    std::shared_ptr<Light> newLight(LightShape shape, float nits);
    void addFixed();
    void addThings();
    void addThing(const std::string& name, std::initializer_list<NodePtr> content, glm::dvec3 half,
                  const glm::dmat4& frame = glm::dmat4(1.0));
    void place(Thing& thing, const glm::dmat4& where);
    glm::dmat4 anywhere(const Thing& thing);
    std::string editThing(Thing& thing);
    std::string editColour();
    std::string editGraph(Thing& thing);
    double uniform(double low, double high);
    std::size_t below(std::size_t count);

    std::mt19937 random_;
    Scene scene_;
    std::vector<Thing> things_;
    std::shared_ptr<Transform> table_; ///< fixed: an edit of it meshes anew
    std::vector<std::shared_ptr<Light>> lights_;
    std::vector<std::shared_ptr<Material>> paints_, emissive_;
};

} // namespace penumbra
