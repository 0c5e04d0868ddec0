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
/// Marks the hit of a surface across a slit.
constexpr std::uint32_t kAcross = 0x80000000u;
constexpr int kSlit = kRays / 4; ///< a vertex with more hits across a slit than this lies in one
/// In a slit light is gathered this far on the way from the vertex to the middle of its elements.
constexpr float kInward = 0.5f;

/// Whether a hit lies across a slit: faces the receiver, nearer than half its element's size. What
/// is drawn there, between vertices much farther apart, says nothing of how light dies off.
bool isAcross(const PatchSet& patches, const DrawnHit& hit, glm::vec3 normal) {
    constexpr float kFacing = -0.7f; // cosine between the normals
    return glm::dot(patches.vertices[hit.vertices[0]].receiver.normal, normal) < kFacing &&
           4 * hit.distance * hit.distance < elementArea(patches, patches.elements[hit.element]);
}

/// Follows rays first ... first + count - 1; returns how many are free up to `reach`.
/// \param slits if given, hits across slits are marked
int follow(const DrawnSurface& surface, const HemisphereRays& rays, const Receiver& receiver,
           int first, int count, float reach, std::uint32_t* hits,
           const PatchSet* slits = nullptr) {
    int free = 0;
    for (int i = first; i < first + count; ++i) {
        const auto hit =
            surface.nearest(receiver.position, rays.direction(i, receiver.normal), 1e30f);
        free += !hit.met() || hit.distance > reach;
        hits[i] = hit.met() ? hit.element : Element::kNone;
        if (slits && hit.met() && isAcross(*slits, hit, receiver.normal)) hits[i] |= kAcross;
    }
    return free;
}

bool isAcross(std::uint32_t hit) {
    return hit != Element::kNone && (hit & kAcross);
}
bool inSlit(const std::uint32_t* hits) {
    return std::count_if(hits, hits + kRays, [](std::uint32_t hit) { return isAcross(hit); }) >
           kSlit;
}

/// Mean direct illuminance of an element's corners [lux].
Rgb directMean(const Element& element, const Lighting& lighting) {
    const std::size_t count = element.isTriangle() ? 3 : 4;
    Rgb sum;
    for (std::size_t k = 0; k < count; ++k) sum += lighting.direct[element.vertices[k]];
    return (1.0f / float(count)) * sum;
}

/// For each vertex the mean of the middles of its elements.
std::vector<glm::vec3> middlesAround(const PatchSet& patches) {
    std::vector<glm::vec3> middles(patches.vertices.size());
    std::vector<float> count(patches.vertices.size());
    for (const Element& element : patches.elements) {
        const std::size_t corners = element.isTriangle() ? 3 : 4;
        glm::vec3 middle(0);
        for (std::size_t k = 0; k < corners; ++k)
            middle += patches.vertices[element.vertices[k]].position / float(corners);
        for (std::size_t k = 0; k < corners; ++k)
            middles[element.vertices[k]] += middle, count[element.vertices[k]] += 1;
    }
    for (std::size_t v = 0; v < middles.size(); ++v)
        if (count[v] > 0) middles[v] /= count[v];
    return middles;
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
    nodeHits_.resize(patches_.nodes.size() * kRays, Element::kNone);
    nodeOpenness_.resize(patches_.nodes.size());
    parallelFor(patches_.nodes.size(), 64, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n)
            if (!isPadding(patches_.nodes[n]))
                nodeOpenness_[n] =
                    double(follow(surface, rays, patches_.nodes[n], 0, kRays, patches_.patchSize,
                                  nodeHits_.data() + n * kRays)) /
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
    const std::vector<glm::vec3> middles = middlesAround(patches_);
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
            int free = follow(surface, rays, receiver, 0, kProbeRays, patches_.patchSize,
                              hits.data(), &patches_);
            traced += kProbeRays;
            const double guess = double(free) / kProbeRays;
            if (std::abs(guess - expected) < 0.07 && guess > 0.5) continue;
            free += follow(surface, rays, receiver, kProbeRays, kRays - kProbeRays,
                           patches_.patchSize, hits.data(), &patches_);
            traced += kRays - kProbeRays;
            const double open = double(free) / kRays;
            double detail = smoothstep(0.02, 0.08, std::abs(open - expected));
            double shut = shutWeight(open);
            if (inSlit(hits.data())) {
                // At its rim a slit is light, but for the least part of an element.
                Receiver inside = receiver;
                inside.position = glm::mix(receiver.position,
                                           middles[v] + patches_.skin * receiver.normal, kInward);
                follow(surface, rays, inside, 0, kRays, patches_.patchSize, hits.data(), &patches_);
                traced += kRays;
                detail = 0, shut = 1;
            }
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

glm::dvec3 DetailGather::gathered(const Sent& sent, const std::uint32_t* hits) const {
    glm::dvec3 sum(0), returned(0);
    const bool slit = inSlit(hits);
    Rgb brightest, second;
    for (int r = 0; r < kRays; ++r) {
        if (hits[r] == Element::kNone) continue;
        const std::uint32_t element = isAcross(hits[r]) ? hits[r] & ~kAcross : hits[r];
        const bool returns = slit && isAcross(hits[r]);
        if (returns) {
            const Rgb rho = patches_.materials[patches_.elements[element].material].reflectance;
            returned += glm::dvec3(rho.r, rho.g, rho.b);
        }
        const Rgb light = returns ? sent.direct[element] : sent.all[element];
        sum += glm::dvec3(light.r, light.g, light.b);
        if (luminance(light) > luminance(brightest))
            second = brightest, brightest = light;
        else if (luminance(light) > luminance(second))
            second = light;
    }
    // A single ray that finds the glowing inside of a lampshade counts like the next: no fireflies.
    const Rgb excess = brightest - second;
    return (sum - glm::dvec3(excess.r, excess.g, excess.b)) / (double(kRays) - returned);
}

void DetailGather::apply(std::span<const glm::dvec3> nodeIndirect, Lighting& lighting) const {
    Sent sent;
    sent.all.resize(patches_.elements.size());
    sent.direct.resize(patches_.elements.size());
    std::vector<glm::dvec3> nodeGathered(nodeIndirect.size()), nodeValue(nodeIndirect.size());
    // From below: what near surfaces add comes with the iterations.
    for (const Gatherer& gatherer : vertices_)
        lighting.indirect[gatherer.vertex] *= 1 - gatherer.shut;
    for (int iteration = 0; iteration < kIterations; ++iteration) {
        parallelFor(sent.all.size(), 4096, [&](std::size_t first, std::size_t last) {
            for (std::size_t e = first; e < last; ++e) {
                const Element& element = patches_.elements[e];
                const Rgb rho = patches_.materials[element.material].reflectance;
                sent.all[e] = rho * elementMean(element, lighting);
                sent.direct[e] = rho * directMean(element, lighting);
            }
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
