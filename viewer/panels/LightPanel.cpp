// Radiosity: when it is updated, how fine it is, how far it is, what it may be wrong by.
#include "viewer/panels/PanelState.h"
#include "viewer/panels/Panels.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace penumbra {

namespace {

constexpr const char* kTriggers[] = {"on grab and release", "on demand (U)", "continuously"};
constexpr const char* kPolicies[] = {"what is seen first", "lamp by lamp", "at random"};

void drawCertificate(const PanelState& state) {
    const RadiosityState& light = state.light;
    if (!(light.meanRadiosity > 0)) return;
    const double share = light.certificate / light.meanRadiosity;
    if (share > 1) // while a scene is young: nothing is bounded yet that anybody could use
        ImGui::TextUnformatted("certificate: above the mean light");
    else
        ImGui::TextWrapped("certificate: %.2g %% of the mean light", 100 * share);
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("What the picture may still be wrong by, of the meshed scene: %.3g lm/m2",
                          light.certificate);
    const History& history = state.certificates;
    if (history.size() > 1)
        ImGui::PlotLines("##certificates", history.values().data(), int(history.size()),
                         int(history.oldest()), "log of the certificate, last minute", -4, 1,
                         {ImGui::GetContentRegionAvail().x, 3.5f * ImGui::GetFontSize()});
}

void drawSizes(PanelState& state) {
    ImGui::SliderFloat("patch", &state.patchSize, 0, 1, state.patchSize > 0 ? "%.2f m" : "chosen");
    ImGui::SliderFloat("element", &state.elementSize, 0, 0.25f,
                       state.elementSize > 0 ? "%.3f m" : "chosen");
    if (ImGui::Button("mesh anew")) state.wantsRestart = true;
    ImGui::SameLine();
    if (ImGui::Button("read the file again (F5)")) state.wantsReload = true;
}

} // namespace

void drawLightPanel(PanelState& state) {
    const RadiosityState& light = state.light;
    int trigger = int(state.trigger);
    if (ImGui::Combo("update", &trigger, kTriggers, int(std::size(kTriggers))))
        state.trigger = Trigger(trigger);
    int policy = int(state.policy);
    if (ImGui::Combo("order", &policy, kPolicies, int(std::size(kPolicies))))
        state.policy = PolicyKind(policy);
    if (light.held > 0) {
        ImGui::Text("%zu edits held back", light.held);
        ImGui::SameLine();
        if (ImGui::SmallButton("update now")) state.wantsUpdate = true;
    }
    if (light.phase == RadiosityState::Phase::solving && !light.task.empty() &&
        light.solution == SolutionState::working && !light.stopped)
        ImGui::ProgressBar(float(light.progress), {-1, 0}, light.task.c_str());
    ImGui::TextWrapped("open work: %zu blocks, %zu edits; light is %.1f s old", light.dirtyBlocks,
                       light.queued, light.age);
    drawCertificate(state);
    drawSizes(state);
}

} // namespace penumbra
