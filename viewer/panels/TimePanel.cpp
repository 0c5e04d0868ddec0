// Frame times and what was drawn.
#include "viewer/panels/PanelState.h"
#include "viewer/panels/Panels.h"

#include <imgui.h>

#include <algorithm>

namespace penumbra {

void drawTimePanel(PanelState& state) {
    const History& frames = state.frameMilliseconds;
    ImGui::Text("%.1f ms a picture, at most %.1f", double(frames.latest()), double(frames.most()));
    ImGui::PlotLines("##frames", frames.values().data(), int(frames.size()), int(frames.oldest()),
                     nullptr, 0, std::max(33.0f, frames.most()),
                     {ImGui::GetContentRegionAvail().x, 3 * ImGui::GetFontSize()});
    ImGui::Text("surfaces: %zu lit, %zu not yet, %zu out of view", state.drawn.lit,
                state.drawn.unlit, state.drawn.culled);
    ImGui::Text("light: %llu updates, %llu pieces, %u restarts",
                static_cast<unsigned long long>(state.light.updates),
                static_cast<unsigned long long>(state.light.blocksTaken), state.light.restarts);
    ImGui::TextWrapped("%s", state.renderer.c_str());
}

} // namespace penumbra
