// Rows of the indirect light, and how edits change them. Which blocks they have is in
// IndirectLinks.cpp, what patches owe in IndirectResiduals.cpp, how they send it in
// IndirectShots.cpp.
#include "radiosity/transport/IndirectLight.h"

#include "base/Bits.h"
#include "base/Parallel.h"
#include "radiosity/rows/SenderSamples.h"
#include "radiosity/schedule/WorkCosts.h"
#include "radiosity/transport/DirectLight.h"
#include "radiosity/transport/RowCarrying.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace penumbra {

namespace {

constexpr std::uint32_t kBlock = PatchSet::kBlock;
bool isDark(const PatchSet& set) {
    return std::ranges::none_of(set.emitters, [&](const Emitter& emitter) {
        return maxChannel(emitter.exitance) > 0 && set.objects[emitter.object.value].present;
    });
}

} // namespace

IndirectLight::IndirectLight(const PatchSet& set, const RayScene& rays, const DirectLight& direct,
                             const NodeHits& nodeHits, std::size_t memory, bool clusters)
    : set_(set), rays_(rays), direct_(direct), nodeHits_(nodeHits), memory_(memory),
      senders_(set, clusters), table_(senders_.count()),
      updates_(set, rays, table_, set.nodeBlockObject,
               {.visit = cost::kIndirectVisit, .entry = cost::kIndirectEntry}),
      nodes_(set.nodes.size()), rowSums_(set.nodes.size()) {
    growSenders();
    for (std::uint32_t n = 0; n < set.nodes.size(); ++n) nodeKeys_.push_back(addressOfNode(set, n));
    for (std::uint32_t p = 0; p < senders_.patchCount(); ++p) planar_.push_back(isPlanar(p));
    std::vector<BlockMask> all;
    for (std::uint32_t b = 0; b < blockCount(); ++b) all.push_back({b, ~std::uint64_t(0)});
    for (std::uint32_t o = 0; o < set.objects.size(); ++o) placeStands({o});
    placeNodes(all);
    reach_.nodes.resize(blockCount());
    reach_.enclosed.resize(blockCount());
    coloursChanged();
}

void IndirectLight::growSenders() {
    const std::size_t count = senders_.count();
    table_.grow(count);
    updates_.grow();
    sendersReached_.resize(count);
    sent_.resize(senders_.cellCount()), residuals_.resize(senders_.cellCount());
    known_.resize(count), kept_.resize(count), expects_.resize(count, 1);
}

void IndirectLight::add(std::span<const ObjectId> objects) {
    for (const ObjectId object : objects) {
        const ObjectPart& part = set_.objects[object.value];
        senders_.add(object);
        for (std::uint32_t p = part.patches.first; p < part.patches.end(); ++p)
            planar_[p] = isPlanar(p);
        for (std::uint32_t n = part.nodes.first; n < part.nodes.end(); ++n)
            nodeKeys_[n] = addressOfNode(set_, n);
    }
    growSenders();
    coloursChanged();
    allChanged();
}

/// Whether a patch sends from one plane.
bool IndirectLight::isPlanar(std::uint32_t index) const {
    const Patch& patch = set_.patches[index];
    const auto points = std::span(senders_.sender(index).samples, kPatchSamples);
    return std::all_of(points.begin(), points.end(), [&](glm::vec3 point) {
        const float height = glm::dot(patch.normal, point - patch.centre);
        return height * height < 1e-8f * patch.area;
    });
}

void IndirectLight::takeOver(IndirectLight& before, const PatchMatch& match) {
    if (before.relaxing() || before.rowsMissing_) before.restart();
    if (!before.described_) before.describeReceivers();
    describeReceivers();
    before.updates_.findAll([&](std::uint32_t s) { return before.factsOf(s); });
    takeReached(before, match);
    const RowCarrying carrying(set_, match, match.nodes);
    const std::vector<std::uint32_t> was = before.keptFor(senders_, match);
    std::vector<std::vector<BlockMask>> anew(senders_.count());
    std::vector<std::size_t> bytes(senders_.count());
    parallelFor(senders_.count(), 64, [&](std::size_t first, std::size_t last) {
        EntryCarrier carrier = carrying.carrier();
        for (auto s = std::uint32_t(first); s < last; ++s) {
            if (was[s] == ObjectId::kNone) continue;
            table_[s].open(senders_.linkedBlocks(s, linkBoxes_));
            anew[s] = carrying.carry({s, was[s]}, before.table_, before.updates_.dirty(), carrier,
                                     table_);
            carryOccluders(s, before.table_.occluders(was[s]), carrying, anew[s]);
            for (const RowBlock& block : table_[s]) bytes[s] += block.bytes();
        }
    });
    for (std::uint32_t s = 0; s < senders_.count(); ++s) {
        if (was[s] == ObjectId::kNone) continue;
        kept_[s] = 1;
        known_[s] = before.known_[was[s]];
        // A patch of one element has one cell or, where it came later, sixteen alike.
        const SenderLight from = before.cellsOf(before.sent_, was[s]);
        const std::span<glm::dvec3> to = cellsOf(sent_, s);
        for (std::size_t c = 0; c < to.size(); ++c) to[c] = from[from.size() == to.size() ? c : 0];
        rowBytes_ += bytes[s];
        updates_.setCurrent(s);
        updates_.mark(
            s, [&](std::uint32_t row) { return factsOf(row); }, anew[s]);
        updates_.dirty().setPower(s, largest(to));
    }
    receiveAgain();
    completed_ = before.completed_;
    described_ = false; // the receivers have light now
    updates_.add(match.changed, carrying.unknown());
}

/// Remembers who hid what from a sender. Blocks are hidden as wholes: receivers of one that was,
/// and that is not what it was, are to be evaluated anew.
void IndirectLight::carryOccluders(std::uint32_t sender,
                                   std::span<const RowTable::BlockerNote> were,
                                   const RowCarrying& carrying, std::vector<BlockMask>& anew) {
    table_.noteOccluders(carrying.occluders(sender, were, table_[sender]));
    const auto partly = carrying.partlyHidden(were, table_[sender]);
    anew.insert(anew.end(), partly.begin(), partly.end());
    unite(anew);
}

/// Of each of some senders the one here that sends just alike and has a row, ObjectId::kNone if
/// there is none.
std::vector<std::uint32_t> IndirectLight::keptFor(const IndirectSenders& senders,
                                                  const PatchMatch& match) const {
    std::vector<std::uint32_t> was = senders.matched(senders_);
    std::vector<std::uint8_t> left = kept_; // two that are alike don't have one row
    for (std::uint32_t s = 0; s < senders.count(); ++s) {
        if (was[s] == ObjectId::kNone) continue;
        if (match.isChanged(senders.object(s)) || !std::exchange(left[was[s]], 0))
            was[s] = ObjectId::kNone;
    }
    return was;
}

/// Nodes that light reached before may still have entries, others have none.
void IndirectLight::takeReached(const IndirectLight& before, const PatchMatch& match) {
    for (std::uint32_t n = 0; n < match.nodes.size(); ++n) {
        const std::uint32_t was = match.nodes[n];
        if (was != PatchMatch::kNew && before.reached(was))
            reach_.nodes[n / 64] |= std::uint64_t(1) << n % 64;
    }
}

/// What nodes have received through the rows as they are.
void IndirectLight::receiveAgain() {
    parallelFor(blockCount(), 16, [&](std::size_t first, std::size_t last) {
        for (std::uint32_t s = 0; s < senders_.count(); ++s) {
            const Row& row = table_[s];
            const SentLight sent(cellsOf(std::as_const(sent_), s));
            std::size_t slot = known_[s] ? row.slotFrom(std::uint32_t(first)) : row.size();
            for (; slot < row.size() && row.blockAt(slot) < last; ++slot) {
                const std::size_t node = row.blockAt(slot) * kBlock;
                const RowBlock& block = row.begin()[std::ptrdiff_t(slot)];
                forEachReceived(block, sent, [&](int r, float factor, glm::dvec3 light) {
                    nodes_[node + std::size_t(r)] += light;
                    rowSums_[node + std::size_t(r)] += factor;
                });
            }
        }
    });
}

void IndirectLight::apply(const SceneChange& change) {
    described_ = false;
    std::ranges::fill(expects_, std::uint8_t(1));
    directStale_ = true;
    for (ObjectId object : change.objects) {
        senders_.place(object);
        placeStands(object);
    }
    for (std::uint32_t p : change.senders) {
        senders_.placePatch(p);
        planar_[p] = isPlanar(p);
    }
    const std::vector<std::uint32_t> otherwiseBright = senders_.followEmitters(change);
    const std::vector<BlockMask> masks = nodesOf(change);
    placeNodes(masks);
    residualsChanged();
    noteSenders(change);
    for (const BlockMask& mask : masks) changedBlocks_[mask.block] = 1;
    if (change.colours) allChanged();
    if (change.colours || !change.parted.empty()) coloursChanged();
    reachStale_ |= !change.objects.empty() || !masks.empty() || !change.patches.empty();
    if (isDark(set_)) restart(); // what is taken back leaves a rest of rounding
    if (change.objects.empty() && masks.empty() && change.senders.empty() &&
        otherwiseBright.empty())
        return;
    for (ObjectId object : change.objects) link(object);
    for (std::uint32_t p : change.senders) linkSender(p);
    for (const BlockMask& mask : masks)
        if (mask.block * kBlock >= set_.parts.firstNode) linkBlock(mask.block);
    if (rowsMissing_) restart();
    updates_.add(change.objects, masks);
    markRows(change.senders);
    markRows(otherwiseBright);
}

/// Nodes that lie elsewhere, block by block.
std::vector<BlockMask> IndirectLight::nodesOf(const SceneChange& change) const {
    std::vector<BlockMask> masks;
    for (ObjectId object : change.objects) {
        const ObjectPart& part = set_.objects[object.value];
        for (std::uint32_t b = part.nodes.first / kBlock; b * kBlock < part.nodes.end(); ++b)
            if (part.nodes.count > 0) masks.push_back({b, ~std::uint64_t(0)});
        for (auto b = std::uint32_t(set_.parts.firstNode / kBlock); b < blockCount(); ++b)
            if (set_.nodeBlockObject[b] == object) masks.push_back({b, ~std::uint64_t(0)});
    }
    for (std::uint32_t n : change.nodes)
        masks.push_back({n / kBlock, std::uint64_t(1) << n % kBlock});
    unite(masks);
    return masks;
}

/// Has all entries of the rows of some senders evaluated anew.
void IndirectLight::markRows(std::span<const std::uint32_t> senders) {
    for (const std::uint32_t s : senders) {
        if (!kept_[s]) continue;
        std::vector<BlockMask> all;
        for (std::size_t i = 0; i < table_[s].size(); ++i)
            all.push_back({table_[s].blockAt(i), ~std::uint64_t(0)});
        updates_.mark(
            s, [&](std::uint32_t row) { return factsOf(row); }, all);
    }
}

void IndirectLight::invalidate(const Bounds& region) {
    described_ = false;
    std::ranges::fill(expects_, std::uint8_t(1));
    residualsChanged();
    if (rowsMissing_) restart();
    updates_.add({}, {}, {region});
}

void IndirectLight::directChanged(bool litChanged) {
    directStale_ = true;
    reachStale_ |= litChanged;
    residualsChanged();
}

/// What rows that were not kept have sent can't be corrected: everything is sent again.
void IndirectLight::restart() {
    for (std::size_t i = 0; shot_ && i < shot_->senders.size(); ++i) {
        const std::uint32_t s = shot_->senders[i];
        if (!shot_->build[i] || !kept_[s]) continue; // else half built
        table_.clear(s);
        kept_[s] = 0;
        updates_.drop(s);
    }
    shot_.reset();
    listing_.reset();
    std::fill(nodes_.begin(), nodes_.end(), glm::dvec3(0));
    std::fill(rowSums_.begin(), rowSums_.end(), 0.0);
    std::fill(sent_.begin(), sent_.end(), glm::dvec3(0));
    std::fill(known_.begin(), known_.end(), std::uint8_t(0));
    std::ranges::fill(expects_, std::uint8_t(1));
    for (std::uint32_t s = 0; s < senders_.count(); ++s) updates_.dirty().setPower(s, 0);
    rowsMissing_ = completed_ = false;
    allChanged();
}

void IndirectLight::updateReach() {
    reachStale_ = false;
    reachRevision_ = nodeHits_.revision();
    Reach now = findReach(set_, nodeHits_, direct_.patchLit());
    std::vector<BlockMask> masks;
    for (std::uint32_t b = 0; b < now.nodes.size(); ++b)
        if (const std::uint64_t differs = now.nodes[b] ^ reach_.nodes[b])
            masks.push_back({b, differs});
    noteReached(now);
    directStale_ |= now.patches != reach_.patches;
    reach_ = std::move(now);
    updateSendersReached();
    listForgotten();
    if (masks.empty()) return;
    if (rowsMissing_) restart();
    updates_.add({}, std::move(masks));
}

/// Rows of senders that light does not get to any more are to be forgotten: a new solution has none
/// of these.
void IndirectLight::listForgotten() {
    forgotten_.clear();
    bool missing = false;
    for (std::uint32_t s = 0; s < senders_.count(); ++s) {
        if (sendersReached_[s]) continue;
        if (kept_[s]) forgotten_.push_back(s);
        missing |= !kept_[s] && known_[s];
    }
    if (missing) restart();
}

bool IndirectLight::isOnItsWay(std::uint32_t sender) const {
    return shot_ && std::ranges::find(shot_->senders, sender) != shot_->senders.end();
}

void IndirectLight::forgetSome(std::size_t effort) {
    residualsChanged();
    constexpr std::size_t kBlocksARay = 8;
    for (std::size_t cost = 0; cost < effort && !forgotten_.empty(); forgotten_.pop_back()) {
        const std::uint32_t s = forgotten_.back();
        if (!kept_[s] || isOnItsWay(s)) continue; // it is listed again when it has arrived
        cost += 1 + table_[s].size() / kBlocksARay;
        forget(s);
    }
}

/// Takes back what a row has sent, and drops it. \pre it is kept, and nothing is on its way
void IndirectLight::forget(std::uint32_t sender) {
    const Row& row = table_[sender];
    const SentLight sent(cellsOf(std::as_const(sent_), sender));
    std::size_t bytes = 0;
    for (std::size_t slot = 0; slot < row.size(); ++slot) {
        const RowBlock& block = row.begin()[std::ptrdiff_t(slot)];
        const std::size_t node = row.blockAt(slot) * kBlock;
        bytes += block.bytes();
        if (!block.empty()) changedBlocks_[row.blockAt(slot)] = 1;
        forEachReceived(block, sent, [&](int r, float factor, glm::dvec3 light) {
            nodes_[node + std::size_t(r)] -= light;
            if (known_[sender]) rowSums_[node + std::size_t(r)] -= double(factor);
        });
    }
    rowBytes_ -= std::min(rowBytes_, bytes);
    table_.clear(sender);
    kept_[sender] = known_[sender] = 0;
    expects_[sender] = 1;
    std::ranges::fill(cellsOf(sent_, sender), glm::dvec3(0));
    changedSenders_.push_back(sender);
    updates_.drop(sender);
    updates_.dirty().setPower(sender, 0);
}

/// For bounds of what dirty blocks may change.
void IndirectLight::describeReceivers() {
    std::vector<DirtySet::Receivers> blocks(blockCount());
    parallelFor(blocks.size(), 16, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            blocks[b].reflectance = reflectances_[b];
            for (auto n = std::uint32_t(b * kBlock); n < (b + 1) * kBlock; ++n)
                blocks[b].light = std::max(blocks[b].light, float(largest(node(n))));
        }
    });
    updates_.dirty().setReceivers(std::move(blocks));
    described_ = true;
}

/// Brings a block up to date. What of it had arrived is taken back, what is right added: in
/// `delta`, node by node. \return the number of entries that are not what they were
int IndirectLight::updateBlock(RowBuilder& builder, const DirtyBlock& item,
                               std::span<const MovedObject> moved, BlockDelta& delta) {
    constexpr std::uint64_t kAll = ~std::uint64_t(0);
    RowBlock& block = table_[item.row][item.block];
    const Arrived arrived = arrivedAt(item.row, item.block);
    const SentLight sent(arrived.light);
    std::array<NodeDelta, kBlock> nodes{};
    forEachReceived(block, sent, [&](int r, float factor, glm::dvec3 light) {
        nodes[std::size_t(r)] = {0, -double(factor), -light};
    });
    ReceiverBlock receivers = receiversOf(item.row, item.block);
    const ObjectId by =
        item.anew != 0 ? hiddenBy(item.row, item.block) : hiddenBy(item.row, item.block, moved);
    if (by.valid()) {
        receivers.wanted = 0;
        builder.occluders.push_back(by);
    }
    const int changed = builder.patches.update(senders_.sender(item.row), receivers,
                                               by.valid() ? kAll : item.anew, moved, block);
    if (changed == 0) return 0;
    forEachReceived(block, sent, [&](int r, float factor, glm::dvec3 light) {
        nodes[std::size_t(r)].factor += double(factor);
        nodes[std::size_t(r)].light += light;
    });
    delta.known = arrived.known;
    for (std::uint32_t r = 0; r < kBlock; ++r) {
        nodes[r].node = item.block * kBlock + r;
        if (nodes[r].factor != 0 || nodes[r].light != glm::dvec3(0))
            delta.nodes.push_back(nodes[r]);
    }
    return changed;
}

bool IndirectLight::update(std::size_t effort, double enough) {
    if (reachStale_ || reachRevision_ != nodeHits_.revision()) {
        updateReach();
        return true;
    }
    if (!forgotten_.empty()) {
        forgetSome(effort);
        return true;
    }
    if (!described_) describeReceivers();
    if (updates_.done(enough)) return false;
    std::vector<BlockDelta> deltas(updates_.mostItems(effort));
    const auto items = updates_.work(
        effort, enough, [&](std::uint32_t s) { return factsOf(s); },
        [&](RowBuilder& builder, const DirtyBlock& item, std::span<const MovedObject> moved,
            std::size_t index) { return updateBlock(builder, item, moved, deltas[index]); });
    if (!items.empty()) residualsChanged();
    for (std::size_t i = 0; i < items.size(); ++i)
        for (const auto& [n, factor, light] : deltas[i].nodes) {
            changedBlocks_[n / kBlock] = 1;
            nodes_[n] += light;
            if (deltas[i].known) rowSums_[n] += factor;
        }
    return true;
}

RowUpdates::RowFacts IndirectLight::factsOf(std::uint32_t sender) const {
    RowUpdates::RowFacts facts{kept_[sender] != 0,
                               senders_.box(sender),
                               senders_.object(sender),
                               senders_.area(sender),
                               {},
                               {}};
    facts.hidden = [this, sender](const Bounds& box) {
        return direct_.walls().between(senders_.box(sender), box);
    };
    facts.boxes = stands_;
    facts.least = senders_.leastFactor(sender), facts.none = kNoFactor;
    if (sender < senders_.patchCount() && planar_[sender]) {
        facts.centre = set_.patches[sender].centre;
        facts.normal = set_.patches[sender].normal;
    }
    return facts;
}

/// What a block has received from a sender. Of a batch that is on its way all has arrived but what
/// is still to be served.
IndirectLight::Arrived IndirectLight::arrivedAt(std::uint32_t row, std::uint32_t block) const {
    const SenderLight sent = cellsOf(sent_, row);
    Arrived arrived{{sent.begin(), sent.end()}, known_[row] != 0};
    if (!shot_) return arrived;
    const auto found = std::find(shot_->senders.begin(), shot_->senders.end(), row);
    if (found == shot_->senders.end()) return arrived;
    const auto i = std::uint32_t(found - shot_->senders.begin());
    if (block >= shot_->next &&
        std::ranges::binary_search(shot_->receivers[block], i, {}, &Link::sender))
        return arrived;
    for (std::size_t c = 0; c < sent.size(); ++c) arrived.light[c] += shot_->light[i][c];
    arrived.known = true;
    return arrived;
}

void IndirectLight::updateSendersReached() {
    sendersReached_.assign(reach_.patches.begin(), reach_.patches.end());
    sendersReached_.resize(senders_.count());
    for (std::uint32_t s = 0; s < senders_.count(); ++s)
        for (std::uint32_t up = senders_.parent(s);
             sendersReached_[s] && up != Clusters::kNone && !sendersReached_[up];
             up = senders_.parent(up))
            sendersReached_[up] = 1;
}

} // namespace penumbra
