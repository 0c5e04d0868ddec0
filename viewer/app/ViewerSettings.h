// What the walkthrough remembers from one start to the next.
#pragma once

#include "io/image/ToneCurve.h"
#include "radiosity/process/RadiosityOptions.h"

#include <filesystem>
#include <string>
#include <vector>

namespace penumbra {

struct ViewerSettings {
    int width = 1136, height = 639; ///< of the window, at 96 dpi: fits a screen of 1280 x 720
    bool panels = true;
    ToneStyle tone = ToneStyle::agx;
    float compensation = 0;  ///< of exposure [stops]
    double walkSpeed = 1.6;  ///< [m/s]
    double eyeHeight = 1.65; ///< [m]
    double sensitivity = 1;
    bool gravity = true, collision = false;
    Trigger trigger = Trigger::continuous;
    std::vector<std::string> recent; ///< whole paths of scenes, the latest first
    friend bool operator==(const ViewerSettings&, const ViewerSettings&) = default;
};

/// Puts a file first among the recent ones, each of which is there once, kMostRecent at most.
void addRecent(ViewerSettings& settings, const std::filesystem::path& file);
inline constexpr std::size_t kMostRecent = 8;

/// As `name = value` lines.
std::string textOf(const ViewerSettings& settings);
/// Reads such lines; what is unknown, out of range or garbled keeps its default.
ViewerSettings settingsFrom(const std::string& text);

/// $XDG_CONFIG_HOME/penumbra/viewer.conf, or ~/.config/...; empty if there is no home.
/// (XDG Base Directory Specification 0.8)
std::filesystem::path settingsFile();

/// The settings of this user, or the defaults: never an error.
ViewerSettings loadSettings();
/// Whether they could be written.
bool saveSettings(const ViewerSettings& settings);

} // namespace penumbra
