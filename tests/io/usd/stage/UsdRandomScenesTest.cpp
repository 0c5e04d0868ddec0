// Scenes with arcs at random, most of them nonsense: composing them ends, and always the same way.
#include "io/usd/stage/UsdReport.h"
#include "io/usd/stage/UsdStage.h"
#include "tests/io/usd/RandomLayers.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

std::string reportOf(const std::filesystem::path& root, const UsdComposeLimits& limits) {
    const UsdAssets assets;
    UsdComposition composition(root, limits, assets);
    std::string text;
    reportComposition(composition, [&](const UsdPrimReport& prim) {
        text += prim.path + "\n";
        for (const auto& [layer, path] : prim.primStack) text += " " + layer + " " + path + "\n";
        for (const auto& [property, targets] : prim.targets)
            for (const std::string& target : targets) text += " " + target + "\n";
    });
    for (const auto& error : composition.errors().list()) text += error.text + "\n";
    return text;
}

} // namespace

TEST(UsdRandomScenes, AreComposedToTheEndAndAlwaysTheSame) {
    UsdComposeLimits limits; // small, for these scenes grow beyond any
    limits.prims = 60;
    limits.index.nodes = 200;
    std::size_t characters = 0;
    for (unsigned seed = 0; seed < 40; ++seed) {
        SCOPED_TRACE(seed);
        const TemporaryFolder folder;
        writeRandomLayers(folder, seed);
        const std::string first = reportOf(folder.path() / "0.usda", limits);
        EXPECT_EQ(first, reportOf(folder.path() / "0.usda", limits));
        characters += first.size();
        EXPECT_GT(UsdStage::open(folder.path() / "0.usda", limits).prims().size(), 1u);
    }
    EXPECT_GT(characters, 40'000u);
}

} // namespace penumbra
