// The text format. What is accepted and what is refused was checked against OpenUSD 24.11.
#include "io/usd/layer/UsdLayer.h"

#include "tests/io/usd/UsdTestFiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>

namespace penumbra {

namespace {

UsdLayer parsed(const std::string& text) {
    return parseUsdLayer("#usda 1.0\n" + text, "t.usda");
}

// A prim "a" with that body.
UsdPrimSpec prim(const std::string& body) {
    UsdLayer layer = parsed("def \"a\"\n{\n" + body + "\n}\n");
    return std::move(layer.prims.at(0));
}

bool accepted(const std::string& text) {
    try {
        parsed(text);
        return true;
    } catch (const SceneFileError&) {
        return false;
    }
}

bool acceptedBody(const std::string& body) {
    return accepted("def \"a\"\n{\n" + body + "\n}\n");
}

// what() of the error that `text`, the whole file, raises.
std::string errorOf(const std::string& text) {
    try {
        parseUsdLayer(text, "t.usda");
    } catch (const SceneFileError& error) {
        return error.what();
    }
    return "no error";
}

template <class T>
std::vector<T> components(const UsdPrimSpec& spec, const char* name) {
    const UsdProperty* property = spec.property(name);
    const auto* values = property ? property->value.as<T>() : nullptr;
    return values ? *values : std::vector<T>{};
}

std::string text(const UsdPrimSpec& spec, const char* name) {
    const auto values = components<std::string>(spec, name);
    return values.size() == 1 ? values[0] : "no text";
}

} // namespace

TEST(UsdLayer, TheHeaderStandsAtTheFirstByte) {
    EXPECT_NO_THROW(parseUsdLayer("#usda 1.0", "t"));
    EXPECT_NO_THROW(parseUsdLayer("#usda 1.1\ndef \"a\"\n{\n}\n", "t"));
    EXPECT_EQ(parseUsdLayer("#usda 1.7\n", "t").diagnostics.size(), 1u);
    EXPECT_THROW(parseUsdLayer("\n#usda 1.0\n", "t"), SceneFileError);
    EXPECT_THROW(parseUsdLayer("#usda 2.0\n", "t"), SceneFileError);
    EXPECT_THROW(parseUsdLayer("#usda\n", "t"), SceneFileError);
    EXPECT_THROW(parseUsdLayer("#usda 1\n", "t"), SceneFileError);
    EXPECT_THROW(parseUsdLayer("#usda 99999999999999.0\n", "t"), SceneFileError);
}

TEST(UsdLayer, WhatIsNoUsdTextIsRefusedWithAdvice) {
    EXPECT_NE(errorOf("").find("empty"), std::string::npos);
    EXPECT_NE(errorOf(std::string("PXR-USDC\0\x08", 10)).find("usdcat"), std::string::npos);
    EXPECT_NE(errorOf("PK\x03\x04xxxx").find("usdcat"), std::string::npos);
    EXPECT_NE(errorOf("\xef\xbb\xbf#usda 1.0\n").find("byte order mark"), std::string::npos);
    EXPECT_NE(errorOf("solid cube").find("not USD text"), std::string::npos);
    EXPECT_EQ(errorOf(std::string("#usda 1.0\n\0", 11)),
              "t.usda:2:1: error: a NUL byte in a text file");
    EXPECT_EQ(errorOf("#usda 1.0\n#\xff\n"), "t.usda:2:2: error: this byte is not valid UTF-8");
}

TEST(UsdLayer, FoldersMissingAndOversizedFilesAreRefused) {
    const TemporaryFolder folder;
    const auto file = folder.write("a.usda", "#usda 1.0\n");
    EXPECT_NO_THROW(readUsdLayer(file));
    EXPECT_THROW(readUsdLayer(folder.path()), SceneFileError);
    EXPECT_THROW(readUsdLayer(folder.path() / "none.usda"), SceneFileError);
    EXPECT_THROW(readUsdLayer(file, {.fileBytes = 5}), SceneFileError);
}

TEST(UsdLayer, ErrorsNameFileLineAndColumn) {
    EXPECT_EQ(errorOf("#usda 1.0\ndef \"a\"\n{\n    int x = 1.0f\n}\n"),
              "t.usda:4:13: error: malformed number");
    EXPECT_EQ(errorOf("#usda 1.0\r\ndef \"a\"\r\n{\r\n  rel r = \"/b\"\r\n}\r\n"),
              "t.usda:4:11: error: expected a <path>, found '\"'");
    EXPECT_EQ(errorOf("#usda 1.0\ndef \"a\"\n{\n    string s = \"x\n}\n"),
              "t.usda:4:16: error: this string is not closed");
    EXPECT_EQ(errorOf("#usda 1.0\ndef \"a\"\n{\n    def \"b\"\n    {\n"),
              "t.usda:6:1: error: the file ends, but the '{' of line 5 (</a/b>) is not closed");
}

TEST(UsdLayer, NumbersAreReadAsTheTypeSays) {
    const UsdPrimSpec a = prim("int i = 1.5\nint64 l = -9007199254740993\n"
                               "uint64 u = 18446744073709551615\nfloat f = 1.5e-3\nhalf h = 0.1\n"
                               "uchar c = 255\ntimecode t = 24\nfloat big = 1e39\nint z = 007\n"
                               "int m = -2147483648");
    EXPECT_EQ(components<std::int32_t>(a, "i"), std::vector<std::int32_t>{1});
    EXPECT_EQ(components<std::int64_t>(a, "l"), std::vector<std::int64_t>{-9007199254740993});
    EXPECT_EQ(components<std::uint64_t>(a, "u"), std::vector<std::uint64_t>{18446744073709551615u});
    EXPECT_EQ(components<float>(a, "f"), std::vector<float>{0.0015f});
    EXPECT_EQ(components<float>(a, "h"), std::vector<float>{0.0999755859375f});
    EXPECT_EQ(components<std::uint8_t>(a, "c"), std::vector<std::uint8_t>{255});
    EXPECT_EQ(components<double>(a, "t"), std::vector<double>{24});
    EXPECT_TRUE(std::isinf(components<float>(a, "big").at(0)));
    EXPECT_EQ(components<std::int32_t>(a, "z"), std::vector<std::int32_t>{7});
    EXPECT_EQ(components<std::int32_t>(a, "m"), std::vector<std::int32_t>{-2147483647 - 1});
    for (const char* bad :
         {"uint x = -1", "uchar x = 256", "int x = 2147483648", "int x = 3e9", "int x = inf",
          "int64 x = 9223372036854775808", "int x = nan", "float x = \"1.5\"", "float x = +1",
          "float x = 1,5", "float x = 0x10", "token x = y", "int x = [1]"})
        EXPECT_FALSE(acceptedBody(bad)) << bad;
}

TEST(UsdLayer, BoolsHaveManyFaces) {
    const UsdPrimSpec a = prim("bool[] x = [1, 0, true, False, \"yes\", no, 2, 0.5]");
    EXPECT_EQ(components<std::uint8_t>(a, "x"),
              (std::vector<std::uint8_t>{1, 0, 1, 0, 1, 0, 1, 1}));
    EXPECT_FALSE(acceptedBody("bool x = maybe"));
}

TEST(UsdLayer, StringsResolveTheirEscapes) {
    const UsdPrimSpec a =
        prim("string e = \"t\\t n\\n q\\\" b\\\\ \\x41\\101\\q\"\nstring s = 'it\"s'\n"
             "string l = \"\"\"one\n\"two\" '3'\"\"\"\nstring n = \"a\\0b\"\nstring z = \"\"");
    EXPECT_EQ(text(a, "e"), "t\t n\n q\" b\\ AAq");
    EXPECT_EQ(text(a, "s"), "it\"s");
    EXPECT_EQ(text(a, "l"), "one\n\"two\" '3'");
    EXPECT_EQ(text(a, "n"), "a"); // OpenUSD cuts at a NUL, too
    EXPECT_EQ(text(a, "z"), "");
    EXPECT_FALSE(acceptedBody("string s = \"\"\"abc\"\"\"\""));
    EXPECT_FALSE(acceptedBody("string s = \"abc"));
    EXPECT_FALSE(acceptedBody("string s = '''abc"));
}

TEST(UsdLayer, AssetPathsMayHoldNearlyAnything) {
    const UsdPrimSpec a =
        prim("asset a = @./x y#1.png@\nasset b = @@\nasset c = @@@we@ird@@@\n"
             "asset d = @@@end@@@@@\nasset e = @@@a\\@@@b@@@\nasset f = \"text.png\"");
    EXPECT_EQ(text(a, "a"), "./x y#1.png");
    EXPECT_EQ(text(a, "b"), "");
    EXPECT_EQ(text(a, "c"), "we@ird");
    EXPECT_EQ(text(a, "d"), "end@@");
    EXPECT_EQ(text(a, "e"), "a@@@b");
    EXPECT_EQ(text(a, "f"), "text.png");
    EXPECT_FALSE(acceptedBody("asset a = @x.png"));
}

TEST(UsdLayer, TuplesAndArraysLieFlat) {
    const UsdPrimSpec a =
        prim("float3 t = (1, 2, 3,)\npoint3f[] p = [(1, 2, 3), (4, 5, 6),]\n"
             "matrix2d m = ( (1, 2), (3, 4) )\nint[] n = [[1, 2], [3]]\nint [ ] b = [ ]\n"
             "int[] w = [\n 1,\n 2\n]");
    EXPECT_EQ(components<float>(a, "t"), (std::vector<float>{1, 2, 3}));
    EXPECT_EQ(components<float>(a, "p"), (std::vector<float>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(a.property("p")->value.size(), 2u);
    EXPECT_EQ(components<double>(a, "m"), (std::vector<double>{1, 2, 3, 4}));
    EXPECT_EQ(components<std::int32_t>(a, "n"), (std::vector<std::int32_t>{1, 2, 3}));
    EXPECT_EQ(a.property("b")->value.size(), 0u);
    EXPECT_EQ(components<std::int32_t>(a, "w"), (std::vector<std::int32_t>{1, 2}));
    for (const char* bad :
         {"int[] a = [1 2]", "int[] a = [1,, 2]", "int[] a = [\n]", "int[] a = [1\n, 2]",
          "int[] a = [1", "float3 a = (1, 2)", "float3 a = (1, 2, 3, 4)", "float3 a = 1",
          "float[] a = [1, None]", "matrix2d a = (1, 0, 0, 1)"})
        EXPECT_FALSE(acceptedBody(bad)) << bad;
}

TEST(UsdLayer, StatementsNeedSeparators) {
    EXPECT_TRUE(acceptedBody("int x = 1; int y = 2"));
    EXPECT_TRUE(accepted("def \"a\" { int x = 1; }\n"));
    EXPECT_TRUE(accepted("def \"a\" {}\n"));
    EXPECT_FALSE(acceptedBody("int x = 1 int y = 2"));
    EXPECT_FALSE(accepted("def \"a\" { int x = 1 }\n"));
    EXPECT_FALSE(accepted("def \"a\" {} def \"b\" {}\n"));
    EXPECT_FALSE(accepted("def \"a\" { def \"b\" {} }\n"));
    EXPECT_FALSE(accepted("(upAxis = \"Z\" metersPerUnit = 1)\n"));
    EXPECT_FALSE(accepted("def \"a\" (kind = \"x\", hidden = true)\n{\n}\n"));
    EXPECT_FALSE(accepted("def \"a\"\n{\n}\n}\n"));
}

TEST(UsdLayer, CommentsStandWhereBlanksMay) {
    EXPECT_TRUE(
        accepted("# a\n// b\n/* c\n d */\ndef /*e*/ \"a\" # f\n{\n int y /* g */ = 2 // h\n}\n"));
    EXPECT_FALSE(accepted("def/*c*/\"a\"\n{\n}\n"));
    EXPECT_FALSE(accepted("/* never closed\n"));
}

TEST(UsdLayer, PrimsAreDefOverOrClass) {
    const UsdLayer layer =
        parsed("over \"a\"\n{\n}\nclass ns::Type '_c'\n{\n}\ndef Xform \"d\" (\n  \"note\"\n"
               "  kind = \"group\"\n  active = false\n)\n{\n    def \"e\"\n    {\n    }\n}\n");
    ASSERT_EQ(layer.prims.size(), 3u);
    EXPECT_EQ(layer.prims[0].specifier, UsdSpecifier::over);
    EXPECT_EQ(layer.prims[1].specifier, UsdSpecifier::classes);
    EXPECT_EQ(layer.prims[1].typeName, "ns::Type");
    EXPECT_EQ(layer.prims[2].children.at(0).name, "e");
    EXPECT_EQ(layer.prims[2].where.line, 8u);
    ASSERT_TRUE(find(layer.prims[2].metadata, "kind"));
    EXPECT_EQ(*find(layer.prims[2].metadata, "kind")->text(), "group");
    EXPECT_EQ(*find(layer.prims[2].metadata, "comment")->text(), "note");
    for (const char* bad :
         {"def \"1a\"\n{\n}\n", "def a\n{\n}\n", "def \"a-b\"\n{\n}\n", "def \"\"\n{\n}\n",
          "def \"a\"\n", "def \"a\"\n{\n}\ndef \"a\"\n{\n}\n", "def \"\\xff\"\n{\n}\n"})
        EXPECT_FALSE(accepted(bad)) << bad;
}

TEST(UsdLayer, SeparateStatementsAboutOnePropertyAddUp) {
    const UsdPrimSpec a = prim(
        "float x = 1 (doc = \"d\")\nfloat x = 2\nfloat x.timeSamples = { 5: 1, 1: None, 5: 3, }\n"
        "float x.connect = </a.y>\ncustom uniform token rel = \"r\"\nfloat def\n");
    ASSERT_EQ(a.properties.size(), 3u);
    const UsdProperty& x = *a.property("x");
    EXPECT_EQ(components<float>(a, "x"), std::vector<float>{2});
    ASSERT_EQ(x.samples.size(), 2u); // sorted, the last of equal times
    EXPECT_EQ(x.samples[0].time, 1);
    EXPECT_TRUE(x.samples[0].value.blocked());
    EXPECT_EQ(*x.samples[1].value.as<float>(), std::vector<float>{3});
    EXPECT_EQ(x.targets.at(0).items, std::vector<std::string>{"/a.y"});
    EXPECT_EQ(*find(x.metadata, "doc")->text(), "d");
    EXPECT_TRUE(a.property("rel")->uniform && a.property("rel")->custom);
    EXPECT_TRUE(a.property("def")->value.empty());
    for (const char* bad :
         {"float x = 1\ndouble x = 2", "rel x\nfloat x", "uniform custom int x = 1",
          "varying float x = 1", "uniform rel x", "float a:1b = 1", "float x = 1\n(doc = \"d\")",
          "rel r = [</b>, </b>]", "prepend float x = 1", "float x.timeSamples = { inf: 1 }",
          "float x.what = 1"})
        EXPECT_FALSE(acceptedBody(bad)) << bad;
}

TEST(UsdLayer, RelationshipsKeepTheirTargetsAbsolute) {
    const UsdPrimSpec a = prim(
        "rel r0\nrel r1 = <../b.c>\nrel r2 = [</b>, <c>]\nrel r3 = None\nprepend rel r4 = </b>\n"
        "delete rel r4 = </c>\ncustom varying rel r5 (bindMaterialAs = \"x\")\nrel r6 = []");
    EXPECT_TRUE(a.property("r0")->targets.empty());
    EXPECT_EQ(a.property("r1")->targets.at(0).items, std::vector<std::string>{"/b.c"});
    EXPECT_EQ(a.property("r2")->targets.at(0).items, (std::vector<std::string>{"/b", "/a/c"}));
    EXPECT_TRUE(a.property("r3")->targets.at(0).items.empty());
    ASSERT_EQ(a.property("r4")->targets.size(), 2u);
    EXPECT_EQ(a.property("r4")->targets[0].op, UsdListOp::prepend);
    EXPECT_EQ(a.property("r4")->targets[1].op, UsdListOp::remove);
}

TEST(UsdLayer, ArcsKeepAssetPathAndOffset) {
    const UsdLayer layer =
        parsed("(subLayers = [@./a.usda@ (offset = 10; scale = 0.5), @b.usda@])\n"
               "def \"a\" (\n prepend references = [@x.usda@</P> (offset = 2), </_k>]\n"
               " payload = @y.usda@\n inherits = </_k>\n apiSchemas = [\"A\"]\n prepend apiSchemas "
               "= [\"B\"]\n"
               " variants = { string look = \"red\" }\n variantSets = \"look\"\n)\n{\n}\n");
    ASSERT_EQ(layer.subLayers.size(), 2u);
    EXPECT_EQ(layer.subLayers[0].asset, "./a.usda");
    EXPECT_EQ(layer.subLayers[0].offset.offset, 10);
    EXPECT_EQ(layer.subLayers[0].offset.scale, 0.5);
    const UsdArcs& arcs = *layer.prims.at(0).arcs;
    ASSERT_EQ(arcs.references.at(0).items.size(), 2u);
    EXPECT_EQ(arcs.references[0].items[0].path, "/P");
    EXPECT_EQ(arcs.references[0].items[0].offset.offset, 2);
    EXPECT_EQ(arcs.references[0].items[1].asset, "");
    ASSERT_EQ(arcs.apiSchemas.size(), 1u); // the later one wins over the explicit one
    EXPECT_EQ(arcs.apiSchemas[0].items, std::vector<std::string>{"B"});
    EXPECT_EQ(*find(arcs.variants, "look")->text(), "red");
    for (const char* bad :
         {"references = \"x.usda\"", "references = @x@</b.c>", "inherits = </k.x>",
          "references = <b>", "prepend apiSchemas = \"A\"", "kind = component"})
        EXPECT_FALSE(accepted(std::string("def \"a\" (\n ") + bad + "\n)\n{\n}\n")) << bad;
}

TEST(UsdLayer, VariantsAreBodiesOfTheirOwn) {
    const UsdPrimSpec a = prim("variantSet \"look\" = {\n \"red\" {\n  color3f c = (1, 0, 0)\n }\n"
                               " \"2-blue\" (\n kind = \"x\"\n ) {\n  over \"child\"\n  {\n  }\n  "
                               "variantSet \"in\" = {\n   \"v\" {\n   }\n  }\n }\n}");
    ASSERT_EQ(a.variantSets.size(), 1u);
    ASSERT_EQ(a.variantSets[0].variants.size(), 2u);
    EXPECT_EQ(a.variantSets[0].variants[0].properties.size(), 1u);
    EXPECT_EQ(a.variantSets[0].variants[1].name, "2-blue");
    EXPECT_EQ(a.variantSets[0].variants[1].children.at(0).name, "child");
    EXPECT_EQ(a.variantSets[0].variants[1].variantSets.at(0).name, "in");
    EXPECT_FALSE(acceptedBody("variantSet \"x\" = {\n}"));
}

TEST(UsdLayer, UnknownTypesAndKeysAreKeptAsText) {
    const UsdLayer layer = parsed(
        "(\n strangeKey = [1, (2, \"]\"), { int x = 1 }]\n upAxis = \"Y\"\n upAxis = \"Z\"\n)\n"
        "def \"a\"\n{\n float5 x = (1, 2, 3, 4, 5) (doc = \"d\")\n}\n");
    EXPECT_EQ(std::get<UsdRaw>(find(layer.metadata, "strangeKey")->data).text,
              "[1, (2, \"]\"), { int x = 1 }]");
    EXPECT_EQ(*find(layer.metadata, "upAxis")->text(), "Z"); // the last one wins
    const UsdProperty& x = *layer.prims.at(0).property("x");
    EXPECT_EQ(std::get<UsdRaw>(x.value.data).text, "(1, 2, 3, 4, 5)");
    EXPECT_TRUE(find(x.metadata, "doc"));
}

TEST(UsdLayer, DictionariesNest) {
    const UsdLayer layer = parsed("(customLayerData = {\n string rel = \"x\"; int def = 2\n "
                                  "dictionary \"a b\" = {\n  float3 c = (1, 2, 3)\n }\n})\n");
    const UsdDictionary& data = *find(layer.metadata, "customLayerData")->dictionary();
    EXPECT_EQ(*find(data, "rel")->text(), "x");
    EXPECT_EQ(*find(data, "def")->as<std::int32_t>(), std::vector<std::int32_t>{2});
    EXPECT_EQ(find(*find(data, "a b")->dictionary(), "c")->numbers(),
              (std::vector<double>{1, 2, 3}));
    EXPECT_FALSE(accepted("(customLayerData = { int a = 1, int b = 2 })\n"));
}

TEST(UsdLayer, SplinesAreSkippedInTheFormatThatHasThem) {
    const std::string body =
        "def \"a\"\n{\n double x.spline = {\n 1: 5; post held,\n 2: 7\n }\n}\n";
    EXPECT_EQ(parseUsdLayer("#usda 1.1\n" + body, "t").diagnostics.size(), 1u);
    EXPECT_THROW(parseUsdLayer("#usda 1.0\n" + body, "t"), SceneFileError);
}

// Ten million brackets, dictionaries and prims: one short error each, at once.
TEST(UsdLayer, NestingIsLimitedAndFailsFast) {
    const auto repeated = [](const std::string& text, int times) {
        std::string all;
        for (int i = 0; i < times; ++i) all += text;
        return all;
    };
    const auto start = std::chrono::steady_clock::now();
    for (const std::string& text :
         {std::string(10'000'000, '('), "def \"a\"\n{\nfoo x = " + std::string(10'000'000, '('),
          "def \"a\"\n{\nint[] x = " + std::string(10'000'000, '['),
          "(customLayerData = {" + repeated("dictionary a = {", 100'000),
          repeated("def \"a\" {\n", 100'000),
          "def \"a\" {\n" + repeated("variantSet \"s\" = {\n\"v\" {\n", 100'000)}) {
        const std::string error = errorOf("#usda 1.0\n" + text);
        EXPECT_NE(error, "no error");
        EXPECT_LT(error.size(), 200u);
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    EXPECT_LT(seconds.count(), 5.0); // half a second without sanitizers
    EXPECT_TRUE(accepted(repeated("def \"a\" {\n", 1000) + repeated("}\n", 1000)));
}

TEST(UsdLayer, ManyRepeatedNamesAreFoundInLinearTime) {
    std::string text = "def \"a\"\n{\n";
    for (int i = 0; i < 100'000; ++i) text += "int x" + std::to_string(i) + " = 1\n";
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(parsed(text + "}\n").prims.at(0).properties.size(), 100'000u);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    EXPECT_LT(seconds.count(), 5.0);
}

// 86 micro files, each with OpenUSD's own verdict.
TEST(UsdLayer, AcceptsExactlyTheMicroFilesThatOpenUsdAccepts) {
    const auto shared = sharedFolder();
    if (!shared) GTEST_SKIP() << "the shared grammar files are not here";
    std::ifstream in(*shared / "assets/grammar/expected.tsv");
    std::string name;
    std::string verdict;
    int files = 0;
    for (; in >> name >> verdict; ++files) {
        std::string found = "ok";
        try {
            readUsdLayer(*shared / "assets/grammar" / (name + ".usda"));
        } catch (const SceneFileError&) {
            found = "ERR";
        }
        EXPECT_EQ(found, verdict) << name;
    }
    EXPECT_EQ(files, 86);
}

} // namespace penumbra
