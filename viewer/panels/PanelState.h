// What the panels show and change: the walkthrough's state, without OpenGL and without ImGui.
#pragma once

#include "io/image/AutoExposure.h"
#include "io/image/ToneCurve.h"
#include "radiosity/process/RadiosityOptions.h"
#include "radiosity/process/RadiosityState.h"
#include "viewer/gl/DrawStatistics.h"
#include "viewer/input/LeaveQuestion.h"
#include "viewer/input/SceneBrowser.h"
#include "viewer/input/Walkthrough.h"
#include "viewer/overlay/Legend.h"
#include "viewer/overlay/Overlay.h"

#include <array>
#include <cstddef>
#include <deque>
#include <string>

namespace penumbra {

/// The last values of something, for a plot.
class History {
public:
    static constexpr std::size_t kSize = 240;

    void add(float value) {
        values_[next_] = value;
        next_ = (next_ + 1) % kSize;
        count_ += count_ < kSize;
    }
    const std::array<float, kSize>& values() const { return values_; } ///< a ring
    std::size_t oldest() const { return count_ < kSize ? 0 : next_; }
    std::size_t size() const { return count_; }
    float latest() const { return values_[(next_ + kSize - 1) % kSize]; }
    float most() const;

private:
    std::array<float, kSize> values_{};
    std::size_t next_ = 0, count_ = 0;
};

/// A line for people that goes away again.
struct Notice {
    std::string text;
    double until = 0; ///< of PanelState::time [s]
};

/// Everything that panels read and write. What they ask for, the main loop does.
struct PanelState {
    Walkthrough* walk = nullptr; ///< null: still loading
    AutoExposure exposure;
    ToneStyle tone = ToneStyle::agx;
    Overlay overlay = Overlay::none;
    Legend legend; ///< of the overlay
    Trigger trigger = Trigger::continuous;
    PolicyKind policy = PolicyKind::importance;
    RadiosityState light;
    InteractiveStatistics drawn;
    History frameMilliseconds; ///< from frame to frame
    History certificates;      ///< log10 of certificateOfLit()
    float patchSize = 0;       ///< that was asked for [m]; 0: chosen for the scene
    float elementSize = 0;
    std::string sceneName, scenePath, renderer;
    std::vector<std::string> recent;     ///< paths of scenes that were opened, the latest first
    std::optional<SceneBrowser> browser; ///< while another scene is chosen
    LeaveQuestion leave;
    bool showPanels = true, showHelp = false, showOpen = false;
    bool noLights = false; ///< the scene has none: a headlight stands in for them
    bool recording = false, playing = false, hasAnimation = false;
    double time = 0; ///< since the start [s]
    std::deque<Notice> notices;

    // Asked for by a panel, and done by the main loop.
    bool wantsUpdate = false, wantsSave = false, wantsReload = false, wantsRestart = false;
    std::string wantsOpen; ///< a file; empty: none
    std::optional<LeaveQuestion::Answer> leaveAnswer;

    void notify(std::string text, double seconds = 6) {
        notices.push_back({std::move(text), time + seconds});
    }
};

} // namespace penumbra
