#include "io/usd/stage/UsdSampleCheck.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

namespace penumbra {

void UsdSampleCheck::each(const UsdPrim& prim, std::span<const std::string_view> attributes,
                          std::string_view reader, const Read& read) {
    for (const double time : times(prim, attributes, reader)) {
        Diagnostics found;
        read(UsdAttributes(prim, time), found);
        for (const Diagnostic& diagnostic : found.list()) warn(diagnostic, time);
    }
}

void UsdSampleCheck::firsts(const UsdPrim& prim, std::span<const std::string_view> attributes,
                            std::string_view reader, const Read& read) {
    const std::vector<double> all = times(prim, attributes, reader);
    if (all.empty()) return;
    Diagnostics found;
    read(UsdAttributes(prim, loaded_), found);
    for (const double time : all) {
        const std::size_t known = found.list().size();
        read(UsdAttributes(prim, time), found);
        for (std::size_t i = known; i < found.list().size(); ++i) warn(found.list()[i], time);
    }
}

/// Time codes of the stage, sorted.
std::vector<double> UsdSampleCheck::times(const UsdPrim& prim,
                                          std::span<const std::string_view> attributes,
                                          std::string_view reader) {
    std::vector<double> times;
    for (const std::string_view attribute : attributes) {
        const UsdSamples samples = UsdStage::samples(prim, attribute);
        if (!samples.property || !seen_.emplace(samples.property, reader).second) continue;
        const UsdValue* const read = UsdStage::value(prim, attribute, loaded_).stored();
        for (const UsdTimeSample& sample : samples.property->samples) {
            const double time = sample.time * samples.offset.scale + samples.offset.offset;
            if (&sample.value != read && std::isfinite(time)) times.push_back(time);
        }
    }
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

void UsdSampleCheck::warn(const Diagnostic& found, double time) {
    char digits[40];
    const std::string code(digits, std::to_chars(digits, digits + sizeof digits, time).ptr);
    diagnostics_.warn(found.where, "at time code " + code + ": " + found.text, found.count);
}

} // namespace penumbra
