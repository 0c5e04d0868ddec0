// A scene that is kept lit while it is edited.
#pragma once

#include "radiosity/mesh/BuildPatches.h"
#include "radiosity/mesh/PosedPatches.h"
#include "radiosity/mesh/ScenePieces.h"
#include "radiosity/transport/SceneChange.h"
#include "radiosity/transport/Solver.h"
#include "scenegraph/Objects.h"

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace penumbra {

/// Everything that is computed from a scene graph: patches, rays, what covers what, and light.
///
/// Objects that are moved, hidden, shown, removed or added, of another scale or other meshes,
/// lights that get into something closed or out of it, materials that begin to shine or cease to,
/// and colours and luminances that change are taken in by follow() at a cost that goes with the
/// change. The scene is meshed anew where there is no room for what comes (Additions.h), which is
/// seldom.
class LitScene {
public:
    /// Meshes; solves nothing yet. Keeps meshes and lights alive until the next follow(), if they
    /// are held by shared pointers.
    /// \param room whether there is to be room for objects that come later; if not, each of them
    /// has the scene meshed anew, to compare with
    /// \param progress of meshing \throws Error
    LitScene(const PlacedScene& scene, const MeshingOptions& meshing, const SolverOptions& solving,
             bool room = true, const Progress& progress = {});
    ~LitScene();
    LitScene(const LitScene&) = delete;
    LitScene& operator=(const LitScene&) = delete;

    /// What was made of an edit.
    struct Followed {
        bool rebuilt = false; ///< the scene was meshed anew: patches(), rays(), solver() are others
        bool added = false; ///< else: whether objects were added to patches(), in `change` as well
        SceneChange change; ///< else: what of the patch set
    };
    /// Takes in how the scene is now. \throws Error if it can't be meshed; the next edit is then
    /// lit from scratch
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
    /// What is made anew when the scene is meshed. Each refers to those before it.
    struct Meshed {
        BuiltPatches built;
        PosedPatches posed;
        Solver solver;
        Meshed(BuiltPatches patches, const SolverOptions& solving, const Progress& progress = {})
            : built(std::move(patches)), posed(built.patches, progress),
              solver(built.patches, posed.rays(), solving) {}
    };
    static BuiltPatches mesh(const PlacedScene& scene, const MeshingOptions& sizes, bool room,
                             const Progress& progress = {});
    void rebuild(const PlacedScene& scene);
    std::vector<ObjectId> unknownObjects(const PlacedScene& now) const;
    std::vector<ObjectId> beginToShine(const PlacedScene& now) const;
    std::vector<ObjectId> goOnOrOff() const;
    void followColours(SceneChange& change);
    bool addObjects(const PlacedScene& now, std::span<const ObjectId> objects);
    std::vector<ObjectId> followObjects(const PlacedScene& now, SceneChange& change);
    bool take(const PlacedScene& now, std::span<const ObjectId> unknown,
              std::vector<ObjectId> toggled, SceneChange change, Followed& followed);
    std::vector<ObjectId> numbersIn(const PlacedScene& now,
                                    std::span<const ObjectId> objects) const;

    SolverOptions solving_;
    bool room_;
    std::unique_ptr<Meshed> meshed_;
    ScenePieces pieces_;
    bool halfTaken_ = false; ///< the last edit, and nobody knows how much of it
};

} // namespace penumbra
