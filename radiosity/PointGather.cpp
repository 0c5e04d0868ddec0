#include "radiosity/PointGather.h"

#include "radiosity/FormFactor.h"
#include "radiosity/SenderSamples.h"

#include <algorithm>
#include <array>

namespace penumbra {

namespace {

constexpr int kShadowSamples = 256;
/// Patches nearer than this many of their radii are gathered element by element.
constexpr float kNear = 6;
constexpr int kManyRays = 1024, kFewRays = 64; ///< over the hemisphere, first and at what is met
constexpr float kCloseBy = 2;                  ///< "near" when rays gather, in element sizes

} // namespace

PointGather::PointGather(const PatchSet& patches, const RayScene& rays, const Lighting& lighting)
    : patches_(patches), rays_(rays), lighting_(lighting), surface_(patches), manyRays_(kManyRays),
      fewRays_(kFewRays), elementRadiosity_(patches.elements.size()),
      patchRadiosity_(patches.patches.size()), patchRadius_(patches.patches.size()),
      patchSamples_(patches.patches.size() * kPatchSamples) {
    for (const Emitter& emitter : patches.emitters)
        emitters_.emplace_back(emitter, kShadowSamples, kShadowSamples);
    for (std::uint32_t p = 0; p < patches.patches.size(); ++p) {
        const Patch& patch = patches.patches[p];
        samplePatch(patches, patch, patchSamples_.data() + p * kPatchSamples);
        for (std::uint32_t i = 0; i < patch.cornerCount; ++i)
            patchRadius_[p] =
                std::max(patchRadius_[p],
                         glm::distance(patch.centre, patches.corners[patch.firstCorner + i]));
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
            elementRadiosity_[e] = patches.materials[element.material].reflectance * mean;
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
        weight[std::size_t(i)] = std::max(0.0f, glm::dot(receiver.normal, d)) *
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

bool PointGather::somethingNear(const Receiver& receiver) const {
    const float near = kCloseBy * patches_.elementSize;
    for (int i = 0; i < fewRays_.count(); ++i)
        if (surface_.nearest(receiver.position, fewRays_.direction(i, receiver.normal), near).met())
            return true;
    return false;
}

Rgb PointGather::indirect(const Receiver& receiver) const {
    return somethingNear(receiver) ? indirectByRays(receiver, manyRays_, 2)
                                   : indirectByForm(receiver);
}

/// \param depth how many times near surfaces are evaluated anew instead of interpolated
Rgb PointGather::indirectByRays(const Receiver& receiver, const HemisphereRays& rays,
                                int depth) const {
    Rgb sum;
    for (int i = 0; i < rays.count(); ++i) {
        const glm::vec3 direction = rays.direction(i, receiver.normal);
        const DrawnHit hit = surface_.nearest(receiver.position, direction, 1e30f);
        if (!hit.met()) continue;
        const Rgb reflectance =
            patches_.materials[patches_.elements[hit.element].material].reflectance;
        Rgb light;
        if (depth > 0 && hit.distance < 2 * kCloseBy * patches_.elementSize) {
            Receiver there{glm::vec3(0), glm::vec3(0)};
            for (std::size_t k = 0; k < 3; ++k)
                there.normal += hit.weights[k] * patches_.vertices[hit.vertices[k]].receiver.normal;
            there.normal = glm::normalize(there.normal);
            there.position =
                receiver.position + hit.distance * direction + patches_.skin * there.normal;
            light = directFrom(there, 16) + indirectByRays(there, fewRays_, depth - 1);
        } else {
            for (std::size_t k = 0; k < 3; ++k)
                light += hit.weights[k] *
                         (lighting_.direct[hit.vertices[k]] + lighting_.indirect[hit.vertices[k]]);
        }
        sum += reflectance * light;
    }
    return (1.0f / float(rays.count())) * sum;
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
            if (glm::dot(patch.normal, away) <= 0) continue;
            const auto outline =
                std::span(patches_.corners).subspan(patch.firstCorner, patch.cornerCount);
            const float factor = polygonFormFactor(receiver.position, receiver.normal, outline);
            if (factor > 0) sum += factor * patchVisibility(p, receiver) * patchRadiosity_[p];
            continue;
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
