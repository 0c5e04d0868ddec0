// What the colours of the overlay mean, at the top left.
#include "viewer/overlay/ColourMap.h"
#include "viewer/panels/PanelState.h"
#include "viewer/panels/Panels.h"

#include <imgui.h>

namespace penumbra {

namespace {

ImU32 colourOf(glm::vec3 colour) {
    return ImGui::GetColorU32({colour.r, colour.g, colour.b, 1});
}

/// The colours of viridis(), and below them the numbers.
void drawBar(const Legend& legend) {
    constexpr int kSteps = 64;
    const float em = ImGui::GetFontSize();
    const float width = 18 * em, margin = 2 * em; // half of the longest number
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    for (int i = 0; i < kSteps; ++i) {
        const float left = at.x + margin + width * float(i) / kSteps;
        draw.AddRectFilled({left, at.y}, {left + width / kSteps + 1, at.y + em},
                           colourOf(viridis((float(i) + 0.5f) / kSteps)));
    }
    for (const Legend::Tick& tick : legend.ticks) {
        const float x = at.x + margin + width * tick.at;
        const float half = ImGui::CalcTextSize(tick.label.c_str()).x / 2;
        const ImU32 colour = ImGui::GetColorU32(ImGuiCol_Text);
        draw.AddLine({x, at.y}, {x, at.y + 1.2f * em}, colour);
        draw.AddText({x - half, at.y + 1.3f * em}, colour, tick.label.c_str());
    }
    ImGui::Dummy({width + 2 * margin, 2.4f * em});
}

void drawKind(const Legend::Kind& kind) {
    const float em = ImGui::GetFontSize();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + em, at.y + em}, colourOf(kind.colour));
    ImGui::Dummy({em, em});
    ImGui::SameLine();
    ImGui::TextUnformatted(kind.label.c_str());
}

} // namespace

void drawLegend(const PanelState& state) {
    const Legend& legend = state.legend;
    if (legend.title.empty()) return;
    const float em = ImGui::GetFontSize();
    ImGui::SetNextWindowBgAlpha(0.75f);
    ImGui::SetNextWindowPos({em / 2, em / 2});
    constexpr ImGuiWindowFlags kPlain = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                                        ImGuiWindowFlags_NoFocusOnAppearing |
                                        ImGuiWindowFlags_NoNav | ImGuiWindowFlags_AlwaysAutoResize;
    if (ImGui::Begin("##legend", nullptr, kPlain)) {
        ImGui::TextUnformatted(legend.title.c_str());
        for (const std::string& line : legend.lines) ImGui::TextUnformatted(line.c_str());
        if (!legend.ticks.empty()) drawBar(legend);
        for (const Legend::Kind& kind : legend.kinds) drawKind(kind);
    }
    ImGui::End();
}

} // namespace penumbra
