// Damaged files: whatever the bytes are, the reader answers with a scene or with one error.
#include "tests/io/usd/UsdTestFiles.h"

#include "io/usd/layer/UsdLayer.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace penumbra {

namespace {

const std::string kValid = R"(#usda 1.0
(
    "comment"
    subLayers = [@./none.usda@ (offset = 1; scale = 2)]
    upAxis = "Z"; metersPerUnit = 1
    customLayerData = { string a = "b"; dictionary d = { int[] x = [1, 2] } }
)
def Xform "World" (
    prepend apiSchemas = ["A"]
    variants = { string v = "x" }
)
{
    double3 xformOp:translate.timeSamples = { 0: (0, 0, 0), 10: (1, 2, 3), 11: None }
    quatf xformOp:orient = (1, 0, 0, 0)
    matrix4d xformOp:transform = ( (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1) )
    uniform token[] xformOpOrder = ["xformOp:translate", "!invert!xformOp:orient"]
    variantSet "v" = {
        "x" {
            over "m" (kind = "group") { }
        }
    }
    def Mesh "m"
    {
        int[] faceVertexCounts = [4, 3]
        int[] faceVertexIndices = [0, 1, 2, 3, 0, 1, 2]
        point3f[] points = [(0, 0, 0), (1e0, 0, 0), (1, 1., 0), (0, .1e1, 0)]
        int[] creaseIndices = [0, 1]
        int[] creaseLengths = [2]
        float[] creaseSharpnesses = [2]
        color3f[] primvars:displayColor = [(0.5, 0.5, 0.5)] (interpolation = "constant")
        rel material:binding = </World/M>
        string s = """long "text" \x41"""
        asset a = @@@x@y@@@
    }
    def Material "M"
    {
        token outputs:surface.connect = </World/M/S.outputs:surface>
        def Shader "S"
        {
            uniform token info:id = "UsdPreviewSurface"
            color3f inputs:diffuseColor.connect = <../../M.inputs:c>
        }
    }
    def RectLight "l"
    {
        float inputs:width = 2
        bool inputs:normalize = true
        float inputs:intensity = 1e3
    }
}
)";

// `text` with some bytes changed, taken out, doubled or replaced by pieces that mean something.
std::string damaged(std::string text) {
    const std::vector<std::string> pieces{"(",          ")",
                                          "[",          "]",
                                          "{",          "}",
                                          "\"",         "'",
                                          "\"\"\"",     "<",
                                          ">",          "@",
                                          "@@@",        "\n",
                                          ";",          ",",
                                          "None",       "-1",
                                          "1e999",      "nan",
                                          "2147483647", "99999999999999999999",
                                          "def ",       "over ",
                                          "rel ",       "\\",
                                          "#",          "/*",
                                          "\xc3",       "timeSamples",
                                          ".connect"};
    const int edits = *rc::gen::inRange(1, 8);
    for (int i = 0; i < edits && !text.empty(); ++i) {
        const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
        const auto length = std::min(*rc::gen::inRange<std::size_t>(0, 30), text.size() - at);
        switch (*rc::gen::inRange(0, 5)) {
        case 0:
            text[at] = *rc::gen::arbitrary<char>();
            break;
        case 1:
            text.erase(at, length);
            break;
        case 2:
            text.insert(at, text.substr(at, length));
            break;
        case 3:
            text.insert(at, *rc::gen::elementOf(pieces));
            break;
        default:
            text.resize(at);
            break;
        }
    }
    return text;
}

} // namespace

TEST(UsdFuzz, TheUndamagedFileIsFine) {
    const TemporaryFolder folder;
    EXPECT_EQ(nodesByPath(*loadUsdScene(folder.write("f.usda", kValid)).scene).count("/World/m"),
              1u);
}

RC_GTEST_PROP(UsdFuzz, DamagedTextGivesALayerOrOneLineOfError, ()) {
    const std::string text = damaged(kValid);
    try {
        parseUsdLayer(text, "f.usda");
    } catch (const SceneFileError& error) {
        const std::string what = error.what();
        RC_ASSERT(what.starts_with("f.usda"));
        RC_ASSERT(what.find('\n') == std::string::npos);
    }
}

RC_GTEST_PROP(UsdFuzz, DamagedTextGivesASceneOrAnError, ()) {
    const TemporaryFolder folder;
    const auto file = folder.write("f.usda", "#usda 1.0\n" + damaged(kValid.substr(10)));
    try {
        nodesByPath(*loadUsdScene(file).scene);
    } catch (const SceneFileError&) {
    }
}

RC_GTEST_PROP(UsdFuzz, AnyBytesGiveALayerOrAnError, (const std::string& bytes)) {
    try {
        parseUsdLayer("#usda 1.0\n" + bytes, "f.usda");
    } catch (const SceneFileError&) {
    }
}

} // namespace penumbra
