// The light of previewed lights at vertices, by rays.
#pragma once

#include "viewer/preview/PreviewLighting.h"
#include "viewer/preview/PreviewRows.h"
#include "viewer/preview/ShownLight.h"

#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace penumbra {

/// Brings the light that vertices carry up to date, as PreviewLighting says, before it is drawn:
/// with visibility by rays (PreviewRows) instead of shadow maps. As the rays are radiosity's own,
/// the fast shadow is the soft one: nobody sees when it becomes exact. See
/// bestPreviewMethod().
class RayPreview {
public:
    /// \param samples as SolverOptions::samples \param patches see PreviewRows
    RayPreview(int samples, PreviewRows::PatchesOf patches) : rows_(samples, std::move(patches)) {}

    using ShownOf = PreviewRows::ShownOf;
    /// Once a frame. \param shown what is shown without previewed lights \param view see
    /// PreviewRows
    void update(const PreviewLighting& light, const ShownOf& shown, const View* view = nullptr);
    /// The same while nothing moves. \param expected see LightBlend::expecting(): is made ready, so
    /// that the first frame of a move need not
    void rest(const PreviewLighting& expected, const ShownOf& shown, const View* view = nullptr);

    /// What is shown of a geometry; null: what is shown without previewed lights.
    const ShownLight* shown(const LitGeometry& geometry) const;

private:
    struct Copy {
        std::uint32_t object = 0;
        std::size_t vertices = 0; ///< with copies that there are already; more are behind them
        ShownLight light;
        std::vector<std::uint64_t> seen;    ///< block revisions of what is copied
        std::vector<std::uint32_t> preview; ///< blocks that differ from that
        std::vector<std::uint8_t> touched;  ///< one a block
    };
    void follow(Copy& copy, const ShownLight& from);
    void restore(Copy& copy, const ShownLight& from, std::uint32_t block);
    using Then = std::array<const PreviewRows::Factors*, 3>; ///< by anchor
    Then thenOf(const PreviewLighting& light, std::size_t at, std::size_t source) const;
    template <class Unoccluded>
    static float change(const PreviewLighting& light, const ShownLight& from, const Then& then,
                        std::size_t source, std::size_t vertex, float now,
                        const Unoccluded& unoccluded);
    bool bringUpToDate(Copy& copy, const PreviewLighting& light, const ShownLight& from,
                       std::size_t reached) const;
    void bringAllUpToDate(const PreviewLighting& light, const ShownOf& shown);
    static void bringCopiesUpToDate(Copy& copy, const ShownLight& from);
    void drawTouched(Copy& copy, std::span<const PreviewRows::Touched> touched,
                     const PreviewLighting& light, const ShownLight& from);
    void drawAllTouched(const PreviewLighting& light, const ShownOf& shown);

    PreviewRows rows_;
    std::unordered_map<const LitGeometry*, Copy> copies_;
    std::uint64_t revision_ = 1; ///< never the same twice
};

} // namespace penumbra
