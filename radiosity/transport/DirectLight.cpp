#include "radiosity/transport/DirectLight.h"

#include "radiosity/schedule/WorkCosts.h"
#include "radiosity/transport/RowCarrying.h"

#include "base/Bits.h"
#include "base/Parallel.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace penumbra {

namespace {

constexpr std::uint32_t kBlock = PatchSet::kBlock;

void noteOnce(std::vector<std::uint32_t>& items, std::uint32_t item) {
    if (std::find(items.rbegin(), items.rend(), item) == items.rend()) items.push_back(item);
}

EmitterSender sender(const Emitter& emitter, int samples) {
    const int base = std::min(samples, RowBlock::kSize);
    return EmitterSender(emitter, base, std::min(4 * base, RowBlock::kSize));
}

} // namespace

DirectLight::DirectLight(const PatchSet& set, const RayScene& rays, int samples)
    : set_(set), samples_(samples), walls_(set), table_(set.emitters.size()),
      updates_(set, rays, table_, set.vertexBlockObject,
               {.visit = cost::kDirectVisit, .entry = cost::kDirectEntry}),
      patchTouched_(set.patches.size()), patches_(set.patches.size()),
      cells_(set.nodes.empty() ? 0 : set.patches.size()), patchLit_(set.patches.size()) {
    placeEmitters();
    blockPatches_.resize(set.firstPrivate / kBlock);
    blockBlends_.resize(blockPatches_.size());
    noteBlends({0, set.firstPrivate});
    noteBlocks({0, std::uint32_t(set.elements.size())});
    std::vector<BlockMask> all;
    for (std::uint32_t b = 0; b < set.vertices.size() / kBlock; ++b)
        all.push_back({b, ~std::uint64_t(0)});
    placeReceivers(all);
    updates_.add({}, std::move(all));
}

/// All of them anew: they refer to those of the set, which may lie elsewhere in memory now.
void DirectLight::placeEmitters() {
    emitters_.clear();
    for (const Emitter& emitter : set_.emitters) emitters_.push_back(sender(emitter, samples_));
    order_.resize(emitters_.size());
    std::iota(order_.begin(), order_.end(), 0u);
    const auto address = [&](std::uint32_t e) {
        const ObjectPart& part = set_.objects[set_.emitters[e].object.value];
        return std::pair(part.key, e - part.emitters.first);
    };
    std::ranges::stable_sort(order_, {}, address);
}

/// Notes which patches the corners of some elements may light.
void DirectLight::noteBlocks(Range elements) {
    for (std::uint32_t e = elements.first; e < elements.end(); ++e) {
        const Element& element = set_.uncoveredElements[e];
        if (element.patch == Element::kNone) continue;
        for (const std::uint32_t v : element.vertices) {
            noteOnce(blockPatches_[v / kBlock], element.patch);
            if (!set_.isBlended(v / kBlock)) continue;
            const VertexBlend& blend = set_.vertexBlend(v);
            for (std::size_t k = 0; k < 4 && blend.weights[k] > 0; ++k)
                noteOnce(blockPatches_[blend.vertices[k] / kBlock], element.patch);
        }
    }
}

/// Notes which blocks take light from which.
void DirectLight::noteBlends(Range vertices) {
    for (std::uint32_t v = vertices.first; v < vertices.end(); ++v) {
        if (!set_.isBlended(v / kBlock)) continue;
        const VertexBlend& blend = set_.vertexBlend(v);
        for (std::size_t k = 0; k < 4 && blend.weights[k] > 0; ++k)
            noteOnce(blockBlends_[blend.vertices[k] / kBlock], v / kBlock);
    }
}

void DirectLight::add(std::span<const ObjectId> objects) {
    walls_.grow();
    placeEmitters();
    const std::size_t before = table_.size();
    table_.grow(emitters_.size());
    for (std::size_t row = before; row < table_.size(); ++row)
        table_[row].resize(table_.blocks().size());
    updates_.grow();
    for (const ObjectId object : objects) {
        noteBlends(set_.objects[object.value].vertices);
        noteBlocks(set_.objects[object.value].elements);
    }
    described_ = false;
}

std::span<const Receiver> DirectLight::receiversOf(std::size_t block) const {
    return std::span(receivers_).subspan(block * kBlock, kBlock);
}

/// Follows the vertices of some blocks. Blocks that are new come at the end.
void DirectLight::placeReceivers(std::vector<BlockMask>& masks) {
    const std::size_t blocks = set_.vertices.size() / kBlock;
    receivers_.resize(set_.vertices.size(), Receiver{});
    vertices_.resize(set_.vertices.size());
    vertexSeen_.resize(set_.vertices.size());
    blockTouched_.resize(blocks);
    if (updates_.dirty().blocks() != blocks) described_ = false;
    blockSummed_.resize(blocks);
    for (std::size_t row = 0; row < table_.size(); ++row) table_[row].resize(blocks);
    while (table_.blocks().size() < blocks) table_.blocks().append({});
    for (const auto& [block, bits] : masks) {
        Bounds box;
        for (std::size_t v = block * kBlock; v < (block + 1) * kBlock; ++v) {
            receivers_[v] = set_.isBlended(block) ? Receiver{} : set_.vertices[v].receiver;
            if (!isPadding(receivers_[v])) box.add(receivers_[v].position);
        }
        table_.blocks().set(block, box);
    }
}

/// Patches that may be lit by vertices of a block, some perhaps several times.
template <class Visit>
void DirectLight::forEachPatch(std::uint32_t block, Visit visit) const {
    if (block < blockPatches_.size()) {
        for (std::uint32_t patch : blockPatches_[block]) set_.forEachPart(patch, visit);
        return;
    }
    for (std::uint32_t v = block * kBlock; v < (block + 1) * kBlock; ++v)
        if (!isPadding(receivers_[v]))
            visit(set_.elements[set_.privateElement[v - set_.firstPrivate]].patch);
}

/// For bounds of what dirty blocks may change. Private vertices are handed out and given back: any
/// surface may be theirs.
void DirectLight::describeReceivers() {
    std::vector<DirtySet::Receivers> blocks(table_.blocks().size());
    parallelFor(blockPatches_.size(), 256, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            blocks[b].reflectance = 0;
            for (std::uint32_t p : blockPatches_[b]) {
                const Rgb rho = patchReflectance(set_, p);
                blocks[b].reflectance = std::max(blocks[b].reflectance, maxChannel(rho));
            }
        }
    });
    updates_.dirty().setReceivers(std::move(blocks));
    for (std::uint32_t e = 0; e < set_.emitters.size(); ++e)
        updates_.dirty().setPower(e, maxChannel(set_.emitters[e].exitance));
    described_ = true;
}

std::vector<double> DirectLight::dirtyLight() const {
    std::vector<double> light(set_.patches.size());
    const DirtySet& dirty = updates_.dirty();
    if (dirty.count() == 0) return light;
    for (std::uint32_t b = 0; b < dirty.blocks(); ++b)
        if (dirty.light(b) > 0)
            forEachPatch(b,
                         [&](std::uint32_t p) { light[p] = std::max(light[p], dirty.light(b)); });
    return light;
}

void DirectLight::takeOver(DirectLight& before, const PatchMatch& match) {
    if (!before.described_) before.describeReceivers();
    describeReceivers();
    before.updates_.findAll([&](std::uint32_t row) { return before.factsOf(row); });
    const RowCarrying carrying(set_, match, match.vertices);
    std::vector<std::vector<BlockMask>> anew(table_.size());
    parallelFor(table_.size(), 1, [&](std::size_t e, std::size_t) {
        const std::uint32_t was = match.emitters[e];
        if (was == PatchMatch::kNew) return;
        const auto row = std::uint32_t(e);
        EntryCarrier carrier = carrying.carrier();
        anew[e] =
            carrying.carry({row, was}, before.table_, before.updates_.dirty(), carrier, table_);
        carryOccluders(row, before, carrying, match);
    });
    for (std::uint32_t e = 0; e < table_.size(); ++e) {
        if (match.emitters[e] == PatchMatch::kNew) continue;
        updates_.setCurrent(e);
        updates_.mark(
            e, [&](std::uint32_t row) { return factsOf(row); }, anew[e]);
    }
    updates_.add(match.changed, carrying.unknown());
    for (std::uint32_t b = 0; b < table_.blocks().size(); ++b) touchBlock(b);
}

/// Remembers who hid what.
void DirectLight::carryOccluders(std::uint32_t row, const DirectLight& before,
                                 const RowCarrying& carrying, const PatchMatch& match) {
    const std::uint32_t wasRow = match.emitters[row];
    const auto were = before.table_.occluders(wasRow);
    if (were.empty()) return;
    std::vector<RowTable::BlockerNote> notes = carrying.occluders(row, were, table_[row]);
    for (std::uint32_t b = 0; b < table_.blocks().size(); ++b) {
        if (carrying.isWhole(b)) continue;
        for (std::uint32_t v = b * kBlock; v < (b + 1) * kBlock; ++v) {
            const std::uint32_t was = match.vertices[v];
            if (was == PatchMatch::kNew || isPadding(before.receivers_[was])) continue;
            if (const ObjectId wall = before.wallBefore(wasRow, was); wall.valid())
                notes.push_back({row, b, match.objects[wall.value]});
        }
    }
    table_.noteOccluders(notes);
}

void DirectLight::apply(const SceneChange& change) {
    if (change.colours || !change.emitters.empty()) described_ = false;
    std::vector<BlockMask> masks;
    const auto isChanged = [&](ObjectId object) {
        return std::find(change.objects.begin(), change.objects.end(), object) !=
               change.objects.end();
    };
    for (std::uint32_t b = 0; b < set_.vertexBlockObject.size(); ++b)
        if (isChanged(set_.vertexBlockObject[b])) masks.push_back({b, ~std::uint64_t(0)});
    for (std::uint32_t v : change.vertices)
        masks.push_back({v / kBlock, std::uint64_t(1) << v % kBlock});
    unite(masks);
    placeReceivers(masks);
    for (ObjectId object : change.objects) {
        const ObjectPart& part = set_.objects[object.value];
        for (std::uint32_t e = part.emitters.first; e < part.emitters.end(); ++e)
            emitters_[e] = sender(set_.emitters[e], samples_);
        walls_.place(object);
        for (std::uint32_t p = part.patches.first; p < part.patches.end(); ++p)
            set_.forEachPart(p, [&](std::uint32_t each) { touchPatch(each); });
    }
    for (std::uint32_t p : change.patches)
        set_.forEachPart(p, [&](std::uint32_t part) { touchPatch(part); });
    for (std::uint32_t p : change.senders) touchPatch(p);
    for (std::uint32_t p : change.patches) touchBlended(p);
    for (std::uint32_t e : change.emitters) // no form factor changes: only sums
        for (std::uint32_t b = 0; b < table_[e].size(); ++b)
            if (table_[e][b].entryCount() > 0) touchBlock(b);
    if (!change.objects.empty() || !masks.empty()) updates_.add(change.objects, std::move(masks));
}

void DirectLight::invalidate(const Bounds& region) {
    updates_.add({}, {}, {region});
}

void DirectLight::touchBlock(std::uint32_t block) {
    if (std::exchange(blockTouched_[block], 1)) return;
    touchedBlocks_.push_back(block);
    if (block >= blockBlends_.size()) return;
    for (const std::uint32_t blended : blockBlends_[block]) touchBlock(blended);
}

/// Of a cluster that other things cover otherwise than before: which of its receivers count.
void DirectLight::touchBlended(std::uint32_t patch) {
    const Patch& p = set_.patches[patch];
    for (std::uint32_t i = 0; p.cluster && i < p.elementCount; ++i)
        for (const std::uint32_t v :
             set_.uncoveredElements[set_.patchElements[p.firstElement + i]].vertices)
            touchBlock(v / kBlock);
}

void DirectLight::touchPatch(std::uint32_t patch) {
    if (std::exchange(patchTouched_[patch], 1)) return;
    touchedPatches_.push_back(patch);
}

void DirectLight::sumUp(std::size_t effort) {
    constexpr std::size_t kPiece = std::size_t(1) << 20;
    for (; effort > 0 && sumBlocks(std::min(effort, kPiece));) effort -= std::min(effort, kPiece);
}

void DirectLight::narrow(const std::function<std::uint64_t(std::uint32_t, std::uint32_t)>& which) {
    for (std::uint32_t e = 0; e < set_.emitters.size(); ++e)
        for (std::uint32_t b = 0; b < set_.vertexBlockObject.size(); ++b)
            updates_.dirty().narrow(e, b, which(e, b));
}

RowUpdates::RowFacts DirectLight::factsOf(std::uint32_t row) const {
    const Emitter& emitter = set_.emitters[row];
    RowUpdates::RowFacts known{true, emitters_[row].box(), emitter.object, {}, {}, {}};
    known.area = float(emitter.area);
    known.hidden = [this, row](const Bounds& box) {
        return walls_.between(emitters_[row].box(), box);
    };
    return known;
}

bool DirectLight::update(std::size_t effort, double enough) {
    if (!described_) describeReceivers();
    if (updates_.done(enough)) return false;
    const auto facts = [&](std::uint32_t row) { return factsOf(row); };
    const auto receiversFor = [&](const DirtyBlock& item, std::span<const MovedObject> moved,
                                  std::vector<ObjectId>& occluders) {
        const bool present = set_.objects[set_.emitters[item.row].object.value].present &&
                             set_.objects[set_.vertexBlockObject[item.block].value].present;
        ReceiverBlock receivers{receiversOf(item.block), 0, {}, item.receivers};
        if (present) receivers.wanted = ~hidden(item, moved, occluders);
        return receivers;
    };
    const auto expect = [&](ChangeProbe& probe, const DirtyBlock& item,
                            std::span<const MovedObject> moved) {
        const ReceiverBlock receivers = receiversFor(item, moved, probe.occluders);
        return probe.at(emitters_[item.row], receivers, item.anew, moved,
                        table_[item.row][item.block]);
    };
    const auto update = [&](RowBuilder& builder, const DirtyBlock& item,
                            std::span<const MovedObject> moved, std::size_t) {
        const ReceiverBlock receivers = receiversFor(item, moved, builder.occluders);
        return builder.emitters.update(emitters_[item.row], receivers, item.anew, moved,
                                       table_[item.row][item.block]);
    };
    for (const DirtyBlock& item : updates_.work(effort, enough, facts, update, expect))
        touchBlock(item.block);
    for (std::uint32_t block : updates_.takeHidden()) touchBlock(block);
    return true;
}

ObjectId DirectLight::wallBefore(std::uint32_t emitter, std::uint32_t vertex) const {
    const glm::vec3 point = receivers_[vertex].position;
    return walls_.between(emitters_[emitter].box(), {point, point});
}

/// Bits: receivers of a block that a wall hides from the emitter, so that there need not be an
/// entry. An entry that is not evaluated anew was not hidden when it last was: only what moved
/// since may hide it. \param occluders receives who does
std::uint64_t DirectLight::hidden(const DirtyBlock& item, std::span<const MovedObject> moved,
                                  std::vector<ObjectId>& occluders) const {
    if (item.anew == 0 && !walls_.areAmong(moved)) return 0;
    const Bounds& sender = emitters_[item.row].box();
    const Bounds& block = table_.blocks()[item.block];
    const auto receivers = receiversOf(item.block);
    std::uint64_t found = 0;
    const auto look = [&](std::uint32_t wall, std::uint64_t which) {
        std::uint64_t behind = 0;
        for (const std::uint32_t r : bitsOf(which & ~found))
            if (!isPadding(receivers[r]) && walls_.isHidden(wall, sender, receivers[r].position))
                behind |= std::uint64_t(1) << r;
        if (behind != 0) occluders.push_back(walls_.objectOf(wall));
        found |= behind;
    };
    if (item.anew != 0) {
        if (const ObjectId wall = walls_.between(sender, block); wall.valid()) {
            occluders.push_back(wall);
            return ~std::uint64_t(0);
        }
        for (const std::uint32_t wall : walls_.beside(sender, block))
            look(wall, item.receivers & item.anew);
    }
    for (const std::uint32_t wall : walls_.beside(sender, block, moved)) {
        if (walls_.isHidden(wall, sender, block)) {
            occluders.push_back(walls_.objectOf(wall));
            return ~std::uint64_t(0);
        }
        look(wall, item.receivers & ~item.anew);
    }
    return found;
}

bool DirectLight::sumBlocks(std::size_t effort) {
    if (touchedBlocks_.empty()) return false;
    const std::size_t each = cost::kSum + cost::kSumRow * emitters_.size();
    const std::size_t count =
        std::min(touchedBlocks_.size(), std::max<std::size_t>(4, effort / each));
    const auto some = std::span(touchedBlocks_).last(count);
    parallelFor(count, 16, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) sumBlock(some[i]);
    });
    for (std::uint32_t block : some) {
        blockTouched_[block] = 0;
        if (!std::exchange(blockSummed_[block], 1)) summedBlocks_.push_back(block);
        forEachPatch(block, [&](std::uint32_t patch) { touchPatch(patch); });
    }
    touchedBlocks_.resize(touchedBlocks_.size() - count);
    return true;
}

std::vector<std::uint32_t> DirectLight::takeSummedBlocks() {
    for (std::uint32_t block : summedBlocks_) blockSummed_[block] = 0;
    return std::exchange(summedBlocks_, {});
}

std::vector<std::uint32_t> DirectLight::dirtyBlocks(std::uint32_t emitter, double enough) const {
    std::vector<std::uint32_t> blocks = updates_.dirty().urgent(emitter, enough);
    for (std::size_t i = 0, count = blocks.size(); i < count; ++i)
        if (blocks[i] < blockBlends_.size())
            blocks.insert(blocks.end(), blockBlends_[blocks[i]].begin(),
                          blockBlends_[blocks[i]].end());
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    return blocks;
}

double DirectLight::brightest() const {
    double most = 0;
    for (const Emitter& emitter : set_.emitters)
        most = std::max<double>(most, maxChannel(emitter.exitance));
    return most;
}

} // namespace penumbra
