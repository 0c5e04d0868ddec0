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

namespace penumbra {

namespace {

constexpr std::uint32_t kBlock = PatchSet::kBlock;
constexpr std::size_t kBatch = 32; ///< senders shot at a time
/// Mean over a patch from its middle and its four corners: Simpson's rule in two dimensions with
/// the edge points left out, exact for quadratics.
constexpr double kMiddleWeight = 2.0 / 3.0;
constexpr std::size_t kServe = 8; ///< what serving a block of a row that is there costs, in rays

glm::dvec3 toDouble(Rgb c) {
    return {c.r, c.g, c.b};
}
double largest(glm::dvec3 v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Names a piece of an object: 32 bits of the object's key and the piece's index.
std::uint32_t keyOf(const ObjectPart& part, std::uint32_t index) {
    return std::uint32_t(part.key ^ part.key >> 32) + index;
}

} // namespace

IndirectLight::IndirectLight(const PatchSet& set, const RayScene& rays, const DirectLight& direct,
                             std::size_t rowMemory)
    : set_(set), rays_(rays), direct_(direct), rowMemory_(rowMemory), table_(set.patches.size()),
      updates_(set, rays, table_, 48), samples_(set.patches.size() * kPatchSamples),
      boxes_(set.patches.size()), keys_(set.patches.size()), reached_(set.nodes.size() / kBlock),
      nodes_(set.nodes.size()), rowSums_(set.nodes.size()), sent_(set.patches.size()),
      residuals_(set.patches.size()), known_(set.patches.size()) {
    prepareSenders({0, std::uint32_t(set.patches.size())});
    for (const ObjectPart& part : set.objects)
        for (std::uint32_t p = part.patches.first; p < part.patches.end(); ++p)
            keys_[p] = keyOf(part, p - part.patches.first);
    std::vector<BlockMask> all;
    for (std::uint32_t b = 0; b < blockCount(); ++b) all.push_back({b, ~std::uint64_t(0)});
    placeNodes(all);
}

void IndirectLight::prepareSenders(Range patches) {
    parallelFor(patches.count, 256, [&](std::size_t first, std::size_t last) {
        for (std::size_t p = patches.first + first; p < patches.first + last; ++p) {
            const Patch& patch = set_.patches[p];
            samplePatch(set_, patch, samples_.data() + p * kPatchSamples);
            boxes_[p] = {};
            for (std::uint32_t c = 0; c < patch.cornerCount; ++c)
                boxes_[p].add(set_.corners[patch.firstCorner + c]);
            for (std::size_t k = 0; k < kPatchSamples; ++k)
                boxes_[p].add(samples_[p * kPatchSamples + k]);
        }
    });
}

PatchSender IndirectLight::senderOf(std::uint32_t index) const {
    const Patch& patch = set_.patches[index];
    return {&patch, std::span(set_.corners).subspan(patch.firstCorner, patch.cornerCount),
            samples_.data() + index * kPatchSamples, keys_[index]};
}

ReceiverBlock IndirectLight::receiversOf(std::uint32_t block) const {
    const ObjectPart& part = set_.objects[set_.nodeBlockObject[block].value];
    return {std::span(set_.nodes).subspan(block * kBlock, kBlock),
            part.present ? reached_[block] : 0,
            keyOf(part, block * kBlock - part.nodes.first),
            {}};
}

void IndirectLight::placeNodes(std::span<const BlockMask> masks) {
    while (table_.blocks().size() < blockCount()) table_.blocks().append({});
    for (const auto& [block, bits] : masks) {
        Bounds box;
        for (std::size_t n = block * kBlock; n < (block + 1) * kBlock; ++n)
            if (!isPadding(set_.nodes[n])) box.add(set_.nodes[n].position);
        table_.blocks().set(block, box);
    }
}

void IndirectLight::apply(const SceneChange& change) {
    while (shot_) serve(blockCount());
    std::vector<BlockMask> masks;
    for (ObjectId object : change.objects) {
        const ObjectPart& part = set_.objects[object.value];
        prepareSenders(part.patches);
        for (std::uint32_t b = part.nodes.first / kBlock; b * kBlock < part.nodes.end(); ++b)
            if (part.nodes.count > 0) masks.push_back({b, ~std::uint64_t(0)});
    }
    for (std::uint32_t n : change.nodes)
        masks.push_back({n / kBlock, std::uint64_t(1) << n % kBlock});
    unite(masks);
    placeNodes(masks);
    residualsStale_ = true;
    if (change.objects.empty() && masks.empty()) return;
    if (rowsMissing_) restart();
    updates_.add(change.objects, std::move(masks));
}

void IndirectLight::invalidate(const Bounds& region) {
    while (shot_) serve(blockCount());
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
    std::fill(sent_.begin(), sent_.end(), glm::dvec3(0));
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
        double factor;
    };
    std::vector<std::vector<Delta>> deltas(effort / 48 + 2); // an item counts for 48 at least
    const auto facts = [&](std::uint32_t p) {
        return RowUpdates::RowFacts{!table_[p].empty(), boxes_[p], set_.patches[p].object};
    };
    const auto update = [&](RowBuilder& builder, const UpdateItem& item, std::size_t index) {
        RowBlock& block = table_[item.row][item.block];
        double factor[kBlock] = {};
        block.forEach([&](int r, float f) { factor[r] = -double(f); });
        ReceiverBlock receivers = receiversOf(item.block);
        if (!set_.objects[set_.patches[item.row].object.value].present) receivers.wanted = 0;
        const int changed = builder.updatePatchBlock(senderOf(item.row), receivers, item.anew,
                                                     item.change->moved, block);
        if (changed == 0) return 0;
        block.forEach([&](int r, float f) { factor[r] += double(f); });
        for (std::uint32_t r = 0; r < kBlock; ++r)
            if (factor[r] != 0) deltas[index].push_back({item.block * kBlock + r, factor[r]});
        return changed;
    };
    const auto items = updates_.work(effort, facts, update);
    for (std::size_t i = 0; i < items.size(); ++i)
        for (const auto& [n, factor] : deltas[i]) {
            nodes_[n] += factor * sent_[items[i].row];
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
    double most = 0, gain = 0, area = 0, radiosity = 0;
    for (std::uint32_t p = 0; p < set_.patches.size(); ++p) {
        const Patch& patch = set_.patches[p];
        const double rho = maxChannel(set_.materials[patch.material].reflectance);
        const glm::dvec3 now = reflected(p);
        residuals_[p] = now - sent_[p];
        most = std::max(most, largest(residuals_[p]));
        gain = std::max(gain, rho); // times the row sum, which is at most 1
        if (rho <= 0) continue;
        area += patch.area;
        radiosity += patch.area * largest(now);
    }
    most_ = most;
    // |B_exact - B| <= max|R| / (1 - max(rho * row sum)), in the maximum norm.
    certificate_ = most / (1 - gain);
    meanRadiosity_ = area > 0 ? radiosity / area : 0;
}

/// The most power first, of those that owe too much: large patches that owe next to nothing would
/// be served again and again before small ones that owe a lot.
std::vector<std::uint32_t> IndirectLight::chooseSenders(double enough) const {
    std::vector<double> power(set_.patches.size());
    for (std::size_t p = 0; p < power.size(); ++p)
        if (largest(residuals_[p]) > enough)
            power[p] = largest(residuals_[p]) * double(set_.patches[p].area);
    return mostValuable(power, kBatch);
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
    serveFor(effort);
    return true;
}

bool IndirectLight::complete(std::size_t effort) {
    if (!shot_) {
        std::vector<std::uint32_t> unknown;
        for (std::uint32_t p = 0; p < known_.size() && unknown.size() < kBatch; ++p)
            if (!known_[p] && isReached(set_.patches[p])) unknown.push_back(p);
        load(unknown, true);
    }
    if (!shot_) return false;
    serveFor(effort);
    return true;
}

bool IndirectLight::isReached(const Patch& patch) const {
    const auto reached = [&](std::uint32_t n) { return (reached_[n / 64] >> n % 64 & 1) != 0; };
    if (!set_.objects[patch.object.value].present) return false;
    return reached(patch.centreNode) ||
           (patch.hasCornerNodes &&
            std::any_of(patch.cornerNodes.begin(), patch.cornerNodes.end(), reached));
}

/// Begins a batch. \param dark the senders send nothing, only their rows are wanted
void IndirectLight::load(const std::vector<std::uint32_t>& senders, bool dark) {
    if (senders.empty()) return;
    shot_ = std::make_unique<Shot>();
    shot_->senders = senders;
    const glm::dvec3 expected = ambient();
    const bool keep = rowBytes_ < rowMemory_;
    for (const std::uint32_t p : senders) {
        // The first time send at once what is sure to come later; too much is taken back in its
        // turn.
        const bool fresh = !known_[p];
        glm::dvec3 light = residuals_[p];
        if (fresh)
            light += toDouble(set_.materials[set_.patches[p].material].reflectance) * expected;
        shot_->fresh.push_back(fresh);
        shot_->light.push_back(dark ? glm::dvec3(0) : light);
        shot_->build.push_back(table_[p].empty());
        if (shot_->build.back() && keep) table_[p].resize(blockCount());
        rowsMissing_ |= table_[p].empty();
    }
    shot_->dark = dark;
}

void IndirectLight::serveFor(std::size_t effort) {
    std::size_t cost = 0; // of serving a block
    for (std::uint8_t build : shot_->build) cost += build ? 100 : kServe;
    serve(std::max<std::size_t>(2, effort / cost));
}

void IndirectLight::serve(std::size_t blocks) {
    constexpr std::size_t kGrain = 4;
    Shot& shot = *shot_;
    blocks = std::min(blocks, blockCount() - shot.nextBlock);
    const std::size_t tasks = (blocks + kGrain - 1) / kGrain;
    struct Task {
        std::size_t bytes = 0;
        std::vector<RowTable::BlockerNote> notes;
    };
    std::vector<Task> done(tasks);
    while (builders_.size() < tasks) builders_.emplace_back(rays_);
    parallelFor(blocks, kGrain, [&](std::size_t first, std::size_t last) {
        RowBuilder& builder = builders_[first / kGrain];
        Task& task = done[first / kGrain];
        for (std::size_t b = shot.nextBlock + first; b < shot.nextBlock + last; ++b) {
            const ReceiverBlock receivers = receiversOf(std::uint32_t(b));
            for (std::size_t i = 0; i < shot.senders.size(); ++i) {
                RowBlock passing;
                Row& row = table_[shot.senders[i]];
                RowBlock& block = row.empty() ? passing : row[b];
                if (shot.build[i]) {
                    builder.patchBlock(senderOf(shot.senders[i]), receivers, block);
                    if (!row.empty()) {
                        task.bytes += block.bytes();
                        RowTable::listBlockers(set_, shot.senders[i], std::uint32_t(b), block,
                                               task.notes);
                    }
                }
                const glm::dvec3 light = shot.light[i];
                const bool fresh = shot.fresh[i];
                block.forEach([&](int r, float factor) {
                    nodes_[b * kBlock + std::size_t(r)] += double(factor) * light;
                    if (fresh) rowSums_[b * kBlock + std::size_t(r)] += factor;
                });
            }
        }
    });
    for (const Task& task : done) {
        shot.bytes += task.bytes;
        table_.note(task.notes);
    }
    for (RowBuilder& builder : builders_) buildRays_ += builder.takeRayCount();
    shot.nextBlock += blocks;
    if (shot.nextBlock == blockCount()) finishShot();
}

void IndirectLight::finishShot() {
    for (std::size_t i = 0; i < shot_->senders.size(); ++i) {
        const std::uint32_t p = shot_->senders[i];
        sent_[p] += shot_->light[i];
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
        owed += size * residuals_[p];
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
