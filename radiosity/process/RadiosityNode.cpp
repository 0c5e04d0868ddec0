#include "radiosity/process/RadiosityNode.h"

#include "base/Error.h"
#include "radiosity/process/LightingClient.h"
#include "radiosity/process/TriggerGate.h"
#include "radiosity/process/snapshot/SceneDiff.h"
#include "radiosity/process/store/LitObjects.h"
#include "scenegraph/Transform.h"
#include "scenegraph/Visitor.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace penumbra {

namespace {

/// A scene whose root is a node that someone else owns.
PlacedScene placeBelow(const Group& root) {
    Scene scene;
    scene.root = std::shared_ptr<Group>(std::shared_ptr<Group>(), const_cast<Group*>(&root));
    return placeScene(scene);
}

} // namespace

struct RadiosityNode::Impl {
    Impl(const Group& root, const RadiosityOptions& wanted, std::unique_ptr<LightingLink> link)
        : options(wanted), table(root), gate(wanted.trigger),
          client(std::move(link), wanted, [this](ByteWriter& out) { writeTask(out); }) {}

    void writeTask(ByteWriter& out) const;
    void diff();
    void place(const Group& root);
    void send(const std::vector<GraphEdit>& edits);
    void takeLight();
    void showObjects(Group& lit, bool moved);
    void rebuildBranch(Group& lit);
    void takeIn(bool allTaken);
    LitObjects::Lights lights() const { return {previewSet, previewLights.size()}; }
    LitMaterial colourOf(const LitMeshMaterial& source) const;

    RadiosityOptions options;
    SceneDiff table;
    TriggerGate gate;
    LightingClient client;
    PlacedScene placed;
    std::unordered_map<std::string, std::size_t> byPath; ///< into placed.objects
    bool toPlace = true, recolour = false;

    std::unique_ptr<LitObjects> shown, incoming;
    std::shared_ptr<StoreReader> store;
    std::vector<LitObject> objects;
    std::vector<std::pair<std::shared_ptr<Switch>, std::shared_ptr<Transform>>> branch;
    const LitObjects* branchOf = nullptr;
    std::uint64_t branchRevision = 0;
    std::vector<Placed<Mesh>> unlit;

    std::vector<std::string> previewLights;
    std::uint32_t previewSet = 0;
    std::uint32_t question = 0, questions = 0; ///< for the dirty set: the present one; so far
    RadiosityState state;
    bool marksTaken = false, lightTaken = false; ///< all that was published before is read
    std::uint64_t updates = 0, blocksBefore = 0;
};

/// The scene as it was sent. Sizes that followed from it at first are kept, so that it is meshed
/// alike wherever things are now.
void RadiosityNode::Impl::writeTask(ByteWriter& out) const {
    LightingTask task{options.meshing, options.solving, {}};
    if (shown) {
        const MeshingOptions& sizes = shown->sizes();
        if (task.meshing.patchSize == 0) task.meshing.patchSize = sizes.patchSize;
        if (task.meshing.elementSize == 0) task.meshing.elementSize = sizes.elementSize;
    }
    write(out, task, table.snapshot());
}

/// Finds edits, and sends those that are due.
void RadiosityNode::Impl::diff() {
    SceneDiff::Change change = table.diff();
    toPlace |= change.any();
    for (GraphEdit& edit : change.edits) {
        recolour |=
            std::holds_alternative<SetMaterial>(edit) || std::holds_alternative<SetLuminance>(edit);
        gate.add(std::move(edit));
    }
    if (change.growth) client.send(*change.growth);
    const std::vector<GraphEdit> due = gate.takeDue();
    updates += change.growth && due.empty();
    send(due);
}

void RadiosityNode::Impl::place(const Group& root) {
    placed = placeBelow(root);
    byPath.clear();
    for (std::size_t o = 0; o < placed.objects.size(); ++o) byPath[placed.objects[o].path] = o;
}

void RadiosityNode::Impl::send(const std::vector<GraphEdit>& edits) {
    for (const GraphEdit& edit : edits)
        if (table.report(edit)) client.send(edit); // else it is of what is gone
    updates += !edits.empty();
}

LitMaterial RadiosityNode::Impl::colourOf(const LitMeshMaterial& source) const {
    LitMaterial colour;
    if (const Material* const material = table.material(source.material)) {
        colour.reflectance = material->reflectance();
        if (source.emits) colour.emission = material->emission();
        colour.textures = material->textures();
        if (!source.emits) colour.textures.emission.reset();
    }
    if (const auto* const light = dynamic_cast<const Light*>(table.node(source.light)))
        if (source.emits) colour.emission = light->luminance();
    return colour;
}

void RadiosityNode::Impl::takeLight() {
    const auto colour = [this](const LitMeshMaterial& material) { return colourOf(material); };
    try {
        if (client.store() && client.store() != store) {
            store = client.store();
            incoming = std::make_unique<LitObjects>(store, lights());
        }
        if (incoming) incoming->take(colour);
        if (incoming && (!shown || incoming->complete())) {
            if (shown) blocksBefore += shown->blocksTaken();
            shown = std::move(incoming);
        } else if (shown) {
            shown->take(colour);
        }
    } catch (const Error& error) {
        client.distrust(error.what());
        incoming.reset();
        store.reset();
    }
    if (shown && question != 0) shown->takeDirty(question);
    if (!std::exchange(recolour, false)) return;
    if (shown) shown->recolour(colour);
    if (incoming) incoming->recolour(colour);
}

void RadiosityNode::Impl::rebuildBranch(Group& lit) {
    for (const auto& [choice, place] : branch) lit.remove(choice);
    branch.clear();
    objects.clear();
    for (const LitObjects::Entry& entry : shown->entries()) {
        objects.push_back(
            {entry.path, glm::dmat4(1.0), true, entry.toObject, entry.geometry, entry.emissive});
        auto choice = std::make_shared<Switch>(entry.path);
        auto place = std::make_shared<Transform>(entry.path);
        if (entry.geometry) place->add(entry.geometry);
        choice->add(place);
        branch.emplace_back(choice, place);
        lit.add(choice);
    }
    branchOf = shown.get();
    branchRevision = shown->revision();
}

/// Puts what is lit where the objects are now.
void RadiosityNode::Impl::showObjects(Group& lit, bool moved) {
    if (shown && (branchOf != shown.get() || branchRevision != shown->revision() ||
                  objects.size() != shown->entries().size())) {
        rebuildBranch(lit);
        moved = true;
    }
    if (!moved) return;
    std::vector<std::uint8_t> isLit(placed.objects.size());
    for (std::size_t o = 0; o < objects.size(); ++o) {
        LitObject& object = objects[o];
        const auto found = byPath.find(object.path);
        object.visible = found != byPath.end() && placed.objects[found->second].visible;
        branch[o].first->setVisible(object.visible);
        if (found == byPath.end()) continue;
        object.toNode = placed.objects[found->second].toWorld;
        branch[o].second->setMatrix(object.toNode * object.toObject);
        isLit[found->second] |= object.geometry != nullptr;
    }
    unlit.clear();
    for (const Placed<Mesh>& mesh : placed.meshes)
        if (!isLit[mesh.object.value] && placed.objects[mesh.object.value].visible)
            unlit.push_back(mesh);
}

RadiosityNode::RadiosityNode(std::string name, const RadiosityOptions& options,
                             std::unique_ptr<LightingLink> link)
    : Group(std::move(name)), lit_(std::make_shared<Group>("lit")),
      impl_(std::make_unique<Impl>(*this, options, std::move(link))) {
    impl_->client.start();
}

RadiosityNode::~RadiosityNode() = default;

void RadiosityNode::accept(Visitor& visitor) const {
    visitor.visit(static_cast<const Group&>(*this));
    visitor.visit(static_cast<const Group&>(*lit_));
}

void RadiosityNode::update() {
    impl_->diff();
    impl_->client.turn(); // the worker begins while objects are posed here
    const bool moved = std::exchange(impl_->toPlace, false);
    if (moved) impl_->place(*this);
    impl_->takeLight();
    impl_->showObjects(*lit_, moved);
    impl_->state = impl_->client.state();
    impl_->state.held = impl_->gate.held();
    impl_->state.updates = impl_->updates;
    impl_->state.blocksTaken =
        impl_->blocksBefore + (impl_->shown ? impl_->shown->blocksTaken() : 0);
    const bool allTaken = !impl_->incoming && impl_->shown && impl_->shown->current();
    impl_->takeIn(allTaken);
}

/// What the worker reports of the light it has published holds here when that has been read.
void RadiosityNode::Impl::takeIn(bool allTaken) {
    marksTaken = state.dirtyMarked && (marksTaken || allTaken);
    state.dirtyMarked = marksTaken;
    lightTaken = state.reached(SolutionState::certified) && (lightTaken || allTaken);
    if (!lightTaken) state.solution = SolutionState::working;
    if (!allTaken) state.solution = std::min(state.solution, SolutionState::certified);
    state.stopped &= allTaken;
}

void RadiosityNode::stop() {
    impl_->client.stop();
}

void RadiosityNode::start() {
    impl_->client.start();
}

void RadiosityNode::setTrigger(Trigger trigger) {
    impl_->diff(); // edits so far belong to the trigger so far
    impl_->gate.setTrigger(trigger);
    impl_->client.send(MessageKind::trigger, std::uint32_t(trigger));
}

void RadiosityNode::setPolicy(PolicyKind policy) {
    impl_->options.solving.policy = policy; // for a worker that is started later
    impl_->client.send(MessageKind::policy, std::uint32_t(policy));
}

void RadiosityNode::setTrigger(const Node& node, std::optional<Trigger> trigger) {
    impl_->diff();
    if (const auto number = impl_->table.numberOf(node)) impl_->gate.setTrigger(*number, trigger);
}

void RadiosityNode::grab(const Node& node) {
    impl_->diff();
    const auto number = impl_->table.numberOf(node);
    if (!number) return;
    impl_->gate.grab(*number);
    impl_->client.send(MessageKind::grab, *number);
}

void RadiosityNode::release(const Node& node) {
    impl_->diff();
    const auto number = impl_->table.numberOf(node);
    if (!number) return;
    impl_->gate.release(*number);
    impl_->client.send(MessageKind::release, *number);
}

void RadiosityNode::requestUpdate() {
    impl_->diff();
    impl_->send(impl_->gate.takeAll());
    impl_->client.send(MessageKind::update, 0);
}

void RadiosityNode::invalidate(const Bounds& box) {
    impl_->client.invalidate(box);
}

void RadiosityNode::setCamera(const View& view) {
    impl_->client.setCamera(view);
}

void RadiosityNode::setPreviewLights(std::vector<std::string> paths) {
    if (paths.size() > kMostPreviewLights) paths.resize(kMostPreviewLights);
    if (paths == impl_->previewLights) return;
    impl_->previewLights = std::move(paths);
    ++impl_->previewSet;
    impl_->client.setPreviewLights(impl_->previewLights, impl_->previewSet);
    if (impl_->shown) impl_->shown->setLights(impl_->lights());
    if (impl_->incoming) impl_->incoming->setLights(impl_->lights());
}

void RadiosityNode::watchDirty(bool watch) {
    if (watch == (impl_->question != 0)) return;
    impl_->question = watch ? ++impl_->questions : 0;
    impl_->client.watchDirty(impl_->question);
}

std::span<const std::vector<DirtyStatus>> RadiosityNode::dirtyBlocks() const {
    if (impl_->question == 0 || !impl_->shown) return {};
    return impl_->shown->work();
}

const std::vector<std::string>& RadiosityNode::previewLights() const {
    return impl_->previewLights;
}

std::span<const LitObject> RadiosityNode::objects() const {
    return impl_->objects;
}

std::optional<PatchSet> RadiosityNode::patches() const {
    return impl_->shown ? impl_->shown->patches() : std::nullopt;
}

const std::vector<Placed<Mesh>>& RadiosityNode::unlit() const {
    return impl_->unlit;
}

const PlacedScene& RadiosityNode::placed() const {
    return impl_->placed;
}

const RadiosityState& RadiosityNode::state() const {
    return impl_->state;
}

std::vector<std::string> RadiosityNode::takeMessages() {
    return impl_->client.takeMessages();
}

} // namespace penumbra
