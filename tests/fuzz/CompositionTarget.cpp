#include "io/usd/crate/UsdFiles.h"
#include "io/usd/scene/UsdScene.h"
#include "io/usd/stage/UsdFlatten.h"
#include "io/usd/stage/UsdReport.h"
#include "io/usd/text/UsdLayerWriter.h"
#include "tests/fuzz/FuzzTargets.h"
#include "tests/io/usd/stage/StageDescription.h"
#include "tests/support/TemporaryFolder.h"

#include <algorithm>
#include <fstream>
#include <vector>

namespace penumbra {

namespace {

constexpr std::size_t kFiles = 4;

UsdComposeLimits smallLimits() {
    UsdComposeLimits limits;
    limits.prims = 500; // what is endless should be so soon
    limits.index.nodes = 1'000;
    limits.index.allNodes = 20'000;
    limits.index.variantSets = 100;
    return limits;
}

void write(const std::filesystem::path& file, std::string_view text) {
    std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
}

/// A scene on disk, written anew for each try, and a file beside it that is nobody's business.
class FuzzedScene {
public:
    FuzzedScene() {
        std::filesystem::create_directory(inside_);
        write(folder_.path() / "outside.usda", "#usda 1.0\ndef Sphere \"a\"\n{\n}\n");
    }

    void writeLayers(std::string_view bytes) const {
        for (std::size_t i = 0; i < kFiles; ++i) {
            const std::size_t end = bytes.find("\n---\n");
            write(inside_ / (std::to_string(i) + ".usda"), bytes.substr(0, end));
            bytes = end == std::string_view::npos ? "" : bytes.substr(end + 5);
        }
    }
    std::filesystem::path root() const { return inside_ / "0.usda"; }
    std::filesystem::path flat() const { return inside_ / "flat.usda"; }

    /// A layer from outside of the scene's folder that has something to say.
    std::string strangerIn(const UsdStage& stage) const {
        for (const UsdPrim& prim : stage.prims())
            for (const UsdOpinion& opinion : prim.opinions)
                if (!opinion.layer->file.starts_with(inside_.string() + "/"))
                    return opinion.layer->file;
        return {};
    }

private:
    TemporaryFolder folder_;
    std::filesystem::path inside_ = folder_.path() / "scene";
};

std::string faultOfLines(const std::vector<Diagnostic>& diagnostics) {
    for (const Diagnostic& d : diagnostics)
        if (d.line().find('\n') != std::string::npos)
            return "a warning has several lines: " + d.line();
    return {};
}

/// The composed scene as one layer must say what the layers together say.
std::string faultOfFlattening(const FuzzedScene& scene, const UsdStage& stage,
                              const UsdFiles& files) {
    const std::string text = usdLayerText(flattenUsdStage(stage, files, scene.flat()));
    write(scene.flat(), text);
    const UsdStage again = UsdStage::open(scene.flat(), smallLimits());
    const std::string before = described(stage), after = described(again);
    if (before == after) return {};
    return "flattened it says something else:\n" + before + "--- flat:\n" + after + "---\n" + text;
}

std::string faultOfComposing(const FuzzedScene& scene, UsdStage& stage, const UsdFiles& files,
                             bool outsideInStack) {
    if (!outsideInStack)
        if (const std::string file = scene.strangerIn(stage); !file.empty())
            return "a file from outside was opened: " + file;
    if (std::string fault = faultOfLines(stage.diagnostics().list()); !fault.empty()) return fault;
    UsdComposition composition(scene.root(), smallLimits(), files);
    reportComposition(composition, [](const UsdPrimReport&) {});
    return {};
}

/// Whether a limit was met: what is composed then depends on where.
bool tooLarge(UsdStage& stage) {
    const auto& list = stage.diagnostics().list();
    return std::any_of(list.begin(), list.end(), [](const Diagnostic& d) {
        return d.text.find("too ") != std::string::npos;
    });
}

std::string faultOfScene(const FuzzedScene& scene, bool outsideInStack) {
    const UsdFiles files(UsdLayerLimits().fileBytes, SceneFolders(scene.root()));
    UsdStage stage = UsdStage::open(scene.root(), smallLimits(), files);
    if (std::string fault = faultOfComposing(scene, stage, files, outsideInStack); !fault.empty())
        return fault;
    if (tooLarge(stage)) return {};
    if (std::string fault = faultOfFlattening(scene, stage, files); !fault.empty()) return fault;
    LoadOptions options;
    options.maxInstanced = 1'000;
    return faultOfLines(loadUsdScene(scene.root(), options).diagnostics);
}

} // namespace

std::string tryComposition(std::string_view bytes) {
    static const FuzzedScene scene; // one folder a process: making one takes longer than a try
    scene.writeLayers(bytes);
    // Sublayers of the root layer may lie anywhere: a recorded session is such a layer.
    const bool outsideInStack = bytes.find("subLayers") != std::string_view::npos &&
                                bytes.find("outside") != std::string_view::npos;
    try {
        return faultOfScene(scene, outsideInStack);
    } catch (const SceneFileError& error) {
        const std::string what = error.what();
        return what.find('\n') == std::string::npos ? "" : "an error has several lines: " + what;
    }
}

} // namespace penumbra
