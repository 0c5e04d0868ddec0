// Radiosity: when it is updated, how fine it is, how far it is, what it may be wrong by.
#include "viewer/panels/LightWords.h"
#include "viewer/panels/PanelState.h"
#include "viewer/panels/Panels.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace penumbra {

namespace {

constexpr const char* kTriggers[] = {"when I grab or let go", "when I press U", "all the time"};
constexpr const char* kPolicies[] = {"what I see", "light by light", "anything"};

/// What the last thing that was drawn means, for those who point at it.
void explain(const char* words) {
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", words);
}

void drawCertificate(const PanelState& state) {
    const RadiosityState& light = state.light;
    if (!(light.litIlluminance > 0)) return;
    ImGui::TextWrapped("%s", errorWords(light).c_str());
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("How far the light of any surface may be from its final value: at most\n"
                          "%.3g lux (the certificate). It shrinks while light is computed.\n"
                          "Half of the lit area has more than %.3g lux.",
                          light.certificate, light.litIlluminance);
    const History& history = state.certificates;
    if (history.size() > 1)
        ImGui::PlotLines("##certificates", history.values().data(), int(history.size()),
                         int(history.oldest()), "what it may be wrong by, last minute", -4, 1,
                         {ImGui::GetContentRegionAvail().x, 3.5f * ImGui::GetFontSize()});
}

void drawSizes(PanelState& state) {
    ImGui::SliderFloat("patch size", &state.patchSize, 0, 1,
                       state.patchSize > 0 ? "%.2f m" : "automatic");
    explain("Surfaces pass light on in patches of this size.\nSmaller: finer and slower.");
    ImGui::SliderFloat("element size", &state.elementSize, 0, 0.25f,
                       state.elementSize > 0 ? "%.3f m" : "automatic");
    explain("Surfaces show light in elements of this size.\nSmaller: sharper shadows, slower.");
    if (ImGui::Button("use these sizes")) state.wantsRestart = true;
    ImGui::SameLine();
    if (ImGui::Button("reload file (F5)")) state.wantsReload = true;
}

} // namespace

void drawLightPanel(PanelState& state) {
    const RadiosityState& light = state.light;
    int trigger = int(state.trigger);
    if (ImGui::Combo("update light", &trigger, kTriggers, int(std::size(kTriggers))))
        state.trigger = Trigger(trigger);
    explain("When the light follows what you change.");
    int policy = int(state.policy);
    if (ImGui::Combo("compute first", &policy, kPolicies, int(std::size(kPolicies))))
        state.policy = PolicyKind(policy);
    explain("The result is the same; what is right first is not.");
    if (light.held > 0) {
        ImGui::Text("%zu change%s", light.held, light.held == 1 ? " waits" : "s wait");
        ImGui::SameLine();
        if (ImGui::SmallButton("update now")) state.wantsUpdate = true;
    }
    using Phase = RadiosityState::Phase;
    const bool working =
        light.phase == Phase::solving && !light.stopped && light.solution == SolutionState::working;
    if ((working || light.phase == Phase::meshing) && !light.task.empty())
        ImGui::ProgressBar(float(light.progress), {-1, 0}, light.task.c_str());
    if (light.dirtyBlocks > 0 || light.queued > 0) {
        ImGui::TextWrapped("still to compute: %zu piece%s, %zu change%s", light.dirtyBlocks,
                           light.dirtyBlocks == 1 ? "" : "s", light.queued,
                           light.queued == 1 ? "" : "s");
        explain("A piece is the direct light of up to 64 points of a surface.");
    }
    if (light.age > 0) ImGui::Text("the light is %.1f s behind", light.age);
    drawCertificate(state);
    drawSizes(state);
}

} // namespace penumbra
