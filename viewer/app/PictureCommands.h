// Commands about how the picture is shown, and nothing else.
#pragma once

#include "viewer/input/Shortcuts.h"
#include "viewer/panels/PanelState.h"

namespace penumbra {

/// Exposure, tone, overlays, which panels are open. \return whether the command was one of these
bool performOnPicture(const Command& command, PanelState& state);

} // namespace penumbra
