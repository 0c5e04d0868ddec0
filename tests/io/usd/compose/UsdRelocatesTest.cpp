#include "io/usd/compose/UsdRelocates.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

class Relocates : public testing::Test {
protected:
    UsdRelocates made(std::vector<std::pair<const char*, const char*>> list) {
        std::vector<UsdRelocates::Pair> pairs;
        for (const auto& [source, target] : list)
            pairs.push_back({table.path(source), table.path(target)});
        refused.clear();
        return UsdRelocates(pairs,
                            [this](std::size_t i, const std::string&) { refused.push_back(i); });
    }

    UsdPathTable table;
    std::vector<std::size_t> refused;
};

} // namespace

TEST_F(Relocates, SourcesAreTracedBackThroughTheirAncestors) {
    const UsdRelocates relocates = made({{"/a/b", "/c"}, {"/c/d", "/c/e"}});
    EXPECT_TRUE(refused.empty());
    EXPECT_EQ(relocates.sourceOf(table.path("/c/e")), table.path("/c/d"));
    const UsdMapping map = relocates.mappingAt(table.path("/a"));
    EXPECT_EQ(map.map(table.path("/a/b/x")), table.path("/c/x"));
    EXPECT_EQ(map.map(table.path("/a/b/d/x")), table.path("/c/e/x"));
    EXPECT_EQ(map.map(table.path("/z")), table.path("/z"));
}

TEST_F(Relocates, WhatIsWrongIsRefused) {
    made({{"/a", "/b"}, {"/c/d", "/c/d"}, {"/e/f", "/e"}, {"/g/h", "/g/h/i"}, {"/j/k", ""}});
    EXPECT_EQ(refused, (std::vector<std::size_t>{0, 1, 2, 3}));
}

TEST_F(Relocates, ConflictsAreRefusedTogether) {
    made({{"/a/b", "/x"},
          {"/c/d", "/x"},
          {"/e/f", "/g/h"},
          {"/g/h", "/i"},
          {"/k/l", "/m"},
          {"/k/l/n", "/o"},
          {"/p/q", "/k/l/r"}});
    EXPECT_EQ(refused, (std::vector<std::size_t>{0, 1, 2, 3, 5, 6}));
}

TEST_F(Relocates, ThoseThatFeedEachOtherEnd) {
    const UsdRelocates relocates = made({{"/a/b/c", "/d/e"}, {"/d/e/f", "/a/b"}});
    EXPECT_FALSE(relocates.empty());
}

} // namespace penumbra
