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
      table_(senders_.count()), updates_(set, rays, table_, 48), reach_(set),
      reached_(set.nodes.size() / kBlock), nodes_(set.nodes.size()), rowSums_(set.nodes.size()),
      sent_(senders_.count()), residuals_(senders_.count()), colours_(senders_.count()),
      known_(senders_.count()), kept_(senders_.count()) {
    for (std::uint32_t p = 0; p < senders_.patchCount(); ++p) {
        const Patch& patch = set.patches[p];
        const auto points = std::span(senders_.sender(p).samples, kPatchSamples);
        planar_.push_back(std::all_of(points.begin(), points.end(), [&](glm::vec3 point) {
            const float height = glm::dot(patch.normal, point - patch.centre);
            return height * height < 1e-8f * patch.area;
        }));
    }
    std::vector<BlockMask> all;
    for (std::uint32_t b = 0; b < blockCount(); ++b) all.push_back({b, ~std::uint64_t(0)});
    placeNodes(all);
    buildRays_.full += reach_.rayCount();
    coloursChanged();
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
    described_ = false;
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
    if (change.colours) coloursChanged();
    if (change.objects.empty() && masks.empty()) return;
    for (ObjectId object : change.objects) link(object);
    if (rowsMissing_) restart();
    updates_.add(change.objects, std::move(masks));
}

void IndirectLight::invalidate(const Bounds& region) {
    described_ = false;
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
    for (std::size_t i = 0; shot_ && i < shot_->senders.size(); ++i) {
        const std::uint32_t s = shot_->senders[i];
        if (!shot_->build[i] || !kept_[s]) continue; // else half built
        table_[s].clear();
        kept_[s] = 0;
        updates_.drop(s);
    }
    shot_.reset();
    std::fill(nodes_.begin(), nodes_.end(), glm::dvec3(0));
    std::fill(rowSums_.begin(), rowSums_.end(), 0.0);
    std::fill(sent_.begin(), sent_.end(), SenderLight{});
    std::fill(known_.begin(), known_.end(), std::uint8_t(0));
    for (std::uint32_t s = 0; s < sent_.size(); ++s) updates_.open().setPower(s, 0);
    rowsMissing_ = false;
}

void IndirectLight::updateReach() {
    reachStale_ = false;
    const std::vector<std::uint64_t> now = reach_.spread(direct_.patchLit());
    std::vector<BlockMask> masks;
    for (std::uint32_t b = 0; b < now.size(); ++b)
        if (const std::uint64_t differs = now[b] ^ reached_[b]) masks.push_back({b, differs});
    reached_ = now;
    updateSendersReached();
    if (masks.empty() || shots_ == 0) return;
    residualsStale_ = true;
    if (rowsMissing_) restart();
    updates_.add({}, std::move(masks));
}

/// For bounds of what open work may change.
void IndirectLight::describeReceivers() {
    std::vector<OpenWork::Receivers> blocks(blockCount());
    parallelFor(blocks.size(), 16, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            blocks[b].reflectance = reflectances_[b];
            for (auto n = std::uint32_t(b * kBlock); n < (b + 1) * kBlock; ++n)
                blocks[b].light = std::max(blocks[b].light, float(largest(node(n))));
        }
    });
    updates_.open().setReceivers(std::move(blocks));
    described_ = true;
}

bool IndirectLight::update(std::size_t effort, double enough) {
    if (reachStale_) {
        updateReach();
        return true;
    }
    if (!described_) describeReceivers();
    if (updates_.done(enough)) return false;
    struct Delta {
        std::uint32_t node;
        double factor = 0;
        glm::dvec3 light{};
    };
    struct Deltas {
        std::vector<Delta> nodes;
        bool known = false; ///< row sums know of the sender
    };
    std::vector<Deltas> deltas(updates_.mostItems(effort));
    const auto update = [&](RowBuilder& builder, const OpenBlock& item,
                            std::span<const MovedObject> moved, std::size_t index) {
        RowBlock& block = table_[item.row][item.block];
        const Arrived arrived = arrivedAt(item.row, item.block);
        deltas[index].known = arrived.known;
        Delta delta[kBlock];
        forEachReceived(block, arrived.light, [&](int r, float factor, glm::dvec3 light) {
            delta[r] = {0, -double(factor), -light};
        });
        const int changed = builder.updatePatchBlock(
            senders_.sender(item.row), receiversOf(item.row, item.block), item.anew, moved, block);
        if (changed == 0) return 0;
        forEachReceived(block, arrived.light, [&](int r, float factor, glm::dvec3 light) {
            delta[r].factor += double(factor);
            delta[r].light += light;
        });
        for (std::uint32_t r = 0; r < kBlock; ++r) {
            delta[r].node = item.block * kBlock + r;
            if (delta[r].factor != 0 || delta[r].light != glm::dvec3(0))
                deltas[index].nodes.push_back(delta[r]);
        }
        return changed;
    };
    const auto facts = [&](std::uint32_t s) { return factsOf(s); };
    const auto items = updates_.work(effort, enough, facts, update);
    for (std::size_t i = 0; i < items.size(); ++i)
        for (const auto& [n, factor, light] : deltas[i].nodes) {
            nodes_[n] += light;
            if (deltas[i].known) rowSums_[n] += factor;
        }
    if (!items.empty()) residualsStale_ = true;
    return true;
}

RowUpdates::RowFacts IndirectLight::factsOf(std::uint32_t sender) const {
    RowUpdates::RowFacts facts{kept_[sender] != 0,
                               senders_.box(sender),
                               senders_.object(sender),
                               senders_.area(sender),
                               {},
                               {}};
    if (sender < senders_.patchCount() && planar_[sender]) {
        facts.centre = set_.patches[sender].centre;
        facts.normal = set_.patches[sender].normal;
    }
    return facts;
}

/// What a block has received from a sender. Of a batch that is on its way all has arrived but what
/// is still to be served.
IndirectLight::Arrived IndirectLight::arrivedAt(std::uint32_t row, std::uint32_t block) const {
    Arrived arrived{sent_[row], known_[row] != 0};
    if (!shot_) return arrived;
    const auto found = std::find(shot_->senders.begin(), shot_->senders.end(), row);
    if (found == shot_->senders.end()) return arrived;
    const auto i = std::size_t(found - shot_->senders.begin());
    const auto toDo = std::span(shot_->work).subspan(shot_->next);
    if (std::binary_search(toDo.begin(), toDo.end(), std::uint64_t(block) << 32 | i))
        return arrived;
    for (std::size_t q = 0; q < 4; ++q) arrived.light[q] += shot_->light[i][q];
    arrived.known = true;
    return arrived;
}

/// Form factors are exact, but visibility is sampled, so that a node's factors may add up to a
/// little more than the whole hemisphere: what is too much is taken off in proportion. This also
/// bounds the certificate.
glm::dvec3 IndirectLight::node(std::uint32_t index) const {
    return nodes_[index] / std::max(1.0, rowSums_[index]);
}

/// Over a patch, of a quantity that is known at its nodes.
template <class Value, class AtNode>
Value IndirectLight::mean(const Patch& patch, AtNode atNode) const {
    const Value middle = atNode(patch.centreNode);
    if (!patch.hasCornerNodes) return middle;
    Value corners(0);
    for (std::uint32_t n : patch.cornerNodes) corners += atNode(n);
    return kMiddleWeight * middle + (1 - kMiddleWeight) / 4 * corners;
}

glm::dvec3 IndirectLight::reflected(std::uint32_t index) const {
    const Patch& patch = set_.patches[index];
    if (!set_.objects[patch.object.value].present) return glm::dvec3(0);
    const auto indirect = mean<glm::dvec3>(patch, [&](std::uint32_t n) { return node(n); });
    return toDouble(set_.materials[patch.material].reflectance) *
           (direct_.patches()[index] + indirect);
}

/// What open work may change in the light at a node [lux]: what arrives, and the row sum f by which
/// it is divided, as far as that is or comes to be above 1.
double IndirectLight::openAt(std::uint32_t index) const {
    const OpenWork& open = updates_.open();
    const double f = open.factor(index / kBlock);
    if (f == 0 || !(reached_[index / 64] >> index % 64 & 1)) return 0;
    const double above = std::max(0.0, rowSums_[index] + f - 1);
    return open.light(index / kBlock) + std::min(f, above) * largest(node(index));
}

void IndirectLight::updateResiduals() {
    residualsStale_ = false;
    struct Part {
        double open = 0, both = 0, area = 0, radiosity = 0;
    };
    constexpr std::size_t kGrain = 512;
    std::vector<Part> parts((senders_.patchCount() + kGrain - 1) / kGrain);
    const std::vector<double> openDirect = direct_.openLight();
    std::vector<glm::dvec3> reflects(senders_.patchCount());
    parallelFor(senders_.patchCount(), kGrain, [&](std::size_t first, std::size_t last) {
        Part& part = parts[first / kGrain];
        for (auto p = std::uint32_t(first); p < last; ++p) {
            const Patch& patch = set_.patches[p];
            const double rho = maxChannel(set_.materials[patch.material].reflectance);
            reflects[p] = reflected(p);
            const double open =
                rho *
                (openDirect[p] + mean<double>(patch, [&](std::uint32_t n) { return openAt(n); }));
            part.open = std::max(part.open, open);
            part.both = std::max(part.both, largest(reflects[p] - sent_[p][0]) + open);
            if (rho <= 0) continue;
            part.area += patch.area;
            part.radiosity += patch.area * largest(reflects[p]);
        }
    });
    Part all;
    for (const Part& part : parts) {
        all.open = std::max(all.open, part.open);
        all.both = std::max(all.both, part.both);
        all.area += part.area;
        all.radiosity += part.radiosity;
    }
    const std::vector<SenderLight> now = senders_.average(reflects);
    most_ = 0;
    for (std::uint32_t s = 0; s < senders_.count(); ++s) {
        for (std::size_t q = 0; q < 4; ++q) residuals_[s][q] = now[s][q] - sent_[s][q];
        most_ = std::max(most_, largest(residuals_[s]));
        if (s >= senders_.patchCount())
            all.both = std::max(all.both, largest(residuals_[s]) + all.open);
    }
    open_ = all.open;
    certificate_ = all.both > 0 ? gain_ * all.both : 0;
    meanRadiosity_ = all.area > 0 ? all.radiosity / all.area : 0;
}

/// Reflectances, and what follows from them. |B_exact - B| <= max|R| / (1 - max(rho * row sum)), in
/// the maximum norm; row sums are at most 1. Means over clusters differ from the exact ones by no
/// more than what they are the means of.
void IndirectLight::coloursChanged() {
    float most = 0;
    std::vector<glm::dvec3> colours;
    reflectances_.assign(blockCount(), 0.0f);
    for (const Patch& patch : set_.patches) {
        const Rgb colour = set_.materials[patch.material].reflectance;
        const float rho = maxChannel(colour);
        colours.push_back(toDouble(colour));
        most = std::max(most, rho);
        const auto at = [&](std::uint32_t n) {
            reflectances_[n / kBlock] = std::max(reflectances_[n / kBlock], rho);
        };
        at(patch.centreNode);
        if (patch.hasCornerNodes) std::for_each_n(patch.cornerNodes.begin(), 4, at);
    }
    colours_ = senders_.average(colours);
    gain_ = 1 / (1 - double(most));
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
    if (!shot_ && residualsStale_) {
        updateResiduals();
        return true;
    }
    constexpr double kBelow = 0.3; // what a patch may owe, of what the certificate allows
    if (!shot_) load(chooseSenders(kBelow * target / gain_), false);
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
        if (keep) {
            row.open(blocks);
            updates_.setCurrent(s);
        }
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

void IndirectLight::finishShot() {
    for (std::size_t i = 0; i < shot_->senders.size(); ++i) {
        const std::uint32_t p = shot_->senders[i];
        for (std::size_t q = 0; q < 4; ++q) sent_[p][q] += shot_->light[i][q];
        known_[p] = 1;
        updates_.open().setPower(p, largest(sent_[p]));
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
