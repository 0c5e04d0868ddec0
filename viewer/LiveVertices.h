// The light of live lamps at vertices, by rays.
#pragma once

#include "viewer/LiveLight.h"
#include "viewer/LiveRows.h"
#include "viewer/ShownLight.h"

#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace penumbra {

/// Brings the light that vertices carry up to date, as LiveLight says, before it is drawn: with
/// visibility by rays (LiveRows) in place of shadow maps. As the rays are radiosity's own, the
/// fast shadow is the soft one: there is nothing to be seen of its becoming exact. See
/// bestLiveBy().
class LiveVertices {
public:
    /// \param samples as SolverOptions::samples \param patches see LiveRows
    LiveVertices(int samples, LiveRows::PatchesOf patches) : rows_(samples, std::move(patches)) {}

    using ShownOf = LiveRows::ShownOf;
    /// Once a frame. \param shown what is shown without live lamps \param view see LiveRows
    void update(const LiveLight& light, const ShownOf& shown, const View* view = nullptr);
    /// The same while nothing moves. \param expected see LightBlend::expecting(): is made ready, so
    /// that the first frame of a move need not
    void rest(const LiveLight& expected, const ShownOf& shown, const View* view = nullptr);

    /// What is shown of a geometry; null: what is shown without live lamps.
    const ShownLight* shown(const LitGeometry& geometry) const;

private:
    struct Copy {
        std::uint32_t object = 0;
        std::size_t vertices = 0; ///< with copies that there are already; more are behind them
        ShownLight light;
        std::vector<std::uint64_t> seen;   ///< block revisions of what is copied
        std::vector<std::uint32_t> live;   ///< blocks that differ from that
        std::vector<std::uint8_t> touched; ///< one a block
    };
    void follow(Copy& copy, const ShownLight& from);
    void restore(Copy& copy, const ShownLight& from, std::uint32_t block);
    using Then = std::array<const LiveRows::Factors*, 3>; ///< by anchor
    Then thenOf(const LiveLight& light, std::size_t at, std::size_t lamp) const;
    template <class Unoccluded>
    static float change(const LiveLight& light, const ShownLight& from, const Then& then,
                        std::size_t lamp, std::size_t vertex, float now,
                        const Unoccluded& unoccluded);
    bool bringUpToDate(Copy& copy, const LiveLight& light, const ShownLight& from,
                       std::size_t reached) const;
    void bringAllUpToDate(const LiveLight& light, const ShownOf& shown);
    static void bringCopiesUpToDate(Copy& copy, const ShownLight& from);
    void drawTouched(Copy& copy, std::span<const LiveRows::Touched> touched, const LiveLight& light,
                     const ShownLight& from);
    void drawAllTouched(const LiveLight& light, const ShownOf& shown);

    LiveRows rows_;
    std::unordered_map<const LitGeometry*, Copy> copies_;
    std::uint64_t revision_ = 1; ///< never the same twice
};

} // namespace penumbra
