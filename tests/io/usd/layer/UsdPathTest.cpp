#include "io/usd/layer/UsdPath.h"

#include <gtest/gtest.h>

namespace penumbra {

TEST(UsdPath, RelativePathsAreMadeAbsoluteFromTheirPrim) {
    EXPECT_EQ(absoluteUsdPath("/a/b", "/x"), "/a/b");
    EXPECT_EQ(absoluteUsdPath("b", "/x/y"), "/x/y/b");
    EXPECT_EQ(absoluteUsdPath("../b", "/x/y"), "/x/b");
    EXPECT_EQ(absoluteUsdPath("../../b.p:q", "/x/y"), "/b.p:q");
    EXPECT_EQ(absoluteUsdPath(".p", "/x"), "/x.p");
    EXPECT_EQ(absoluteUsdPath(".", "/x"), "/x");
    EXPECT_EQ(absoluteUsdPath("..", "/x/y"), "/x");
    EXPECT_EQ(absoluteUsdPath("/", "/x"), "/");
    EXPECT_EQ(absoluteUsdPath("/a.rel[/b].attr", "/x"), "/a.rel[/b].attr");
}

TEST(UsdPath, MalformedPathsAreRefused) {
    for (const char* text : {"", "/a/", "//a", "/a b", "/1a", "/a.", "/a..b", "/a.b c", "/a{v=x}b",
                             "../..", "/a.b:", "/.p", "a/../../..", "/a[b", "/a.r[b", "/a-b"})
        EXPECT_FALSE(absoluteUsdPath(text, "/x")) << text;
}

TEST(UsdPath, PartsOfAPath) {
    EXPECT_EQ(usdPrimPart("/a/b.p:q"), "/a/b");
    EXPECT_EQ(usdPropertyPart("/a/b.p:q"), "p:q");
    EXPECT_EQ(usdPropertyPart("/a/b"), "");
    EXPECT_EQ(usdParentPath("/a/b"), "/a");
    EXPECT_EQ(usdParentPath("/a"), "/");
    EXPECT_EQ(usdChildPath("/", "a"), "/a");
    EXPECT_EQ(usdChildPath("/a", "b"), "/a/b");
    EXPECT_TRUE(isUsdPropertyPath("/a.b"));
}

TEST(UsdPath, NamesMayBeInAnyScript) {
    EXPECT_TRUE(isUsdIdentifier("a1_"));
    EXPECT_TRUE(isUsdIdentifier("\xc3\xa9t\xc3\xa9"));
    EXPECT_FALSE(isUsdIdentifier("1a"));
    EXPECT_FALSE(isUsdIdentifier("a-b"));
    EXPECT_FALSE(isUsdIdentifier(""));
    EXPECT_TRUE(isUsdPropertyName("xformOp:translate:pivot"));
    EXPECT_FALSE(isUsdPropertyName("a::b"));
    EXPECT_FALSE(isUsdPropertyName("a:"));
}

} // namespace penumbra
