// What a scene is composed of, for programs.
#pragma once

#include "io/usd/layer/UsdDiagnostic.h"

#include <filesystem>
#include <string>
#include <vector>

namespace penumbra {

/// The composition of a scene as JSON, in the form of `pcp.json` of the AOUSD core specification's
/// suite, and what was warned of. Beside the suite's keys each prim has its `Full Prim Stack`: the
/// suite's has a layer once only, where its strongest site is and with the path of its weakest.
struct CompositionJson {
    std::string text;
    std::vector<std::filesystem::path> files; ///< all that were read
    std::vector<Diagnostic> diagnostics;
    std::string fault; ///< why the root layer could not be read; empty if it could
};

CompositionJson compositionJson(const std::filesystem::path& scene, bool allowOutside);

} // namespace penumbra
