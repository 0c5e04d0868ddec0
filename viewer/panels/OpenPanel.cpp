// Another scene: those opened lately, and the folders of the disk.
#include "viewer/panels/PanelState.h"
#include "viewer/panels/Panels.h"

#include <imgui.h>

#include <filesystem>

namespace penumbra {

namespace {

void choose(PanelState& state, std::string file) {
    state.wantsOpen = std::move(file);
    state.showOpen = false;
}

void drawRecent(PanelState& state) {
    if (state.recent.empty()) return;
    ImGui::TextDisabled("opened lately");
    for (std::size_t i = 0; i < state.recent.size(); ++i) {
        const std::string file = state.recent[i]; // choosing changes the list
        ImGui::PushID(int(i));
        if (ImGui::Selectable(file.c_str())) choose(state, file);
        ImGui::PopID();
    }
    ImGui::Separator();
}

void drawFolder(PanelState& state) {
    SceneBrowser& browser = *state.browser;
    std::string wanted; // going there changes the lists
    ImGui::TextWrapped("%s", browser.folder().c_str());
    if (!browser.fault().empty()) ImGui::TextWrapped("%s", browser.fault().c_str());
    const float em = ImGui::GetFontSize();
    if (ImGui::BeginChild("entries", {0, 20 * em}, true)) {
        if (ImGui::Selectable("../")) wanted = "..";
        for (const std::string& folder : browser.folders())
            if (ImGui::Selectable((folder + "/").c_str())) wanted = folder;
        for (const std::string& file : browser.files())
            if (ImGui::Selectable(file.c_str())) choose(state, (browser.folder() / file).string());
        if (browser.files().empty()) ImGui::TextDisabled("no scene or model in this folder");
    }
    ImGui::EndChild();
    if (!wanted.empty()) browser.go(wanted);
}

} // namespace

void drawOpen(PanelState& state) {
    if (!state.showOpen) {
        state.browser.reset(); // what is on the disk may change meanwhile
        return;
    }
    if (!state.browser) state.browser.emplace(std::filesystem::path(state.scenePath).parent_path());
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float em = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({display.x / 2, display.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSizeConstraints({34 * em, 0}, {display.x * 0.95f, display.y * 0.95f});
    if (ImGui::Begin("Open a scene or a model", &state.showOpen,
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse |
                         ImGuiWindowFlags_NoMove)) {
        drawRecent(state);
        drawFolder(state);
    }
    ImGui::End();
}

} // namespace penumbra
