// The light of previewed lights at vertices, by rays.
#pragma once

#include "viewer/preview/Preview.h"
#include "viewer/preview/PreviewRows.h"
#include "viewer/preview/ShownLight.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace penumbra {

/// Brings the light that vertices carry up to date, as PreviewLighting says, before it is drawn:
/// with visibility by rays (PreviewRows) instead of shadow maps. As the rays are radiosity's own,
/// the fast shadow is the soft one: nobody sees when it becomes exact.
class RayPreview : public Preview {
public:
    /// \param samples as SolverOptions::samples \param patches see PreviewRows
    /// \param seconds that the rays of a frame may take: what has no turn then stays as it was
    /// shown last, or as it is lit without a preview
    RayPreview(int samples, PreviewRows::PatchesOf patches,
               PreviewRows::Indexing indexing = PreviewRows::Indexing::atOnce,
               double seconds = std::numeric_limits<double>::infinity())
        : rows_(samples, std::move(patches), indexing), seconds_(seconds) {}

    bool unfinished() const override { return rows_.unfinished(); }
    PreviewMethod method() const override { return PreviewMethod::rays; }
    void takeBack() override;
    void update(const PreviewLighting& light, const ShownOf& shown, const View* view) override;
    void rest(const PreviewLighting& expected, const ShownOf& shown, const View* view) override;

private:
    /// A block that is reached, and the light that its vertices carry without previewed lights.
    struct Block {
        ShownLight* light = nullptr; ///< null: is not changed
        std::size_t block = 0;
        std::array<Rgb, LitGeometry::kBlock> before{};

        void keep();
        void restore() const;
    };
    /// A surface with blocks that are reached, and its copies without previewed lights.
    struct Surface {
        ShownLight* light = nullptr;
        std::uint32_t object = 0;
        SplitCorners corners;
        std::vector<Rgb> copies; ///< direct light
    };
    using Then = std::array<const PreviewRows::Known*, 3>; ///< by anchor
    Then thenOf(const PreviewLighting& light, std::size_t at, std::size_t source) const;
    template <class Unoccluded>
    static float change(const PreviewLighting& light, const ShownLight& shown, const Then& then,
                        std::size_t source, std::size_t vertex, float now,
                        const Unoccluded& unoccluded);
    void listReached(const PreviewLighting& light, const ShownOf& shown);
    bool bringUpToDate(const PreviewLighting& light, std::size_t reached);
    void bringAllUpToDate(const PreviewLighting& light);
    static void bringCopiesUpToDate(const Surface& surface, const std::vector<Rgb>& over);
    void splitTouched(const Surface& surface, std::span<const PreviewRows::Touched> touched,
                      const PreviewLighting& light);
    void splitAllTouched(const PreviewLighting& light);
    Rgb before(const Surface& surface, const PreviewRows::Touched& corner, std::size_t drawn) const;

    PreviewRows rows_;
    double seconds_;
    std::vector<Block> blocks_; ///< as reached()
    std::vector<Surface> surfaces_;
};

} // namespace penumbra
