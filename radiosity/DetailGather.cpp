#include "radiosity/DetailGather.h"

#include "radiosity/DrawnSurface.h"
#include "radiosity/HemisphereRays.h"
#include "radiosity/Interpolation.h"
#include "radiosity/Parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace penumbra {

namespace {

constexpr int kRays = 64;
constexpr int kProbeRays = 16;  ///< enough to see that a vertex has nothing to gather
constexpr int kIterations = 10; ///< light goes from gathering vertex to gathering vertex

/// Follows rays first ... first + count - 1; returns how many are free up to `reach`.
int follow(const DrawnSurface& surface, const HemisphereRays& rays, const Receiver& receiver,
           int first, int count, float reach, std::uint32_t* hits) {
    int free = 0;
    for (int i = first; i < first + count; ++i) {
        const auto hit =
            surface.nearest(receiver.position, rays.direction(i, receiver.normal), 1e30f);
        free += !hit.met() || hit.distance > reach;
        hits[i] = hit.met() ? hit.element : Element::kNone;
    }
    return free;
}

double smoothstep(double low, double high, double x) {
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

/// How far what rays gather takes the place of what patches say, at a vertex of this openness.
double shutWeight(double openness) {
    return 1 - smoothstep(0.25, 0.45, openness);
}
/// The same at a node: what is wrong there spreads over its patches, so patches are believed later.
double shutNodeWeight(double openness) {
    return 1 - smoothstep(0.4, 0.85, openness);
}

Rgb toRgb(glm::dvec3 v) {
    return {float(v.x), float(v.y), float(v.z)};
}

} // namespace

DetailGather::DetailGather(const PatchSet& patches) : patches_(patches) {
    const DrawnSurface surface(patches);
    const HemisphereRays rays(kRays);
    traceNodes(surface, rays);
    traceVertices(surface, rays);
}

void DetailGather::traceNodes(const DrawnSurface& surface, const HemisphereRays& rays) {
    nodeHits_.resize(patches_.nodes.size() * kRays);
    nodeOpenness_.resize(patches_.nodes.size());
    parallelFor(patches_.nodes.size(), 64, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n)
            nodeOpenness_[n] = double(follow(surface, rays, patches_.nodes[n], 0, kRays,
                                             patches_.patchSize, nodeHits_.data() + n * kRays)) /
                               kRays;
    });
    rayCount_ += nodeHits_.size();
}

void DetailGather::traceVertices(const DrawnSurface& surface, const HemisphereRays& rays) {
    constexpr std::size_t kGrain = 1024;
    struct Found {
        std::vector<Gatherer> vertices;
        std::vector<std::uint32_t> hits;
    };
    std::vector<Found> found((patches_.vertices.size() + kGrain - 1) / kGrain);
    std::atomic<std::uint64_t> traced{0};
    parallelFor(patches_.vertices.size(), kGrain, [&](std::size_t first, std::size_t last) {
        Found& out = found[first / kGrain];
        std::vector<std::uint32_t> hits(kRays);
        for (std::size_t v = first; v < last; ++v) {
            const auto [patch, s, t] = patches_.vertexCoordinates[v];
            if (patch == Element::kNone) continue;
            const Receiver& receiver = patches_.vertices[v].receiver;
            const double expected =
                interpolateNodes<double>(patches_.patches[patch], s, t, nodeOpenness_);
            int free =
                follow(surface, rays, receiver, 0, kProbeRays, patches_.patchSize, hits.data());
            traced += kProbeRays;
            const double guess = double(free) / kProbeRays;
            if (std::abs(guess - expected) < 0.07 && guess > 0.5) continue;
            free += follow(surface, rays, receiver, kProbeRays, kRays - kProbeRays,
                           patches_.patchSize, hits.data());
            traced += kRays - kProbeRays;
            const double open = double(free) / kRays;
            const double detail = smoothstep(0.02, 0.08, std::abs(open - expected));
            const double shut = shutWeight(open);
            if (detail == 0 && shut == 0) continue;
            out.vertices.push_back({std::uint32_t(v), float(detail), float(shut)});
            out.hits.insert(out.hits.end(), hits.begin(), hits.end());
        }
    });
    for (const Found& part : found) {
        vertices_.insert(vertices_.end(), part.vertices.begin(), part.vertices.end());
        vertexHits_.insert(vertexHits_.end(), part.hits.begin(), part.hits.end());
    }
    rayCount_ += traced;
}

glm::dvec3 DetailGather::gathered(std::span<const Rgb> sent, const std::uint32_t* hits) const {
    glm::dvec3 sum(0);
    Rgb brightest, second;
    for (int r = 0; r < kRays; ++r) {
        if (hits[r] == Element::kNone) continue;
        const Rgb light = sent[hits[r]];
        sum += glm::dvec3(light.r, light.g, light.b);
        if (luminance(light) > luminance(brightest))
            second = brightest, brightest = light;
        else if (luminance(light) > luminance(second))
            second = light;
    }
    // A single ray that finds the glowing inside of a lampshade counts like the next: no fireflies.
    const Rgb excess = brightest - second;
    return (sum - glm::dvec3(excess.r, excess.g, excess.b)) / double(kRays);
}

void DetailGather::apply(std::span<const glm::dvec3> nodeIndirect, Lighting& lighting) const {
    std::vector<Rgb> sent(patches_.elements.size());
    std::vector<glm::dvec3> nodeGathered(nodeIndirect.size()), nodeValue(nodeIndirect.size());
    // From below: what near surfaces add comes with the iterations.
    for (const Gatherer& gatherer : vertices_)
        lighting.indirect[gatherer.vertex] *= 1 - gatherer.shut;
    for (int iteration = 0; iteration < kIterations; ++iteration) {
        parallelFor(sent.size(), 4096, [&](std::size_t first, std::size_t last) {
            for (std::size_t e = first; e < last; ++e)
                sent[e] = patches_.materials[patches_.elements[e].material].reflectance *
                          elementMean(patches_.elements[e], lighting);
        });
        parallelFor(nodeIndirect.size(), 1024, [&](std::size_t first, std::size_t last) {
            for (std::size_t n = first; n < last; ++n) {
                nodeGathered[n] = gathered(sent, nodeHits_.data() + n * kRays);
                nodeValue[n] =
                    glm::mix(nodeIndirect[n], nodeGathered[n], shutNodeWeight(nodeOpenness_[n]));
            }
        });
        parallelFor(vertices_.size(), 1024, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                const auto [vertex, detail, shut] = vertices_[i];
                const auto [patch, s, t] = patches_.vertexCoordinates[vertex];
                const Patch& p = patches_.patches[patch];
                const glm::dvec3 own = gathered(sent, vertexHits_.data() + i * kRays);
                const glm::dvec3 known = interpolateNodes<glm::dvec3>(p, s, t, nodeValue);
                const glm::dvec3 expected = interpolateNodes<glm::dvec3>(p, s, t, nodeGathered);
                const glm::dvec3 corrected = known + double(detail) * (own - expected);
                lighting.indirect[vertex] =
                    toRgb(glm::max(glm::mix(corrected, own, double(shut)), 0.0));
            }
        });
    }
}

} // namespace penumbra
