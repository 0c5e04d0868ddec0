// After [Cohen1988] (progressive refinement) in the form of Southwell's relaxation (Gortler, Cohen
// & Slusallek, IEEE CG&A 14(6), 1994). Departures: senders shoot in batches of a fixed size, so
// that receivers can be worked on side by side; a patch receives at its middle and its corners; its
// first shot sends more than it owes, by what the ambient estimate says will come (Shao & Badler
// 1993, Xu & Fussell 1994 call this overshooting).
#include "radiosity/Solver.h"

#include "importance/WorkOrder.h"
#include "radiosity/DrawnSurface.h"
#include "radiosity/HemisphereRays.h"
#include "radiosity/Interpolation.h"
#include "radiosity/Parallel.h"
#include "radiosity/SenderSamples.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>

namespace penumbra {

namespace {

constexpr std::size_t kBatch = 32; ///< senders shot at a time
/// Mean over a patch from its middle and its four corners: Simpson's rule in two dimensions with
/// the edge points left out, exact for quadratics.
constexpr double kMiddleWeight = 2.0 / 3.0;

double seconds() {
    using namespace std::chrono;
    return duration<double>(steady_clock::now().time_since_epoch()).count();
}

glm::dvec3 toDouble(Rgb c) {
    return {c.r, c.g, c.b};
}
Rgb toRgb(glm::dvec3 v) {
    return {float(v.x), float(v.y), float(v.z)};
}
double largest(glm::dvec3 v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

std::size_t blockCount(std::size_t receivers) {
    return (receivers + RowBlock::kSize - 1) / RowBlock::kSize;
}

std::span<const Receiver> blockOf(const std::vector<Receiver>& receivers, std::size_t block) {
    const std::size_t first = block * RowBlock::kSize;
    return std::span(receivers).subspan(
        first, std::min<std::size_t>(RowBlock::kSize, receivers.size() - first));
}

} // namespace

Solver::Solver(const PatchSet& patches, const RayScene& rays, const SolverOptions& options)
    : set_(patches), rays_(rays), options_(options), vertexDirect_(patches.vertices.size()),
      patchDirect_(patches.patches.size()), nodeIndirect_(patches.nodes.size()),
      nodeRowSum_(patches.nodes.size()), shot_(patches.patches.size()),
      residual_(patches.patches.size()), patchRows_(patches.patches.size()),
      rowKnown_(patches.patches.size()) {
    for (const Emitter& emitter : set_.emitters) {
        const int base = std::min(options.samples, RowBlock::kSize);
        emitters_.emplace_back(emitter, base, std::min(4 * base, RowBlock::kSize));
        statistics_.brightest =
            std::max<double>(statistics_.brightest, maxChannel(emitter.exitance));
    }
    receivers_.reserve(set_.vertices.size());
    for (const Vertex& vertex : set_.vertices) receivers_.push_back(vertex.receiver);
    patchSamples_.resize(set_.patches.size() * kPatchSamples);
    parallelFor(set_.patches.size(), 256, [&](std::size_t first, std::size_t last) {
        for (std::size_t p = first; p < last; ++p)
            samplePatch(set_, set_.patches[p], patchSamples_.data() + p * kPatchSamples);
    });
}

void Solver::solveDirect(const Progress& progress) {
    const double start = seconds();
    const std::size_t blocks = blockCount(receivers_.size());
    emitterRows_.clear();
    for (std::size_t e = 0; e < emitters_.size(); ++e) emitterRows_.emplace_back(blocks);
    std::atomic<std::uint64_t> rayCount{0};
    std::atomic<std::size_t> done{0};
    parallelFor(blocks, 16, [&](std::size_t first, std::size_t last) {
        RowBuilder builder(rays_);
        for (std::size_t b = first; b < last; ++b) {
            const auto receivers = blockOf(receivers_, b);
            Rgb* const out = vertexDirect_.data() + b * RowBlock::kSize;
            for (std::size_t e = 0; e < emitters_.size(); ++e) {
                RowBlock& block = emitterRows_[e][b];
                builder.emitterBlock(emitters_[e], receivers, block);
                const Rgb exitance = emitters_[e].emitter().exitance;
                block.forEach([&](int r, float factor) { out[r] += factor * exitance; });
            }
        }
        rayCount += builder.rayCount();
        done += last - first;
        if (progress) progress("direct light", double(done) / double(blocks));
    });
    statistics_.directRays = rayCount;
    averageDirect();
    updateResiduals();
    statistics_.directSeconds = seconds() - start;
}

Rgb elementMean(const Element& element, const Lighting& lighting) {
    const std::size_t count = element.isTriangle() ? 3 : 4;
    Rgb sum;
    for (std::size_t k = 0; k < count; ++k)
        sum += lighting.direct[element.vertices[k]] + lighting.indirect[element.vertices[k]];
    return (1.0f / float(count)) * sum;
}

void Solver::averageDirect() {
    const Lighting direct{vertexDirect_, std::vector<Rgb>(vertexDirect_.size())};
    for (std::size_t p = 0; p < set_.patches.size(); ++p) {
        const Patch& patch = set_.patches[p];
        glm::dvec3 sum(0);
        double area = 0;
        for (std::uint32_t i = 0; i < patch.elementCount; ++i) {
            const Element& element = set_.elements[set_.patchElements[patch.firstElement + i]];
            const double size = elementArea(set_, element);
            sum += size * toDouble(elementMean(element, direct));
            area += size;
        }
        patchDirect_[p] = area > 0 ? sum / area : glm::dvec3(0);
    }
}

/// Form factors are exact, but visibility is sampled, so that a node's factors may add up to a
/// little more than the whole hemisphere: what is too much is taken off in proportion. This also
/// bounds the certificate.
glm::dvec3 Solver::nodeIndirect(std::uint32_t node) const {
    return nodeIndirect_[node] / std::max(1.0, nodeRowSum_[node]);
}

glm::dvec3 Solver::received(std::uint32_t index) const {
    const Patch& patch = set_.patches[index];
    glm::dvec3 indirect = nodeIndirect(patch.centreNode);
    if (patch.hasCornerNodes) {
        glm::dvec3 corners(0);
        for (std::uint32_t node : patch.cornerNodes) corners += nodeIndirect(node);
        indirect = kMiddleWeight * indirect + (1 - kMiddleWeight) / 4 * corners;
    }
    return patchDirect_[index] + indirect;
}

void Solver::updateResiduals() {
    double most = 0, gain = 0, area = 0, radiosity = 0;
    for (std::uint32_t p = 0; p < set_.patches.size(); ++p) {
        const Patch& patch = set_.patches[p];
        const glm::dvec3 rho = toDouble(set_.materials[patch.material].reflectance);
        const glm::dvec3 sent = rho * received(p);
        residual_[p] = sent - shot_[p];
        most = std::max(most, largest(residual_[p]));
        gain = std::max(gain, largest(rho)); // times the row sum, which is at most 1
        if (largest(rho) <= 0) continue;
        area += patch.area;
        radiosity += patch.area * largest(sent);
    }
    statistics_.residual = most;
    // |B_exact - B| <= max|R| / (1 - max(rho * row sum)), in the maximum norm.
    statistics_.certificate = most / (1 - gain);
    statistics_.meanRadiosity = area > 0 ? radiosity / area : 0;
}

double Solver::target() const {
    return options_.residual > 0 ? options_.residual * statistics_.brightest
                                 : 0.01 * statistics_.meanRadiosity;
}

bool Solver::settled() const {
    if (statistics_.residual == 0) return true;
    return statistics_.certificate <= target();
}

/// A shot visits every node: the limit keeps shots times nodes in bounds.
bool Solver::spent() const {
    constexpr std::uint64_t kMostVisits = 3'000'000'000;
    std::uint64_t most = options_.mostShots;
    if (most == 0 && options_.residual == 0)
        most = std::max<std::uint64_t>(2000,
                                       kMostVisits / std::max<std::size_t>(1, set_.nodes.size()));
    return most > 0 && statistics_.shots >= most;
}

std::vector<std::uint32_t> Solver::chooseSenders() const {
    std::vector<double> power(set_.patches.size());
    for (std::size_t p = 0; p < power.size(); ++p)
        power[p] = largest(residual_[p]) * double(set_.patches[p].area);
    return mostValuable(power, kBatch);
}

void Solver::shoot(const std::vector<std::uint32_t>& senders) {
    const std::size_t blocks = blockCount(set_.nodes.size());
    const bool keep = rowBytes_ < options_.rowMemory;
    std::vector<std::uint8_t> fresh(senders.size()), build(senders.size());
    std::vector<glm::dvec3> sent(senders.size());
    const glm::dvec3 expected = ambient();
    for (std::size_t i = 0; i < senders.size(); ++i) {
        Row& row = patchRows_[senders[i]];
        fresh[i] = !rowKnown_[senders[i]];
        // The first time send at once what is sure to come later; too much is taken back in its
        // turn.
        sent[i] = residual_[senders[i]];
        if (fresh[i])
            sent[i] +=
                toDouble(set_.materials[set_.patches[senders[i]].material].reflectance) * expected;
        build[i] = row.empty();
        if (build[i]) row.resize(keep ? blocks : 0);
    }
    std::atomic<std::uint64_t> rayCount{0};
    std::atomic<std::size_t> bytes{0};
    parallelFor(blocks, 4, [&](std::size_t first, std::size_t last) {
        RowBuilder builder(rays_);
        std::size_t added = 0;
        for (std::size_t b = first; b < last; ++b) {
            const std::size_t base = b * RowBlock::kSize;
            for (std::size_t i = 0; i < senders.size(); ++i) {
                RowBlock passing;
                Row& row = patchRows_[senders[i]];
                RowBlock& block = row.empty() ? passing : row[b];
                if (build[i]) {
                    builder.patchBlock(
                        set_, senders[i], patchSamples_.data() + senders[i] * kPatchSamples,
                        blockOf(set_.nodes, b), nodeReached_[b], std::uint32_t(base), block);
                    if (!row.empty()) added += block.bytes();
                }
                const glm::dvec3 light = sent[i];
                block.forEach([&](int r, float factor) {
                    nodeIndirect_[base + std::size_t(r)] += double(factor) * light;
                    if (fresh[i]) nodeRowSum_[base + std::size_t(r)] += factor;
                });
            }
        }
        rayCount += builder.rayCount();
        bytes += added;
    });
    for (std::size_t i = 0; i < senders.size(); ++i) {
        shot_[senders[i]] += sent[i];
        knownRows_ += fresh[i];
        rowKnown_[senders[i]] = 1;
    }
    rowBytes_ += bytes;
    statistics_.shots += senders.size();
    statistics_.indirectRays += rayCount;
}

/// Marks the nodes that light can reach: from which a ray meets an element that is lit, or one of a
/// patch that light can reach. The outsides of a room's walls and the insides of its hollow things
/// are many; no light ever gets there, and no row needs an entry for them.
void Solver::findReached() {
    constexpr int kRays = 16;
    const DrawnSurface surface(set_);
    const HemisphereRays rays(kRays);
    std::vector<std::uint32_t> seen(set_.nodes.size() * kRays); // patch that each ray meets
    parallelFor(set_.nodes.size(), 256, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n)
            for (int r = 0; r < kRays; ++r) {
                const Receiver& node = set_.nodes[n];
                const auto hit =
                    surface.nearest(node.position, rays.direction(r, node.normal), 1e30f);
                seen[n * kRays + std::size_t(r)] =
                    hit.met() ? set_.elements[hit.element].patch : Element::kNone;
            }
    });
    statistics_.indirectRays += seen.size();
    std::vector<std::uint8_t> lit(set_.patches.size()), reached(set_.nodes.size());
    for (std::size_t p = 0; p < lit.size(); ++p) lit[p] = largest(patchDirect_[p]) > 0;
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t n = 0; n < reached.size(); ++n)
            for (std::size_t r = n * kRays; !reached[n] && r < (n + 1) * kRays; ++r)
                reached[n] = seen[r] != Element::kNone && lit[seen[r]];
        for (std::size_t p = 0; p < lit.size(); ++p) {
            const Patch& patch = set_.patches[p];
            bool any = reached[patch.centreNode];
            if (patch.hasCornerNodes)
                for (std::uint32_t node : patch.cornerNodes) any |= reached[node];
            if (!any || lit[p]) continue;
            lit[p] = true;
            changed = true;
        }
    }
    nodeReached_.assign(blockCount(reached.size()), 0);
    for (std::size_t n = 0; n < reached.size(); ++n)
        nodeReached_[n / 64] |= std::uint64_t(reached[n]) << n % 64;
}

void Solver::solveIndirect(const Progress& progress) {
    const double start = seconds();
    findReached();
    double first = 0;
    while (!settled() && !spent()) {
        const std::vector<std::uint32_t> senders = chooseSenders();
        if (senders.empty()) break;
        shoot(senders);
        updateResiduals();
        if (!progress || !(statistics_.certificate > 0)) continue;
        first = std::max(first, statistics_.certificate);
        const double span = std::log(first / std::max(target(), 1e-30));
        progress("indirect light",
                 span > 0 ? std::log(first / statistics_.certificate) / span : 1.0);
    }
    statistics_.settled = settled();
    statistics_.indirectSeconds = seconds() - start;
}

/// What is owed goes, on average, once over all surfaces and is reflected on: Cohen et al. 1988.
glm::dvec3 Solver::ambient() const {
    glm::dvec3 owed(0), reflected(0);
    double area = 0;
    for (std::size_t p = 0; p < set_.patches.size(); ++p) {
        const double size = set_.patches[p].area;
        owed += size * residual_[p];
        reflected += size * toDouble(set_.materials[set_.patches[p].material].reflectance);
        area += size;
    }
    if (area == 0) return owed;
    return (owed / area) / (1.0 - glm::min(reflected / area, 0.98));
}

std::vector<glm::dvec3> Solver::nodeIlluminance() const {
    const glm::dvec3 owed = ambient();
    std::vector<glm::dvec3> nodes(nodeIndirect_.size());
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
        const bool reached = !nodeReached_.empty() && (nodeReached_[n / 64] >> n % 64 & 1);
        nodes[n] = nodeIndirect(n) + (reached ? owed : glm::dvec3(0));
    }
    return nodes;
}

Lighting Solver::lighting() const {
    Lighting light;
    light.direct = vertexDirect_;
    light.indirect.resize(set_.vertices.size());
    if (options_.directOnly || set_.patches.empty()) return light;
    const std::vector<glm::dvec3> nodes = nodeIlluminance();
    for (std::size_t v = 0; v < set_.vertices.size(); ++v) {
        const auto [index, s, t] = set_.vertexCoordinates[v];
        if (index == Element::kNone) continue;
        const Patch& patch = set_.patches[index];
        light.indirect[v] = toRgb(interpolateNodes<glm::dvec3>(patch, s, t, nodes));
    }
    return light;
}

std::vector<Rgb> Solver::radiosity() const {
    std::vector<Rgb> radiosity;
    for (std::uint32_t p = 0; p < set_.patches.size(); ++p)
        radiosity.push_back(
            toRgb(toDouble(set_.materials[set_.patches[p].material].reflectance) * received(p)));
    return radiosity;
}

SolveStatistics Solver::statistics() const {
    SolveStatistics result = statistics_;
    const auto count = [&](const Row& row) {
        if (row.empty()) return;
        const RowSize size = sizeOf(row);
        ++result.rows;
        result.entries += size.entries;
        result.bytes += size.bytes;
    };
    for (const Row& row : emitterRows_) count(row);
    for (const Row& row : patchRows_) count(row);
    return result;
}

} // namespace penumbra
