#include "radiosity/schedule/KernelEstimate.h"

#include "base/Bits.h"

#include <algorithm>
#include <bit>

namespace penumbra {

namespace {

/// Of answers that are far or face elsewhere: they count where there are no others.
constexpr float kLeastWeight = 1e-6f;

float squared(float x) {
    return x * x;
}

} // namespace

KernelEstimate::KernelEstimate(std::span<const Receiver> receivers) : receivers_(receivers) {
    float sum = 0, count = 0;
    for (std::size_t r = 1; r < receivers.size(); ++r) {
        if (isPadding(receivers[r - 1]) || isPadding(receivers[r])) continue;
        const glm::vec3 step = receivers[r].position - receivers[r - 1].position;
        sum += glm::dot(step, step);
        ++count;
    }
    perReach2_ = sum > 0 ? count / (3 * sum) : 0;
}

float KernelEstimate::at(std::size_t receiver, std::uint64_t asked, std::uint64_t yes) const {
    yes &= asked;
    if (yes == 0) return 0;
    if (yes == asked) return 1;
    const Receiver& middle = receivers_[receiver];
    float sum = 0, all = 0;
    for (const int r : bitsOf(asked)) {
        const Receiver& other = receivers_[std::size_t(r)];
        const glm::vec3 way = other.position - middle.position;
        const float near = std::max(0.0f, 1 - glm::dot(way, way) * perReach2_);
        const float facing = std::max(0.0f, glm::dot(other.normal, middle.normal));
        const float weight = squared(near * facing) + kLeastWeight;
        all += weight;
        if (yes >> r & 1) sum += weight;
    }
    return sum / all;
}

} // namespace penumbra
