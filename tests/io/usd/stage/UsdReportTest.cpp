// A composition spelt out: names of layers, bounds, and what is said of it.
#include "io/usd/stage/UsdReport.h"
#include "tests/io/usd/UsdTestFiles.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

const std::string kHeader = "#usda 1.0\n";

class Report : public testing::Test {
protected:
    void open(const std::filesystem::path& root, const UsdComposeLimits& limits = {}) {
        composition.emplace(root, limits, assets);
        prims.clear();
        reportComposition(*composition,
                          [this](const UsdPrimReport& prim) { prims.push_back(prim); });
    }
    std::size_t errors(const std::string& text) {
        std::size_t count = 0;
        for (const auto& error : composition->errors().list())
            count += error.text.find(text) != std::string::npos;
        return count;
    }

    TemporaryFolder folder;
    UsdAssets assets;
    std::optional<UsdComposition> composition;
    std::vector<UsdPrimReport> prims;
};

} // namespace

TEST_F(Report, ALayerThatIsNamedByItsWholePathFromARelativeRootKeepsIt) {
    const auto other = folder.write("b.usda", kHeader + "def \"b\"\n{\n}\n");
    const auto root = folder.write("a.usda", kHeader + "def \"a\" (references = @" +
                                                 other.string() + "@</b>)\n{\n}\n");
    open(std::filesystem::relative(root));
    ASSERT_EQ(prims.size(), 1u);
    const UsdPrimReport::Sites expected{{"a.usda", "/a"}, {other.generic_string(), "/b"}};
    EXPECT_EQ(prims[0].primStack, expected);
}

TEST_F(Report, PrimsThatAreTooDeepAreNamed) {
    UsdComposeLimits limits;
    limits.levels = 2;
    const std::string text = "def \"a\"\n{\n def \"b\"\n {\n  def \"c\"\n  {\n  }\n }\n}\n";
    open(folder.write("a.usda", kHeader + text), limits);
    EXPECT_EQ(prims.size(), 2u);
    EXPECT_EQ(errors("nested too deeply"), 1u);
    limits.levels = 3;
    open(folder.write("a.usda", kHeader + text), limits);
    EXPECT_EQ(prims.size(), 3u);
    EXPECT_EQ(errors("nested too deeply"), 0u);
}

TEST_F(Report, EndsAfterSoManyOpinions) {
    UsdComposeLimits limits;
    limits.opinions = 2;
    std::string text;
    for (int i = 0; i < 10; ++i) text += "def \"p" + std::to_string(i) + "\"\n{\n}\n";
    open(folder.write("a.usda", kHeader + text), limits);
    EXPECT_EQ(prims.size(), 3u);
    EXPECT_EQ(errors("its report ends here"), 1u);
}

// Whether a target in a class is what inherits it is found by composing that prim: once more.
TEST_F(Report, WhatIsWrongWithAPrimThatIsComposedTwiceIsSaidOnce) {
    open(folder.write("a.usda", kHeader + R"(class "c"
{
    rel r = </a>
    rel s = </a>
}
def "a" (inherits = </c>; references = @gone.usda@)
{
}
)"));
    EXPECT_EQ(errors("gone.usda"), 1u);
}

} // namespace penumbra
