// Camera, exposure, tone curve, saving.
#include "viewer/panels/PanelState.h"
#include "viewer/panels/Panels.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace penumbra {

namespace {

void drawExposure(PanelState& state) {
    bool automatic = state.exposure.automatic();
    if (ImGui::Checkbox("exposure by itself", &automatic))
        state.exposure.fix(automatic ? std::nullopt
                                     : std::optional(state.exposure.uncompensated()));
    if (!automatic) {
        // A photographer's exposure value at ISO 100: 8 middleGrey = 2^EV.
        float value = std::log2(8 * state.exposure.uncompensated());
        if (ImGui::SliderFloat("exposure value", &value, -6, 20, "%.1f EV"))
            state.exposure.fix(std::exp2(value) / 8);
    }
    float stops = state.exposure.compensation();
    if (ImGui::SliderFloat("brighter by", &stops, -6, 6, "%.1f stops"))
        state.exposure.setCompensation(stops);
    int tone = int(state.tone);
    if (ImGui::Combo("tone curve", &tone, kToneStyleNames.data(), int(kToneStyleNames.size())))
        state.tone = ToneStyle(tone);
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
    slider("speed", rig.options.speed, 0.1f, 20, "%.1f m/s");
    slider("eye height", rig.options.eyeHeight, 0.2f, 5, "%.2f m");
    slider("mouse", walk.controls().sensitivity, 0.1f, 5, "%.1f");
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
    if (ImGui::Combo("overlay", &overlay, kOverlayNames, int(std::size(kOverlayNames))))
        state.overlay = Overlay(overlay);
    ImGui::Separator();
    drawCamera(*state.walk);
    ImGui::Separator();
    int size[2] = {state.saveWidth, state.saveHeight};
    if (ImGui::InputInt2("picture [pixel]", size)) {
        state.saveWidth = std::clamp(size[0], 1, 16384);
        state.saveHeight = std::clamp(size[1], 1, 16384);
    }
    if (ImGui::Button("save EXR and PNG (F12)")) state.wantsSave = true;
}

} // namespace penumbra
