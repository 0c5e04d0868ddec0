#include "radiosity/process/store/RoughLight.h"

#include "base/Bits.h"
#include "base/Parallel.h"
#include "radiosity/clusters/CoarseBlock.h"
#include "radiosity/rows/EmitterSender.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <numeric>
#include <span>

namespace penumbra {

namespace {

constexpr std::uint32_t kBlock = PatchSet::kBlock;
constexpr int kSamples = 16;          ///< that an emitter is made ready with
constexpr std::uint32_t kFirst = 0xf; ///< those of them that are traced where all receivers are
constexpr double kMostReflected = 0.98;

float visibility(const EmitterSender& sender, const RayScene& rays, const Receiver& receiver,
                 std::uint32_t samples) {
    SampleGroup group;
    sender.sampleGroup(receiver, 0, group);
    if ((group.rays.used & samples) != 0) group.rays.used &= samples;
    rays.occluded(group.rays);
    float total = 0, seen = 0;
    group.add(total, seen);
    return total > 0 ? seen / total : 0.0f;
}

/// Mean over the corners of an element.
glm::dvec3 meanAt(const Element& element, const std::vector<Rgb>& light) {
    const std::size_t corners = element.isTriangle() ? 3 : 4;
    glm::dvec3 sum(0);
    for (std::size_t k = 0; k < corners; ++k) {
        const Rgb& at = light[element.vertices[k]];
        sum += glm::dvec3(at.r, at.g, at.b);
    }
    return sum / double(corners);
}

Rgb ambientOf(const PatchSet& set, const std::vector<Rgb>& direct) {
    glm::dvec3 sent(0), reflected(0);
    double area = 0;
    for (std::uint32_t p = 0; p < set.patches.size(); ++p) {
        if (!set.sends(p)) continue;
        const Rgb colour = patchReflectance(set, p);
        const glm::dvec3 reflectance(colour.r, colour.g, colour.b);
        const Patch& patch = set.patches[p];
        for (std::uint32_t i = 0; i < patch.elementCount; ++i) {
            const std::uint32_t e = set.patchElements[patch.firstElement + i];
            if (!set.receives(e)) continue;
            const double size = elementArea(set, set.elements[e]);
            sent += size * reflectance * meanAt(set.elements[e], direct);
            reflected += size * reflectance;
            area += size;
        }
    }
    if (!(area > 0)) return {};
    const glm::dvec3 ambient =
        (sent / area) / (1.0 - glm::min(reflected / area, glm::dvec3(kMostReflected)));
    return {float(ambient.r), float(ambient.g), float(ambient.b)};
}

/// Receivers of a block, and those of them that are traced.
struct TracedBlock {
    std::uint64_t receivers = 0, traced = 0; ///< a bit each
    CoarseBlock coarse;                      ///< where not all are traced
};

std::vector<TracedBlock> blocksOf(const PatchSet& set, bool all) {
    std::vector<TracedBlock> blocks(set.vertices.size() / kBlock);
    parallelFor(blocks.size(), 16, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            if (set.isBlended(std::uint32_t(b))) continue;
            std::array<glm::vec3, kBlock> positions{}, normals{};
            for (std::size_t i = 0; i < kBlock; ++i) {
                const Receiver& receiver = set.vertices[b * kBlock + i].receiver;
                if (isPadding(receiver)) continue;
                positions[i] = receiver.position;
                normals[i] = receiver.normal;
                blocks[b].receivers |= std::uint64_t(1) << i;
            }
            blocks[b].traced = blocks[b].receivers;
            if (all || b * kBlock >= set.firstPrivate) continue; // those lie here and there
            blocks[b].coarse = coarseBlock(positions, normals, blocks[b].receivers);
            blocks[b].traced = blocks[b].coarse.chosen;
        }
    });
    return blocks;
}

std::size_t tracedIn(const std::vector<TracedBlock>& blocks) {
    return std::accumulate(blocks.begin(), blocks.end(), std::size_t(0),
                           [](std::size_t sum, const TracedBlock& block) {
                               return sum + std::size_t(std::popcount(block.traced));
                           });
}

/// Vertices that take their light from receivers beside them.
void blend(const PatchSet& set, std::vector<Rgb>& light) {
    parallelFor(set.vertices.size() / kBlock, 4, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            if (!set.isBlended(std::uint32_t(b))) continue;
            for (auto v = std::uint32_t(b * kBlock); v < (b + 1) * kBlock; ++v)
                if (!isPadding(set.vertices[v].receiver))
                    set.forEachReceiver(v, [&](std::uint32_t receiver, float weight) {
                        light[v] += weight * light[receiver];
                    });
        }
    });
}

} // namespace

RoughLight roughLight(const PatchSet& set, const RayScene& rays, std::size_t most) {
    const std::size_t emitters = set.emitters.size();
    if (emitters == 0) return {};
    std::vector<TracedBlock> blocks = blocksOf(set, true);
    std::uint32_t samples = kFirst;
    if (tracedIn(blocks) * emitters > most) {
        blocks = blocksOf(set, false);
        samples = ~0u; // the noise of one would be seen over all that is guessed from it
    }
    if (tracedIn(blocks) * emitters > most) return {};
    std::vector<EmitterSender> senders;
    for (const Emitter& emitter : set.emitters) senders.emplace_back(emitter, kSamples, kSamples);
    const auto lit = [&](const Receiver& receiver) {
        Rgb sum;
        for (const EmitterSender& sender : senders)
            if (const float factor = sender.formFactor(receiver); factor > 0)
                sum += factor * visibility(sender, rays, receiver, samples) *
                       sender.emitter().exitance;
        return sum;
    };
    RoughLight light;
    light.direct.resize(set.vertices.size());
    parallelFor(blocks.size(), 4, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            const auto& [receivers, traced, coarse] = blocks[b];
            const auto of = std::span(light.direct).subspan(b * kBlock, kBlock);
            for (const std::size_t i : bitsOf(traced))
                of[i] = lit(set.vertices[b * kBlock + i].receiver);
            for (const std::size_t i : bitsOf(receivers & ~traced)) of[i] = coarse.guess(of, i);
        }
    });
    blend(set, light.direct);
    light.ambient = ambientOf(set, light.direct);
    return light;
}

} // namespace penumbra
