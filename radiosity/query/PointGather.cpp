#include "radiosity/query/PointGather.h"

#include "base/PairHash.h"
#include "radiosity/rays/Margins.h"
#include "radiosity/rows/FormFactor.h"
#include "radiosity/rows/SenderSamples.h"

#include <algorithm>
#include <array>

namespace penumbra {

namespace {

constexpr int kShadowSamples = 256;
/// Patches nearer than this many of their radii are gathered element by element.
constexpr float kNear = 6;
constexpr float kCloseBy = 2;  ///< something nearer than this has paths followed, in element sizes
constexpr float kBelieved = 4; ///< drawn light is believed from this far on, in element sizes
constexpr int kProbes = 64;    ///< rays that search for something near
constexpr int kPathBits = 12;  ///< 4096 paths
constexpr int kMostBounces = 64;
constexpr int kSureBounces = 2; ///< before a path may die
constexpr int kPathShadowSamples = 16;

/// Which of the directions a path takes at a bounce: each path another one, each bounce in an order
/// of its own, so that every bounce of all paths together is spread as evenly as the first.
int raySlot(int path, int bounce) {
    if (bounce == 0) return path;
    constexpr std::uint32_t kMask = (1u << kPathBits) - 1;
    auto slot = std::uint32_t(path);
    for (std::uint32_t round = 0; round < 3; ++round) { // each step is one to one
        const std::uint32_t key = pairHash(std::uint32_t(bounce), round);
        slot = (slot * (4 * key + 1) + (key >> 8)) & kMask;
        slot ^= slot >> kPathBits / 2;
    }
    return int(slot);
}

/// Russian roulette [ArvoKirk1990]: a path goes on with a probability, and then counts for more.
bool survives(int path, int bounce, Rgb& weight) {
    if (bounce < kSureBounces) return true;
    const float chance = std::min(1.0f, maxChannel(weight));
    const std::uint32_t draw = pairHash(std::uint32_t(path), 0x9e3779b9u + std::uint32_t(bounce));
    if (!(float(draw >> 8) * 0x1p-24f < chance)) return false;
    weight = (1 / chance) * weight;
    return true;
}

} // namespace

PointGather::PointGather(const PatchSet& patches, const RayScene& rays, const Lighting& lighting)
    : patches_(patches), rays_(rays), lighting_(lighting), surface_(patches), probes_(kProbes),
      paths_(1 << kPathBits), elementRadiosity_(patches.elements.size()),
      patchRadiosity_(patches.patches.size()), patchRadius_(patches.patches.size()),
      patchSamples_(patches.patches.size() * kPatchSamples) {
    for (const Emitter& emitter : patches.emitters)
        if (patches.objects[emitter.object.value].present)
            emitters_.emplace_back(emitter, kShadowSamples, kShadowSamples);
    for (std::uint32_t p = 0; p < patches.patches.size(); ++p) {
        const Patch& patch = patches.patches[p];
        if (!patches.sends(p)) continue;
        if (patch.cluster) {
            const ClusterParts own = partsOf(patches, patch);
            std::ranges::copy(own.samples, patchSamples_.begin() + p * kPatchSamples);
            clusterParts_.emplace(p, own.parts);
        } else {
            samplePatch(patches, patch, patchSamples_.data() + p * kPatchSamples);
        }
        patches.forEachCorner(patch, [&](glm::vec3 corner) {
            patchRadius_[p] = std::max(patchRadius_[p], glm::distance(patch.centre, corner));
        });
        Rgb sum;
        for (std::uint32_t i = 0; i < patch.elementCount; ++i) {
            const std::uint32_t e = patches.patchElements[patch.firstElement + i];
            const Element& element = patches.elements[e];
            const int count = element.isTriangle() ? 3 : 4;
            Rgb mean;
            for (int k = 0; k < count; ++k) {
                const std::uint32_t v = element.vertices[std::size_t(k)];
                mean += (1.0f / float(count)) * (lighting.direct[v] + lighting.indirect[v]);
            }
            elementRadiosity_[e] = elementReflectance(patches, e) * mean;
            sum += elementArea(patches, element) * elementRadiosity_[e];
        }
        patchRadiosity_[p] = (1 / patch.area) * sum;
    }
}

Rgb PointGather::direct(const Receiver& receiver) const {
    return directFrom(receiver, kShadowSamples);
}

Rgb PointGather::directFrom(const Receiver& receiver, int shadowSamples) const {
    Rgb sum;
    for (const EmitterSender& sender : emitters_) {
        const float factor = sender.formFactor(receiver);
        if (!(factor > 0)) continue;
        const float visible = sender.visibility(rays_, receiver, 0, shadowSamples);
        sum += factor * visible * sender.emitter().exitance;
    }
    return sum;
}

float PointGather::patchVisibility(std::uint32_t index, const Receiver& receiver) const {
    const Patch& patch = patches_.patches[index];
    ShadowRays rays;
    std::array<float, 16> weight;
    for (int i = 0; i < 16; ++i) {
        const glm::vec3 target = patchSamples_[index * kPatchSamples + std::size_t(i)];
        const glm::vec3 d = target - receiver.position;
        const float d2 = glm::dot(d, d);
        weight[std::size_t(i)] =
            patch.cluster ? partFormFactor(receiver, clusterParts_.at(index)[std::size_t(i)])
                          : std::max(0.0f, glm::dot(receiver.normal, d)) *
                                std::max(0.0f, -glm::dot(patch.normal, d)) / (d2 * d2);
        if (weight[std::size_t(i)] > 0) rays.set(i, receiver.position, target);
    }
    rays_.occluded(rays);
    float total = 0, seen = 0;
    for (int i = 0; i < 16; ++i) {
        if (!(rays.used >> i & 1)) continue;
        total += weight[std::size_t(i)];
        if (rays.blocker[i] == ObjectId::kNone) seen += weight[std::size_t(i)];
    }
    return total > 0 ? seen / total : 0.0f;
}

/// Form factor of all of a patch, unoccluded.
float PointGather::patchFactor(std::uint32_t index, const Receiver& receiver) const {
    const Patch& patch = patches_.patches[index];
    if (patch.cluster) {
        float sum = 0;
        for (const SenderPart& part : clusterParts_.at(index))
            sum += partFormFactor(receiver, part);
        return sum;
    }
    if (glm::dot(patch.normal, receiver.position - patch.centre) <= 0) return 0;
    const auto outline = std::span(patches_.corners).subspan(patch.firstCorner, patch.cornerCount);
    return polygonFormFactor(receiver.position, receiver.normal, outline);
}

bool PointGather::somethingNear(const Receiver& receiver) const {
    const float near = kCloseBy * patches_.elementSize;
    for (int i = 0; i < probes_.count(); ++i)
        if (surface_.nearest(receiver.position, probes_.direction(i, receiver.normal), near).met())
            return true;
    return false;
}

Rgb PointGather::indirect(const Receiver& receiver) const {
    return somethingNear(receiver) ? indirectByPaths(receiver) : indirectByForm(receiver);
}

/// Follows paths out of the gap: what near surfaces reflect is what they receive there, and so on,
/// until a path meets something far enough for its drawn light to be believed, or dies.
Rgb PointGather::indirectByPaths(const Receiver& receiver) const {
    Rgb sum;
    for (int path = 0; path < paths_.count(); ++path) {
        Receiver at = receiver;
        Rgb weight(1.0f);
        for (int bounce = 0; bounce < kMostBounces; ++bounce) {
            const glm::vec3 direction = paths_.direction(raySlot(path, bounce), at.normal);
            const DrawnHit hit = surface_.nearest(at.position, direction, 1e30f);
            if (!hit.met()) break;
            weight = weight * elementReflectance(patches_, hit.element);
            if (hit.distance >= kBelieved * patches_.elementSize) {
                sum += weight * drawnAt(hit);
                break;
            }
            at = receiverAt(hit, at.position + hit.distance * direction);
            sum += weight * directFrom(at, kPathShadowSamples);
            if (!survives(path, bounce, weight)) break;
        }
    }
    return (1.0f / float(paths_.count())) * sum;
}

Rgb PointGather::drawnAt(const DrawnHit& hit) const {
    Rgb light;
    for (std::size_t k = 0; k < 3; ++k)
        light += hit.weights[k] *
                 (lighting_.direct[hit.vertices[k]] + lighting_.indirect[hit.vertices[k]]);
    return light;
}

Receiver PointGather::receiverAt(const DrawnHit& hit, glm::vec3 position) const {
    glm::vec3 normal(0);
    for (std::size_t k = 0; k < 3; ++k)
        normal += hit.weights[k] * patches_.vertices[hit.vertices[k]].receiver.normal;
    normal = glm::normalize(normal);
    return {position + hoverAt(patches_.skin, position) * normal, normal};
}

Rgb PointGather::indirectByForm(const Receiver& receiver) const {
    Rgb sum;
    for (std::uint32_t p = 0; p < patches_.patches.size(); ++p) {
        const Patch& patch = patches_.patches[p];
        if (maxChannel(patchRadiosity_[p]) <= 0) continue;
        const glm::vec3 away = receiver.position - patch.centre;
        if (glm::dot(receiver.normal, away) >= patchRadius_[p]) continue;
        const bool near = glm::dot(away, away) < kNear * kNear * patchRadius_[p] * patchRadius_[p];
        if (!near) {
            const float factor = patchFactor(p, receiver);
            const float visible = factor > 0 ? patchVisibility(p, receiver) : 0;
            // What is in half shadow itself often has another light where it is seen than
            // elsewhere.
            const bool partly = visible > 0 && visible < 1;
            if (!partly) sum += factor * visible * patchRadiosity_[p];
            if (!partly) continue;
        }
        for (std::uint32_t i = 0; i < patch.elementCount; ++i) {
            const std::uint32_t e = patches_.patchElements[patch.firstElement + i];
            const Element& element = patches_.elements[e];
            const std::size_t count = element.isTriangle() ? 3 : 4;
            std::array<glm::vec3, 4> outline;
            glm::vec3 middle(0);
            for (std::size_t k = 0; k < count; ++k) {
                outline[k] = patches_.vertices[element.vertices[k]].position;
                middle += outline[k] / float(count);
            }
            const float factor = polygonFormFactor(receiver.position, receiver.normal,
                                                   std::span(outline).first(count));
            if (!(factor > 0) || rays_.occluded(receiver.position, middle)) continue;
            sum += factor * elementRadiosity_[e];
        }
    }
    return sum;
}

} // namespace penumbra
