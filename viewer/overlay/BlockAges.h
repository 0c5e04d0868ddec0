// When the light of each block was published last.
#pragma once

#include "scenegraph/LitGeometry.h"

#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

namespace penumbra {

struct LitObject;

/// Follows the light that a RadiosityNode takes in, block by block. What is published again with
/// the same values (factors of previewed lights come that way) is as old as it was.
class BlockAges {
public:
    /// To be called after each update() of the node. \param time that only grows [s]
    void advance(std::span<const LitObject> objects, double time);

    /// When the light of each block was last found to be another one, by the time given to
    /// advance() [s]; empty: the geometry is not known.
    std::span<const double> times(const LitGeometry& geometry) const;
    double newest() const { return newest_; } ///< of all; far in the past if there is none

private:
    struct Entry {
        std::weak_ptr<const LitGeometry> alive;
        std::uint64_t revision = 0;
        std::vector<std::uint64_t> blockRevisions, light; ///< light: a hash of its values
        std::vector<double> times;
    };
    void follow(Entry& entry, const LitGeometry& geometry, double time);

    std::unordered_map<const LitGeometry*, Entry> entries_;
    double newest_ = -1e9;
};

} // namespace penumbra
