#include "viewer/app/WalkLight.h"

#include "base/Clock.h"
#include "viewer/input/Walkthrough.h"
#include "viewer/preview/RayPreview.h"

#include <algorithm>
#include <unordered_set>
#include <utility>

namespace penumbra {

WalkLight::WalkLight(const Walkthrough& walk, const RadiosityOptions& options,
                     std::unique_ptr<LightingLink> link, const BlendOptions& blend)
    : scene_(*walk.scene().root),
      node_(std::make_shared<RadiosityNode>("lit", options, std::move(link))), blend_(blend),
      by_(blend.by), choice_(blend.software, blend.inTime), samples_(options.solving.samples),
      slice_(blend.slice), mostLights_(blend.lights), trigger_(options.trigger),
      policy_(options.solving.policy), hadLights_(hasLights(walk.placed())) {
    node_->add(walk.scene().root);
    choosePreview();
}

WalkLight::~WalkLight() = default;

void WalkLight::setTrigger(Trigger trigger) {
    if (std::exchange(trigger_, trigger) != trigger) node_->setTrigger(trigger);
}

/// The other way is taken when nothing moves and the lights that are previewed are those for it.
void WalkLight::choosePreview() {
    const PreviewMethod wanted = wantedMethod();
    if (preview_ && preview_->method() == wanted) return;
    if (preview_ && (lightsBy_ != wanted || !blend_.hasWanted() || blend_.preview().active()))
        return;
    if (preview_) preview_->takeBack();
    if (wanted == PreviewMethod::maps) {
        auto maps = std::make_unique<MapPreview>();
        maps_ = maps.get();
        preview_ = std::move(maps);
    } else {
        maps_ = nullptr;
        preview_ = std::make_unique<RayPreview>(
            samples_, [this] { return node_->patches(); }, PreviewRows::Indexing::aside, slice_);
    }
}

/// Those of the selected thing: their rows are there when a drag begins.
void WalkLight::chooseLights(const Walkthrough& walk) {
    const auto& selection = walk.selection();
    if (!selection || !selection->node) return; // what was selected may be moved by undo
    const PreviewMethod by = wantedMethod();
    if (lightsFor_ == selection->object && lightsOf_ == walk.revision() &&
        lightsLit_ == complete() && lightsBy_ == by)
        return; // emissive meshes are known when they are lit
    const bool inHand = lightsFor_ == selection->object && walk.inHand();
    if (inHand) return; // no other lights in the middle of a move
    lightsFor_ = selection->object;
    lightsOf_ = walk.revision();
    lightsLit_ = complete();
    lightsBy_ = by;
    PreviewLimits limits = previewLimits(by);
    limits.most = std::min(limits.most, mostLights_);
    // The node's objects are the walkthrough's; its paths begin at the node.
    blend_.want(
        lightsThatMatter(previewableLights(*node_, by), walk.rays(), selection->object, limits));
}

/// Brings the shown light up to date while something moves, and is ready for that when something
/// may.
void WalkLight::updatePreview(const Walkthrough& walk, const View& view) {
    const auto shown = [&](const LitGeometry& geometry) { return blend_.shown(geometry); };
    const auto& selection = walk.selection();
    const std::vector<Object>& objects = node_->placed().objects; // as the walkthrough has them
    if (blend_.preview().active()) {
        const double begun = steadySeconds();
        preview_->update(blend_.preview(), shown, &view);
        if (!maps_) choice_.note(steadySeconds() - begun);
    } else if (selection && selection->node && selection->object.value < objects.size()) {
        preview_->rest(blend_.expecting(*node_, objects[selection->object.value].path), shown,
                       &view);
    } else {
        const bool known = complete() && !node_->state().rough;
        preview_->rest(known ? blend_.expecting(*node_, "") : PreviewLighting(), shown, &view);
    }
}

void WalkLight::setPolicy(PolicyKind policy) {
    if (std::exchange(policy_, policy) != policy) node_->setPolicy(policy);
}

bool WalkLight::update(const Walkthrough& walk, const View& view) {
    const std::shared_ptr<const Transform> inHand = walk.inHand();
    if (inHand != inHand_) {
        if (inHand_) node_->release(*inHand_);
        if (inHand) node_->grab(*inHand);
        inHand_ = inHand;
    }
    const glm::dmat4 seenFrom = view.worldToClip();
    if (std::exchange(seenFrom_, seenFrom) != seenFrom) node_->setCamera(view);
    node_->update();
    hadLights_ |= hasLights(walk.placed());
    chooseLights(walk);
    choosePreview();
    preview_->takeBack();
    blend_.advance(*node_, walk.time());
    ages_.advance(node_->objects(), walk.time());
    updatePreview(walk, view);
    const RadiosityState& state = node_->state();
    const bool unfinished = blend_.preview().active() && preview_->unfinished();
    const bool news = unfinished || blend_.changing() || blocks_ != state.blocksTaken ||
                      phase_ != state.phase || solution_ != state.solution ||
                      unlit_ != node_->unlit().size();
    blocks_ = state.blocksTaken;
    phase_ = state.phase;
    solution_ = state.solution;
    unlit_ = node_->unlit().size();
    return news;
}

bool WalkLight::complete() const {
    return !node_->objects().empty() && node_->unlit().empty();
}

DrawList WalkLight::listVisible(const Frustum& frustum) const {
    const bool begun = !node_->placed().objects.empty();
    if (dark() || !begun) return penumbra::listVisible(scene_, frustum);
    DrawList list = penumbra::listVisible(node_->lit(), frustum);
    for (DrawItem& item : list.items) item.shown = blend_.shown(*item.geometry);
    if (complete()) return list;
    std::unordered_set<std::string> litPaths;
    for (const LitObject& object : node_->objects())
        if (object.geometry) litPaths.insert(object.path);
    std::unordered_set<const Node*> unlit;
    for (const auto& mesh : node_->unlit()) unlit.insert(mesh.node);
    const PlacedScene& placed = node_->placed();
    for (const auto& light : placed.lights)
        if (!litPaths.contains(placed.objects[light.object.value].path)) unlit.insert(light.node);
    if (placed.objects.empty()) return penumbra::listVisible(scene_, frustum); // before update()
    DrawList all = penumbra::listVisible(scene_, frustum);
    for (const UnlitItem& item : all.unlit) {
        const Node* const node = item.mesh ? static_cast<const Node*>(item.mesh) : item.light;
        if (unlit.contains(node)) list.unlit.push_back(item);
    }
    return list;
}

} // namespace penumbra
