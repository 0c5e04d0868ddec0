// What an observer sees of the difference between two pictures.
#pragma once

#include "importance/Pyramid.h"

namespace penumbra {

/// How visible the difference of two pictures is at each pixel, in just noticeable differences
/// (JND): at 1 a typical observer, who may look at both as long as they like, sees it half the
/// time.
///
/// The logarithms of both are taken apart into bands of spatial frequency (a Laplacian pyramid,
/// Burt & Adelson 1983). Each band is a picture of local contrast C, compared in units of what the
/// eye can just see at that frequency and luminance. What both pictures show masks a difference on
/// top of it, and differences far above threshold appear more and more alike:
///
///     E_b = |(C_test - C_reference) S(f_b, L)|^p / (1 + k (m S(f_b, L))^q)   m = min(|C_t|, |C_r|)
///     JND = (sum over bands of D_b^4)^(1/4)       D_b = (E_max E_b / (E_max + E_b))^(1/p)
///
/// with S = contrastSensitivity(). This is the still, achromatic part of ColorVideoVDP (Mantiuk et
/// al., ACM TOG 43(4), 2024) with its constants, for an eye that looks straight at every point;
/// light scattered within the eye is left out. Departures: contrast is that of logarithms, so that
/// lights in view drown nothing; and the coarsest band counts like the others, so that a whole
/// picture that is too dark is no less a difference than a part of it.
///
/// \param test, reference luminances [nit], >= 0, of the same size; exchanging them changes nothing
/// \param pixelsPerDegree as the pictures are seen, > 0, see Viewpoint
Plane visibleDifference(const Plane& test, const Plane& reference, double pixelsPerDegree);

/// A map of visible differences in a few figures. Judge by `p99` and `most`: the mean is small when
/// all of a picture is off by what nobody sees, and as small when one shadow is missing.
struct DifferenceSummary {
    double mean = 0;      ///< [JND]
    double cubicMean = 0; ///< cube root of the mean of cubes [JND]
    double p99 = 0;       ///< what all but a hundredth of the pixels are below [JND]
    double most = 0;      ///< [JND]
    double visible = 0;   ///< share of the pixels that are above 1 JND
};
DifferenceSummary summarise(const Plane& jnd);

} // namespace penumbra
