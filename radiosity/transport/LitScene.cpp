#include "radiosity/transport/LitScene.h"

#include "radiosity/mesh/Additions.h"
#include "radiosity/rays/Margins.h"
#include "radiosity/rays/Shaft.h"
#include "scenegraph/Light.h"
#include "scenegraph/Material.h"

#include <algorithm>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace penumbra {

namespace {

constexpr double kBuilt = 0.6; ///< share of the time of meshing when there are patches

using ObjectsByPath = std::unordered_map<std::string_view, const Object*>;

ObjectsByPath objectsByPath(const PlacedScene& scene) {
    ObjectsByPath objects;
    for (const Object& object : scene.objects) objects[object.path] = &object;
    return objects;
}

} // namespace

LitScene::LitScene(const PlacedScene& scene, const MeshingOptions& meshing,
                   const SolverOptions& solving, bool room, const Progress& progress)
    : solving_(solving), room_(room),
      meshed_(std::make_unique<Meshed>(mesh(scene, meshing, room, shareOf(progress, 0, kBuilt)),
                                       solving, shareOf(progress, kBuilt, 1))) {
    pieces_.note(scene);
}

LitScene::~LitScene() = default;

BuiltPatches LitScene::mesh(const PlacedScene& scene, const MeshingOptions& sizes, bool room,
                            const Progress& progress) {
    BuiltPatches built = buildPatches(scene, sizes, progress);
    if (room) makeRoom(built.patches);
    return built;
}

/// Meshes the scene anew, and takes over all that still holds.
void LitScene::rebuild(const PlacedScene& scene) {
    Meshed& before = *meshed_;
    BuiltPatches built = mesh(scene, sizesOf(patches()), room_);
    const bool settled = before.solver.state() == SolutionState::exact;
    keepGone(before.built.patches, built.patches, !settled);
    auto now = std::make_unique<Meshed>(std::move(built), solving_);
    const PatchMatch match = matchPatches(before.built.patches, now->built.patches);
    now->posed.setAlone(match.changed);
    now->solver.takeOver(before.solver, match);
    meshed_ = std::move(now);
    pieces_ = {};
    pieces_.note(scene);
}

/// Objects, by their numbers in `now`, that are not meshed as they are: new ones, and those of
/// other pieces or another scale.
std::vector<ObjectId> LitScene::unknownObjects(const PlacedScene& now) const {
    std::vector<ObjectId> unknown = pieces_.others(now);
    const ObjectsByPath objects = objectsByPath(now);
    for (const ObjectPart& part : patches().objects) {
        const auto found = objects.find(part.path);
        if (found == objects.end()) continue;
        const ObjectId object{std::uint32_t(found->second - now.objects.data())};
        if (placementOf(found->second->toWorld).stretch != part.stretch &&
            std::ranges::find(unknown, object) == unknown.end())
            unknown.push_back(object);
    }
    return unknown;
}

/// Objects, by their numbers in `now`, with a material that shines and did not when they were
/// meshed: there are no rows that it could emit through.
std::vector<ObjectId> LitScene::beginToShine(const PlacedScene& now) const {
    const PatchSet& set = patches();
    const auto materialOf = [&](std::uint32_t m) { return built().materialSources[m].material; };
    std::vector<std::uint8_t> wasDark(set.materials.size());
    for (std::uint32_t m = 0; m < wasDark.size(); ++m)
        wasDark[m] = materialOf(m) && materialOf(m)->emissive() && built().materialEmits[m] &&
                     !(maxChannel(set.materials[m].emission) > 0);
    if (std::ranges::find(wasDark, 1) == wasDark.end()) return {};
    const auto begins = [&](const ObjectPart& part) {
        const auto emits = [&](std::uint32_t m) {
            const auto sources =
                std::span(built().emitterSources).subspan(part.emitters.first, part.emitters.count);
            return std::ranges::find(sources, materialOf(m), &LightSource::material) !=
                   sources.end();
        };
        std::uint32_t known = Element::kNone; // a material that emits
        for (std::uint32_t e = part.elements.first; e < part.elements.end(); ++e) {
            const std::uint32_t m = set.elements[e].material;
            if (!wasDark[m] || m == known) continue;
            if (!emits(m)) return true;
            known = m;
        }
        return false;
    };
    std::vector<ObjectId> objects;
    for (std::uint32_t o = 0; o < set.objects.size(); ++o)
        if (!set.objects[o].path.empty() && begins(set.objects[o])) objects.push_back({o});
    return numbersIn(now, objects);
}

/// Objects of the patch set with emitters that begin or cease to shine.
std::vector<ObjectId> LitScene::goOnOrOff() const {
    const PatchSet& set = patches();
    std::vector<ObjectId> objects;
    for (std::uint32_t e = 0; e < set.emitters.size(); ++e) {
        const Material* const material = built().emitterSources[e].material;
        if (!material || material->emissive() == (maxChannel(set.emitters[e].exitance) > 0))
            continue;
        if (objects.empty() || objects.back() != set.emitters[e].object)
            objects.push_back(set.emitters[e].object);
    }
    return objects;
}

void LitScene::followColours(SceneChange& change) {
    PatchSet& set = meshed_->built.patches;
    const auto lightOf = [](const LightSource& source) {
        return source.light ? source.light->luminance() : source.material->emission();
    };
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
}

/// Meshes objects that are unknown and takes them in, hidden, in place of what has their paths.
/// \return false: there is no room for them, or it can't be told which is which
bool LitScene::addObjects(const PlacedScene& now, std::span<const ObjectId> objects) {
    if (solver().directOnly() && !solving_.directOnly) return false; // nothing was lit
    std::unordered_map<std::string_view, std::size_t> paths;
    for (const Object& object : now.objects) ++paths[object.path];
    const ObjectsByPath places = objectsByPath(now);
    PatchSet& set = meshed_->built.patches;
    const PlacedScene part = partOf(now, objects);
    std::vector<ObjectId> replaced;
    std::vector<Pose> poses;
    for (const ObjectPart& known : set.objects) {
        const auto place = places.find(known.path);
        poses.push_back(place != places.end() ? placementOf(place->second->toWorld).pose : Pose());
    }
    for (const Object& object : part.objects) {
        if (paths[object.path] > 1) return false;
        for (std::uint32_t o = 0; o < set.objects.size(); ++o)
            if (set.objects[o].path == object.path) replaced.push_back({o});
    }
    const auto others = meshed_->built.enclosures.lights([&](ObjectId o) -> const Pose* {
        const bool is = places.contains(set.objects[o.value].path);
        return is && std::ranges::find(replaced, o) == replaced.end() ? &poses[o.value] : nullptr;
    });
    BuiltPatches built = buildObjects(part, sizesOf(set), others);
    const auto added = penumbra::addObjects(meshed_->built, built);
    if (!added) return false;
    for (const ObjectId object : replaced) {
        set.objects[object.value].path.clear();
        meshed_->built.enclosures.remove(object);
    }
    meshed_->posed.add(*added);
    solver().add(*added);
    pieces_.note(part);
    return true;
}

/// \return objects that were moved or removed, or came: lights may be in other closed things than
/// before
std::vector<ObjectId> LitScene::followObjects(const PlacedScene& now, SceneChange& change) {
    PatchSet& set = meshed_->built.patches;
    const ObjectsByPath objects = objectsByPath(now);
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

/// Takes in objects that are unknown, and where all of them are.
/// \param toggled of the patch set: began or ceased to shine
/// \param change of colours \return false: the scene is to be meshed anew
bool LitScene::take(const PlacedScene& now, std::span<const ObjectId> unknown,
                    std::vector<ObjectId> toggled, SceneChange change, Followed& followed) {
    if (!unknown.empty() && !addObjects(now, unknown)) return false;
    followed.added |= !unknown.empty();
    const std::vector<ObjectId> replaced = followObjects(now, change);
    toggled.insert(toggled.end(), replaced.begin(), replaced.end());
    solver().apply(change);
    followed.change.add(change);
    if (meshed_->posed.exhausted()) return false;
    const std::vector<ObjectId> open =
        numbersIn(now, built().enclosures.changed(patches(), toggled)); // lights got in or out
    return open.empty() || take(now, open, {}, {}, followed);
}

/// What objects of the patch set are called in `now`, those that are there.
std::vector<ObjectId> LitScene::numbersIn(const PlacedScene& now,
                                          std::span<const ObjectId> objects) const {
    const ObjectsByPath places = objectsByPath(now);
    std::vector<ObjectId> numbers;
    for (const ObjectId object : objects)
        if (const auto found = places.find(patches().objects[object.value].path);
            found != places.end())
            numbers.push_back({std::uint32_t(found->second - now.objects.data())});
    return numbers;
}

LitScene::Followed LitScene::follow(const PlacedScene& now) {
    if (std::exchange(halfTaken_, true)) { // the last edit was refused on the way
        meshed_ = std::make_unique<Meshed>(mesh(now, sizesOf(patches()), room_), solving_);
        pieces_ = {};
        pieces_.note(now);
        halfTaken_ = false;
        return {true, false, {}};
    }
    Followed followed;
    std::vector<ObjectId> unknown = unknownObjects(now);
    for (const ObjectId object : beginToShine(now))
        if (std::ranges::find(unknown, object) == unknown.end()) unknown.push_back(object);
    std::vector<ObjectId> toggled = goOnOrOff();
    SceneChange colours;
    followColours(colours);
    if (!take(now, unknown, std::move(toggled), colours, followed)) {
        rebuild(now);
        followed = {true, false, {}};
    }
    halfTaken_ = false;
    return followed;
}

void LitScene::invalidate(const Bounds& box) {
    if (box.empty()) return;
    const float hover = hoverAt(patches().skin, magnitude(box));
    solver().invalidate(grown(box, 2 * hover)); // receivers hover over what is lit
}

} // namespace penumbra
