// The smallest luminance step that is seen at a given adaptation.
#pragma once

namespace penumbra {

/// Just noticeable luminance difference of a spot against its surround: the threshold of the rods
/// in the dark, of the cones in the light, as one curve over log10 of the adaptation luminance.
/// The classic unit of the rendering literature. It is a lenient one: against fine gratings the eye
/// is an order of magnitude more sensitive, see ContrastSensitivity.h.
///
/// \param adaptation luminance that the eye is adapted to [nit], > 0
/// \return           [nit], > 0
///
/// Ferwerda, Pattanaik, Shirley & Greenberg, SIGGRAPH 1996; in the piecewise form of Ward Larson,
/// Rushmeier & Piatko, IEEE TVCG 3(4), 1997.  [docs/references.md]
double thresholdVersusIntensity(double adaptation);

} // namespace penumbra
