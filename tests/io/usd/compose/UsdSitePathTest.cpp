#include "io/usd/compose/UsdMapping.h"

#include <gtest/gtest.h>

namespace penumbra {

TEST(UsdSitePath, IsMadeOnceAndKnowsItsParts) {
    UsdPathTable table;
    const UsdSitePath path = table.path("/a/b");
    EXPECT_EQ(path, table.root().child("a").child("b"));
    EXPECT_EQ(path.text(), "/a/b");
    EXPECT_EQ(path.parent().text(), "/a");
    EXPECT_EQ(path.levels(), 2u);
    EXPECT_FALSE(table.path("a/b"));
    EXPECT_FALSE(table.path("/a//b"));
    EXPECT_EQ(table.path("/"), table.root());
}

TEST(UsdSitePath, TextOfTooManyElementsIsNone) {
    UsdPathTable table;
    std::string text;
    for (std::size_t i = 0; i < UsdPathTable::kMaxLength; ++i) text += "/p";
    EXPECT_EQ(table.path(text).length(), UsdPathTable::kMaxLength);
    EXPECT_FALSE(table.path(text + "/p"));
}

TEST(UsdSitePath, ChoicesAreElementsButNoLevels) {
    UsdPathTable table;
    const UsdSitePath path = table.path("/a").withChoice("v", "x").child("b");
    EXPECT_EQ(path.text(), "/a{v=x}b");
    EXPECT_EQ(path.length(), 3u);
    EXPECT_EQ(path.levels(), 2u);
    EXPECT_EQ(path.plain(), table.path("/a/b"));
    EXPECT_TRUE(path.hasPrefix(table.path("/a")));
    EXPECT_FALSE(path.hasPrefix(table.path("/a/b")));
    EXPECT_EQ(path.replacePrefix(table.path("/a"), table.path("/c/d")).text(), "/c/d{v=x}b");
}

TEST(UsdMapping, TheLongestSourceCounts) {
    UsdPathTable t;
    const UsdMapping map({{t.path("/a"), t.path("/x")}, {t.path("/a/b"), t.path("/y")}}, {});
    EXPECT_EQ(map.map(t.path("/a/c")), t.path("/x/c"));
    EXPECT_EQ(map.map(t.path("/a/b/c")), t.path("/y/c"));
    EXPECT_FALSE(map.map(t.path("/d")));
    EXPECT_EQ(map.mapBack(t.path("/y/c")), t.path("/a/b/c"));
}

TEST(UsdMapping, IsOneToOne) {
    UsdPathTable t;
    // A class in the same layer: what it is inherited by hides the prim of that name.
    const UsdMapping map = UsdMapping({{t.path("/class"), t.path("/prim")}}, {}).rooted();
    EXPECT_EQ(map.map(t.path("/class/a")), t.path("/prim/a"));
    EXPECT_EQ(map.map(t.path("/other")), t.path("/other"));
    EXPECT_FALSE(map.map(t.path("/prim/a")));
    EXPECT_FALSE(map.mapBack(t.path("/class/a")));
}

TEST(UsdMapping, CombinesPathsAndTimes) {
    UsdPathTable t;
    const UsdMapping inner({{t.path("/a"), t.path("/b/c")}}, {10, 2});
    const UsdMapping outer({{t.path("/b"), t.path("/d")}}, {1, 0.5});
    const UsdMapping both = outer.after(inner);
    EXPECT_EQ(both.map(t.path("/a/e")), t.path("/d/c/e"));
    EXPECT_DOUBLE_EQ(both.offset().offset, 6); // 1 + 0.5 * 10
    EXPECT_DOUBLE_EQ(both.offset().scale, 1);
    EXPECT_EQ(both.inverse().map(t.path("/d/c/e")), t.path("/a/e"));
    EXPECT_TRUE(UsdMapping::identity(t.root()).isIdentity());
}

TEST(UsdMapping, WhatHasNoTargetHasNoImage) {
    UsdPathTable t;
    const UsdMapping map({{t.root(), t.root()}, {t.path("/a"), {}}}, {});
    EXPECT_FALSE(map.map(t.path("/a/b")));
    EXPECT_EQ(map.map(t.path("/c")), t.path("/c"));
}

} // namespace penumbra
