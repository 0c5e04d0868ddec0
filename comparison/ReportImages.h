// Pictures that are part of a page.
#pragma once

#include "base/FrameLayers.h"
#include "comparison/ComparePolicies.h"
#include "importance/Pyramid.h"

#include <cstddef>
#include <span>
#include <string>

namespace penumbra {

/// Bytes as text (RFC 4648).
std::string base64(std::span<const std::byte> bytes);

/// A picture as a PNG within a "data:" address, as the window would show it.
std::string pictureUri(const Picture& picture, const ToneMap& tone);

/// How all pictures are shown that are to be compared with this one.
ToneMap toneFor(const Picture& picture);

/// A map of visible differences in false colours, likewise. The scale is logarithmic: black up to
/// 1/4 JND, blue at 1, orange at 4, white from 16 on.
std::string differenceUri(const Plane& jnd);

/// The scale of those colours as an SVG drawing with ticks.
std::string differenceLegend();

} // namespace penumbra
