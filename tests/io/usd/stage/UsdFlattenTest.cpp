// The composed scene as one layer says what the composed scene says.
#include "io/usd/stage/UsdFlatten.h"

#include "io/usd/crate/UsdFiles.h"
#include "io/usd/text/UsdLayerWriter.h"
#include "tests/io/usd/RandomLayers.h"
#include "tests/io/usd/stage/StageDescription.h"

#include <gmock/gmock.h>

namespace penumbra {

namespace {

using testing::HasSubstr;
using testing::Not;

/// Writes the stage as one layer, which is opened on its own. \return what both say
std::pair<std::string, std::string> bothWays(const std::filesystem::path& root,
                                             const UsdComposeLimits& limits = {}) {
    const TemporaryFolder folder;
    const UsdFiles files;
    const UsdStage stage = UsdStage::open(root, limits, files);
    const UsdLayer layer = flattenUsdStage(stage, files, folder.path() / "flat.usda");
    const auto flat = folder.write("flat.usda", usdLayerText(layer));
    UsdStage again = UsdStage::open(flat);
    EXPECT_EQ(again.files().size(), 1u);
    for (const Diagnostic& d : again.diagnostics().take()) ADD_FAILURE() << d.line();
    return {described(stage), described(again)};
}

} // namespace

TEST(UsdFlatten, EveryArcIsWorkedIn) {
    const TemporaryFolder folder;
    folder.write(
        "part.usda",
        "#usda 1.0\n(defaultPrim = \"p\")\nclass \"c\"\n{\n float k = 4\n}\n"
        "def Xform \"p\" (inherits = </c>\n variants = { string v = \"b\" }\n"
        " variantSets = \"v\")\n{\n float x.timeSamples = { 0: 1, 10: 2 }\n float x = 7\n"
        " rel r = </p/child>\n asset file = @./pictures/a.png@\n def \"child\" (\n"
        " apiSchemas = [\"A\"])\n {\n }\n variantSet \"v\" = {\n \"a\" {\n float w = 1\n }\n"
        " \"b\" {\n float w = 2\n def \"more\"\n {\n }\n }\n }\n}\n");
    const auto root = folder.write("scene/root.usda",
                                   "#usda 1.0\n(upAxis = \"Z\"\n metersPerUnit = 1)\ndef \"a\" (\n"
                                   " references = @../part.usda@ (offset = 5; scale = 2)\n"
                                   " instanceable = true\n)\n{\n float y = 3\n}\n");
    const auto [composed, flat] = bothWays(root);
    EXPECT_EQ(flat, composed);
    EXPECT_THAT(flat, HasSubstr("/a/more"));
    EXPECT_THAT(flat, HasSubstr("</a/child>"));
    const UsdFiles files;
    const UsdStage stage = UsdStage::open(root, {}, files);
    const std::string text = usdLayerText(flattenUsdStage(stage, files, folder.path() / "f.usda"));
    EXPECT_THAT(text, HasSubstr("@./pictures/a.png@")); // as seen from f.usda
    EXPECT_THAT(text, HasSubstr("25: 2"));              // 2 * 10 + 5
    EXPECT_THAT(text, HasSubstr("upAxis = \"Z\""));
    for (const char* gone : {"references", "inherits", "variantSet", "variants", "instanceable"})
        EXPECT_THAT(text, Not(HasSubstr(gone)));
}

TEST(UsdFlatten, AStrongerDefaultHidesSamplesAndABlockHidesBoth) {
    const TemporaryFolder folder;
    folder.write("weak.usda",
                 "#usda 1.0\ndef \"a\"\n{\n float x.timeSamples = { 0: 1, 5: 2 }\n"
                 " float y.timeSamples = { 0: 1, 5: 2 }\n float z = 3\n float u = 4\n}\n");
    const auto root = folder.write(
        "root.usda", "#usda 1.0\n(subLayers = [@weak.usda@])\nover \"a\"\n{\n float x = 9\n"
                     " float y = None\n float z.timeSamples = { 0: 5, 5: None }\n}\n");
    const auto [composed, flat] = bothWays(root);
    EXPECT_EQ(flat, composed);
}

TEST(UsdFlatten, ScenesOfAllArcsAtRandomStayTheSame) {
    UsdComposeLimits limits; // small, for these scenes grow beyond any
    limits.prims = 60;
    limits.index.nodes = 200;
    for (unsigned seed = 0; seed < 40; ++seed) {
        SCOPED_TRACE(seed);
        const TemporaryFolder folder;
        writeRandomLayers(folder, seed);
        const auto [composed, flat] = bothWays(folder.path() / "0.usda", limits);
        EXPECT_EQ(flat, composed);
    }
}

TEST(UsdFlatten, EverySceneOfTheWorkingGroupStaysTheSame) {
    const auto shared = sharedFolder();
    if (!shared) GTEST_SKIP() << "../shared/assets is not there";
    std::size_t scenes = 0;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(*shared / "assets/usd-wg")) {
        if (!entry.path().extension().string().starts_with(".usd")) continue;
        SCOPED_TRACE(entry.path());
        try {
            const auto [composed, flat] = bothWays(entry.path());
            EXPECT_EQ(flat, composed);
            ++scenes;
        } catch (const SceneFileError&) { // refused, which other tests look into
        }
    }
    EXPECT_GT(scenes, 50u);
}

} // namespace penumbra
