#include "io/usd/stage/UsdStage.h"

#include "tests/io/usd/UsdTestFiles.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

const std::string kHeader = "#usda 1.0\n";

UsdStage stageOf(const std::string& text) {
    const TemporaryFolder folder;
    return UsdStage::open(folder.write("s.usda", kHeader + text));
}

// The numbers of an attribute of </a>.
std::vector<double> numbers(const UsdStage& stage, const char* attribute, UsdTime time = {}) {
    const UsdPrim* prim = stage.find("/a");
    const UsdResolved value = prim ? UsdStage::value(*prim, attribute, time) : UsdResolved();
    return value ? value->numbers() : std::vector<double>{};
}

using Numbers = std::vector<double>;

} // namespace

TEST(UsdStage, StrongerLayersOverrideAttributeByAttribute) {
    const TemporaryFolder folder;
    folder.write("weak.usda",
                 kHeader +
                     "def Xform \"a\"\n{\n float x = 1\n float y = 2\n def \"b\"\n {\n }\n}\n");
    const UsdStage stage = UsdStage::open(
        folder.write("root.usda", kHeader + "(subLayers = [@./weak.usda@])\nover \"a\"\n{\n float "
                                            "x = 10\n def \"c\"\n {\n }\n}\n"));
    EXPECT_EQ(numbers(stage, "x"), Numbers{10});
    EXPECT_EQ(numbers(stage, "y"), Numbers{2});
    const UsdPrim& a = *stage.find("/a");
    EXPECT_EQ(a.typeName, "Xform");
    EXPECT_TRUE(a.defined);
    ASSERT_EQ(a.children.size(), 2u); // the weaker layer's children come first, as in OpenUSD
    EXPECT_EQ(stage.prims()[a.children[0]].name, "b");
    EXPECT_EQ(stage.prims()[a.children[1]].name, "c");
}

TEST(UsdStage, SubLayersAreTakenDepthFirst) {
    const TemporaryFolder folder;
    folder.write("sub/one.usda",
                 kHeader + "(subLayers = [@../deep.usda@])\ndef \"a\"\n{\n float y = 1\n}\n");
    folder.write("deep.usda", kHeader + "def \"a\"\n{\n float x = 1\n float y = 3\n}\n");
    folder.write("two.usda", kHeader + "def \"a\"\n{\n float x = 2\n float y = 2\n}\n");
    const UsdStage stage = UsdStage::open(
        folder.write("root.usda", kHeader + "(subLayers = [@sub/one.usda@, @two.usda@])\n"));
    EXPECT_EQ(numbers(stage, "x"), Numbers{1}); // deep is stronger than two
    EXPECT_EQ(numbers(stage, "y"), Numbers{1});
}

TEST(UsdStage, MissingBrokenAndCyclicSubLayersAreReportedAndLeftOut) {
    const TemporaryFolder folder;
    folder.write("broken.usda", kHeader + "def a");
    folder.write("cycle.usda", kHeader + "(subLayers = [@root.usda@])\n");
    UsdStage stage = UsdStage::open(
        folder.write("root.usda", kHeader + "(subLayers = [@none.usda@, @broken.usda@, "
                                            "@cycle.usda@, @root.usda@, @http://x/y.usda@])\n"
                                            "def \"a\"\n{\n}\n"));
    EXPECT_TRUE(stage.find("/a"));
    ASSERT_EQ(stage.diagnostics().list().size(), 4u);
    EXPECT_EQ(stage.diagnostics().list()[2].count,
              2u); // root.usda, from itself and from cycle.usda
    EXPECT_EQ(stage.diagnostics().list()[0].where.line, 2u);
}

TEST(UsdStage, LayerOffsetsMapTheTimesOfSubLayers) {
    const TemporaryFolder folder;
    folder.write("anim.usda",
                 kHeader + "def \"a\"\n{\n float x.timeSamples = { 0: 0, 10: 10 }\n}\n");
    folder.write("mid.usda", kHeader + "(subLayers = [@anim.usda@ (scale = 2)])\n");
    folder.write("fast.usda", kHeader + "(timeCodesPerSecond = 48)\ndef \"a\"\n{\n float "
                                        "z.timeSamples = { 0: 0, 48: 48 }\n}\n");
    const UsdStage stage = UsdStage::open(folder.write(
        "root.usda", kHeader + "(subLayers = [@mid.usda@ (offset = 100), @fast.usda@])\n"));
    // outer = inner * 2 + 100: the sample of time 10 is at 120.
    EXPECT_EQ(numbers(stage, "x", 120), Numbers{10});
    EXPECT_EQ(numbers(stage, "x", 110), Numbers{5});
    // 48 time codes a second become 24: a second is a second.
    EXPECT_EQ(numbers(stage, "z", 24), Numbers{48});
}

TEST(UsdStage, SamplesAreInterpolatedOrHeld) {
    const UsdStage stage = stageOf(
        "def \"a\"\n{\n float3 v.timeSamples = { 0: (0, 0, 0), 10: (10, 20, 30) }\n"
        " int i.timeSamples = { 0: 1, 10: 2 }\n float[] n.timeSamples = { 0: [1], 10: [1, 2] }\n"
        " float b = 7\n float b.timeSamples = { 0: 1, 5: None, 10: 3 }\n"
        " quatf q.timeSamples = { 0: (1, 0, 0, 0), 1: (0, 1, 0, 0) }\n}\n");
    EXPECT_EQ(numbers(stage, "v", 5), (Numbers{5, 10, 15}));
    EXPECT_EQ(numbers(stage, "v", -1), (Numbers{0, 0, 0}));
    EXPECT_EQ(numbers(stage, "v", 11), (Numbers{10, 20, 30}));
    EXPECT_EQ(numbers(stage, "i", 9.9), Numbers{1});
    EXPECT_EQ(numbers(stage, "n", 9.9), Numbers{1}); // lengths differ
    EXPECT_EQ(numbers(stage, "b", 4), Numbers{1});   // a block is held up to, not blended with
    EXPECT_EQ(numbers(stage, "b", 5), Numbers{});
    EXPECT_EQ(numbers(stage, "b"), Numbers{7}); // without a time only the default counts
    const auto q = numbers(stage, "q", 0.5);    // half way to 180 degrees about X
    ASSERT_EQ(q.size(), 4u);
    EXPECT_NEAR(q[0], 0.70710678, 1e-6);
    EXPECT_NEAR(q[1], 0.70710678, 1e-6);
}

TEST(UsdStage, BetweenSamplesThatAreAlikeAValueStandsStillToTheLastBit) {
    const UsdStage stage =
        stageOf("def \"a\"\n{\n double x.timeSamples = { 3: .2366, 6: .2366 }\n}\n");
    for (const double time : {4.0, 5.0}) EXPECT_EQ(numbers(stage, "x", time), Numbers{.2366});
}

TEST(UsdStage, WithoutATimeSamplesCountOnlyWhereThereIsNoDefault) {
    const UsdStage stage = stageOf("def \"a\"\n{\n float x.timeSamples = { 3: 30, 4: 40 }\n}\n");
    EXPECT_EQ(numbers(stage, "x"), Numbers{30});
}

TEST(UsdStage, AStrongerDefaultHidesWeakerSamples) {
    const TemporaryFolder folder;
    folder.write("weak.usda",
                 kHeader +
                     "def \"a\"\n{\n float x.timeSamples = { 0: 0, 10: 10 }\n float y = 3\n}\n");
    const UsdStage stage = UsdStage::open(folder.write(
        "root.usda",
        kHeader +
            "(subLayers = [@weak.usda@])\nover \"a\"\n{\n float x = 5\n float y = None\n}\n"));
    EXPECT_EQ(numbers(stage, "x", 2), Numbers{5});
    EXPECT_EQ(numbers(stage, "y"), Numbers{}); // blocked
    EXPECT_TRUE(UsdStage::animated(*stage.find("/a"), "x"));
}

TEST(UsdStage, InactivePrimsAreNotThere) {
    const UsdStage stage =
        stageOf("def \"a\" (active = false)\n{\n def \"b\"\n {\n }\n}\ndef \"c\"\n{\n}\n");
    EXPECT_FALSE(stage.find("/a"));
    EXPECT_FALSE(stage.find("/a/b"));
    EXPECT_TRUE(stage.find("/c"));
}

TEST(UsdStage, OversAndClassesAreMarked) {
    const UsdStage stage =
        stageOf("over \"o\"\n{\n def \"x\"\n {\n }\n}\nclass \"k\"\n{\n def \"y\"\n {\n }\n}\n");
    EXPECT_FALSE(stage.find("/o/x")->defined);
    EXPECT_TRUE(stage.find("/k/y")->abstract);
}

TEST(UsdStage, ListEditsOfAllLayersAreApplied) {
    const TemporaryFolder folder;
    folder.write(
        "weak.usda",
        kHeader + "def \"a\" (apiSchemas = [\"A\", \"B\"])\n{\n rel r = [</x>, </y>, </z>]\n}\n");
    const UsdStage stage = UsdStage::open(
        folder.write("root.usda", kHeader + "(subLayers = [@weak.usda@])\nover \"a\" (prepend "
                                            "apiSchemas = [\"C\"]\n delete apiSchemas = [\"A\"])\n"
                                            "{\n prepend rel r = </z>\n append rel r = </x>\n "
                                            "delete rel r = </y>\n add rel r = </w>\n}\n"));
    const UsdPrim& a = *stage.find("/a");
    EXPECT_EQ(UsdStage::targets(a, "r"), (std::vector<std::string>{"/z", "/w", "/x"}));
    EXPECT_FALSE(UsdStage::hasApi(a, "A"));
    EXPECT_TRUE(UsdStage::hasApi(a, "B") && UsdStage::hasApi(a, "C"));
}

TEST(UsdStage, ArcsThatLeadNowhereAreSaid) {
    UsdStage stage = stageOf("def \"a\" (references = @x.usda@)\n{\n}\ndef \"b\" (references = "
                             "</x>\n inherits = </a>)\n{\n}\n"
                             "def \"c\" (references = None)\n{\n}\n");
    const auto& list = stage.diagnostics().list();
    ASSERT_EQ(list.size(),
              2u); // inheriting </a>, </b> has its reference again, and it says the same
    EXPECT_NE(list[0].text.find("reference @x.usda@<> of </a> left out: "), std::string::npos);
    EXPECT_EQ(list[0].count, 2u);
    EXPECT_EQ(list[0].where.line, 2u);
    EXPECT_EQ(list[1].text, "reference @@</x> of </b> left out: there is no prim");
}

} // namespace penumbra
