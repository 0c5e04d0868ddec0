#include "radiosity/clusters/CoarseBlock.h"

#include "base/Bits.h"
#include "base/Bounds.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace penumbra {

namespace {

constexpr float kAlike = 0.8f; ///< cosine between normals
constexpr float kNear = 0.25f; ///< of the block's diagonal

} // namespace

CoarseBlock coarseBlock(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                        std::uint64_t valid) {
    assert(positions.size() <= CoarseBlock::kMost && positions.size() == normals.size());
    if (positions.size() < CoarseBlock::kMost) valid &= (std::uint64_t(1) << positions.size()) - 1;
    Bounds box;
    for (const std::size_t p : bitsOf(valid)) box.add(positions[p]);
    const float near = kNear * box.diagonal();
    const auto distance = [&](std::size_t a, std::size_t b) {
        return glm::dot(normals[a], normals[b]) > kAlike ? glm::distance(positions[a], positions[b])
                                                         : std::numeric_limits<float>::infinity();
    };
    CoarseBlock block;
    std::vector<std::size_t> chosen;
    for (const std::size_t p : bitsOf(valid)) {
        if (std::ranges::any_of(chosen, [&](std::size_t c) { return distance(p, c) < near; }))
            continue;
        chosen.push_back(p);
        block.chosen |= std::uint64_t(1) << p;
    }
    for (const std::size_t p : bitsOf(valid)) {
        std::array<std::pair<float, std::size_t>, 2> found;
        found.fill({std::numeric_limits<float>::infinity(), chosen.front()});
        for (const std::size_t c : chosen) {
            found[1] = std::min(found[1], std::pair(distance(p, c), c));
            if (found[1] < found[0]) std::swap(found[0], found[1]);
        }
        block.nearest[p] = std::uint8_t(found[0].second);
        block.secondNear[p] = std::uint8_t(found[1].second);
        const float sum = found[0].first + found[1].first;
        block.share[p] = std::isfinite(sum) && sum > 0 ? found[1].first / sum : 1;
    }
    return block;
}

} // namespace penumbra
