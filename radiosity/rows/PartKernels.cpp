#include "radiosity/rows/PartKernels.h"

#include "radiosity/rows/SenderSamples.h"

#include <cassert>

namespace penumbra {

void PartTable::load(std::span<const SenderPart> parts, Kernel kernel) {
    assert(parts.size() <= kPatchSamples);
    count_ = std::uint32_t(parts.size());
    kernel_ = kernel;
    for (std::size_t k = 0; k < kPatchSamples; ++k) {
        const SenderPart part = k < parts.size() ? parts[k] : SenderPart{}; // the rest face nobody
        x_[k] = part.centre.x, y_[k] = part.centre.y, z_[k] = part.centre.z;
        normalX_[k] = part.normal.x, normalY_[k] = part.normal.y, normalZ_[k] = part.normal.z;
        area_[k] = part.area;
    }
}

PartKernels PartTable::kernels(const Receiver& receiver) const {
    const glm::vec3 p = receiver.position, n = receiver.normal;
    Lanes distance2, cosines;
    int counting = 0;
    for (std::size_t k = 0; k < kPatchSamples; ++k) {
        const float x = x_[k] - p.x, y = y_[k] - p.y, z = z_[k] - p.z;
        const float here = n.x * x + n.y * y + n.z * z;
        const float there = -(normalX_[k] * x + normalY_[k] * y + normalZ_[k] * z);
        distance2[k] = x * x + y * y + z * z;
        cosines[k] = facing(here, there, distance2[k]);
        counting += cosines[k] > 0;
    }
    PartKernels out;
    out.count = count_;
    if (counting == 0) return out; // as most are: receiver or sender faces away
    const auto evaluate = [&](auto factor) {
        for (std::size_t k = 0; k < kPatchSamples; ++k)
            out.part[k] = cosines[k] > 0 ? factor(area_[k], cosines[k], distance2[k]) : 0.0f;
    };
    if (kernel_ == Kernel::disk)
        evaluate([](float area, float cos, float d2) { return diskKernel(area, cos, d2); });
    else
        evaluate([](float area, float cos, float d2) { return area * pointKernel(cos, d2); });
    for (std::uint32_t k = 0; k < count_; ++k) out.total += out.part[k];
    return out;
}

} // namespace penumbra
