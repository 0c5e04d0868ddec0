// What each overlay shows, as colours of blocks with a legend: no OpenGL, no ImGui.
#pragma once

#include "radiosity/process/BlockWork.h"
#include "viewer/Legend.h"
#include "viewer/Overlay.h"

#include <span>
#include <vector>

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

/// What RadiosityNode::openWork() says of each object.
using WorkOfObjects = std::span<const std::vector<BlockWork>>;

/// The frontier of the work: which blocks are open, and what for.
OverlayView openWorkView(std::span<const LitObject> objects, WorkOfObjects work);

/// What the open work is worth to the viewer, as the solver ranks it: a heat map over four powers
/// of ten.
/// \param most the largest worth so far, which the scale ends above; raised if there is a larger
///             one, so that colours keep their meaning as work is done
OverlayView importanceView(std::span<const LitObject> objects, WorkOfObjects work, double& most);
/// The same if the work is done in another order: a word about that.
OverlayView noImportanceView();

} // namespace penumbra
