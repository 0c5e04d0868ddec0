// How pictures for people are exposed and toned: options of all commands that show or write some.
#pragma once

#include "io/image/ToneCurve.h"

#include <optional>

namespace CLI {
class App;
}

namespace penumbra {

struct DisplaySettings {
    std::optional<double> exposure; ///< exposure value at ISO 100; none: metered in the view
    std::optional<ToneStyle> tone;  ///< none: the command's default
};

/// Adds --exposure and --tone; `settings` must outlive the parsing.
/// \param toneDefault what is taken without --tone, for the help
void addDisplayOptions(CLI::App& command, DisplaySettings& settings, const char* toneDefault);

} // namespace penumbra
