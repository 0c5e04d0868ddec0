#include "radiosity/transport/Solver.h"

#include "base/Clock.h"
#include "base/MachineMemory.h"
#include "base/Parallel.h"
#include "radiosity/mesh/Interpolation.h"
#include "radiosity/schedule/ViewPriority.h"
#include "radiosity/transport/LitLevel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace penumbra {

namespace {

constexpr std::size_t kMostEffort = std::size_t(1) << 20; ///< [rays]
constexpr std::size_t kMostPromptEffort = 1536; ///< of a piece within a prompt budget [rays]
constexpr double kPrompt = 2e-3;                ///< a budget below is one [s]
/// What deferred work may change, of what the certificate allows.
constexpr double kDirectMayStayDirty = 0.04, kIndirectMayStayDirty = 0.35;
constexpr double kFinish = 0.3; ///< of what is certified: relaxation ends there
/// A piece of work within a prompt budget takes about so long; within others it takes the budget,
/// up to so long [s]: small pieces have threads wait for each other, and work take longer in all.
constexpr double kPause = 3e-4, kLongest = 0.05;

Rgb toRgb(glm::dvec3 v) {
    return {float(v.x), float(v.y), float(v.z)};
}

} // namespace

Solver::Solver(const PatchSet& patches, const RayScene& rays, const SolverOptions& options)
    : set_(patches), rays_(rays), options_(options), direct_(patches, rays, options.samples) {
    const bool lit = !patches.patches.empty() && !patches.emitters.empty(); // else all is black
    if (!options.directOnly && lit) {
        nodeHits_ = std::make_unique<NodeHits>(patches, rays);
        indirect_ = std::make_unique<IndirectLight>(patches, rays, direct_, *nodeHits_, memory(),
                                                    options.clusters);
        if (options.detail) detail_ = std::make_unique<DetailGather>(patches, *nodeHits_);
    }
    if (options.policy != PolicyKind::importance) setPolicy(options.policy);
}

Solver::~Solver() = default;

void Solver::attend(const Attention& attention) {
    attention_ = attention;
    if (options_.policy != PolicyKind::importance) return;
    direct_.setWhole(attention.whole);
    const double ambient = meanRadiosity();
    if (!seen_)
        seen_ = std::make_shared<ViewPriority>(set_, rays_, [this] { return direct_.vertices(); });
    seen_->attend(attention, ambient);
    if (std::exchange(inViewOrder_, true))
        direct_.rekey();
    else
        direct_.setPolicy(seen_);
}

void Solver::setPolicy(PolicyKind policy) {
    options_.policy = policy;
    std::shared_ptr<SchedulingPolicy> all = std::make_shared<BoundPolicy>();
    if (policy == PolicyKind::plain) all = std::make_shared<PlainPolicy>();
    if (policy == PolicyKind::random) all = std::make_shared<RandomPolicy>(1);
    setDirectPolicy(all);
    if (indirect_) indirect_->setPolicy(all);
    if (attention_) attend(*attention_);
}

void Solver::setDirectPolicy(std::shared_ptr<SchedulingPolicy> policy) {
    direct_.setPolicy(std::move(policy));
    inViewOrder_ = false;
}

void Solver::takeOver(Solver& before, const PatchMatch& match) {
    if (indirect_ && before.indirect_) {
        const NodeHits::Taken taken = nodeHits_->takeOver(*before.nodeHits_, match);
        indirect_->takeOver(*before.indirect_, match);
        if (detail_ && before.detail_) detail_->takeOver(*before.detail_, match, taken);
    }
    direct_.takeOver(before.direct_, match);
    pace_ = before.pace_;
    begin();
}

void Solver::add(std::span<const ObjectId> objects) {
    direct_.add(objects);
    if (indirect_) {
        nodeHits_->add();
        indirect_->add(objects);
        if (detail_) detail_->add(objects);
    }
    if (!seen_) return;
    raysBefore_ += seen_->rays();
    seen_.reset();
    inViewOrder_ = false;
    attend(*attention_);
}

void Solver::apply(const SceneChange& change) {
    if (change.empty()) return;
    direct_.apply(change);
    if (seen_) {
        if (change.colours) seen_->followColours();
        seen_->follow(change.objects);
        if (inViewOrder_) direct_.rekey();
    }
    if (indirect_) {
        const std::vector<NodeHits::Move> moves = nodeHits_->apply(change);
        indirect_->apply(change);
        if (detail_) detail_->apply(change, moves);
    }
    begin();
}

void Solver::invalidate(const Bounds& region) {
    direct_.invalidate(region);
    if (nodeHits_) nodeHits_->invalidate(region);
    if (indirect_) indirect_->invalidate(region);
    if (detail_) detail_->invalidate(region);
    begin();
}

/// Something is to be done again.
void Solver::begin() {
    handedOver_ = completed_ = idle_ = stopped_ = false;
    state_ = SolutionState::working;
    firstCertificate_ = relaxed_ = 0;
    firstKnown_ = 1;
    if (!indirect_) return;
    shotsBefore_ = indirect_->shots();
    servedBefore_ = indirect_->blocksServed();
}

bool Solver::step(double budget, const Progress& progress) {
    return stepUntil(SolutionState::exact, budget, progress);
}

/// What nobody sees waits for so long while something is moved all the time; then it has a share of
/// the work, see DirtySet [s].
constexpr double kAging = 0.5;

bool Solver::stepUntil(SolutionState wanted, double budget, const Progress& progress) {
    const double start = steadySeconds();
    const bool prompt = budget < kPrompt;
    const std::size_t most = prompt ? kMostPromptEffort : kMostEffort;
    const double piece = prompt ? kPause : std::min(budget, kLongest);
    const auto enough = [&] { return idle_ && wanted <= SolutionState::certified; };
    for (double left = budget; left > 0 && !enough(); left = budget - (steadySeconds() - start)) {
        direct_.setAging(kAging / pace_.secondsPerRay(Pace::direct));
        pace_.aim(std::min(piece, std::max(left, 0.5 * kPause)), most);
        if (!work(pace_, progress)) return true;
    }
    return enough();
}

void Solver::settle(SolutionState wanted, const Progress& progress) {
    while (!stepUntil(wanted, 3600, progress)) {
    }
    while (state_ < wanted && !step(3600, progress)) { // it takes what was deferred
    }
}

bool Solver::work(std::size_t effort, const Progress& progress) {
    Pace pace(effort);
    return work(pace, progress);
}

bool Solver::work(Pace& pace, const Progress& progress) {
    if (workOnce(pace, progress)) return true;
    if (detail_ && workOnDetail(pace, progress)) return true;
    const std::size_t dirty =
        direct_.updates().dirty().count() + (indirect_ ? indirect_->updates().dirty().count() : 0);
    state_ = reached(dirty > 0);
    const bool first = !std::exchange(idle_, true);
    stopped_ = dirty == 0 && state_ == SolutionState::working;
    if (dirty == 0 || !first) return false;
    if (detail_) detail_->sweepAgain(); // after what was deferred, for which it is time now
    return true;                        // so that who waits for this state can read it
}

/// The state when nothing is left to be done. \param open whether deferred work is left
SolutionState Solver::reached(bool deferred) const {
    return stateOf({.certificate = indirect_ && !certificateMet(),
                    .fineShadows = detail_ && detail_->pending(),
                    .deferred = deferred});
}

/// The same, but for what may be deferred.
bool Solver::workOnce(Pace& pace, const Progress& progress) {
    const double start = steadySeconds();
    if (pace.work(Pace::direct,
                  [&](std::size_t effort) {
                      return direct_.update(effort, mayStayDirty(kDirectMayStayDirty));
                  }) ||
        pace.work(Pace::sums, [&](std::size_t effort) { return direct_.sum(effort); })) {
        handedOver_ = false;
        directSeconds_ += steadySeconds() - start;
        if (progress) progress("direct light", direct_.updates().share());
        return true;
    }
    if (!indirect_) return false;
    handOver();
    const bool more = workOnIndirect(pace, progress);
    indirectSeconds_ += steadySeconds() - start;
    return more;
}

/// Notifies the indirect light that direct light has changed.
void Solver::handOver() {
    if (std::exchange(handedOver_, true)) return;
    const bool litChanged = direct_.takeLitChanged();
    indirect_->directChanged(litChanged);
    if (litChanged) completed_ = false; // light may reach more patches
}

/// What nodes see, then rows that an edit changed, then rows that are missing, then shots.
bool Solver::workOnIndirect(Pace& pace, const Progress& progress) {
    if (pace.work(Pace::nodes, [&](std::size_t effort) { return nodeHits_->work(effort); })) {
        if (progress) progress("where light gets to", nodeHits_->share());
        return true;
    }
    bool more = pace.work(Pace::rows, [&](std::size_t effort) {
        return indirect_->update(effort, mayStayDirty(kIndirectMayStayDirty));
    });
    if (more && progress) progress("shadows of indirect light", indirect_->updates().share());
    // Rows that are missing come all at once, for each changes a little of what is owed, and
    // early, so that this is sent along with the rest.
    constexpr double kEarly = 1000;
    if (!more && !completed_ && !spent() && !indirect_->relaxing() &&
        !indirect_->residualsStale() && indirect_->certificate() <= kEarly * target())
        completing_ = completed_ = true;
    if (!more && completing_) {
        completing_ = more = pace.work(
            Pace::completion, [&](std::size_t effort) { return indirect_->complete(effort); });
        reportIndirect(progress);
    }
    finished_ = isFinished();
    if (!more &&
        (!(finished_ || spent()) || indirect_->relaxing() || indirect_->residualsStale())) {
        more = pace.work(Pace::relaxation, [&](std::size_t effort) {
            return indirect_->relax(effort, kFinish * target());
        });
        finished_ = finished_ || (!more && certificateMet()); // what is left is deferred
        reportIndirect(progress);
    }
    return more;
}

/// Rows that are built take most of the time, then shots: by how far the certificate has come.
/// Progress, once made, stands: of what comes in late nobody could know.
void Solver::reportIndirect(const Progress& progress) {
    if (!progress) return;
    const double now = indirect_->certificate(), known = indirect_->knownShare();
    firstCertificate_ = std::max(firstCertificate_, now);
    firstKnown_ = std::min(firstKnown_, known);
    constexpr double kBuilding = 0.8; // share of the time, if no row is there at first
    const double building = kBuilding * (1 - firstKnown_);
    const double built = firstKnown_ < 1 ? (known - firstKnown_) / (1 - firstKnown_) : 1;
    const double span = std::log(firstCertificate_ / std::max(target(), 1e-30));
    const double sent = !(now > 0) ? 0 : span > 0 ? std::log(firstCertificate_ / now) / span : 1;
    relaxed_ = std::max(relaxed_, building * built + (1 - building) * std::min(sent, 1.0));
    progress("indirect light", relaxed_);
}

bool Solver::workOnDetail(Pace& pace, const Progress& progress) {
    if (detail_->swept()) return false;
    const double start = steadySeconds();
    if (!pace.work(Pace::detail, [&](std::size_t effort) { return detail_->trace(effort); })) {
        if (!detail_->sweeping()) detail_->beginSweeps(direct_.vertices(), nodeIlluminance());
        pace.work(Pace::sweeps, [&](std::size_t effort) { return detail_->sweep(effort), true; });
    }
    detailSeconds_ += steadySeconds() - start;
    if (progress) progress("fine shadows", detail_->share());
    return true;
}

std::size_t Solver::memory() const {
    return memoryBudget(options_.memory);
}

double Solver::directTolerance() const {
    return tolerance(kDirectMayStayDirty);
}

/// How much of what is owed may be deferred [lm/m^2].
double Solver::tolerance(double share) const {
    if (!indirect_) return share * options_.residual * direct_.brightest();
    return share * target() / indirect_->gain();
}

double Solver::target() const {
    return options_.residual > 0 ? options_.residual * direct_.brightest()
                                 : 0.01 * indirect_->meanRadiosity();
}

bool Solver::certificateMet() const {
    return !indirect_->residualsStale() && indirect_->certificate() <= target();
}

/// Whether relaxation is at its end: it goes on to well below what is certified, for all that is
/// owed by then comes at once, as an estimate; and begins again when the certificate is lost.
bool Solver::isFinished() const {
    if (indirect_->residualsStale()) return finished_;
    const double now = indirect_->certificate();
    return now <= kFinish * target() || (finished_ && now <= target());
}

bool Solver::spent() const {
    constexpr std::uint64_t kMostBlocks = 150'000'000, kMostTimes = 50; // each block is served
    constexpr std::uint64_t kAnyway = 2000;                             // shots
    const std::uint64_t shots = indirect_->shots() - shotsBefore_;
    const std::uint64_t served = indirect_->blocksServed() - servedBefore_;
    if (options_.mostShots > 0) return shots >= options_.mostShots;
    if (options_.residual > 0 || shots < kAnyway || served < kMostBlocks) return false;
    return served >= kMostTimes * indirect_->blocksKept();
}

std::vector<glm::dvec3> Solver::nodeIlluminance() const {
    return indirect_ ? indirect_->nodes() : std::vector<glm::dvec3>(set_.nodes.size());
}

Lighting Solver::lighting() const {
    std::vector<std::uint32_t> blocks(set_.vertices.size() / PatchSet::kBlock);
    std::iota(blocks.begin(), blocks.end(), 0u);
    Lighting lighting;
    light(blocks, lighting);
    return lighting;
}

void Solver::light(std::span<const std::uint32_t> blocks, Lighting& lighting) const {
    lighting.direct.resize(set_.vertices.size());
    lighting.indirect.resize(set_.vertices.size());
    const std::vector<glm::dvec3> nodes = nodeIlluminance();
    parallelFor(blocks.size(), 8, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const std::uint32_t begin = blocks[i] * PatchSet::kBlock;
            for (std::uint32_t v = begin; v < begin + PatchSet::kBlock; ++v) {
                const PatchCoordinate& at = set_.vertexCoordinates[v];
                lighting.direct[v] = direct_.vertices()[v];
                lighting.indirect[v] = Rgb();
                if (at.patch != Element::kNone && indirect_)
                    lighting.indirect[v] =
                        toRgb(glm::max(interpolateNodes<glm::dvec3>(set_, at, nodes), 0.0));
            }
            if (detail_) detail_->correct(blocks[i], nodes, lighting.indirect);
        }
    });
}

std::vector<Rgb> Solver::radiosity() const {
    std::vector<Rgb> radiosity;
    for (std::uint32_t p = 0; p < set_.patches.size(); ++p) {
        const Rgb rho = set_.sends(p) ? patchReflectance(set_, p) : Rgb();
        radiosity.push_back(indirect_ ? toRgb(indirect_->reflected(p))
                                      : rho * toRgb(direct_.patches()[p]));
    }
    return radiosity;
}

double Solver::litIlluminance() const {
    const std::vector<glm::dvec3> nodes = nodeIlluminance();
    LitLevel level, far;
    for (std::uint32_t p = 0; p < set_.patches.size(); ++p) {
        const Patch& patch = set_.patches[p];
        if (!set_.sends(p) || !(maxChannel(patchReflectance(set_, p)) > 0)) continue;
        glm::dvec3 h = direct_.patches()[p];
        if (indirect_)
            h += interpolate<glm::dvec3>(patch, 0.5f, 0.5f,
                                         [&](std::uint32_t n) { return nodes[n]; });
        (patch.far ? far : level).add(std::max({h.r, h.g, h.b}), patch.area);
    }
    const double median = level.median();
    return median > 0 ? median : far.median();
}

WorkDone Solver::done() const {
    WorkDone done;
    done.rays = direct_.updates().rays().total();
    done.blocks = direct_.updates().blocksVisited();
    done.nodes = set_.nodes.size();
    done.rays += raysBefore_ + (seen_ ? seen_->rays() : 0);
    if (!indirect_) return done;
    done.rays += indirect_->updates().rays().total() + indirect_->buildRays().total();
    done.rays += nodeHits_->count().rays;
    done.blocks += indirect_->updates().blocksVisited() + nodeHits_->count().groups;
    done.shots = indirect_->shots();
    if (!detail_) return done;
    done.rays += detail_->hits().count().rays;
    done.blocks += detail_->hits().count().groups;
    return done;
}

SolveStatistics Solver::statistics() const {
    SolveStatistics result;
    const auto count = [](const RowUpdates& updates, double time) {
        return WorkCount{updates.rays(), updates.blocksVisited(), updates.entriesChanged(), time};
    };
    result.state = state_;
    result.brightest = direct_.brightest();
    result.litIlluminance = litIlluminance();
    result.direct = count(direct_.updates(), directSeconds_);
    result.dirtyBlocks = direct_.updates().dirty().count();
    if (indirect_) {
        result.dirtyBlocks += indirect_->updates().dirty().count();
        result.dirtyBound = indirect_->dirtyBound();
        result.indirect = count(indirect_->updates(), indirectSeconds_);
        result.indirect.rays += indirect_->buildRays();
        result.indirect.rays.full += nodeHits_->count().rays;
        result.indirect.blocksVisited += nodeHits_->count().groups;
        if (detail_) {
            const GroupCount& done = detail_->hits().count();
            result.detail = {{done.rays, 0}, done.groups, 0, detailSeconds_};
        }
        result.shots = indirect_->shots();
        result.rowsNotKept = indirect_->rowsNotKept();
        result.residual = indirect_->residual();
        result.certificate = indirect_->certificate();
        result.meanRadiosity = indirect_->meanRadiosity();
    }
    const auto add = [&](const Row& row) {
        if (row.empty()) return;
        const RowSize size = sizeOf(row);
        ++result.rows;
        result.entries += size.entries;
        result.bytes += size.bytes;
    };
    for (const Row& row : emitterRows()) add(row);
    for (const Row& row : patchRows()) add(row);
    return result;
}

} // namespace penumbra
