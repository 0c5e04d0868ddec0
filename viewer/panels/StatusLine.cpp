// What is always there: how far the light is, and what there is to say.
#include "viewer/panels/LightWords.h"
#include "viewer/panels/PanelState.h"
#include "viewer/panels/Panels.h"

#include <imgui.h>

#include <cmath>
#include <string>
#include <vector>

namespace penumbra {

namespace {

constexpr ImGuiWindowFlags kPlain = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                                    ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;

struct Words {
    std::string text;
    ImVec4 colour;
};

std::vector<Words> statusWords(const PanelState& state) {
    const ImVec4& plain = ImGui::GetStyleColorVec4(ImGuiCol_Text);
    const ImVec4& faint = ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled);
    std::vector<Words> all;
    all.push_back({!state.walk      ? "reading " + state.sceneName
                   : state.noLights ? "no light here: shown by a headlight"
                                    : lightWords(state.light),
                   plain});
    if (state.walk) all.push_back({kCameraModeNames[int(state.walk->rig().mode())], faint});
    if (state.recording) all.push_back({"recording", {0.9f, 0.3f, 0.25f, 1}});
    if (state.playing) all.push_back({"playing (P)", plain});
    all.push_back({"? keys   N panels", faint});
    return all;
}

} // namespace

void drawStatusLine(PanelState& state) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float em = ImGui::GetFontSize(), gap = 2 * em;
    const ImGuiStyle& style = ImGui::GetStyle();
    // As wide as its words are now: what resizes itself is a picture late.
    float width = 2 * style.WindowPadding.x - gap;
    const std::vector<Words> all = statusWords(state);
    for (const Words& words : all) width += gap + ImGui::CalcTextSize(words.text.c_str()).x;
    ImGui::SetNextWindowSize({std::ceil(width), em + 2 * style.WindowPadding.y});
    ImGui::SetNextWindowBgAlpha(0.55f);
    ImGui::SetNextWindowPos({em / 2, display.y - em / 2}, ImGuiCond_Always, {0, 1});
    if (ImGui::Begin("##status", nullptr, kPlain))
        for (const Words& words : all) {
            if (&words != &all.front()) ImGui::SameLine(0, gap);
            ImGui::TextColored(words.colour, "%s", words.text.c_str());
        }
    ImGui::End();

    while (!state.notices.empty() && state.notices.front().until < state.time)
        state.notices.pop_front();
    if (state.notices.empty()) return;
    ImGui::SetNextWindowBgAlpha(0.75f);
    ImGui::SetNextWindowPos({em / 2, display.y - 3 * em}, ImGuiCond_Always, {0, 1});
    if (ImGui::Begin("##notices", nullptr, kPlain | ImGuiWindowFlags_AlwaysAutoResize))
        for (const Notice& notice : state.notices) ImGui::TextUnformatted(notice.text.c_str());
    ImGui::End();
}

void drawSelectionBox(const PanelState& state) {
    if (!state.walk || !state.walk->selection()) return;
    const Walkthrough& walk = *state.walk;
    if (!walk.selection()->node) return; // the room itself
    const Bounds box = walk.rays().bounds(walk.selection()->object);
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const View view = walk.rig().view(int(display.x), int(display.y));
    const glm::dmat4 toClip = view.worldToClip();
    const auto corner = [&](int i) {
        const glm::vec3 p(i & 1 ? box.upper.x : box.lower.x, i & 2 ? box.upper.y : box.lower.y,
                          i & 4 ? box.upper.z : box.lower.z);
        return toClip * glm::dvec4(p, 1);
    };
    ImDrawList& lines = *ImGui::GetBackgroundDrawList();
    const ImU32 colour = ImGui::GetColorU32({0.95f, 0.65f, 0.25f, 0.8f});
    for (int i = 0; i < 8; ++i)
        for (const int bit : {1, 2, 4}) {
            if (i & bit) continue;
            const glm::dvec4 a = corner(i), b = corner(i | bit);
            if (a.w <= 0.01 || b.w <= 0.01) continue; // behind the eye
            const auto place = [&](const glm::dvec4& p) {
                return ImVec2(float((0.5 + 0.5 * p.x / p.w) * double(display.x)),
                              float((0.5 - 0.5 * p.y / p.w) * double(display.y)));
            };
            lines.AddLine(place(a), place(b), colour, ImGui::GetFontSize() / 12);
        }
}

} // namespace penumbra
