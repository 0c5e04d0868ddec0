// Layers written as text: what is read back is the same.
#include "io/usd/text/UsdLayerWriter.h"
#include "io/usd/text/UsdValueText.h"
#include "tests/io/usd/UsdTestFiles.h"
#include "tests/io/usd/crate/LayerDifference.h"

#include <gtest/gtest.h>

#include <iostream>

namespace penumbra {

namespace {

std::string written(const std::string& text) {
    return usdLayerText(parseUsdLayer("#usda 1.0\n" + text, "t.usda"));
}

} // namespace

TEST(UsdLayerWriter, TheOrderAndAllStatementsStay) {
    const std::string text = R"((
    "a comment"
    upAxis = "Y"
    customLayerData = {
        string[] "not an identifier" = ["a", "b"]
        dictionary empty = {
        }
    }
    unknown = (1, 2)
    prepend other = ["x"]
    subLayers = [
        @a.usda@ (offset = 1.5; scale = 2),
        @@@b@c.usda@@@,
    ]
    relocates = {
        </A/B>: </A/C>,
        </A/D>: <>,
    }
)
reorder rootPrims = ["b", "a"]

class "b" (
    active = 0
    append apiSchemas = ["S"]
    delete apiSchemas = ["T"]
    prepend inherits = [</c>, </d>]
    payload = None
    references = [@x.usda@</P> (customData = {
        int n = 1
    }), <>]
    specializes = </e>
    variants = {
        string v = "x"
    }
    add variantSets = ["v", "w"]
)
{
    custom uniform token[] names = ["a"] (
        doc = """two
lines"""
    )
    double d.timeSamples = {
        -1: None,
        0.1: 1e+300,
    }
    float f.connect = </b.g>
    prepend float f.connect = [</b.h>, </b.i>]
    prepend varying rel r = None
    rel s
    reorder nameChildren = ["c"]
    variantSet "v" = {
        "1.x" (
            kind = "group"
        ) {
            int i = 3

            over "c"
            {
            }
        }
    }

    def ns::Type "c"
    {
        string odd = "\"\\\t\x01"
    }
}
)";
    std::string expected = "#usda 1.0\n" + text;
    // An explicit list replaces edits of other kinds, so that these need one of their own.
    const std::string explicitConnection = "    float f.connect = </b.g>\n";
    expected.erase(expected.find(explicitConnection), explicitConnection.size());
    EXPECT_EQ(written(text), expected);
}

TEST(UsdLayerWriter, AssetPathsOfAllKindsReadBack) {
    for (const std::string path :
         {"", "a", "a@b", "@", "@@", "@@@", "a@@@@b", "a@", "a\\b", "a\\@"}) {
        const std::string text =
            "#usda 1.0\ndef \"a\"\n{\n    asset x = " + usdAssetLiteral(path) + "\n}\n";
        const UsdLayer layer = parseUsdLayer(text, "t.usda");
        EXPECT_EQ(*layer.prims[0].properties[0].value.text(), path);
        EXPECT_EQ(usdLayerText(layer).find(usdAssetLiteral(path)) == std::string::npos, false);
    }
}

TEST(UsdLayerWriter, NumbersReadBackExactly) {
    const std::string text = R"(#usda 1.0

def "a"
{
    float f = 3.4028235e+38
    double d = 5e-324
    double[] e = [-0, inf, -inf, nan, 0.1, 9007199254740993]
    half h = 6e-08
    int64 i = -9223372036854775808
    uint64 u = 18446744073709551615
}
)";
    const UsdLayer layer = parseUsdLayer(text, "t.usda");
    EXPECT_EQ(differenceOf(parseUsdLayer(usdLayerText(layer), "u.usda"), layer), "");
}

TEST(UsdLayerWriter, TextsOfOthersReadBack) {
    const auto shared = sharedFolder();
    if (!shared) GTEST_SKIP() << "the shared files are not here";
    std::size_t read = 0, refused = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(*shared / "assets")) {
        if (entry.path().extension() != ".usda" || entry.file_size() > 10'000'000) continue;
        SCOPED_TRACE(entry.path());
        UsdLayer layer;
        try {
            layer = readUsdLayer(entry.path());
        } catch (const SceneFileError&) {
            ++refused; // some are wrong on purpose
            continue;
        }
        const std::string text = usdLayerText(layer);
        UsdLayer again;
        ASSERT_NO_THROW(again = parseUsdLayer(text, "again.usda"));
        EXPECT_EQ(differenceOf(layer, again), "");
        EXPECT_EQ(usdLayerText(again), text);
        ++read;
    }
    std::cout << read << " text layers written and read back, " << refused << " refused\n";
}

} // namespace penumbra
