// All keys.
#include "viewer/PanelState.h"
#include "viewer/Panels.h"
#include "viewer/Shortcuts.h"

#include <imgui.h>

#include <string>

namespace penumbra {

void drawHelp(PanelState& state) {
    if (!state.showHelp) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({display.x / 2, display.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {display.x * 0.95f, display.y * 0.95f});
    if (ImGui::Begin("Keys", &state.showHelp,
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse |
                         ImGuiWindowFlags_NoMove) &&
        ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
        std::string group;
        for (const HelpLine& line : helpLines()) {
            ImGui::TableNextRow();
            if (group != line.group) {
                group = line.group;
                ImGui::TableNextColumn();
                ImGui::TextDisabled("%s", line.group);
                ImGui::TableNextRow();
            }
            ImGui::TableNextColumn();
            ImGui::Text("%s   ", line.keys);
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(line.text);
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

} // namespace penumbra
