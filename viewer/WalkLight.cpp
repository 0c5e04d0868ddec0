#include "viewer/WalkLight.h"

#include "scenegraph/Light.h"
#include "viewer/Walkthrough.h"

#include <algorithm>
#include <unordered_set>
#include <utility>

namespace penumbra {

WalkLight::WalkLight(const Walkthrough& walk, const RadiosityOptions& options,
                     std::unique_ptr<LightingLink> link)
    : scene_(*walk.scene().root),
      node_(std::make_shared<RadiosityNode>("lit", options, std::move(link))),
      trigger_(options.trigger) {
    node_->add(walk.scene().root);
}

WalkLight::~WalkLight() = default;

void WalkLight::setTrigger(Trigger trigger) {
    if (std::exchange(trigger_, trigger) != trigger) node_->setTrigger(trigger);
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
    const RadiosityState& state = node_->state();
    const bool news =
        blocks_ != state.blocksTaken || phase_ != state.phase || unlit_ != node_->unlit().size();
    blocks_ = state.blocksTaken;
    phase_ = state.phase;
    unlit_ = node_->unlit().size();
    return news;
}

bool WalkLight::complete() const {
    return !node_->objects().empty() && node_->unlit().empty();
}

DrawList WalkLight::listVisible(const Frustum& frustum) const {
    DrawList list = penumbra::listVisible(node_->lit(), frustum);
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
