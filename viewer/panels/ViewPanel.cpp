// Camera, exposure, tone curve, saving.
#include "viewer/panels/PanelState.h"
#include "viewer/panels/Panels.h"

#include <imgui.h>

namespace penumbra {

namespace {

void drawExposure(PanelState& state) {
    bool automatic = state.exposure.automatic();
    if (ImGui::Checkbox("automatic exposure", &automatic))
        state.exposure.fix(automatic ? std::nullopt
                                     : std::optional(state.exposure.uncompensated()));
    if (!automatic) {
        float value = float(exposureValueOf(state.exposure.uncompensated()));
        if (ImGui::SliderFloat("exposure value", &value, float(kLowestExposureValue),
                               float(kHighestExposureValue), "%.1f EV"))
            state.exposure.fix(middleGreyAt(double(value)));
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip("As on a camera at ISO 100: one more halves the brightness");
    }
    float stops = state.exposure.compensation();
    if (ImGui::SliderFloat("brighter by", &stops, -6, 6, "%.1f stops"))
        state.exposure.setCompensation(stops);
    int tone = int(state.tone);
    if (ImGui::Combo("tone curve", &tone, kToneStyleNames.data(), int(kToneStyleNames.size())))
        state.tone = ToneStyle(tone);
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("How very bright light is brought within what a screen can show");
}

void drawCamera(Walkthrough& walk) {
    CameraRig& rig = walk.rig();
    int mode = int(rig.mode());
    if (ImGui::Combo("move by", &mode, kCameraModeNames, int(std::size(kCameraModeNames))))
        rig.setMode(CameraMode(mode));
    if (rig.mode() == CameraMode::walk) {
        ImGui::Checkbox("gravity", &rig.options.gravity);
        ImGui::SameLine();
        ImGui::Checkbox("walls stop me", &rig.options.collision);
    }
    const auto slider = [](const char* name, double& value, float least, float most,
                           const char* format) {
        float shown = float(value);
        if (ImGui::SliderFloat(name, &shown, least, most, format, ImGuiSliderFlags_Logarithmic))
            value = double(shown);
    };
    slider("walking speed", rig.options.speed, 0.1f, 20, "%.1f m/s");
    slider("eye height", rig.options.eyeHeight, 0.2f, 5, "%.2f m");
    slider("mouse speed", walk.controls().sensitivity, 0.1f, 5, "%.1f");
    int number = 0;
    for (const Bookmark& bookmark : walk.bookmarks()) {
        ImGui::PushID(++number);
        if (ImGui::Button(bookmark.path.c_str())) rig.flyTo(bookmark);
        ImGui::PopID();
    }
}

} // namespace

void drawViewPanel(PanelState& state) {
    drawExposure(state);
    if (!state.walk) return;
    int overlay = int(state.overlay);
    if (ImGui::Combo("show on top", &overlay, kOverlayNames, int(std::size(kOverlayNames))))
        state.overlay = Overlay(overlay);
    ImGui::Separator();
    drawCamera(*state.walk);
    ImGui::Separator();
    if (ImGui::Button("save picture (F12)")) state.wantsSave = true;
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("PNG: as shown here, without panels. EXR: its light in cd/m2, in layers");
}

} // namespace penumbra
