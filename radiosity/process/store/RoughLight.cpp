#include "radiosity/process/store/RoughLight.h"

#include "base/Parallel.h"
#include "radiosity/rows/EmitterSender.h"

#include <algorithm>
#include <cstdint>

namespace penumbra {

namespace {

constexpr std::uint32_t kBlock = PatchSet::kBlock;
constexpr int kSamples = 16;          ///< that an emitter is made ready with
constexpr std::uint32_t kFirst = 0xf; ///< those of them that are traced
constexpr double kMostReflected = 0.98;

float visibility(const EmitterSender& sender, const RayScene& rays, const Receiver& receiver) {
    SampleGroup group;
    sender.sampleGroup(receiver, 0, group);
    if ((group.rays.used & kFirst) != 0) group.rays.used &= kFirst;
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

} // namespace

RoughLight roughLight(const PatchSet& set, const RayScene& rays, std::size_t most) {
    const std::size_t receivers = set.vertices.size();
    if (set.emitters.empty() || receivers * set.emitters.size() > most) return {};
    std::vector<EmitterSender> senders;
    for (const Emitter& emitter : set.emitters) senders.emplace_back(emitter, kSamples, kSamples);
    RoughLight light;
    light.direct.resize(receivers);
    const auto eachVertex = [&](bool blended, auto&& lit) {
        parallelFor(receivers / kBlock, 4, [&](std::size_t first, std::size_t last) {
            for (std::size_t b = first; b < last; ++b) {
                if (set.isBlended(std::uint32_t(b)) != blended) continue;
                for (auto v = std::uint32_t(b * kBlock); v < (b + 1) * kBlock; ++v)
                    if (!isPadding(set.vertices[v].receiver)) light.direct[v] = lit(v);
            }
        });
    };
    eachVertex(false, [&](std::uint32_t v) {
        const Receiver& receiver = set.vertices[v].receiver;
        Rgb sum;
        for (const EmitterSender& sender : senders)
            if (const float factor = sender.formFactor(receiver); factor > 0)
                sum += factor * visibility(sender, rays, receiver) * sender.emitter().exitance;
        return sum;
    });
    eachVertex(true, [&](std::uint32_t v) {
        Rgb sum;
        set.forEachReceiver(v, [&](std::uint32_t receiver, float weight) {
            sum += weight * light.direct[receiver];
        });
        return sum;
    });
    light.ambient = ambientOf(set, light.direct);
    return light;
}

} // namespace penumbra
