#include "radiosity/process/store/LightPublisher.h"

#include "base/Parallel.h"
#include "radiosity/mesh/Interpolation.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace penumbra {

namespace {

constexpr std::uint32_t kBlock = PatchSet::kBlock;

/// Light that differs by less is not published while it is still being worked on: nobody sees it.
constexpr double kSmall = 0x1p-12;

bool differs(const glm::dvec3& a, const glm::dvec3& b, bool exact) {
    if (exact) return a != b;
    for (int c = 0; c < 3; ++c)
        if (std::abs(a[c] - b[c]) > kSmall * std::max(std::abs(a[c]), std::abs(b[c]))) return true;
    return false;
}

bool isLit(const glm::dvec3& light) {
    return light != glm::dvec3(0);
}

} // namespace

LightPublisher::LightPublisher(LitScene& scene) : scene_(scene) {
    grow();
}

void LightPublisher::grow() {
    const PatchSet& set = scene_.patches();
    numberElements(set, elementNumber_);
    patchBlocks_.resize(set.patches.size());
    nodes_.resize(set.nodes.size());
    for (; objects_ < set.objects.size(); ++objects_) take(set.objects[objects_]);
    for (std::uint32_t v = set.firstPrivate; v < set.vertices.size(); ++v) take(v);
    if (!lights_.empty() && emitters_ != set.emitters.size())
        setPreviewLights(previewSet_, std::exchange(previewed_, {}));
}

/// The vertices of an object that is known now.
void LightPublisher::take(const ObjectPart& object) {
    for (std::uint32_t v = object.vertices.first; v < object.vertices.end(); ++v) {
        take(v);
        if (v % kBlock == 0) touch(v / kBlock);
    }
}

/// Notes the block of a vertex for the patches whose nodes light it.
void LightPublisher::take(std::uint32_t vertex) {
    const PatchSet& set = scene_.patches();
    const PatchCoordinate& at = set.vertexCoordinates[vertex];
    if (at.patch == Element::kNone) return;
    noteBlock(set.wholeOf(at.patch), vertex / kBlock);
    if (at.blend == PatchCoordinate::kNone) return;
    const NodeBlend& blend = set.blends[at.blend];
    for (std::size_t k = 0; k < blend.patches.size() && blend.weights[k] > 0; ++k)
        noteBlock(blend.patches[k], vertex / kBlock);
}

void LightPublisher::showRough(RoughLight light) {
    if (light.empty()) return;
    rough_ = std::move(light);
    if (scene_.solver().directOnly()) rough_.ambient = {};
    objectsLit_ = objects_;
}

void LightPublisher::directIsDone() {
    objectsLit_ = objects_;
    if (!std::exchange(rough_.direct, {}).empty()) touchAll();
}

void LightPublisher::touchAll() {
    for (std::uint32_t b = 0; b < blockCount(); ++b) touch(b);
}

/// A block has a vertex that is lit by the nodes of a patch of the mesh, or of its parts.
void LightPublisher::noteBlock(std::uint32_t patch, std::uint32_t block) {
    std::vector<std::uint32_t>& blocks = patchBlocks_[patch];
    if (std::find(blocks.rbegin(), blocks.rend(), block) == blocks.rend()) blocks.push_back(block);
}

std::uint32_t LightPublisher::blockCount() const {
    return std::uint32_t(scene_.patches().vertices.size() / kBlock);
}

bool LightPublisher::outgrown() const {
    return store_ && store_->shape().blocks < blockCount();
}

void LightPublisher::setStore(std::unique_ptr<StoreWriter> store) {
    store_ = std::move(store);
    touchAll();
}

void LightPublisher::touch(std::uint32_t block) {
    const PatchSet& set = scene_.patches();
    if (set.objects[set.vertexBlockObject[block].value].path.empty()) return; // nobody draws it
    if (touched_.size() <= block) touched_.resize(std::max(block + 1, blockCount()));
    if (touched_[block] != Touched::no) return;
    touched_[block] = Touched::yes;
    left_.push_back(block);
}

void LightPublisher::touchStale(std::uint32_t block) {
    touch(block);
    staleToShow_ += std::exchange(touched_[block], Touched::stale) != Touched::stale;
}

bool LightPublisher::canPublish(std::uint32_t block) const {
    return block < store_->shape().blocks &&
           (isRough() || scene_.solver().direct().summed(block)) &&
           scene_.patches().vertexBlockObject[block].value < objectsLit_;
}

void LightPublisher::follow(const SceneChange& change) {
    for (std::uint32_t vertex : change.vertices) {
        touch(vertex / kBlock);
        take(vertex);
    }
    for (std::uint32_t patch : change.parted)
        for (std::uint32_t block : patchBlocks_[patch]) touch(block);
}

void LightPublisher::setPreviewLights(std::uint32_t serial, const std::vector<std::string>& paths) {
    const PatchSet& set = scene_.patches();
    previewSet_ = serial;
    previewed_ = paths;
    emitters_ = set.emitters.size();
    lights_.clear();
    lights_.resize(paths.size());
    others_ = {};
    for (std::uint32_t e = 0; e < set.emitters.size(); ++e) {
        if (set.objects[set.emitters[e].object.value].path.empty()) continue; // was replaced
        const auto path = std::find(paths.begin(), paths.end(), set.emitters[e].path);
        LightRows& rows =
            path != paths.end() ? lights_[std::size_t(path - paths.begin())] : others_;
        rows.emitters.push_back(e);
    }
    findStale();
    touchAll();
}

bool LightPublisher::findStale() {
    if (!scene_.solver().direct().dirtyKnown()) return false;
    if (lights_.empty()) return true;
    for (LightRows& rows : lights_) findStale(rows);
    findStale(others_);
    return true;
}

void LightPublisher::findStale(LightRows& rows) {
    const Solver& solver = scene_.solver();
    std::vector<std::uint32_t> now;
    for (std::uint32_t emitter : rows.emitters)
        for (std::uint32_t block : solver.direct().dirtyBlocks(emitter, solver.directTolerance()))
            now.push_back(block);
    std::sort(now.begin(), now.end());
    now.erase(std::unique(now.begin(), now.end()), now.end());
    std::vector<std::uint32_t> begun, ended;
    std::ranges::set_difference(now, rows.stale, std::back_inserter(begun));
    std::ranges::set_difference(rows.stale, now, std::back_inserter(ended));
    for (std::uint32_t block : ended) touch(block);
    for (std::uint32_t block : begun) touchStale(block);
    rows.stale = std::move(now);
}

void LightPublisher::directWorked() {
    for (std::uint32_t block : scene_.solver().takeSummedBlocks()) touch(block);
}

void LightPublisher::solverWorked(bool settled) {
    directWorked();
    nodesChanged(settled);
    if (!settled || scene_.solver().directOnly()) return;
    const Lighting light = scene_.solver().lighting();
    detail_.resize(light.indirect.size());
    for (std::uint32_t v = 0; v < detail_.size(); ++v)
        if (const Rgb detail = light.indirect[v] - interpolatedAt(v); detail != detail_[v]) {
            detail_[v] = detail;
            touch(v / kBlock);
        }
}

/// \param exact all is settled: takes note of the smallest change, not only of what can be seen
void LightPublisher::nodesChanged(bool exact) {
    const std::vector<glm::dvec3> now = scene_.solver().nodeIlluminance();
    if (rough_.ambient != Rgb() && (exact || std::ranges::any_of(now, isLit))) {
        rough_.ambient = {};
        touchAll();
    }
    const PatchSet& set = scene_.patches();
    for (std::uint32_t p = 0; p < set.patches.size(); ++p) {
        const Patch& patch = set.patches[p];
        const auto changed = [&](std::uint32_t node) {
            return differs(nodes_[node], now[node], exact);
        };
        if (!changed(patch.centreNode) &&
            !(patch.hasCornerNodes &&
              std::any_of(patch.cornerNodes.begin(), patch.cornerNodes.end(), changed)))
            continue;
        if (!set.sends(p)) continue;
        for (std::uint32_t block : patchBlocks_[set.wholeOf(p)]) touch(block);
    }
    nodes_ = now;
}

bool LightPublisher::publish(std::size_t most) {
    if (!store_ || left_.empty()) return false;
    store_->setUsed(std::min(blockCount(), store_->shape().blocks));
    std::vector<std::uint32_t> some, later;
    for (; !left_.empty() && some.size() < most; left_.pop_back())
        (canPublish(left_.back()) ? some : later).push_back(left_.back());
    left_.insert(left_.end(), later.rbegin(), later.rend());
    parallelFor(some.size(), 16, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) store_->write(some[i], blockOf(some[i]));
    });
    for (std::uint32_t block : some)
        staleToShow_ -= std::exchange(touched_[block], Touched::no) == Touched::stale;
    return !some.empty();
}

void LightPublisher::publishDirty(std::uint32_t question) {
    if (!store_) return;
    const Solver& solver = scene_.solver();
    const std::vector<DirtySet::AtBlock> dirty =
        solver.direct().updates().dirty().atBlocks(solver.directTolerance());
    std::vector<DirtyStatus> work(blockCount());
    if (!solver.directOnly()) markPatches(work);
    for (std::uint32_t b = 0; b < work.size(); ++b) {
        const DirtySet::AtBlock at = b < dirty.size() ? dirty[b] : DirtySet::AtBlock();
        const bool touched = b < touched_.size() && touched_[b] != Touched::no;
        work[b].rows = std::uint8_t(std::min(at.rows + at.small, 255u));
        work[b].priority = float(std::min(at.priority, 1e30));
        if (at.rows > 0)
            work[b].kind = DirtyStatus::Kind::lights;
        else if (touched || !solver.direct().summed(b))
            work[b].kind = DirtyStatus::Kind::coming;
        else if (at.small > 0 && work[b].kind == DirtyStatus::Kind::none)
            work[b].kind = DirtyStatus::Kind::deferred;
    }
    store_->writeDirty(question, work);
}

/// Blocks of vertices that are lit by patches of which rows are dirty.
void LightPublisher::markPatches(std::vector<DirtyStatus>& work) const {
    const DirtySet& dirty = scene_.solver().indirect().updates().dirty();
    if (dirty.count() == 0) return;
    const std::vector<DirtySet::AtBlock> at = dirty.atBlocks(0);
    const auto isOpen = [&](std::uint32_t node) {
        return node / kBlock < at.size() && at[node / kBlock].rows > 0;
    };
    const PatchSet& set = scene_.patches();
    for (std::uint32_t p = 0; p < set.patches.size(); ++p) {
        const Patch& patch = set.patches[p];
        if (!isOpen(patch.centreNode) &&
            !(patch.hasCornerNodes && std::ranges::any_of(patch.cornerNodes, isOpen)))
            continue;
        if (!set.sends(p)) continue;
        for (std::uint32_t block : patchBlocks_[set.wholeOf(p)])
            work[block].kind = DirtyStatus::Kind::patches;
    }
}

LightBlock LightPublisher::blockOf(std::uint32_t block) const {
    const PatchSet& set = scene_.patches();
    LightBlock light;
    light.object = set.vertexBlockObject[block].value;
    const std::span<const Rgb> lit =
        isRough() ? std::span<const Rgb>(rough_.direct) : scene_.solver().direct().vertices();
    for (std::uint32_t k = 0; k < kBlock; ++k) {
        const std::uint32_t v = block * kBlock + k;
        if (v < lit.size()) light.direct[k] = lit[v];
        light.indirect[k] = indirectAt(v);
    }
    if (block * kBlock >= set.firstPrivate) writeCorners(block, light);
    if (!lights_.empty()) writeLights(block, light);
    return light;
}

Rgb LightPublisher::interpolatedAt(std::uint32_t vertex) const {
    const PatchSet& set = scene_.patches();
    const PatchCoordinate& at = set.vertexCoordinates[vertex];
    if (at.patch == Element::kNone || scene_.solver().directOnly()) return {};
    const glm::dvec3 light = interpolateNodes<glm::dvec3>(set, at, nodes_);
    return {float(light.x), float(light.y), float(light.z)};
}

Rgb LightPublisher::indirectAt(std::uint32_t vertex) const {
    const bool known = vertex < detail_.size() &&
                       scene_.patches().vertexCoordinates[vertex].patch != Element::kNone;
    return rough_.ambient + interpolatedAt(vertex) + (known ? detail_[vertex] : Rgb());
}

void LightPublisher::writeLights(std::uint32_t block, LightBlock& light) const {
    light.previewSet = previewSet_;
    light.lights = std::uint32_t(lights_.size());
    for (std::size_t l = 0; l < lights_.size(); ++l) {
        for (std::uint32_t emitter : lights_[l].emitters) {
            const auto factors = scene_.solver().direct().factors(emitter, block);
            for (std::size_t k = 0; k < kBlock; ++k) light.factor[l][k] += factors[k];
        }
        if (!lights_[l].emitters.empty())
            light.exitance[l] = scene_.patches().emitters[lights_[l].emitters.front()].exitance;
        // What other lights give is in the light that a factor is taken with.
        const auto isStale = [&](const LightRows& rows) {
            return std::ranges::binary_search(rows.stale, block);
        };
        if (isRough() || isStale(lights_[l]) || isStale(others_)) light.stale |= 1u << l;
    }
}

void LightPublisher::writeCorners(std::uint32_t block, LightBlock& light) const {
    const PatchSet& set = scene_.patches();
    for (std::uint32_t k = 0; k < kBlock; ++k) {
        const std::uint32_t v = block * kBlock + k;
        light.corners[k] = kNoCorner;
        if (isPadding(set.vertices[v].receiver)) continue;
        const std::uint32_t element = set.privateElement[v - set.firstPrivate];
        const auto& corners = set.elements[element].vertices;
        const auto corner = std::find(corners.begin(), corners.end(), v) - corners.begin();
        if (corner < 4) light.corners[k] = 4 * elementNumber_[element] + std::uint32_t(corner);
    }
}

} // namespace penumbra
