// The rays by which a receiver sees its surroundings, kept while things move.
#pragma once

#include "base/Bounds.h"
#include "radiosity/mesh/PatchSet.h"
#include "radiosity/rays/RayScene.h"
#include "radiosity/rows/HemisphereRays.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// Follows rays over the hemisphere of a receiver to the sides that are lit, and tells which of
/// them meet something else than before now that objects were moved.
class DetailRays {
public:
    static constexpr int kRays = 64;
    static constexpr int kProbes = 16; ///< the first ones: enough to see that nothing is near
    static constexpr std::uint64_t kAllRays = ~std::uint64_t(0);
    static constexpr std::uint64_t kAllProbes = (std::uint64_t(1) << kProbes) - 1;
    /// Marks the hit of a surface across a slit: one that faces the receiver, nearer than half its
    /// element's size. What is drawn there, between vertices much farther apart, says nothing of
    /// how light dies off.
    static constexpr std::uint32_t kAcross = 0x80000000u;

    /// What the rays of a receiver meet.
    struct Hits {
        /// Elements, some with kAcross; Element::kNone: nothing.
        std::array<std::uint32_t, kRays> elements;
        std::uint64_t near = 0; ///< bit i: ray i meets something up to the reach
        Bounds ways;            ///< around all that the rays cross that were followed [m, world]
    };
    /// Both must outlive this. \param reach of what is near [m]
    DetailRays(const PatchSet& patches, const RayScene& rays, float reach);

    /// Follows some rays. \param which bits, a ray each \param slits whether to mark these
    /// \return number of rays
    int follow(const Receiver& receiver, std::uint64_t which, bool slits, Hits& hits) const;

    /// Objects that were posed anew, hidden or shown.
    struct Moved {
        std::vector<Range> elements;
        std::vector<Bounds> boxes; ///< where they stand now, those that are there [m, world]
    };
    /// Rays that may not meet what they met: they ended on something that moved, or something that
    /// moved may now stand before that on which they end. All others meet the same, bit for bit.
    /// \param which rays that are known
    /// \param reach how far things matter [m]; a ray that meets nothing matters up to here
    std::uint64_t affected(const Receiver& receiver, std::uint64_t which,
                           std::span<const std::uint32_t> hits, const Moved& moved,
                           float reach) const;

private:
    void note(const Receiver& receiver, glm::vec3 direction, const RayHit& hit, int ray, bool slits,
              Hits& hits) const;
    float farthest(glm::vec3 from, std::uint32_t element) const;

    const PatchSet& patches_;
    const RayScene& scene_;
    HemisphereRays rays_;
    float reach_;
};

/// Whether a hit lies across a slit.
inline bool isAcross(std::uint32_t hit) {
    return hit != Element::kNone && (hit & DetailRays::kAcross);
}
/// Whether a receiver with these hits lies in a slit: more than a quarter are across.
bool inSlit(std::span<const std::uint32_t> hits);

} // namespace penumbra
