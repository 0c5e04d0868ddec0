// Scenes that are small to write and endless to compose: each ends soon and says why.
#include "io/usd/stage/UsdStage.h"
#include "tests/io/usd/UsdTestFiles.h"

#include <gtest/gtest.h>

#include <chrono>

namespace penumbra {

namespace {

const std::string kHeader = "#usda 1.0\n";

bool warns(UsdStage& stage, const std::string& text) {
    for (const Diagnostic& d : stage.diagnostics().list())
        if (d.text.find(text) != std::string::npos) return true;
    return false;
}

/// 40 files, each of which refers to the next one as `body` says: `@` stands for its name.
std::filesystem::path chain(const TemporaryFolder& folder, const std::string& body) {
    for (int i = 40; i >= 0; --i) {
        std::string text = body;
        const std::string next = "@" + std::to_string(i + 1) + ".usda@";
        for (std::size_t at = 0; (at = text.find('@', at)) != std::string::npos; at += next.size())
            text.replace(at, 1, next);
        folder.write(std::to_string(i) + ".usda", kHeader + text);
    }
    folder.write("41.usda", kHeader + "def \"a\"\n{\n def \"b\"\n {\n }\n}\n");
    return folder.path() / "0.usda";
}

class HostileScenes : public testing::Test {
protected:
    void TearDown() override {
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin_;
        EXPECT_LT(took.count(), 120); // a second or two; the rest is for sanitizers
    }

private:
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

} // namespace

TEST_F(HostileScenes, EachFileRefersTwiceToTheNext) {
    const TemporaryFolder folder;
    UsdStage stage = UsdStage::open(
        chain(folder, "def \"a\" (references = [@</a>, @</a> (offset = 1)])\n{\n}\n"));
    EXPECT_TRUE(stage.find("/a"));
    EXPECT_TRUE(warns(stage, "too many arcs"));
}

TEST_F(HostileScenes, TheSameBelowARoot) {
    const TemporaryFolder folder;
    UsdStage stage = UsdStage::open(chain(
        folder,
        "def \"a\"\n{\n def \"b\" (references = [@</a/b>, @</a/b> (offset = 1)])\n {\n }\n}\n"));
    EXPECT_TRUE(stage.find("/a/b"));
    EXPECT_TRUE(warns(stage, "too many arcs"));
}

TEST_F(HostileScenes, EachPrimHasTwoThatReferToTheNext) {
    const TemporaryFolder folder;
    UsdComposeLimits limits;
    limits.prims = 20'000;
    UsdStage stage =
        UsdStage::open(chain(folder, "def \"a\"\n{\n def \"b\" (references = @</a>)\n {\n }\n"
                                     " def \"c\" (references = @</a>)\n {\n }\n}\n"),
                       limits);
    EXPECT_EQ(stage.prims().size(), 20'000u);
    EXPECT_TRUE(warns(stage, "too large"));
}

TEST_F(HostileScenes, ArcsThatAreNestedDeeply) {
    const TemporaryFolder folder;
    std::string text;
    for (int i = 0; i < 1000; ++i)
        text += "def \"p" + std::to_string(i) + "\" (references = </p" + std::to_string(i + 1) +
                ">)\n{\n}\n";
    UsdStage stage = UsdStage::open(folder.write("s.usda", kHeader + text));
    EXPECT_TRUE(stage.find("/p0"));
    EXPECT_TRUE(warns(stage, "nested too deeply"));
}

TEST_F(HostileScenes, AHundredThousandSubLayersOfOneFile) {
    const TemporaryFolder folder;
    folder.write("one.usda", kHeader + "def \"a\"\n{\n int x = 1\n}\n");
    std::string text = "(subLayers = [\n";
    for (int i = 0; i < 100'000; ++i) text += "@one.usda@,\n";
    UsdStage stage = UsdStage::open(folder.write("s.usda", kHeader + text + "])\n"));
    EXPECT_TRUE(stage.find("/a"));
    EXPECT_TRUE(warns(stage, "too many layers"));
}

TEST_F(HostileScenes, TenThousandRelocates) {
    const TemporaryFolder folder;
    std::string rig = "def \"R\"\n{\n", relocates = "(relocates = {\n";
    for (int i = 0; i < 10'000; ++i) {
        const std::string n = std::to_string(i);
        rig += " def \"p" + n + "\"\n {\n  rel r = </R/p" + n + ">\n }\n";
        relocates += "</a/p" + n + ">: </a/q" + n + ">,\n";
    }
    folder.write("rig.usda", kHeader + rig + "}\n");
    const UsdStage stage = UsdStage::open(folder.write(
        "s.usda", kHeader + relocates + "})\ndef \"a\" (references = @rig.usda@</R>)\n{\n}\n"));
    EXPECT_EQ(stage.prims().size(), 10'002u);
    ASSERT_TRUE(stage.find("/a/q9999"));
    EXPECT_EQ(UsdStage::targets(*stage.find("/a/q9999"), "r"),
              std::vector<std::string>{"/a/q9999"});
}

TEST_F(HostileScenes, AHundredThousandArcsOfOnePrim) {
    const TemporaryFolder folder;
    std::string text = "class \"c\"\n{\n}\ndef \"a\" (\n references = [\n";
    for (int i = 0; i < 100'000; ++i) text += "</c> (offset = " + std::to_string(i) + "),\n";
    text += "]\n inherits = [\n";
    for (int i = 0; i < 100'000; ++i) text += "</c" + std::to_string(i) + ">,\n";
    UsdStage stage = UsdStage::open(folder.write("s.usda", kHeader + text + "]\n)\n{\n}\n"));
    EXPECT_TRUE(stage.find("/a"));
    EXPECT_TRUE(warns(stage, "too many arcs"));
}

TEST_F(HostileScenes, PathsOfThousandsOfElements) {
    const TemporaryFolder folder;
    std::string path;
    for (int i = 0; i < 5'000; ++i) path += "/p";
    UsdStage stage = UsdStage::open(folder.write(
        "s.usda", kHeader + "(relocates = {</a/b>: <" + path + ">})\ndef \"a\" (references = <" +
                      path + ">; inherits = <" + path + ">)\n{\n def \"b\"\n {\n }\n}\n"));
    EXPECT_TRUE(stage.find("/a/b"));
    EXPECT_TRUE(warns(stage, "relocate of </a/b> to <" + path + "> left out: not the path"));
    EXPECT_TRUE(warns(stage, "of </a> left out: not the path of a prim"));
    EXPECT_TRUE(warns(stage, "class </p/p"));
}

TEST_F(HostileScenes, RelocatesThatFeedEachOtherAndTwoThousandBelowThem) {
    const TemporaryFolder folder;
    std::string longPath;
    for (int i = 0; i < 500; ++i) longPath += "/p";
    std::string text =
        "(relocates = {\n</a/b/c" + longPath + ">: </d/e>,\n</d/e/f" + longPath + ">: </a/b>,\n";
    for (int i = 0; i < 2'000; ++i) {
        const std::string n = std::to_string(i);
        text += "</a/b/x" + n + ">: </q" + n + ">,\n";
    }
    UsdStage stage =
        UsdStage::open(folder.write("s.usda", kHeader + text + "})\ndef \"a\"\n{\n}\n"));
    EXPECT_TRUE(stage.find("/a"));
    EXPECT_TRUE(warns(stage, "not traced back"));
}

TEST_F(HostileScenes, ThousandsOfClassesOfAReferencedPrim) { // each is implied where it is used
    const TemporaryFolder folder;
    std::string rig = "def \"R\" (inherits = [\n";
    for (int i = 0; i < 3'000; ++i) rig += "</c" + std::to_string(i) + ">,\n";
    folder.write("rig.usda", kHeader + rig + "])\n{\n}\n");
    UsdStage stage = UsdStage::open(
        folder.write("s.usda", kHeader + "def \"a\" (references = @rig.usda@</R>)\n{\n}\n"
                                         "class \"c2999\"\n{\n int x = 1\n}\n"));
    ASSERT_TRUE(stage.find("/a"));
    EXPECT_TRUE(UsdStage::property(*stage.find("/a"), "x"));
}

TEST_F(HostileScenes, AStackOfThousandsOfLayersThatIsReferredToAThousandTimes) {
    const TemporaryFolder folder;
    folder.write("one.usda", kHeader + "def \"a\"\n{\n}\n");
    std::string layers = "(subLayers = [\n", arcs;
    for (int i = 0; i < 4'000; ++i) layers += "@one.usda@,\n";
    folder.write("many.usda", kHeader + layers + "])\n");
    for (int i = 0; i < 1'000; ++i)
        arcs += "@many.usda@</a> (offset = " + std::to_string(i) + "),\n";
    UsdStage stage = UsdStage::open(
        folder.write("s.usda", kHeader + "def \"a\" (references = [\n" + arcs + "])\n{\n}\n"));
    EXPECT_TRUE(stage.find("/a"));
    EXPECT_TRUE(warns(stage, "too many arcs"));
}

TEST_F(HostileScenes, AHundredThousandVariantSets) {
    const TemporaryFolder folder;
    std::string names, sets, choices;
    for (int i = 0; i < 100'000; ++i) {
        const std::string n = std::to_string(i);
        names += "\"v" + n + "\", ";
        choices += "string v" + n + " = \"x\"\n";
        sets += " variantSet \"v" + n + "\" = {\n  \"x\" {\n  }\n }\n";
    }
    UsdStage stage = UsdStage::open(
        folder.write("s.usda", kHeader + "def \"a\" (\n variantSets = [" + names +
                                   "]\n variants = {\n" + choices + "}\n)\n{\n" + sets + "}\n"));
    EXPECT_TRUE(stage.find("/a"));
    EXPECT_TRUE(warns(stage, "too many arcs"));
}

} // namespace penumbra
