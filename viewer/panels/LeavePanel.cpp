// Before another scene is opened: what becomes of the edits of this one.
#include "viewer/panels/PanelState.h"
#include "viewer/panels/Panels.h"

#include <imgui.h>

#include <filesystem>

namespace penumbra {

void drawLeave(PanelState& state) {
    if (state.leave.file().empty()) return;
    using Answer = LeaveQuestion::Answer;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({display.x / 2, display.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    if (ImGui::Begin("Save the changes?", nullptr,
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse |
                         ImGuiWindowFlags_NoMove)) {
        const std::string next = std::filesystem::path(state.leave.file()).filename().string();
        ImGui::Text("%s was changed, and %s takes its place.", state.sceneName.c_str(),
                    next.c_str());
        ImGui::TextUnformatted("The changes can be saved as a scene over it, a file of its own.");
        if (ImGui::Button("Save")) state.leaveAnswer = Answer::save;
        ImGui::SameLine();
        if (ImGui::Button("Discard")) state.leaveAnswer = Answer::discard;
        ImGui::SameLine();
        if (ImGui::Button("Cancel (Esc)")) state.leaveAnswer = Answer::cancel;
    }
    ImGui::End();
}

} // namespace penumbra
