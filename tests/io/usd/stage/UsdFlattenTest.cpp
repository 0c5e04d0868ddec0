// The composed scene as one layer says what the composed scene says.
#include "io/usd/stage/UsdFlatten.h"

#include "io/usd/crate/UsdFiles.h"
#include "io/usd/text/UsdLayerWriter.h"
#include "io/usd/text/UsdValueText.h"
#include "tests/io/usd/RandomLayers.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <set>

namespace penumbra {

namespace {

using testing::HasSubstr;
using testing::Not;

/// Numbers to nine digits: a time that was scaled is the same but for rounding.
std::string described(const UsdValue& value) {
    const std::vector<double> numbers = value.numbers();
    if (numbers.empty()) return usdText(value);
    std::string text = value.type.array ? "array" : "";
    for (const double number : numbers) text += fmt::format(" {:.9g}", number);
    return text;
}

/// All properties of a prim with what they say, at three times and without one.
void describeProperties(const UsdPrim& prim, std::string& text) {
    std::set<std::string> names;
    for (const UsdOpinion& opinion : prim.opinions)
        for (const UsdProperty& property : opinion.spec->properties) names.insert(property.name);
    for (const std::string& name : names) {
        const UsdProperty& strongest = *UsdStage::property(prim, name);
        text.append(" ").append(name).append(strongest.custom ? " custom" : "");
        text += strongest.uniform ? " uniform" : "";
        for (const UsdTime time : {UsdTime(), UsdTime(0.0), UsdTime(2.5), UsdTime(7.0)})
            if (const UsdResolved value = UsdStage::value(prim, name, time))
                if (value->type.kind != UsdKind::asset) text.append(" ").append(described(*value));
        for (const std::string& target : UsdStage::targets(prim, name))
            text.append(" <").append(target).append(">");
        if (const UsdValue* value = UsdStage::metadata(prim, name, "interpolation"))
            text.append(" ").append(usdText(*value));
        text += "\n";
    }
}

std::string described(const UsdStage& stage) {
    std::string text;
    for (const UsdPrim& prim : stage.prims()) {
        text.append(prim.path).append(" ").append(prim.typeName).append(" ");
        text.append(std::to_string(int(prim.specifier))).append("\n");
        describeProperties(prim, text);
    }
    return text;
}

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
