// What each overlay shows, as colours of blocks with a legend: no OpenGL, no ImGui.
#pragma once

#include "viewer/Legend.h"
#include "viewer/Overlay.h"

#include <span>

namespace penumbra {

class BlockAges;
struct LitObject;

struct OverlayView {
    OverlayPicture picture;
    Legend legend;
};

/// Outlines of patches and elements.
OverlayView meshView();

constexpr LogScale kAgeScale{100, 0.1}; ///< [s]: what is new is bright
/// How long ago the light of each block was published. \param now as for BlockAges::advance() [s]
OverlayView ageView(std::span<const LitObject> objects, const BlockAges& ages, double now);

} // namespace penumbra
