// The difference evaluator FLIP for grey pictures, as another opinion.
#pragma once

#include "importance/Pyramid.h"

namespace penumbra {

/// Perceived difference per pixel in [0, 1], when the viewer alternates between the two pictures.
/// For pictures without colour, of which only the luminance channel is left.
/// \param test, reference display luminance, linear, in [0, 1]
///
/// Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem & Fairchild, "FLIP: a difference
/// evaluator for alternating images", Proc. ACM on Computer Graphics and Interactive Techniques
/// 3(2), 2020.
Plane flip(const Plane& test, const Plane& reference, double pixelsPerDegree);

} // namespace penumbra
