// How a view is metered for exposure.
#pragma once

#include <span>
#include <vector>

namespace penumbra {

/// A view is metered in kColumns x kRows cells, by kSide x kSide points in each, whatever the size
/// of the picture.
struct MeterGrid {
    static constexpr int kColumns = 64, kRows = 36, kSide = 4;
};

/// Sums over the points of a cell. A point of the background adds nothing.
struct MeterCell {
    float reflected = 0;  ///< luminance of surfaces that reflect only [nit]
    float reflecting = 0; ///< how many points these are
    float emitted = 0;    ///< luminance of surfaces that emit [nit]
    float emitting = 0;   ///< how many points these are
};

/// The mean luminances of the cells [nit], of what counts for exposure: reflected light, so that
/// lights in view do not darken the room. A view of lights alone is metered by these. Cells of the
/// background are left out.
std::vector<float> meteredLuminances(std::span<const MeterCell> cells);

} // namespace penumbra
