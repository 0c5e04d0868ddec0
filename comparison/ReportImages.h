// Pictures that are part of a page.
#pragma once

#include "comparison/ComparePolicies.h"
#include "importance/Pyramid.h"
#include "io/image/PngWriter.h"

#include <cstddef>
#include <span>
#include <string>

namespace penumbra {

/// Bytes as text (RFC 4648).
std::string base64(std::span<const std::byte> bytes);

/// A picture as a PNG within a "data:" address, tone-mapped.
std::string pictureUri(const Picture& picture, const Exposure& exposure);

/// Exposure for all pictures that are to be compared with this one.
Exposure exposureFor(const Picture& picture);

/// A map of visible differences in false colours, likewise. The scale is logarithmic: black up to
/// 1/4 JND, blue at 1, orange at 4, white from 16 on.
std::string differenceUri(const Plane& jnd);

/// The scale of those colours as an SVG drawing with ticks.
std::string differenceLegend();

} // namespace penumbra
