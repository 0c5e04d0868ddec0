// All keys.
#include "viewer/input/Shortcuts.h"
#include "viewer/panels/PanelState.h"
#include "viewer/panels/Panels.h"

#include <imgui.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <string_view>

namespace penumbra {

namespace {

std::size_t endOfGroup(std::span<const HelpLine> lines, std::size_t first) {
    std::size_t end = first;
    while (end < lines.size() && std::string_view(lines[end].group) == lines[first].group) ++end;
    return end;
}

void drawGroup(std::span<const HelpLine> lines, float width) {
    ImGui::BeginGroup();
    ImGui::TextDisabled("%s", lines.front().group);
    if (ImGui::BeginTable(lines.front().group, 2, ImGuiTableFlags_SizingFixedFit, {width, 0})) {
        ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed);
        ImGui::TableSetupColumn("text", ImGuiTableColumnFlags_WidthStretch);
        for (const HelpLine& line : lines) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::Text("%s  ", line.keys);
            ImGui::TableNextColumn();
            ImGui::TextWrapped("%s", line.text);
        }
        ImGui::EndTable();
    }
    ImGui::EndGroup();
}

} // namespace

void drawHelp(PanelState& state) {
    if (!state.showHelp) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float em = ImGui::GetFontSize();
    const float column = std::min(42 * em, (0.95f * display.x - 6 * em) / 2);
    ImGui::SetNextWindowPos({display.x / 2, display.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {display.x * 0.95f, display.y * 0.95f});
    if (ImGui::Begin("Keys", &state.showHelp,
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse |
                         ImGuiWindowFlags_NoMove)) {
        const std::span<const HelpLine> lines = helpLines();
        for (std::size_t first = 0, group = 0; first < lines.size(); ++group) {
            const std::size_t end = endOfGroup(lines, first);
            drawGroup(lines.subspan(first, end - first), column);
            if (group % 2 == 0) ImGui::SameLine(0, 2 * em);
            first = end;
        }
    }
    ImGui::End();
}

} // namespace penumbra
