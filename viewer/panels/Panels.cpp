#include "viewer/panels/Panels.h"

#include "viewer/panels/PanelState.h"

#include <imgui.h>

namespace penumbra {

void drawPanels(PanelState& state) {
    if (!state.showPanels) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float em = ImGui::GetFontSize();
    const float width = 21 * em;
    ImGui::SetNextWindowPos({display.x - width - em / 2, em / 2});
    ImGui::SetNextWindowSizeConstraints({width, 0}, {width, display.y - 3.2f * em});
    if (ImGui::Begin("Penumbra", &state.showPanels,
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove |
                         ImGuiWindowFlags_NoFocusOnAppearing)) {
        ImGui::PushItemWidth(10 * em);
        if (ImGui::Button("Open ...")) state.showOpen = true;
        ImGui::SameLine();
        ImGui::TextDisabled("Ctrl+O, or drop a file here");
        if (state.walk && ImGui::CollapsingHeader("Light", ImGuiTreeNodeFlags_DefaultOpen))
            drawLightPanel(state);
        if (ImGui::CollapsingHeader("View")) drawViewPanel(state);
        if (state.walk && ImGui::CollapsingHeader("Selection", ImGuiTreeNodeFlags_DefaultOpen))
            drawSelectionPanel(state);
        if (ImGui::CollapsingHeader("Speed")) drawTimePanel(state);
        ImGui::PopItemWidth();
    }
    ImGui::End();
}

} // namespace penumbra
