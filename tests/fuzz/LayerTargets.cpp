#include "io/usd/crate/CrateLayer.h"
#include "io/usd/text/UsdLayerWriter.h"
#include "tests/fuzz/FuzzTargets.h"
#include "tests/io/usd/crate/LayerDifference.h"

#include <span>

namespace penumbra {

namespace {

/// What is wrong with how a file was refused.
std::string faultOf(const SceneFileError& error, std::string_view file) {
    const std::string what = error.what();
    if (!what.starts_with(file)) return "an error does not begin with its file: " + what;
    if (what.find('\n') != std::string::npos) return "an error has several lines: " + what;
    return {};
}

/// The text of a layer must read back as the same.
std::string faultOfWriting(const UsdLayer& layer) {
    const std::string text = usdLayerText(layer);
    try {
        const std::string difference = differenceOf(layer, parseUsdLayer(text, "written.usda"));
        return difference.empty() ? difference : "read back: " + difference + "\n" + text;
    } catch (const SceneFileError& error) {
        return std::string("what was written is refused: ") + error.what() + "\n" + text;
    }
}

} // namespace

std::string tryText(std::string_view bytes) {
    try {
        return faultOfWriting(parseUsdLayer(std::string(bytes), "f.usda"));
    } catch (const SceneFileError& error) {
        return faultOf(error, "f.usda");
    }
}

std::string tryCrate(std::string_view bytes) {
    try {
        return faultOfWriting(readCrateLayer(std::as_bytes(std::span(bytes)), "f.usdc"));
    } catch (const SceneFileError& error) {
        return faultOf(error, "f.usdc");
    }
}

} // namespace penumbra
