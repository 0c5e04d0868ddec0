// Which luminance of a view becomes middle grey: the one rule for files and for the window.
#pragma once

#include <optional>
#include <span>

namespace penumbra {

/// Middle grey where nothing is lit and so nothing can be measured [nit]: that of a dim room.
inline constexpr float kUnmeasuredGrey = 64;

/// The exposure values that may be set, at ISO 100: from starlight to the surface of a light.
inline constexpr double kLowestExposureValue = -10, kHighestExposureValue = 25;

/// Middle grey [nit] for the metered luminances of a view [nit], see base/ViewMeter.h. It follows
/// their geometric mean and leans to the brighter or the darker end as the view does; the darkest
/// and the brightest 1 % don't count. What is not positive is left out; none if nothing is left.
///
/// Reinhard, "Parameter Estimation for Photographic Tone Reproduction", J. Graphics Tools 7(1),
/// 2002.
std::optional<float> middleGreyOf(std::span<const float> luminances);

/// A photographer's exposure value at ISO 100 (a light meter with K = 12.5): log2(8 middleGrey).
double exposureValueOf(float middleGrey);
/// The other way round [nit].
float middleGreyAt(double exposureValue);

} // namespace penumbra
