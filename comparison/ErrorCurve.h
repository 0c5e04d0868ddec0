// How the visible error falls as work goes on.
#pragma once

#include "importance/VisibleDifference.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace penumbra {

/// The picture at one moment after an edit, against the settled one.
struct ErrorSample {
    double work = 0;    ///< done since the edit, see WorkDone [rays]
    double seconds = 0; ///< that this took; without the pictures
    std::uint64_t rays = 0, shots = 0;
    DifferenceSummary error; ///< [JND]
};

/// A quantity that is measured as work or time goes on.
struct CurvePoint {
    double x = 0; ///< rises from point to point
    double y = 0;
};

/// Mean visible error over work, or over time [s].
std::vector<CurvePoint> errorOverWork(std::span<const ErrorSample> samples);
std::vector<CurvePoint> errorOverTime(std::span<const ErrorSample> samples);

/// What the error is at x: that of the last picture before, which is what the viewer sees until the
/// next one; the first point's before that. \param curve not empty
double valueAt(std::span<const CurvePoint> curve, double x);

/// Area under the curve up to `last`, as a share of what it would be if nothing were done:
///
///     area = 1 / (last y(0)) * integral of y from 0 to last
///
/// 0: right at once, 1: no better all the time. 0 also where nothing was wrong at first.
double normalisedArea(std::span<const CurvePoint> curve, double last);

/// The x from which on y stays at or below a share of what it was at first; nothing if it never
/// does.
std::optional<double> whenBelow(std::span<const CurvePoint> curve, double share);

/// Mean of several curves at every x where one of them changes.
std::vector<CurvePoint> meanOf(std::span<const std::vector<CurvePoint>> curves);

} // namespace penumbra
