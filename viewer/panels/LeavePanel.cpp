// Before a scene is left: what becomes of its edits.
#include "viewer/panels/PanelState.h"
#include "viewer/panels/Panels.h"

#include <imgui.h>

#include <filesystem>
#include <string>

namespace penumbra {

namespace {

std::string whatComes(const Departure& next) {
    if (next.to == Departure::To::nothing) return "Penumbra is about to end";
    if (next.to == Departure::To::itselfAgain) return "its file is read again";
    return std::filesystem::path(next.file).filename().string() + " takes its place";
}

} // namespace

void drawLeave(PanelState& state) {
    if (!state.leave.next()) return;
    using Answer = LeaveQuestion::Answer;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({display.x / 2, display.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    if (ImGui::Begin("Save the changes?", nullptr,
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse |
                         ImGuiWindowFlags_NoMove)) {
        ImGui::Text("%s was changed, and %s.", state.sceneName.c_str(),
                    whatComes(*state.leave.next()).c_str());
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
