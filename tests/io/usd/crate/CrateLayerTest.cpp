// Crate files that the tests make themselves.
#include "io/usd/crate/CrateLayer.h"
#include "io/usd/text/UsdLayerWriter.h"
#include "tests/io/usd/crate/CrateSample.h"
#include "tests/io/usd/crate/LayerDifference.h"
#include "tests/support/CrateWriter.h"

#include <gmock/gmock.h>

#include <chrono>

namespace penumbra {
namespace {

UsdLayer layerOf(const std::string& bytes) {
    return readCrateLayer(std::as_bytes(std::span(bytes)), "t.usdc");
}

std::string errorOf(const std::string& bytes) {
    try {
        layerOf(bytes);
    } catch (const SceneFileError& error) {
        return error.what();
    }
    return "no error";
}

std::string firstWarning(const UsdLayer& layer) {
    return layer.diagnostics.empty() ? "" : layer.diagnostics.front().text;
}

/// A layer of one prim /A with an attribute `a`.
UsdLayer withAttribute(CrateWriter& out, const std::string& type, std::uint64_t value) {
    const auto name = [&](const std::string& text) {
        return CrateWriter::inlined(11, out.token(text));
    };
    const std::uint32_t a = out.path(0, "A");
    out.spec(0, 7, {{"primChildren", out.tokens({"A"})}});
    out.spec(a, 6, {{"properties", out.tokens({"a"})}});
    out.spec(out.path(a, "a", true), 1, {{"typeName", name(type)}, {"default", value}});
    return layerOf(out.bytes());
}

} // namespace

TEST(CrateLayer, EachVersionGivesTheLayerOfTheText) {
    const UsdLayer text = parseUsdLayer(std::string(kSampleText), "t.usda");
    for (const int minor : {0, 1, 4, 5, 6, 7, 8, 12, 14}) {
        SCOPED_TRACE(minor);
        const UsdLayer layer = layerOf(sampleCrate(minor));
        EXPECT_EQ(differenceOf(layer, text), "");
        EXPECT_EQ(firstWarning(layer), "");
    }
    EXPECT_THAT(errorOf(sampleCrate(15)), testing::HasSubstr("version 0.15 is not supported"));
}

// A package may place it so.
TEST(CrateLayer, AFileThatLiesAtAnOddAddressGivesTheSameLayer) {
    const UsdLayer text = parseUsdLayer(std::string(kSampleText), "t.usda");
    for (std::size_t shift = 1; shift < 8; ++shift) {
        const std::string bytes = std::string(shift, ' ') + sampleCrate(8);
        const auto file = std::as_bytes(std::span(bytes)).subspan(shift);
        EXPECT_EQ(differenceOf(readCrateLayer(file, "t.usdc"), text), "") << shift;
    }
}

TEST(CrateLayer, TheTextOfALayerGivesTheSameLayer) {
    const UsdLayer layer = layerOf(sampleCrate(8));
    const std::string text = usdLayerText(layer);
    EXPECT_EQ(differenceOf(parseUsdLayer(text, "t.usda"), layer), "") << text;
}

TEST(CrateLayer, AValueThatCantBeReadIsLeftOutAndTheRestIsKept) {
    struct Case {
        std::uint64_t value;
        const char* why;
    };
    const std::uint64_t arrayEdit = std::uint64_t(1) << 60;
    for (const auto& [value, why] :
         {Case{arrayEdit | CrateWriter::array(8, 90), "array edits are not supported"},
          Case{CrateWriter::inlined(17, 1), "can't be inlined"},
          Case{CrateWriter::rep(61, 0), "values of type 61 can't be read"},
          Case{CrateWriter::rep(0, 0), "values of type 0 can't be read"},
          Case{CrateWriter::rep(9, 1 << 30), "leads out of the file"},
          Case{CrateWriter::array(8, 88), "goes beyond the end of the file"},
          Case{CrateWriter::inlined(10, 12345), "a string that is not there"},
          Case{CrateWriter::inlined(11, 12345), "a token that is not there"}}) {
        CrateWriter out;
        out.put(std::uint64_t(1) << 60); // at 88: as a count, too much
        const UsdLayer layer = withAttribute(out, "float", value);
        SCOPED_TRACE(why);
        ASSERT_EQ(layer.prims.size(), 1u);
        ASSERT_EQ(layer.prims[0].properties.size(), 1u);
        EXPECT_TRUE(layer.prims[0].properties[0].value.empty());
        ASSERT_EQ(layer.diagnostics.size(), 1u);
        EXPECT_THAT(firstWarning(layer), testing::HasSubstr(why));
        EXPECT_THAT(firstWarning(layer), testing::HasSubstr("'default' of </A.a> left out"));
    }
}

TEST(CrateLayer, NumbersOfAnotherKindAreConverted) {
    CrateWriter out;
    const UsdLayer layer = withAttribute(out, "float", CrateWriter::inlined(3, 7));
    EXPECT_EQ(layer.prims[0].properties[0].value,
              (UsdValue{usdTypeNamed("float"), std::vector<float>{7}}));
}

// Compressed with the code `t`: two doubles, and 16 indices of them.
TEST(CrateLayer, ArraysMayBeIndicesOfATable) {
    for (const std::int32_t last : {1, 2}) {
        CrateWriter out;
        const std::uint64_t at = out.arrayHead(16);
        std::vector<std::int32_t> indices(16, 1);
        indices.back() = last;
        out.put('t').put(std::uint32_t(2)).put(0.5).put(-3.0);
        out.put(CrateWriter::packedIntegers(indices));
        const UsdLayer layer = withAttribute(out, "double[]", CrateWriter::array(9, at, true));
        const UsdValue& value = layer.prims[0].properties[0].value;
        if (last == 1)
            EXPECT_EQ(*value.as<double>(), std::vector<double>(16, -3.0));
        else
            EXPECT_THAT(firstWarning(layer), testing::HasSubstr("outside its table"));
    }
}

TEST(CrateLayer, ChildrenThatAreNotThereOrTwiceAreLeftOut) {
    CrateWriter out;
    const std::uint32_t a = out.path(0, "A");
    out.path(0, "C"); // a path without a spec
    out.spec(0, 7, {{"primChildren", out.tokens({"A", "B", "A", "C"})}});
    out.spec(a, 6, {});
    out.rawSpec(a, 0, 6);     // a second spec of one path
    out.rawSpec(12345, 0, 6); // no path
    out.rawSpec(a, 12345, 6); // no fields
    out.rawSpec(a, 0, 12);    // no such form
    const UsdLayer layer = layerOf(out.bytes());
    EXPECT_EQ(layer.prims.size(), 1u);
    EXPECT_EQ(layer.diagnostics.size(), 7u);
}

TEST(CrateLayer, PrimsWithImpossibleNamesAreLeftOut) {
    CrateWriter out;
    for (const char* name : {"..", "a/b", "", "{x", "a b"}) out.spec(out.path(0, name), 6, {});
    out.spec(0, 7, {{"primChildren", out.tokens({"..", "a/b", "", "{x", "a b"})}});
    const UsdLayer layer = layerOf(out.bytes());
    EXPECT_TRUE(layer.prims.empty());
    EXPECT_FALSE(layer.diagnostics.empty());
}

// One name of a megabyte, named by many: in a list of children, by fields, in paths. Copying or
// hashing it each time would take a minute.
TEST(CrateLayer, LongNamesCostNoMoreThanTheirLength) {
    CrateWriter out;
    const std::string name(1'000'000, 'n');
    const std::uint32_t a = out.path(0, "A"), token = out.token(name);
    const std::uint64_t list = out.here();
    out.put(std::uint64_t(9000));
    for (int i = 0; i < 9000; ++i) out.put(token);
    out.spec(a, 6, {{"properties", CrateWriter::rep(41, list)}});
    out.path(a, name);
    out.path(a, name, true);
    CrateWriter::Fields fields{{"primChildren", out.tokens({"A"})}};
    for (int i = 0; i < 50; ++i) fields.emplace_back(name, CrateWriter::inlined(3, 0));
    out.spec(0, 7, fields);
    const std::string bytes = out.bytes();
    const auto begin = std::chrono::steady_clock::now();
    const UsdLayer layer = layerOf(bytes);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
    ASSERT_EQ(layer.prims.size(), 1u);
    EXPECT_TRUE(layer.prims[0].properties.empty());
    EXPECT_FALSE(layer.diagnostics.empty());
}

TEST(CrateLayer, TooDeepATreeIsRefused) {
    for (const int depth : {1000, 1100}) {
        CrateWriter out;
        std::uint32_t path = 0;
        for (int i = 0; i < depth; ++i) path = out.path(path, "a");
        EXPECT_THAT(errorOf(out.bytes()),
                    testing::HasSubstr(depth > 1024 ? "nested too deeply" : "no error"));
    }
}

// 40 dictionaries, each with the next one twice: 2^40 entries, if they are all made.
TEST(CrateLayer, DictionariesThatDoubleAtEachLevelAreRefused) {
    CrateWriter out;
    std::uint64_t next = CrateWriter::inlined(31, 0);
    for (int level = 0; level < 40; ++level) {
        const std::uint64_t at = out.here();
        out.put(std::uint64_t(2));
        for (const char* name : {"a", "b"})
            out.put(out.string(name)).put(std::int64_t(8)).put(next);
        next = CrateWriter::rep(31, at);
    }
    out.spec(0, 7, {{"customLayerData", next}});
    EXPECT_THAT(errorOf(out.bytes()), testing::HasSubstr("unfolds to more"));
}

TEST(CrateLayer, ADictionaryInItselfIsLeftOut) {
    CrateWriter out;
    const std::uint64_t at = out.here();
    out.put(std::uint64_t(1)).put(out.string("a")).put(std::int64_t(8));
    out.put(CrateWriter::rep(31, at));
    out.spec(0, 7, {{"customLayerData", CrateWriter::rep(31, at)}});
    EXPECT_THAT(firstWarning(layerOf(out.bytes())), testing::HasSubstr("nested too deeply"));
}

// A thousand attributes share one array of 100,000 numbers: 400 MB from 400 kB.
TEST(CrateLayer, SharedArraysAreRefusedBeforeTheyFillTheMemory) {
    CrateWriter out;
    const std::uint64_t array = out.plainArray(8, std::vector<float>(100'000), 100'000);
    const std::uint32_t a = out.path(0, "A");
    std::vector<std::string> names;
    for (int i = 0; i < 1000; ++i) {
        names.push_back("a" + std::to_string(i));
        out.spec(
            out.path(a, names.back(), true), 1,
            {{"typeName", CrateWriter::inlined(11, out.token("float[]"))}, {"default", array}});
    }
    out.spec(a, 6, {{"properties", out.tokens(names)}});
    out.spec(0, 7, {{"primChildren", out.tokens({"A"})}});
    EXPECT_THAT(errorOf(out.bytes()), testing::HasSubstr("unfolds to more"));
}

TEST(CrateLayer, SamplesWhoseTimesDontRiseAreLeftOut) {
    for (const std::vector<double>& times :
         {std::vector<double>{1, 1}, std::vector<double>{2, 1}, std::vector<double>{0, NAN}}) {
        CrateWriter out;
        const std::uint32_t a = out.path(0, "A");
        const std::uint64_t value = CrateWriter::inlined(8, 0);
        out.spec(out.path(a, "a", true), 1,
                 {{"typeName", CrateWriter::inlined(11, out.token("float"))},
                  {"timeSamples", out.samples(times, {value, value})}});
        out.spec(a, 6, {{"properties", out.tokens({"a"})}});
        out.spec(0, 7, {{"primChildren", out.tokens({"A"})}});
        EXPECT_THAT(firstWarning(layerOf(out.bytes())), testing::HasSubstr("don't rise"));
    }
}

TEST(CrateLayer, TextThatIsNotUtf8IsMended) {
    CrateWriter out;
    out.spec(0, 7,
             {{"documentation", CrateWriter::inlined(10, out.string("a\xff"
                                                                    "b"))}});
    const UsdLayer layer = layerOf(out.bytes());
    EXPECT_EQ(*find(layer.metadata, "doc")->text(), "a?b");
    EXPECT_THAT(firstWarning(layer), testing::HasSubstr("not UTF-8"));
}

} // namespace penumbra
