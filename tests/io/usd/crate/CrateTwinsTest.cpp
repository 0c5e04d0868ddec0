// Binary layers of others beside the same layers as text: the "AOUSD core" test files.
#include "io/usd/crate/UsdFiles.h"
#include "io/usd/text/UsdLayerWriter.h"
#include "tests/io/usd/UsdTestFiles.h"
#include "tests/io/usd/crate/LayerDifference.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <iostream>

namespace penumbra {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> filesBelow(const fs::path& folder, const std::string& extension) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().extension() == extension) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

/// Pairs of one layer as binary and as text, which the folder `usda` beside it holds.
std::vector<std::pair<fs::path, fs::path>> twinsBelow(const fs::path& folder) {
    std::vector<std::pair<fs::path, fs::path>> twins;
    for (const fs::path& file : filesBelow(folder, ".usd")) {
        fs::path text = file.parent_path() / "usda" / file.filename();
        if (!fs::exists(text)) text.replace_extension(".usda");
        const bool damaged = text.parent_path().parent_path().filename() == "clip_basic" &&
                             text.filename() == "ref.usda"; // it begins with "4#usda"
        if (fs::exists(text) && !damaged) twins.emplace_back(file, text);
    }
    return twins;
}

// The binary files were made of text with returns before its newlines, the text beside them has
// none: these differ in comments of several lines.
void dropReturns(UsdDictionary& metadata) {
    for (UsdNamedValue& entry : metadata)
        if (auto* strings = std::get_if<std::vector<std::string>>(&entry.value.data))
            for (std::string& text : *strings) std::erase(text, '\r');
}
void dropReturns(std::vector<UsdPrimSpec>& prims) {
    for (UsdPrimSpec& prim : prims) {
        dropReturns(prim.metadata);
        for (UsdProperty& property : prim.properties) dropReturns(property.metadata);
        for (UsdVariantSet& set : prim.variantSets) dropReturns(set.variants);
        dropReturns(prim.children);
    }
}

void expectTwinsAreEqual(const std::string& folder) {
    const auto shared = sharedFolder();
    if (!shared || !fs::exists(*shared / "assets/aousd"))
        GTEST_SKIP() << "the AOUSD files are not here";
    std::size_t equal = 0;
    const auto twins = twinsBelow(*shared / "assets/aousd" / folder);
    for (const auto& [binary, text] : twins) {
        UsdLayer layer = readAnyUsdLayer(binary);
        dropReturns(layer.metadata);
        dropReturns(layer.prims);
        const std::string difference = differenceOf(layer, readAnyUsdLayer(text));
        EXPECT_EQ(difference, "") << binary;
        equal += difference.empty();
    }
    std::cout << folder << ": " << equal << " of " << twins.size() << " pairs are equal\n";
    EXPECT_GT(twins.size(), 10u);
}

TEST(CrateTwins, CompositionLayersAreEqualToTheirText) {
    expectTwinsAreEqual("composition");
}

TEST(CrateTwins, ValueResolutionLayersAreEqualToTheirText) {
    expectTwinsAreEqual("value_resolution");
}

TEST(CrateTwins, EveryBinaryLayerReadsBackFromItsText) {
    const auto shared = sharedFolder();
    if (!shared || !fs::exists(*shared / "assets/aousd"))
        GTEST_SKIP() << "the AOUSD files are not here";
    auto files = filesBelow(*shared / "assets/aousd", ".usd");
    const auto binary = filesBelow(*shared / "assets/aousd/binary", ".usdc");
    files.insert(files.end(), binary.begin(), binary.end());
    std::size_t read = 0, splines = 0;
    for (const fs::path& file : files) {
        if (file.parent_path().filename() == "usda") continue;
        SCOPED_TRACE(file);
        const UsdLayer layer = readAnyUsdLayer(file);
        const std::string text = usdLayerText(layer);
        for (const Diagnostic& said : layer.diagnostics) {
            EXPECT_THAT(said.text, testing::HasSubstr("splines are not read"));
            ++splines;
        }
        UsdLayer again;
        ASSERT_NO_THROW(again = parseUsdLayer(text, "again.usda")) << text;
        EXPECT_EQ(differenceOf(layer, again), "");
        EXPECT_EQ(usdLayerText(again), text);
        ++read;
    }
    std::cout << read << " binary layers written as text and read back; " << splines
              << " splines left out\n";
}

} // namespace
} // namespace penumbra
