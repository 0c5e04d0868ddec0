#include "radiosity/query/CostEstimate.h"

#include "base/MachineMemory.h"
#include "base/PairHash.h"
#include "radiosity/mesh/Interpolation.h"
#include "radiosity/query/MemoryWarning.h"
#include "radiosity/rows/EmitterRowBuilder.h"
#include "radiosity/rows/PatchRowBuilder.h"
#include "radiosity/rows/RowRoom.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <ctime>
#include <vector>

namespace penumbra {

namespace {

constexpr std::uint32_t kBlock = PatchSet::kBlock;
constexpr std::uint32_t kRun =
    16; ///< receivers side by side: they find their surroundings in the cache
constexpr double kTime = 0.15; ///< processor time for each kind of sample [s]

/// Of rows that were not kept, by power the last ones: how often each is traced again. Measured:
/// office.
constexpr double kShotsAgain = 3;
/// What sums take, and fine shadows; measured [bytes a vertex].
constexpr double kVertexSums = 40, kVertexFine = 160;

/// Of this thread: other programs do not count [s].
double processorSeconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

/// What was found out by samples, of one each.
struct Sampled {
    double rays = 0, seconds = 0, bytes = 0;
    std::size_t count = 0;

    double each(double sum) const { return count > 0 ? sum / double(count) : 0; }
};

/// Takes samples until the time is over: at least `least` of them, at most `most`.
/// \param take adds to what it is given, from a number that spreads over all 32 bits
template <class Take>
Sampled sample(std::size_t least, std::size_t most, Take take) {
    Sampled sum;
    const double start = processorSeconds();
    while (sum.count < most && (sum.count < least || processorSeconds() < start + kTime)) {
        take(pairHash(std::uint32_t(sum.count), 0x5eed), sum);
        ++sum.count;
    }
    sum.seconds = processorSeconds() - start;
    return sum;
}

/// A number below `count`, from all bits of a hash.
std::uint32_t below(std::size_t count, std::uint32_t hash) {
    return std::uint32_t(std::uint64_t(count) * hash >> 32);
}

class Sampler {
public:
    Sampler(const Solver& solver, const PatchSet& set, const RayScene& rays)
        : solver_(solver), set_(set), emitters_(rays), patches_(rays), open_(set.nodes.size(), -1) {
    }

    Sampled emitterBlocks();
    Sampled patchBlocks();
    Sampled nodes();
    Sampled vertices();

private:
    double openness(std::uint32_t node, Sampled& sum);
    double fineRays(std::uint32_t vertex, double expected) const;

    const Solver& solver_;
    const PatchSet& set_;
    EmitterRowBuilder emitters_;
    PatchRowBuilder patches_;
    std::vector<double> open_; ///< of nodes; negative: not known
};

/// Blocks of vertices as emitters light them; of each pair.
Sampled Sampler::emitterBlocks() {
    std::vector<Receiver> receivers(kBlock);
    return sample(64, 4096, [&](std::uint32_t hash, Sampled& sum) {
        const std::uint32_t b = below(set_.vertices.size() / kBlock, hash);
        const std::uint32_t e = below(set_.emitters.size(), pairHash(hash, 1));
        if (!set_.objects[set_.vertexBlockObject[b].value].present) return;
        std::uint64_t wanted = 0;
        for (std::uint32_t i = 0; i < kBlock; ++i) {
            receivers[i] = set_.isBlended(b) ? Receiver{} : set_.vertices[b * kBlock + i].receiver;
            const bool hidden = solver_.direct().wallBefore(e, b * kBlock + i).valid();
            wanted |= std::uint64_t(!isPadding(receivers[i]) && !hidden) << i;
        }
        RowBlock block;
        emitters_.update(solver_.direct().senders()[e], {receivers, wanted}, ~std::uint64_t(0), {},
                         block);
        sum.rays += double(emitters_.takeRayCount().total());
        sum.bytes += double(block.bytes());
    });
}

/// Blocks of nodes as patches and clusters light them; of each link.
Sampled Sampler::patchBlocks() {
    constexpr std::size_t kOfABlock = 8; // links that are sampled
    const IndirectSenders& senders = solver_.indirect().senders();
    std::vector<std::uint32_t> linked, keys(kBlock);
    double links = 0;
    std::size_t blocks = 0;
    Sampled mean; // of the links of a block, by how many it has
    Sampled sum = sample(32, 1024, [&](std::uint32_t hash, Sampled& out) {
        const std::uint32_t b = below(set_.nodes.size() / kBlock, hash);
        Bounds box;
        for (std::uint32_t n = b * kBlock; n < (b + 1) * kBlock; ++n) {
            if (!isPadding(set_.uncoveredNodes[n])) box.add(set_.uncoveredNodes[n].position);
            keys[n - b * kBlock] = addressOfNode(set_, n);
        }
        linked.clear();
        senders.forEachLinked(box, [&](std::uint32_t s) {
            if (senders.present(s)) linked.push_back(s);
        });
        if (linked.empty()) return;
        const double weight = double(linked.size()) / kOfABlock;
        for (std::uint32_t i = 0; i < kOfABlock; ++i) {
            const std::uint32_t s = linked[below(linked.size(), pairHash(hash, i + 1))];
            if (solver_.indirect().hiddenBy(s, b).valid()) continue; // costs next to nothing
            RowBlock block;
            const double start = processorSeconds();
            patches_.build(
                senders.sender(s),
                {std::span(set_.nodes).subspan(b * kBlock, kBlock), ~std::uint64_t(0), keys},
                block);
            mean.seconds += weight * (processorSeconds() - start);
            out.rays += weight * double(patches_.takeRayCount().total());
            out.bytes += weight * double(block.bytes());
        }
        links += double(linked.size());
        ++blocks;
    });
    // Of a link, for the number of links is known better than by these blocks.
    sum.seconds = mean.seconds;
    sum.count = std::size_t(links);
    return sum;
}

double Sampler::openness(std::uint32_t node, Sampled& sum) {
    if (open_[node] >= 0 || isPadding(set_.nodes[node])) return std::max(open_[node], 0.0);
    DetailRays::Hits hits;
    sum.rays +=
        solver_.nodeHits()->rays().follow(set_.nodes[node], DetailRays::kAllRays, false, hits);
    return open_[node] = 1 - double(std::popcount(hits.near)) / DetailRays::kRays;
}

/// What nodes see; of each.
Sampled Sampler::nodes() {
    Sampled sum = sample(8, 1024, [&](std::uint32_t hash, Sampled& out) {
        const std::uint32_t first = kRun * below(set_.nodes.size() / kRun, hash);
        for (std::uint32_t n = first; n < first + kRun; ++n) {
            open_[n] = -1; // if it is known already, that took no time
            openness(n, out);
        }
    });
    sum.count *= kRun;
    return sum;
}

/// Fine shadows of a vertex, as DetailHits finds them. \param expected see there
double Sampler::fineRays(std::uint32_t vertex, double expected) const {
    constexpr double kAsExpected = 0.07, kOpen = 0.5; // see DetailHits::follow()
    const DetailRays& rays = solver_.nodeHits()->rays();
    const Receiver& at = set_.vertices[vertex].receiver;
    DetailRays::Hits hits;
    int count = rays.follow(at, DetailRays::kAllProbes, true, hits);
    const double free = 1 - double(std::popcount(hits.near)) / DetailRays::kProbes;
    if (std::abs(free - expected) < kAsExpected && free > kOpen) return count;
    count += rays.follow(at, ~DetailRays::kAllProbes, true, hits);
    if (inSlit(hits.elements)) count += rays.follow(at, DetailRays::kAllRays, true, hits);
    return count;
}

/// The same; of each.
Sampled Sampler::vertices() {
    Sampled others; // of nodes
    double seconds = 0;
    std::vector<double> expected(kRun);
    Sampled sum = sample(8, 1024, [&](std::uint32_t hash, Sampled& out) {
        const std::uint32_t first = kRun * below(set_.vertices.size() / kRun, hash);
        const auto there = [&](std::uint32_t v) {
            return set_.vertexCoordinates[v].patch != Element::kNone && !set_.isBlended(v / kBlock);
        };
        for (std::uint32_t v = first; v < first + kRun; ++v) {
            if (!there(v)) continue;
            expected[v - first] =
                interpolate<double>(set_, set_.vertexCoordinates[v],
                                    [&](std::uint32_t n) { return openness(n, others); });
        }
        const double start = processorSeconds();
        for (std::uint32_t v = first; v < first + kRun; ++v)
            if (there(v)) out.rays += fineRays(v, expected[v - first]);
        seconds += processorSeconds() - start;
    });
    sum.seconds = seconds;
    sum.count *= kRun;
    return sum;
}

void addDirect(Sampler& sampler, const PatchSet& set, CostEstimate& cost) {
    const Sampled lit = sampler.emitterBlocks();
    const auto vertices = double(set.vertices.size());
    const double pairs = vertices / kBlock * double(set.emitters.size());
    cost.directRays = pairs * lit.each(lit.rays);
    cost.directSeconds = pairs * lit.each(lit.seconds);
    const double bytes = pairs * lit.each(lit.bytes) + kVertexSums * vertices;
    cost.directBytes += bytes;
    cost.allBytes += bytes;
}

void addIndirect(Sampler& sampler, const PatchSet& set, const Solver& solver, CostEstimate& cost) {
    const auto vertices = double(set.vertices.size()), nodes = double(set.nodes.size());
    const Sampled linked = sampler.patchBlocks(), seen = sampler.nodes(), fine = sampler.vertices();
    const double links = countLinks(set, solver.indirect().senders());
    cost.rowBytes = links * linked.each(linked.bytes) * kRowOverhead;
    cost.allBytes += kVertexFine * vertices;
    const double room = double(solver.memory()) - cost.allBytes;
    if (cost.rowBytes > room) cost.rowsKept = std::max(room, 0.0) / cost.rowBytes;
    cost.allBytes += cost.rowsKept * cost.rowBytes;

    const double times = 1 + kShotsAgain * (1 - cost.rowsKept); // that a row is built
    cost.indirectRays = times * links * linked.each(linked.rays) + nodes * seen.each(seen.rays);
    cost.detailRays = vertices * fine.each(fine.rays);
    cost.allSeconds = cost.directSeconds + times * links * linked.each(linked.seconds) +
                      nodes * seen.each(seen.seconds) + vertices * fine.each(fine.seconds);
}

} // namespace

CostEstimate estimateCost(const LitScene& scene, const SolverOptions& options) {
    const PatchSet& set = scene.patches();
    CostEstimate cost;
    cost.directBytes = cost.allBytes = double(residentMemory());
    if (set.emitters.empty() || set.patches.empty()) return cost;
    if (options.directOnly) {
        Sampler sampler(scene.solver(), set, scene.rays());
        addDirect(sampler, set, cost);
        return cost;
    }
    const Solver solver(set, scene.rays(), options);
    cost.allBytes = double(residentMemory());
    Sampler sampler(solver, set, scene.rays());
    addDirect(sampler, set, cost);
    addIndirect(sampler, set, solver, cost);
    return cost;
}

} // namespace penumbra
