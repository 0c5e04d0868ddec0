#include "tools/DisplayOptions.h"

#include "io/image/Exposure.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <charconv>
#include <cstddef>
#include <string>

namespace penumbra {

namespace {

std::optional<double> exposureOf(const std::string& text) {
    if (text == "auto") return std::nullopt;
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto [at, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || at != end ||
        !(value >= kLowestExposureValue && value <= kHighestExposureValue))
        throw CLI::ValidationError(
            "--exposure", fmt::format("'{}' is neither 'auto' nor an exposure value from {} to {}",
                                      text, kLowestExposureValue, kHighestExposureValue));
    return value;
}

ToneStyle toneOf(const std::string& text) {
    for (std::size_t style = 0; style < kToneStyleNames.size(); ++style)
        if (CLI::detail::to_lower(kToneStyleNames[style]) == CLI::detail::to_lower(text))
            return ToneStyle(style);
    throw CLI::ValidationError("--tone", fmt::format("'{}' is none of agx, aces, srgb", text));
}

} // namespace

void addDisplayOptions(CLI::App& command, DisplaySettings& settings, const char* toneDefault) {
    command
        .add_option_function<std::string>(
            "--exposure",
            [&settings](const std::string& text) { settings.exposure = exposureOf(text); },
            "Exposure value (EV) at ISO 100, as on a camera: 2^EV / 8 cd/m^2 is shown as\n"
            "middle grey, one more halves the brightness (default: auto, metered in the view)")
        ->type_name("EV|auto");
    command
        .add_option_function<std::string>(
            "--tone", [&settings](const std::string& text) { settings.tone = toneOf(text); },
            std::string("Tone curve of what people see: agx, aces or srgb (default: ") +
                toneDefault + ")")
        ->type_name("NAME");
}

} // namespace penumbra
