// Shots: who sends next, and serving the receivers, a piece at a time.
// After [Cohen1988] (progressive refinement) in the form of Southwell's relaxation (Gortler, Cohen
// & Slusallek, IEEE CG&A 14(6), 1994). Departures: senders shoot in batches of a fixed size, so
// that receivers can be worked on side by side; a patch receives at its middle and its corners; its
// first shot after an edit sends more than it owes, by what the ambient estimate says will come
// (Shao & Badler 1993, Xu & Fussell 1994 call this overshooting).
#include "radiosity/transport/IndirectLight.h"

#include "radiosity/rows/RowRoom.h"
#include "radiosity/schedule/WorkCosts.h"

#include "base/Parallel.h"
#include "importance/HighestPriorities.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace penumbra {

namespace {

constexpr std::uint32_t kBlock = PatchSet::kBlock;
/// Senders shot at a time: a share of them all, for choosing them goes through all.
constexpr std::size_t kLeastBatch = 32, kMostBatch = 4096, kBatchShare = 16;

} // namespace

/// Those that owe most, by the root of their areas, of those that owe too much. By power alone,
/// what is small and bright, as what lies beside a light, would be left to the end, the certificate
/// with it; by radiosity alone large surfaces would wait. And a few that owe most, whatever their
/// size: the certificate is theirs.
std::vector<std::uint32_t> IndirectLight::chooseSenders(double enough) const {
    constexpr std::size_t kTinyShare = 64;
    std::vector<double> priority(senders_.count()), most(senders_.count());
    for (std::uint32_t s = 0; s < priority.size(); ++s)
        if (const double now = owed_[s].toAny; now > enough) {
            most[s] = now;
            priority[s] = now * std::sqrt(double(senders_.area(s)));
        }
    const std::size_t tiny = 1 + batch() / kTinyShare;
    std::vector<std::uint32_t> chosen = highestPriorities(priority, batch() - tiny);
    for (const std::uint32_t s : chosen) most[s] = 0;
    const std::vector<std::uint32_t> rest = highestPriorities(most, tiny);
    chosen.insert(chosen.end(), rest.begin(), rest.end());
    return chosen;
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
    if (!relaxing()) choose(chooseSenders(kBelow * target / gain_), false);
    if (!relaxing()) return false;
    shot_ ? serve(effort) : list(effort);
    return true;
}

bool IndirectLight::complete(std::size_t effort) {
    if (!relaxing()) {
        std::vector<std::uint32_t> unknown;
        for (std::uint32_t p = 0; p < known_.size() && unknown.size() < batch(); ++p)
            if (!known_[p] && sendersReached_[p] && senders_.present(p)) unknown.push_back(p);
        if (unknown.empty() && !std::exchange(completed_, true)) allChanged();
        choose(std::move(unknown), true);
    }
    if (!relaxing()) return false;
    shot_ ? serve(effort) : list(effort);
    return true;
}

/// \param dark the senders send nothing, only their rows are wanted
void IndirectLight::choose(std::vector<std::uint32_t> senders, bool dark) {
    if (senders.empty()) return;
    listing_ = std::make_unique<Listing>();
    listing_->linked.resize(senders.size());
    listing_->receivers = std::exchange(lists_, {});
    listing_->receivers.resize(blockCount());
    listing_->senders = std::move(senders);
    listing_->dark = dark;
}

/// Lists the receivers of some more senders. Nothing else knows of a batch until that is done.
/// Blocks without entries, as all that a wall hides, are left out: none of these receives.
void IndirectLight::list(std::size_t effort) {
    constexpr std::size_t kBlocksARay = 64, kFind = 64; // of a row that is there; without one
    Listing& listing = *listing_;
    for (std::size_t cost = 0; cost < effort && listing.next < listing.senders.size();) {
        const auto i = std::uint32_t(listing.next++);
        const std::uint32_t s = listing.senders[i];
        const auto toServe = [&](std::uint32_t block, std::size_t slot) {
            listing.receivers[block].push_back({i, std::uint32_t(slot)});
        };
        if (kept_[s]) {
            const Row& row = table_[s];
            for (std::size_t slot = 0; slot < row.size(); ++slot)
                if (!row.begin()[std::ptrdiff_t(slot)].empty()) toServe(row.blockAt(slot), slot);
            cost += 1 + row.size() / kBlocksARay;
            continue;
        }
        listing.linked[i] = senders_.linkedBlocks(s, linkBoxes_);
        const std::vector<std::uint32_t>& linked = listing.linked[i];
        for (std::size_t slot = 0; slot < linked.size(); ++slot) toServe(linked[slot], slot);
        cost += kFind;
    }
    if (listing.next < listing.senders.size()) return;
    load(listing);
    listing_.reset();
}

std::size_t IndirectLight::rowsNotKept() const {
    std::size_t count = 0;
    for (std::size_t s = 0; s < known_.size(); ++s) count += known_[s] && !kept_[s];
    return count;
}

double IndirectLight::knownShare() const {
    std::size_t reached = 0;
    double known = 0;
    for (std::uint32_t s = 0; s < known_.size(); ++s)
        if (sendersReached_[s] && senders_.present(s)) ++reached, known += known_[s];
    if (shot_ && !shot_->receivers.empty())
        known += double(std::ranges::count(shot_->fresh, 1)) * double(shot_->next) /
                 double(shot_->receivers.size());
    return reached > 0 ? std::min(known / double(reached), 1.0) : 1;
}

std::uint64_t IndirectLight::blocksKept() const {
    std::uint64_t count = 0;
    for (const Row& row : table_.rows())
        count += std::uint64_t(
            std::ranges::count_if(row, [](const RowBlock& block) { return !block.empty(); }));
    return count;
}

/// Begins a batch.
void IndirectLight::load(Listing& listing) {
    shot_ = std::make_unique<Shot>();
    shot_->senders = listing.senders;
    shot_->dark = listing.dark;
    const glm::dvec3 expected = ambient();
    if (!rowRoom_) rowRoom_ = roomForRows(memory_, rowBytes_, set_);
    std::size_t coming = 0; // [bytes]
    for (std::uint32_t i = 0; i < listing.senders.size(); ++i) {
        const std::uint32_t s = listing.senders[i];
        // The first time since an edit send at once what is sure to come later; too much is taken
        // back in its turn: sent every time, some of it would go to and fro.
        const bool fresh = !known_[s];
        const SenderLight owed = cellsOf(residuals_, s), colours = cellsOf(colours_, s);
        std::vector<glm::dvec3> light(owed.size());
        for (std::size_t c = 0; c < light.size() && !listing.dark; ++c) {
            light[c] = owed[c];
            if (expects_[s]) light[c] += colours[c] * expected;
        }
        expects_[s] = 0;
        shot_->fresh.push_back(fresh);
        shot_->sent.emplace_back(light);
        shot_->light.push_back(std::move(light));
        shot_->build.push_back(!kept_[s]);
        if (kept_[s]) continue;
        const bool keep = rowBytes_ + coming < *rowRoom_;
        if (keep) {
            coming += listing.linked[i].size() * kFullBlock;
            table_[s].open(listing.linked[i]);
            updates_.setCurrent(s);
        }
        kept_[s] = keep;
        rowsMissing_ |= !keep;
    }
    shot_->receivers = std::move(listing.receivers);
}

/// Serves some more blocks of the batch: each receives from all of its senders before the next one
/// does, so that sums are taken in a fixed order.
void IndirectLight::serve(std::size_t effort) {
    constexpr std::size_t kGrain = 64; // pairs of a sender and a block
    Shot& shot = *shot_;
    std::vector<std::size_t> cuts{shot.next}; // of tasks: blocks
    std::size_t last = shot.next;
    for (std::size_t sum = 0, pairs = 0; last < shot.receivers.size() && sum < effort; ++last) {
        if (pairs >= kGrain) cuts.push_back(last), pairs = 0;
        pairs += shot.receivers[last].size();
        for (const Link link : shot.receivers[last])
            sum += shot.build[link.sender] ? cost::kBuild : cost::kServe;
    }
    cuts.push_back(last);
    const std::size_t tasks = cuts.size() - 1;
    std::vector<Served> done(tasks);
    parallelFor(tasks, 1, [&](std::size_t first, std::size_t end) {
        std::optional<PatchRowBuilder> builder;
        for (std::size_t t = first; t < end; ++t) {
            for (auto b = std::uint32_t(cuts[t]); b < cuts[t + 1]; ++b)
                serveBlock(b, builder, done[t]);
            if (builder) done[t].rays = builder->takeRayCount();
        }
    });
    for (const Served& task : done) {
        shot.bytes += task.bytes;
        table_.note(task.blockers);
        table_.noteOccluders(task.occluders);
        buildRays_ += task.rays;
    }
    for (; shot.next < last; ++shot.next) served_ += shot.receivers[shot.next].size();
    if (last == shot.receivers.size()) finishShot();
}

/// \param builder is made once there is something to build
void IndirectLight::serveBlock(std::uint32_t b, std::optional<PatchRowBuilder>& builder,
                               Served& served) {
    constexpr std::size_t kAhead = 16; // so many are fetched at a time
    const std::vector<Link>& links = shot_->receivers[b];
    for (std::size_t first = 0; first < links.size(); first += kAhead) {
        const auto some =
            std::span(links).subspan(first).first(std::min(kAhead, links.size() - first));
        std::array<RowBlock, kAhead> passing;
        std::array<RowBlock*, kAhead> blocks;
        for (std::size_t k = 0; k < some.size(); ++k) {
            const std::uint32_t s = shot_->senders[some[k].sender];
            blocks[k] = kept_[s] ? &table_[s].at(b, some[k].slot) : &passing[k];
        }
        for (std::size_t k = 0; k < some.size(); ++k) blocks[k]->prefetch();
        for (std::size_t k = 0; k < some.size(); ++k) {
            if (shot_->build[some[k].sender]) {
                if (!builder) builder.emplace(rays_);
                buildBlock(shot_->senders[some[k].sender], b, *builder, *blocks[k], served);
            }
            serveLink(some[k].sender, b, *blocks[k]);
        }
    }
}

void IndirectLight::buildBlock(std::uint32_t s, std::uint32_t b, PatchRowBuilder& builder,
                               RowBlock& block, Served& served) {
    ReceiverBlock receivers = receiversOf(s, b);
    const ObjectId by = receivers.wanted != 0 ? hiddenBy(s, b) : ObjectId();
    if (by.valid()) receivers.wanted = 0;
    builder.build(senders_.sender(s), receivers, block);
    if (!kept_[s]) return;
    served.bytes += block.bytes();
    RowTable::listBlockers(s, b, block, served.blockers);
    if (by.valid()) served.occluders.push_back({s, b, by.value});
}

/// \param i index into the senders of the batch
void IndirectLight::serveLink(std::uint32_t i, std::uint32_t b, const RowBlock& block) {
    const bool fresh = shot_->fresh[i];
    forEachReceived(block, shot_->sent[i], [&](int r, float factor, glm::dvec3 light) {
        nodes_[b * kBlock + std::size_t(r)] += light;
        if (fresh) rowSums_[b * kBlock + std::size_t(r)] += factor;
    });
}

void IndirectLight::finishShot() {
    for (std::size_t i = 0; i < shot_->senders.size(); ++i) {
        const std::uint32_t p = shot_->senders[i];
        const std::span<glm::dvec3> sent = cellsOf(sent_, p);
        for (std::size_t c = 0; c < sent.size(); ++c) sent[c] += shot_->light[i][c];
        known_[p] = 1;
        if (shot_->build[i]) table_.fit(p);
        if (kept_[p] && !sendersReached_[p]) forgotten_.push_back(p);
        updates_.dirty().setPower(p, largest(sent));
    }
    rowBytes_ += shot_->bytes;
    if (!shot_->dark) shots_ += shot_->senders.size();
    noteBatch(*shot_);
    lists_ = std::move(shot_->receivers);
    for (std::vector<Link>& list : lists_) list.clear();
    shot_.reset();
}

} // namespace penumbra
