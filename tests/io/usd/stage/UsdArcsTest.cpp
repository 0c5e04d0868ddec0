// Each arc by itself, as the stage shows it.
#include "io/usd/stage/UsdStage.h"
#include "tests/io/usd/UsdTestFiles.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

const std::string kHeader = "#usda 1.0\n";

class Arcs : public testing::Test {
protected:
    void layer(const std::string& name, const std::string& text) {
        folder.write(name, kHeader + text);
    }
    void open(const std::string& text) { stage.emplace(UsdStage::open(root(text))); }
    std::filesystem::path root(const std::string& text) {
        return folder.write("root.usda", kHeader + text);
    }
    /// A number of a prim at a time; -1 if there is none.
    double number(const char* prim, const char* attribute, UsdTime time = {}) const {
        const UsdPrim* found = stage->find(prim);
        if (!found) return -1;
        const UsdResolved value = UsdStage::value(*found, attribute, time);
        const auto numbers = value ? value->numbers() : std::vector<double>{};
        return numbers.size() == 1 ? numbers[0] : -1;
    }
    std::vector<std::string> targets(const char* prim, const char* property) const {
        return UsdStage::targets(*stage->find(prim), property);
    }
    std::size_t warnings(const std::string& text) {
        std::size_t count = 0;
        for (const Diagnostic& d : stage->diagnostics().list())
            if (d.text.find(text) != std::string::npos) count += d.count;
        return count;
    }

    TemporaryFolder folder;
    std::optional<UsdStage> stage;
};

using Paths = std::vector<std::string>;

} // namespace

TEST_F(Arcs, VariablesOfOtherTypesMakeOtherLayerStacks) {
    layer("x.usda", "def \"p\"\n{\n float x = 7\n}\n");
    layer("f.usda", "def \"f\" (references = @`if(${V}, \"x.usda\", \"\")`@</p>)\n{\n}\n");
    for (const char* type : {"bool", "int"})
        layer(std::string(type) + ".usda", std::string("(expressionVariables = { ") + type +
                                               " V = 1 })\ndef \"g\" (references = "
                                               "@f.usda@</f>)\n{\n}\n");
    open("def \"a\" (references = @bool.usda@</g>)\n{\n}\n"
         "def \"b\" (references = @int.usda@</g>)\n{\n}\n");
    EXPECT_EQ(number("/a", "x"), 7);
    EXPECT_EQ(number("/b", "x"), -1); // its variable is no condition
}

TEST_F(Arcs, AReferenceBringsAPrimAndIsWeaker) {
    layer("chair.usda",
          "(defaultPrim = \"Chair\")\ndef Xform \"Chair\"\n{\n float x = 1\n float y = 2\n"
          " def Mesh \"Seat\"\n {\n }\n}\n");
    open("def \"a\" (references = @chair.usda@)\n{\n float x = 10\n}\n");
    EXPECT_EQ(number("/a", "x"), 10);
    EXPECT_EQ(number("/a", "y"), 2);
    EXPECT_EQ(stage->find("/a")->typeName, "Xform");
    EXPECT_EQ(stage->find("/a/Seat")->typeName, "Mesh");
    EXPECT_TRUE(stage->find("/a/Seat")->defined);
    EXPECT_EQ(stage->find("/a/Seat")->location().line, 7u); // of chair.usda
    EXPECT_TRUE(stage->diagnostics().list().empty());
}

TEST_F(Arcs, StrengthIsLiverps) {
    layer("r.usda", "def \"r\"\n{\n int r = 4\n int p = 4\n int s = 4\n}\n");
    layer("p.usda", "def \"p\"\n{\n int p = 5\n int s = 5\n}\n");
    open("class \"i\"\n{\n int i = 1\n int v = 1\n int r = 1\n int p = 1\n int s = 1\n}\n"
         "class \"s\"\n{\n int s = 6\n int only = 6\n}\n"
         "def \"a\" (\n inherits = </i>\n specializes = </s>\n references = @r.usda@</r>\n"
         " payload = @p.usda@</p>\n variants = { string set = \"one\" }\n"
         " variantSets = \"set\"\n)\n{\n int l = 0\n int i = 0\n variantSet \"set\" = {\n"
         "  \"one\" {\n   int i = 3\n   int v = 3\n   int r = 3\n  }\n }\n}\n"
         "def \"b\" (\n specializes = </s>\n references = @r.usda@</r>\n payload = @p.usda@</p>\n)"
         "\n{\n}\n");
    EXPECT_EQ(number("/a", "l"), 0);
    EXPECT_EQ(number("/a", "i"), 0);
    EXPECT_EQ(number("/a", "v"), 1);
    EXPECT_EQ(number("/a", "only"), 6);
    EXPECT_EQ(number("/b", "r"), 4);
    EXPECT_EQ(number("/b", "p"), 4);
    EXPECT_EQ(number("/b", "s"), 4);
    EXPECT_EQ(number("/b", "only"), 6);
    EXPECT_FALSE(stage->find("/a")->abstract); // a class makes no class of what inherits it
}

TEST_F(Arcs, ClassesWorkWhereAPrimIsReferencedTo) {
    layer("chair.usda", "class \"_wood\"\n{\n float x = 1\n float y = 1\n}\n"
                        "def \"Chair\" (inherits = </_wood>)\n{\n}\n");
    open("class \"_wood\"\n{\n float x = 2\n}\ndef \"a\" (references = "
         "@chair.usda@</Chair>)\n{\n}\n");
    EXPECT_EQ(number("/a", "x"), 2);
    EXPECT_EQ(number("/a", "y"), 1);
}

TEST_F(Arcs, VariantsAreChosenAnywhere) {
    layer("car.usda",
          "def \"Car\" (\n variantSets = [\"paint\", \"standin\"]\n variants = { string "
          "paint = \"red\" }\n)\n{\n variantSet \"paint\" = {\n  \"red\" {\n   int c = 1\n"
          "  }\n  \"blue\" {\n   int c = 2\n   def \"Sticker\"\n   {\n   }\n  }\n }\n"
          " variantSet \"standin\" = {\n  \"anim\" {\n   int s = 1\n  }\n"
          "  \"render\" {\n   int s = 2\n  }\n }\n}\n");
    open("def \"a\" (references = @car.usda@</Car>)\n{\n}\n"
         "def \"b\" (\n references = @car.usda@</Car>\n variants = { string paint = \"blue\" }\n)\n"
         "{\n}\n");
    EXPECT_EQ(number("/a", "c"), 1);
    EXPECT_EQ(number("/b", "c"), 2);
    EXPECT_TRUE(stage->find("/b/Sticker"));
    EXPECT_FALSE(stage->find("/a/Sticker"));
    EXPECT_EQ(number("/a", "s"), 2); // nobody chose: render
}

TEST_F(Arcs, RelocatesMoveWhatAnArcBrought) {
    layer("rig.usda", "def \"Rig\"\n{\n def \"Arm\"\n {\n  int x = 1\n }\n"
                      " rel r = </Rig/Arm>\n def \"Leg\"\n {\n }\n}\n");
    open("(relocates = { </a/Arm>: </a/Hand>, </a/Leg>: <> })\n"
         "def \"a\" (references = @rig.usda@</Rig>)\n{\n over \"Hand\"\n {\n  int y = 2\n }\n}\n");
    EXPECT_FALSE(stage->find("/a/Arm"));
    EXPECT_FALSE(stage->find("/a/Leg"));
    EXPECT_EQ(number("/a/Hand", "x"), 1);
    EXPECT_EQ(number("/a/Hand", "y"), 2);
    EXPECT_EQ(targets("/a", "r"), Paths{"/a/Hand"});
}

TEST_F(Arcs, TargetsAreNamedAsTheStageDoes) {
    layer("chair.usda", "def \"Chair\"\n{\n rel r = [</Chair/Wood>, </Outside>]\n"
                        " float x.connect = </Chair/Wood.out>\n def \"Wood\"\n {\n }\n}\n"
                        "def \"Outside\"\n{\n}\n");
    open("def \"a\"\n{\n def \"b\" (references = @chair.usda@</Chair>)\n {\n"
         "  append rel r = </a>\n }\n}\n");
    EXPECT_EQ(targets("/a/b", "r"), (Paths{"/a/b/Wood", "/a"}));
    EXPECT_EQ(targets("/a/b", "x"), Paths{"/a/b/Wood.out"});
    EXPECT_EQ(warnings("outside of what the arc brings"), 1u);
}

TEST_F(Arcs, TimesPassThroughAllOffsets) {
    layer("anim.usda", "(timeCodesPerSecond = 48)\ndef \"A\"\n{\n"
                       " float x.timeSamples = { 0: 0, 48: 48 }\n}\n");
    layer("sub.usda", "def \"a\" (references = @anim.usda@</A> (offset = 10; scale = 2))\n{\n}\n");
    open("(\n timeCodesPerSecond = 24\n subLayers = [@sub.usda@ (offset = 100)]\n)\n");
    // 48 codes of the layer are a second, 24 codes of the stage; twice as slow, 110 later.
    EXPECT_EQ(number("/a", "x", 110), 0);
    EXPECT_EQ(number("/a", "x", 134), 24);
    EXPECT_EQ(number("/a", "x", 158), 48);
}

TEST_F(Arcs, PathsAreRelativeToTheLayerThatHasThem) {
    layer("sets/room.usda",
          "def \"Room\"\n{\n def \"c\" (references = @../props/chair.usda@</C>)\n {\n"
          " }\n}\n");
    layer("props/chair.usda", "def \"C\" (payload = @./parts/leg.usda@</L>)\n{\n}\n");
    layer("props/parts/leg.usda", "def \"L\"\n{\n int x = 7\n}\n");
    open("def \"a\" (references = @sets/room.usda@</Room>)\n{\n}\n");
    EXPECT_EQ(number("/a/c", "x"), 7);
    ASSERT_EQ(stage->files().size(), 4u);
    for (const auto& file : stage->files()) EXPECT_TRUE(std::filesystem::exists(file)) << file;
}

TEST_F(Arcs, ExpressionsNameFiles) {
    layer("s1.usda", "def \"S\"\n{\n int x = 1\n}\n");
    layer("s2.usda", "def \"S\"\n{\n int x = 2\n}\n");
    layer("shot.usda", "(expressionVariables = { string SHOT = \"s1\" })\n"
                       "def \"a\" (references = @`\"${SHOT}.usda\"`@</S>)\n{\n}\n");
    open("(expressionVariables = { string SHOT = \"s2\" })\n"
         "def \"b\" (references = @shot.usda@</a>)\n{\n}\n"
         "def \"c\" (references = @`\"${NOWHERE}.usda\"`@</S>)\n{\n}\n");
    EXPECT_EQ(number("/b", "x"), 2); // what refers to a layer has the say
    EXPECT_EQ(warnings("no variable 'NOWHERE'"), 1u);
}

TEST_F(Arcs, WhatIsMissingIsSaidAndTheRestIsThere) {
    layer("broken.usda", "def a");
    layer("empty.usda", "");
    open("def \"a\" (references = [@none.usda@, @broken.usda@, @empty.usda@, @empty.usda@</P>, "
         "@http://x/y.usda@])\n{\n int x = 1\n}\n");
    EXPECT_EQ(number("/a", "x"), 1);
    EXPECT_EQ(warnings("reference @"), 5u);
    const Diagnostic& first = stage->diagnostics().list().front();
    EXPECT_EQ(first.where.line, 2u);
    EXPECT_NE(first.text.find("@none.usda@"), std::string::npos);
    EXPECT_NE(first.text.find("</a>"), std::string::npos);
    EXPECT_EQ(stage->files().size(), 3u); // broken.usda, too: it must not be overwritten
}

TEST_F(Arcs, CirclesAreSaidAndCut) {
    layer("other.usda", "def \"O\" (references = @root.usda@</a>)\n{\n int y = 2\n}\n");
    open("def \"a\" (references = @other.usda@</O>)\n{\n int x = 1\n}\n"
         "def \"b\"\n{\n def \"c\" (references = </b>)\n {\n }\n}\n"
         "def \"d\" (inherits = </e>)\n{\n}\ndef \"e\" (specializes = </d>)\n{\n int z = 3\n}\n");
    EXPECT_EQ(number("/a", "y"), 2);
    EXPECT_EQ(number("/d", "z"), 3);
    EXPECT_FALSE(stage->find("/b/c/c"));
    EXPECT_GE(warnings("leads in a circle"), 3u);
}

TEST_F(Arcs, WhatIsBelowAnInstanceIsShared) {
    layer("chair.usda", "def \"C\"\n{\n def \"Seat\"\n {\n  int x = 1\n }\n}\n");
    open("def \"a\" (\n references = @chair.usda@</C>\n instanceable = true\n)\n{\n"
         " over \"Seat\"\n {\n  int x = 2\n }\n def \"Own\"\n {\n }\n}\n");
    EXPECT_EQ(number("/a/Seat", "x"), 1);
    EXPECT_FALSE(stage->find("/a/Own"));
}

} // namespace penumbra
