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

constexpr int kProbeRays = 16; ///< that tell the openness
constexpr int kIterations = 12; ///< light goes from gathering vertex to gathering vertex

/// Follows the first `count` rays from `receiver`; returns how many are free up to `reach`.
int follow(const DrawnSurface& surface, const HemisphereRays& rays, const Receiver& receiver, int first,
           int count, float reach, std::uint32_t* hits) {
    int free = 0;
    for (int i = first; i < first + count; ++i) {
        const auto hit = surface.nearest(receiver.position, rays.direction(i, receiver.normal), 1e30f);
        free += !hit.met() || hit.distance > reach;
        if (hits) hits[i] = hit.met() ? hit.element : Element::kNone;
    }
    return free;
}

} // namespace

DetailGather::DetailGather(const PatchSet& patches, const DetailOptions& options)
    : patches_(patches), rays_(std::max(options.rays, kProbeRays)) {
    const DrawnSurface surface(patches);
    const HemisphereRays rays(rays_);
    const float reach = patches.patchSize;
    std::vector<double> nodeOpenness(patches.nodes.size());
    parallelFor(patches.nodes.size(), 256, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n)
            nodeOpenness[n] = double(follow(surface, rays, patches.nodes[n], 0, kProbeRays, reach,
                                            nullptr)) / kProbeRays;
    });

    constexpr std::size_t kGrain = 1024;
    struct Found {
        std::vector<std::uint32_t> vertices, hits;
        std::vector<float> openness;
    };
    std::vector<Found> found((patches.vertices.size() + kGrain - 1) / kGrain);
    std::atomic<std::uint64_t> traced{patches.nodes.size() * kProbeRays};
    parallelFor(patches.vertices.size(), kGrain, [&](std::size_t first, std::size_t last) {
        Found& out = found[first / kGrain];
        std::vector<std::uint32_t> hits(static_cast<std::size_t>(rays_));
        for (std::size_t v = first; v < last; ++v) {
            const auto [patch, s, t] = patches.vertexCoordinates[v];
            if (patch == Element::kNone) continue;
            const Receiver& receiver = patches.vertices[v].receiver;
            const double expected = interpolateNodes<double>(patches.patches[patch], s, t, nodeOpenness);
            const double open =
                double(follow(surface, rays, receiver, 0, kProbeRays, reach, hits.data())) / kProbeRays;
            traced += kProbeRays;
            if (std::abs(open - expected) <= options.tolerance && open >= options.shut) continue;
            follow(surface, rays, receiver, kProbeRays, rays_ - kProbeRays, reach, hits.data());
            traced += std::uint64_t(rays_ - kProbeRays);
            out.vertices.push_back(std::uint32_t(v));
            out.openness.push_back(float(open));
            out.hits.insert(out.hits.end(), hits.begin(), hits.end());
        }
    });
    for (const Found& part : found) {
        vertices_.insert(vertices_.end(), part.vertices.begin(), part.vertices.end());
        openness_.insert(openness_.end(), part.openness.begin(), part.openness.end());
        hits_.insert(hits_.end(), part.hits.begin(), part.hits.end());
    }
    rayCount_ = traced;
}

void DetailGather::apply(Lighting& lighting) const {
    // From below: what near surfaces add comes with the iterations.
    for (std::size_t i = 0; i < vertices_.size(); ++i) lighting.indirect[vertices_[i]] *= openness_[i];
    std::vector<Rgb> sent(patches_.elements.size());
    for (int iteration = 0; iteration < kIterations; ++iteration) {
        parallelFor(sent.size(), 4096, [&](std::size_t first, std::size_t last) {
            for (std::size_t e = first; e < last; ++e)
                sent[e] = patches_.materials[patches_.elements[e].material].reflectance *
                          elementMean(patches_.elements[e], lighting);
        });
        parallelFor(vertices_.size(), 1024, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                glm::dvec3 sum(0);
                for (int r = 0; r < rays_; ++r) {
                    const std::uint32_t e = hits_[i * std::size_t(rays_) + std::size_t(r)];
                    if (e != Element::kNone) sum += glm::dvec3(sent[e].r, sent[e].g, sent[e].b);
                }
                sum /= double(rays_);
                lighting.indirect[vertices_[i]] = Rgb(float(sum.x), float(sum.y), float(sum.z));
            }
        });
    }
}

} // namespace penumbra
