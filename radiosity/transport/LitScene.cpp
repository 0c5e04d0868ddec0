#include "radiosity/transport/LitScene.h"

#include "radiosity/rays/Margins.h"
#include "radiosity/rays/Shaft.h"
#include "scenegraph/Light.h"
#include "scenegraph/Material.h"
#include "scenegraph/Mesh.h"

#include <algorithm>
#include <utility>

namespace penumbra {

LitScene::LitScene(const PlacedScene& scene, const MeshingOptions& meshing,
                   const SolverOptions& solving)
    : solving_(solving), meshed_(std::make_unique<Meshed>(buildPatches(scene, meshing), solving)),
      pieces_(piecesOf(scene)) {}

LitScene::~LitScene() = default;

/// Meshes the scene anew, and takes over all that still holds.
void LitScene::rebuild(const PlacedScene& scene) {
    Meshed& before = *meshed_;
    BuiltPatches built = buildPatches(scene, sizesOf(patches()));
    const bool settled = before.solver.state() == SolutionState::exact;
    keepGone(before.built.patches, built.patches, !settled);
    auto now = std::make_unique<Meshed>(std::move(built), solving_);
    const PatchMatch match = matchPatches(before.built.patches, now->built.patches);
    now->posed.setAlone(match.changed);
    now->solver.takeOver(before.solver, match);
    meshed_ = std::move(now);
    pieces_ = piecesOf(scene);
}

LitScene::Pieces LitScene::piecesOf(const PlacedScene& scene) {
    Pieces pieces;
    const auto add = [&](const auto& placed) {
        pieces[scene.objects[placed.object.value].path].push_back(
            {placed.node, placed.node->weak_from_this().lock(), placed.path, placed.toObject});
    };
    for (const auto& mesh : scene.meshes) add(mesh);
    for (const auto& light : scene.lights) add(light);
    return pieces;
}

/// Whether all objects that are there are made of the same pieces.
bool LitScene::samePieces(const PlacedScene& now) const {
    struct Matched {
        const std::vector<Piece>* pieces = nullptr;
        std::size_t seen = 0;
    };
    std::vector<Matched> objects(now.objects.size());
    for (std::size_t o = 0; o < objects.size(); ++o) {
        const auto known = pieces_.find(now.objects[o].path);
        if (known == pieces_.end()) return false;
        objects[o].pieces = &known->second;
    }
    const auto isNext = [&](const auto& placed) {
        auto& [pieces, seen] = objects[placed.object.value];
        if (seen == pieces->size()) return false;
        const Piece& piece = (*pieces)[seen++];
        return piece.node == placed.node && piece.path == placed.path &&
               piece.frame == placed.toObject;
    };
    return std::all_of(now.meshes.begin(), now.meshes.end(), isNext) &&
           std::all_of(now.lights.begin(), now.lights.end(), isNext) &&
           std::all_of(objects.begin(), objects.end(),
                       [](const Matched& m) { return m.seen == m.pieces->size(); });
}

/// Whether the scene is made of the same pieces; objects may be missing.
bool LitScene::sameStructure(const PlacedScene& now, const ObjectsByPath& objects) const {
    if (!samePieces(now)) return false;
    for (const ObjectPart& part : built().patches.objects) {
        const auto found = objects.find(part.path);
        if (found == objects.end()) continue;
        if (placementOf(found->second->toWorld).stretch != part.stretch) return false;
    }
    return true;
}

/// Whether colours and luminances can be taken in: what never emitted has no rows to emit through.
bool LitScene::followColours(SceneChange& change) {
    PatchSet& set = meshed_->built.patches;
    const auto lightOf = [](const LightSource& source) {
        return source.light ? source.light->luminance() : source.material->emission();
    };
    for (std::size_t m = 0; m < set.materials.size(); ++m) {
        const LightSource& source = built().materialSources[m];
        if (!source.material || !source.material->emissive()) continue;
        // What is dark in a texture has no emitters, however brightly it would shine.
        if (source.material->textures().emission && maxChannel(set.materials[m].emission) > 0)
            continue;
        const bool emits = std::any_of(
            built().emitterSources.begin(), built().emitterSources.end(),
            [&](const LightSource& emitter) { return emitter.material == source.material; });
        if (!emits) return false;
    }
    for (std::size_t m = 0; m < set.materials.size(); ++m) {
        const LightSource& source = built().materialSources[m];
        LitMaterial now = set.materials[m];
        if (source.material) now.reflectance = source.material->reflectance();
        if (built().materialEmits[m]) now.emission = lightOf(source);
        if (now == set.materials[m]) continue;
        set.materials[m] = now;
        change.colours = true;
    }
    for (std::uint32_t e = 0; e < set.emitters.size(); ++e) {
        const Rgb exitance =
            lambertianExitance(lightOf(built().emitterSources[e])) * set.emitters[e].texture;
        if (exitance == set.emitters[e].exitance) continue;
        set.emitters[e].exitance = exitance;
        change.emitters.push_back(e);
    }
    return true;
}

/// \return objects that were moved or removed: lights may be in other closed things than before
std::vector<ObjectId> LitScene::followObjects(const ObjectsByPath& objects, SceneChange& change) {
    PatchSet& set = meshed_->built.patches;
    std::vector<PosedPatches::ObjectPose> wanted;
    std::vector<ObjectId> replaced;
    for (std::uint32_t o = 0; o < set.objects.size(); ++o) {
        ObjectPart& part = set.objects[o];
        const auto found = objects.find(part.path);
        const bool wasRemoved = std::exchange(part.removed, found == objects.end());
        const bool present = !part.removed && found->second->visible;
        const Pose pose =
            found != objects.end() ? placementOf(found->second->toWorld).pose : part.pose;
        if (wasRemoved != part.removed || pose != part.pose) replaced.push_back({o});
        wanted.push_back({{o}, pose, present});
    }
    PosedPatches::Change moved = meshed_->posed.pose(wanted);
    change.objects = std::move(moved.objects);
    change.vertices = std::move(moved.covered.vertices);
    change.patches = std::move(moved.covered.patches);
    change.nodes = std::move(moved.covered.parted.nodes);
    change.senders = std::move(moved.covered.parted.patches);
    change.parted = std::move(moved.covered.parted.wholes);
    return replaced;
}

LitScene::Followed LitScene::follow(const PlacedScene& now) {
    Followed followed;
    ObjectsByPath objects;
    for (const Object& object : now.objects) objects[object.path] = &object;
    if (!sameStructure(now, objects) || !followColours(followed.change)) {
        rebuild(now);
        followed = {true, {}};
        return followed;
    }
    const std::vector<ObjectId> replaced = followObjects(objects, followed.change);
    solver().apply(followed.change);
    if (meshed_->posed.exhausted() ||
        built().enclosures.changed(built().patches, replaced, built().enclosuresLit)) {
        rebuild(now);
        followed = {true, {}};
    }
    return followed;
}

void LitScene::invalidate(const Bounds& box) {
    if (box.empty()) return;
    const float hover = hoverAt(patches().skin, magnitude(box));
    solver().invalidate(grown(box, 2 * hover)); // receivers hover over what is lit
}

} // namespace penumbra
