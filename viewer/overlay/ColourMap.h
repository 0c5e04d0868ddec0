// Colours for numbers, and for kinds of things, which all eyes can tell apart.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>

namespace penumbra {

/// The colour of a value in [0, 1] (others count as the nearer end), as a display takes it: sRGB,
/// each channel in [0, 1].
///
/// Viridis: equal steps of the value look equally large, and lightness alone tells them apart, so
/// that it serves people who can't tell red from green, and in print [SmithVanDerWalt2015]. Every
/// 32nd entry of its table; between these it is linear.
glm::vec3 viridis(float value);

/// Colours of kinds, as many as kKinds, which people with any kind of colour vision can tell apart
/// [OkabeIto2008]: orange, sky blue, bluish green, yellow, blue, vermilion, reddish purple.
constexpr std::size_t kKinds = 7;
glm::vec3 kindColour(std::size_t kind);

} // namespace penumbra
