// The overlay that was chosen, of the scene and the light as they are.
#pragma once

#include "viewer/app/WalkLight.h"
#include "viewer/input/Walkthrough.h"
#include "viewer/overlay/OverlayViews.h"

namespace penumbra {

/// What is laid over the picture.
/// \param picture of the window [pixel]
/// \param ranked whether the scheduling policy gives the priorities that `importance` shows
/// \param highestPriority see importanceView()
OverlayView overlayView(Overlay overlay, const Walkthrough& walk, const WalkLight& light,
                        glm::ivec2 picture, bool ranked, double& highestPriority);

/// Whether it goes on changing by itself.
bool overlayChanging(Overlay overlay, const Walkthrough& walk, const WalkLight& light);

} // namespace penumbra
