// After [Cohen1988] (progressive refinement) in the form of Southwell's relaxation (Gortler, Cohen
// & Slusallek, IEEE CG&A 14(6), 1994). Departures: senders shoot in batches of a fixed size, so
// that receivers can be worked on side by side; a patch receives at its middle and its corners; its
// first shot sends more than it owes, by what the ambient estimate says will come (Shao & Badler
// 1993, Xu & Fussell 1994 call this overshooting).
#include "radiosity/IndirectLight.h"

#include "importance/WorkOrder.h"
#include "radiosity/DirectLight.h"
#include "radiosity/Parallel.h"
#include "radiosity/SenderSamples.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra {

namespace {

constexpr std::uint32_t kBlock = PatchSet::kBlock;
/// Senders shot at a time: a share of them all, for choosing them goes through all.
constexpr std::size_t kLeastBatch = 32, kMostBatch = 1024, kBatchShare = 32;
/// Mean over a patch from its middle and its four corners: Simpson's rule in two dimensions with
/// the edge points left out, exact for quadratics.
constexpr double kMiddleWeight = 2.0 / 3.0;
/// What serving a block of a row costs that is there, and of one that is not [rays].
constexpr std::size_t kServe = 8, kBuild = 100;

glm::dvec3 toDouble(Rgb c) {
    return {c.r, c.g, c.b};
}
double largest(glm::dvec3 v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

double largest(const SenderLight& light) {
    return std::max({largest(light[0]), largest(light[1]), largest(light[2]), largest(light[3])});
}

/// Calls visit(receiver, form factor times visibility, what that makes of `light`).
template <class Visit>
void forEachReceived(const RowBlock& block, const SenderLight& light, const Visit& visit) {
    if (!block.isParted()) {
        block.forEach([&](int r, float factor) { visit(r, factor, double(factor) * light[0]); });
        return;
    }
    // Sum over the quarters, put by the shares that the first one, two and three of them have.
    const glm::dvec3 steps[3] = {(light[0] - light[1]) / 255.0, (light[1] - light[2]) / 255.0,
                                 (light[2] - light[3]) / 255.0};
    block.forEachParted([&](int r, float factor, RowBlock::Split split) {
        visit(r, factor,
              double(factor) * (light[3] + double(split[0]) * steps[0] +
                                double(split[1]) * steps[1] + double(split[2]) * steps[2]));
    });
}

/// Names a node of an object: 32 bits of the object's key and the node's index.
std::uint32_t keyOf(const ObjectPart& part, std::uint32_t index) {
    return std::uint32_t(part.key ^ part.key >> 32) + index;
}

} // namespace

IndirectLight::IndirectLight(const PatchSet& set, const RayScene& rays, const DirectLight& direct,
                             std::size_t rowMemory, std::size_t flatPatches)
    : set_(set), rays_(rays), direct_(direct), rowMemory_(rowMemory), senders_(set, flatPatches),
      table_(senders_.count()), updates_(set, rays, table_, 48),
      reached_(set.nodes.size() / kBlock), nodes_(set.nodes.size()), rowSums_(set.nodes.size()),
      sent_(senders_.count()), residuals_(senders_.count()), colours_(senders_.count()),
      known_(senders_.count()), kept_(senders_.count()) {
    std::vector<BlockMask> all;
    for (std::uint32_t b = 0; b < blockCount(); ++b) all.push_back({b, ~std::uint64_t(0)});
    placeNodes(all);
}

ReceiverBlock IndirectLight::receiversOf(std::uint32_t sender, std::uint32_t block) const {
    const ObjectPart& part = set_.objects[set_.nodeBlockObject[block].value];
    const bool lit =
        part.present && senders_.present(sender) && senders_.linked(sender, linkBoxes_[block]);
    return {std::span(set_.nodes).subspan(block * kBlock, kBlock),
            lit ? reached_[block] : 0,
            keyOf(part, block * kBlock - part.nodes.first),
            {}};
}

void IndirectLight::placeNodes(std::span<const BlockMask> masks) {
    while (table_.blocks().size() < blockCount()) table_.blocks().append({});
    while (linkBoxes_.size() < blockCount()) linkBoxes_.append({});
    const auto boxOf = [](const Receiver* nodes) {
        Bounds box;
        for (std::size_t n = 0; n < kBlock; ++n)
            if (!isPadding(nodes[n])) box.add(nodes[n].position);
        return box;
    };
    for (const auto& [block, bits] : masks) {
        table_.blocks().set(block, boxOf(&set_.nodes[block * kBlock]));
        linkBoxes_.set(block, boxOf(&set_.uncoveredNodes[block * kBlock]));
    }
}

/// Gives rows the blocks that are linked to them since an object was placed anew: all of what it
/// sends, and of all that it receives.
void IndirectLight::link(ObjectId object) {
    const ObjectPart& part = set_.objects[object.value];
    const auto open = [&](std::uint32_t sender, std::uint32_t block) {
        if (kept_[sender]) table_[sender].open(block);
    };
    for (const Range own : {part.patches, senders_.clustersOf(object)})
        for (std::uint32_t s = own.first; s < own.end(); ++s)
            if (kept_[s])
                for (std::uint32_t b : senders_.linkedBlocks(s, linkBoxes_)) open(s, b);
    for (std::uint32_t b = part.nodes.first / kBlock; b * kBlock < part.nodes.end(); ++b)
        if (!linkBoxes_[b].empty())
            senders_.forEachLinked(linkBoxes_[b], [&](std::uint32_t s) { open(s, b); });
}

void IndirectLight::apply(const SceneChange& change) {
    serveAll();
    std::vector<BlockMask> masks;
    for (ObjectId object : change.objects) {
        const ObjectPart& part = set_.objects[object.value];
        senders_.place(object);
        for (std::uint32_t b = part.nodes.first / kBlock; b * kBlock < part.nodes.end(); ++b)
            if (part.nodes.count > 0) masks.push_back({b, ~std::uint64_t(0)});
    }
    for (std::uint32_t n : change.nodes)
        masks.push_back({n / kBlock, std::uint64_t(1) << n % kBlock});
    unite(masks);
    placeNodes(masks);
    residualsStale_ = true;
    if (change.objects.empty() && masks.empty()) return;
    for (ObjectId object : change.objects) link(object);
    if (rowsMissing_) restart();
    updates_.add(change.objects, std::move(masks));
}

void IndirectLight::invalidate(const Bounds& region) {
    serveAll();
    residualsStale_ = true;
    if (rowsMissing_) restart();
    updates_.add({}, {}, {region});
}

void IndirectLight::directChanged(bool litChanged) {
    reachStale_ |= litChanged;
    residualsStale_ = true;
}

/// What rows that were not kept have sent can't be corrected: everything is sent again.
void IndirectLight::restart() {
    std::fill(nodes_.begin(), nodes_.end(), glm::dvec3(0));
    std::fill(rowSums_.begin(), rowSums_.end(), 0.0);
    std::fill(sent_.begin(), sent_.end(), SenderLight{});
    std::fill(known_.begin(), known_.end(), std::uint8_t(0));
    rowsMissing_ = false;
}

void IndirectLight::updateReach() {
    reachStale_ = false;
    if (!reach_) {
        reach_ = std::make_unique<Reach>(set_);
        buildRays_.full += reach_->rayCount();
    }
    const std::vector<std::uint64_t> now = reach_->spread(direct_.patchLit());
    std::vector<BlockMask> masks;
    for (std::uint32_t b = 0; b < now.size(); ++b)
        if (const std::uint64_t differs = now[b] ^ reached_[b]) masks.push_back({b, differs});
    reached_ = now;
    updateSendersReached();
    if (masks.empty() || shots_ == 0) return;
    if (rowsMissing_) restart();
    updates_.add({}, std::move(masks));
}

bool IndirectLight::update(std::size_t effort) {
    if (reachStale_) {
        updateReach();
        return true;
    }
    if (updates_.done()) return false;
    struct Delta {
        std::uint32_t node;
        double factor = 0;
        glm::dvec3 light{};
    };
    std::vector<std::vector<Delta>> deltas(effort / 48 + 2); // an item counts for 48 at least
    const auto facts = [&](std::uint32_t p) {
        return RowUpdates::RowFacts{kept_[p] != 0, senders_.box(p), senders_.object(p)};
    };
    const auto update = [&](RowBuilder& builder, const UpdateItem& item, std::size_t index) {
        RowBlock& block = table_[item.row][item.block];
        Delta delta[kBlock];
        forEachReceived(block, sent_[item.row], [&](int r, float factor, glm::dvec3 light) {
            delta[r] = {0, -double(factor), -light};
        });
        const int changed =
            builder.updatePatchBlock(senders_.sender(item.row), receiversOf(item.row, item.block),
                                     item.anew, item.change->moved, block);
        if (changed == 0) return 0;
        forEachReceived(block, sent_[item.row], [&](int r, float factor, glm::dvec3 light) {
            delta[r].factor += double(factor);
            delta[r].light += light;
        });
        for (std::uint32_t r = 0; r < kBlock; ++r) {
            delta[r].node = item.block * kBlock + r;
            if (delta[r].factor != 0 || delta[r].light != glm::dvec3(0))
                deltas[index].push_back(delta[r]);
        }
        return changed;
    };
    const auto items = updates_.work(effort, facts, update);
    for (std::size_t i = 0; i < items.size(); ++i)
        for (const auto& [n, factor, light] : deltas[i]) {
            nodes_[n] += light;
            if (known_[items[i].row]) rowSums_[n] += factor;
        }
    residualsStale_ = true;
    return true;
}

/// Form factors are exact, but visibility is sampled, so that a node's factors may add up to a
/// little more than the whole hemisphere: what is too much is taken off in proportion. This also
/// bounds the certificate.
glm::dvec3 IndirectLight::node(std::uint32_t index) const {
    return nodes_[index] / std::max(1.0, rowSums_[index]);
}

glm::dvec3 IndirectLight::reflected(std::uint32_t index) const {
    const Patch& patch = set_.patches[index];
    if (!set_.objects[patch.object.value].present) return glm::dvec3(0);
    glm::dvec3 indirect = node(patch.centreNode);
    if (patch.hasCornerNodes) {
        glm::dvec3 corners(0);
        for (std::uint32_t n : patch.cornerNodes) corners += node(n);
        indirect = kMiddleWeight * indirect + (1 - kMiddleWeight) / 4 * corners;
    }
    return toDouble(set_.materials[patch.material].reflectance) *
           (direct_.patches()[index] + indirect);
}

void IndirectLight::updateResiduals() {
    residualsStale_ = false;
    double gain = 0, area = 0, radiosity = 0;
    std::vector<glm::dvec3> reflects(senders_.patchCount()), colours(senders_.patchCount());
    for (std::uint32_t p = 0; p < senders_.patchCount(); ++p) {
        reflects[p] = reflected(p);
        colours[p] = toDouble(set_.materials[set_.patches[p].material].reflectance);
        const double rho = largest(colours[p]);
        gain = std::max(gain, rho); // times the row sum, which is at most 1
        if (rho <= 0) continue;
        area += set_.patches[p].area;
        radiosity += set_.patches[p].area * largest(reflects[p]);
    }
    const std::vector<SenderLight> now = senders_.average(reflects);
    colours_ = senders_.average(colours);
    most_ = 0;
    for (std::uint32_t s = 0; s < senders_.count(); ++s) {
        for (std::size_t q = 0; q < 4; ++q) residuals_[s][q] = now[s][q] - sent_[s][q];
        most_ = std::max(most_, largest(residuals_[s]));
    }
    // |B_exact - B| <= max|R| / (1 - max(rho * row sum)), in the maximum norm. Means over clusters
    // differ from the exact ones by no more than what they are the means of.
    certificate_ = most_ / (1 - gain);
    meanRadiosity_ = area > 0 ? radiosity / area : 0;
}

/// The most power first, of those that owe too much: large patches that owe next to nothing would
/// be served again and again before small ones that owe a lot.
std::vector<std::uint32_t> IndirectLight::chooseSenders(double enough) const {
    std::vector<double> power(senders_.count());
    for (std::uint32_t s = 0; s < power.size(); ++s)
        if (largest(residuals_[s]) > enough)
            power[s] = largest(residuals_[s]) * double(senders_.area(s));
    return mostValuable(power, batch());
}

std::size_t IndirectLight::batch() const {
    return std::clamp<std::size_t>(senders_.count() / kBatchShare, kLeastBatch, kMostBatch);
}

bool IndirectLight::relax(std::size_t effort, double target) {
    if (residualsStale_) {
        updateResiduals();
        return true;
    }
    constexpr double kBelow = 0.3; // what a patch may owe, of what the certificate allows
    const double allowed = most_ > 0 ? target * most_ / certificate_ : 0;
    if (!shot_) load(chooseSenders(kBelow * allowed), false);
    if (!shot_) return false;
    serve(effort);
    return true;
}

bool IndirectLight::complete(std::size_t effort) {
    if (!shot_) {
        std::vector<std::uint32_t> unknown;
        for (std::uint32_t p = 0; p < known_.size() && unknown.size() < batch(); ++p)
            if (!known_[p] && sendersReached_[p] && senders_.present(p)) unknown.push_back(p);
        load(unknown, true);
    }
    if (!shot_) return false;
    serve(effort);
    return true;
}

void IndirectLight::updateSendersReached() {
    const auto reached = [&](std::uint32_t n) { return (reached_[n / 64] >> n % 64 & 1) != 0; };
    sendersReached_.assign(senders_.count(), 0);
    for (std::uint32_t p = 0; p < senders_.patchCount(); ++p) {
        const Patch& patch = set_.patches[p];
        sendersReached_[p] =
            reached(patch.centreNode) ||
            (patch.hasCornerNodes &&
             std::any_of(patch.cornerNodes.begin(), patch.cornerNodes.end(), reached));
    }
    for (std::uint32_t s = 0; s < senders_.count(); ++s)
        for (std::uint32_t up = senders_.parent(s);
             sendersReached_[s] && up != Clusters::kNone && !sendersReached_[up];
             up = senders_.parent(up))
            sendersReached_[up] = 1;
}

/// Begins a batch. \param dark the senders send nothing, only their rows are wanted
void IndirectLight::load(const std::vector<std::uint32_t>& senders, bool dark) {
    if (senders.empty()) return;
    shot_ = std::make_unique<Shot>();
    shot_->senders = senders;
    const glm::dvec3 expected = ambient();
    const bool keep = rowBytes_ < rowMemory_;
    for (std::uint32_t i = 0; i < senders.size(); ++i) {
        const std::uint32_t s = senders[i];
        // The first time send at once what is sure to come later; too much is taken back in its
        // turn.
        const bool fresh = !known_[s];
        SenderLight light{};
        for (std::size_t q = 0; q < 4 && !dark; ++q) {
            light[q] = residuals_[s][q];
            if (fresh) light[q] += colours_[s][q] * expected;
        }
        shot_->fresh.push_back(fresh);
        shot_->light.push_back(light);
        shot_->build.push_back(!kept_[s]);
        Row& row = table_[s];
        const auto toServe = [&](std::uint32_t block) {
            shot_->work.push_back(std::uint64_t(block) << 32 | i);
        };
        if (kept_[s]) {
            for (std::size_t b = 0; b < row.size(); ++b) toServe(row.blockAt(b));
            continue;
        }
        const std::vector<std::uint32_t> blocks = senders_.linkedBlocks(s, linkBoxes_);
        for (std::uint32_t b : blocks) toServe(b);
        if (keep) row.open(blocks);
        kept_[s] = keep;
        rowsMissing_ |= !keep;
    }
    std::sort(shot_->work.begin(), shot_->work.end());
    shot_->dark = dark;
}

/// Serves some more blocks of the batch: each receives from all of its senders before the next one
/// does, so that sums are taken in a fixed order.
void IndirectLight::serve(std::size_t effort) {
    constexpr std::size_t kGrain = 64; // pairs of a sender and a block
    Shot& shot = *shot_;
    std::vector<std::size_t> cuts{shot.next}; // of tasks: between two blocks
    std::size_t last = shot.next;
    for (std::size_t sum = 0; last < shot.work.size() && sum < effort;) {
        const std::uint64_t block = shot.work[last] >> 32;
        for (; last < shot.work.size() && shot.work[last] >> 32 == block; ++last)
            sum += shot.build[std::uint32_t(shot.work[last])] ? kBuild : kServe;
        if (last - cuts.back() >= kGrain) cuts.push_back(last);
    }
    if (cuts.back() != last) cuts.push_back(last);
    const std::size_t tasks = cuts.size() - 1;
    struct Task {
        std::size_t bytes = 0;
        std::vector<RowTable::BlockerNote> notes;
    };
    std::vector<Task> done(tasks);
    while (builders_.size() < tasks) builders_.emplace_back(rays_);
    parallelFor(tasks, 1, [&](std::size_t first, std::size_t end) {
        for (std::size_t t = first; t < end; ++t)
            for (std::size_t w = cuts[t]; w < cuts[t + 1]; ++w)
                servePair(shot.work[w], builders_[t], done[t].bytes, done[t].notes);
    });
    for (const Task& task : done) {
        shot.bytes += task.bytes;
        table_.note(task.notes);
    }
    for (RowBuilder& builder : builders_) buildRays_ += builder.takeRayCount();
    served_ += last - shot.next;
    shot.next = last;
    if (last == shot.work.size()) finishShot();
}

void IndirectLight::servePair(std::uint64_t work, RowBuilder& builder, std::size_t& bytes,
                              std::vector<RowTable::BlockerNote>& notes) {
    const Shot& shot = *shot_;
    const auto b = std::uint32_t(work >> 32), i = std::uint32_t(work);
    const std::uint32_t s = shot.senders[i];
    RowBlock passing;
    RowBlock& block = kept_[s] ? table_[s][b] : passing;
    if (shot.build[i]) {
        builder.patchBlock(senders_.sender(s), receiversOf(s, b), block);
        if (kept_[s]) {
            bytes += block.bytes();
            RowTable::listBlockers(set_, s, b, block, notes);
        }
    }
    const bool fresh = shot.fresh[i];
    forEachReceived(block, shot.light[i], [&](int r, float factor, glm::dvec3 light) {
        nodes_[b * kBlock + std::size_t(r)] += light;
        if (fresh) rowSums_[b * kBlock + std::size_t(r)] += factor;
    });
}

void IndirectLight::serveAll() {
    while (shot_) serve(std::numeric_limits<std::size_t>::max());
}

void IndirectLight::finishShot() {
    for (std::size_t i = 0; i < shot_->senders.size(); ++i) {
        const std::uint32_t p = shot_->senders[i];
        for (std::size_t q = 0; q < 4; ++q) sent_[p][q] += shot_->light[i][q];
        known_[p] = 1;
        if (shot_->build[i]) updates_.setCurrent(p);
    }
    rowBytes_ += shot_->bytes;
    if (!shot_->dark) shots_ += shot_->senders.size();
    shot_.reset();
    residualsStale_ = true;
}

/// What is owed goes, on average, once over all surfaces and is reflected on: Cohen et al. 1988.
glm::dvec3 IndirectLight::ambient() const {
    glm::dvec3 owed(0), reflected(0);
    double area = 0;
    for (std::size_t p = 0; p < set_.patches.size(); ++p) {
        const double size = set_.patches[p].area;
        owed += size * residuals_[p][0];
        reflected += size * toDouble(set_.materials[set_.patches[p].material].reflectance);
        area += size;
    }
    if (area == 0) return owed;
    return (owed / area) / (1.0 - glm::min(reflected / area, 0.98));
}

std::vector<glm::dvec3> IndirectLight::nodes() const {
    const glm::dvec3 owed = ambient();
    std::vector<glm::dvec3> values(nodes_.size());
    for (std::uint32_t n = 0; n < values.size(); ++n)
        values[n] = node(n) + (reached_[n / 64] >> n % 64 & 1 ? owed : glm::dvec3(0));
    return values;
}

} // namespace penumbra
