// The panels, one a file. All are called between GuiLayer::begin() and end().
#pragma once

namespace penumbra {

struct PanelState;

/// The column at the right, which holds the four panels below it.
void drawPanels(PanelState& state);

void drawViewPanel(PanelState& state);      ///< camera, exposure, tone curve, saving
void drawLightPanel(PanelState& state);     ///< radiosity: trigger, sizes, progress, certificate
void drawSelectionPanel(PanelState& state); ///< the selected object: lights, paint, why it is dark
void drawTimePanel(PanelState& state);      ///< frame times and what was drawn

/// What is always there: the line at the bottom, and what there is to say.
void drawStatusLine(PanelState& state);
/// What the colours of the overlay mean.
void drawLegend(const PanelState& state);
/// The box around the selected object.
void drawSelectionBox(const PanelState& state);
/// The choice of another scene.
void drawOpen(PanelState& state);
/// What becomes of edits when another scene takes the place of this one.
void drawLeave(PanelState& state);
/// All keys.
void drawHelp(PanelState& state);

} // namespace penumbra
