#include "viewer/app/PictureCommands.h"

namespace penumbra {

bool performOnPicture(const Command& command, PanelState& state) {
    constexpr float kStop = 1.0f / 3;
    AutoExposure& exposure = state.exposure;
    switch (command.action) {
    case Action::help:
        state.showHelp = !state.showHelp;
        return true;
    case Action::panels:
        state.showPanels = !state.showPanels;
        return true;
    case Action::brighterView:
        exposure.setCompensation(exposure.compensation() + kStop);
        return true;
    case Action::darkerView:
        exposure.setCompensation(exposure.compensation() - kStop);
        return true;
    case Action::autoExposure:
        exposure.fix(exposure.automatic() ? std::optional(exposure.uncompensated()) : std::nullopt);
        return true;
    case Action::nextTone:
        state.tone = ToneStyle((int(state.tone) + 1) % int(kToneStyleNames.size()));
        return true;
    case Action::nextOverlay:
        state.overlay = after(state.overlay, 1);
        return true;
    case Action::previousOverlay:
        state.overlay = after(state.overlay, -1);
        return true;
    case Action::cancel:
        if (state.leave.next()) {
            state.leaveAnswer = LeaveQuestion::Answer::cancel;
            return true;
        }
        return std::exchange(state.showHelp, false) || std::exchange(state.showOpen, false);
    default:
        return false;
    }
}

} // namespace penumbra
