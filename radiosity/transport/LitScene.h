// A scene that is kept lit while it is edited.
#pragma once

#include "radiosity/mesh/BuildPatches.h"
#include "radiosity/mesh/PosedPatches.h"
#include "radiosity/transport/SceneChange.h"
#include "radiosity/transport/Solver.h"
#include "scenegraph/Objects.h"

#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace penumbra {

/// Everything that is computed from a scene graph: patches, rays, what covers what, and light.
///
/// Objects that are moved, hidden, shown or removed, and colours and luminances that change are
/// taken in by follow() at a cost that goes with the change. Edits of geometry or of scale, things
/// that are added, and a light that gets into or out of something closed mesh the scene anew.
class LitScene {
public:
    /// Meshes; solves nothing yet. Keeps meshes and lights alive until the next follow(), if they
    /// are held by shared pointers. \throws Error
    LitScene(const PlacedScene& scene, const MeshingOptions& meshing, const SolverOptions& solving);
    ~LitScene();
    LitScene(const LitScene&) = delete;
    LitScene& operator=(const LitScene&) = delete;

    /// What was made of an edit.
    struct Followed {
        bool rebuilt = false; ///< the scene was meshed anew: patches(), rays(), solver() are others
        SceneChange change;   ///< else: what of the patch set
    };
    /// Takes in how the scene is now. \throws Error if it can't be meshed
    Followed follow(const PlacedScene& now);

    /// Has what lies in a box, or is crossed by light through it, evaluated anew by the steps that
    /// follow: receivers whose block meets the box, and entries of the shadow-form-factor-list
    /// whose shaft between sender and block meets it. Light stays as it is where nothing was wrong,
    /// within the certificate where rows were not kept. What things cover of each other is not
    /// found again.
    ///
    /// \param box axis-aligned [m, world], taken a hair larger; its sides may be infinite; an empty
    ///            one changes nothing
    void invalidate(const Bounds& box);

    const PatchSet& patches() const { return meshed_->built.patches; }
    const BuiltPatches& built() const { return meshed_->built; }
    const RayScene& rays() const { return meshed_->posed.rays(); }
    Solver& solver() { return meshed_->solver; }
    const Solver& solver() const { return meshed_->solver; }
    const std::vector<std::string>& warnings() const { return meshed_->built.warnings; }

private:
    /// One mesh or light of an object: what may not change.
    struct Piece {
        const void* node = nullptr;
        std::shared_ptr<const Node> kept; ///< it, with its materials, though the scene may drop it
        std::string path;
        glm::dmat4 frame{1.0}; ///< in its object's frame
    };
    using Pieces = std::unordered_map<std::string, std::vector<Piece>>; ///< by object
    using ObjectsByPath = std::unordered_map<std::string_view, const Object*>;

    /// What is made anew when the scene is meshed. Each refers to those before it.
    struct Meshed {
        BuiltPatches built;
        PosedPatches posed;
        Solver solver;
        Meshed(BuiltPatches patches, const SolverOptions& solving)
            : built(std::move(patches)), posed(built.patches),
              solver(built.patches, posed.rays(), solving) {}
    };
    void rebuild(const PlacedScene& scene);
    static Pieces piecesOf(const PlacedScene& scene);
    bool samePieces(const PlacedScene& now) const;
    bool sameStructure(const PlacedScene& now, const ObjectsByPath& objects) const;
    bool followColours(SceneChange& change);
    std::vector<ObjectId> followObjects(const ObjectsByPath& objects, SceneChange& change);

    SolverOptions solving_;
    std::unique_ptr<Meshed> meshed_;
    Pieces pieces_;
};

} // namespace penumbra
