// Names of prims are valid, unique, and soon found.
#include "io/model/PrimNames.h"

#include <gtest/gtest.h>

#include <unordered_set>

namespace penumbra {

TEST(PrimNames, OnlyLettersDigitsAndUnderscoresOfAsciiAreLeft) {
    EXPECT_EQ(primName("a b\xc3\xa4", "X"), "a_b_");
    EXPECT_EQ(primName("1st", "X"), "_1st");
    EXPECT_EQ(primName("\xe6\x9c\xa8", "X"), "X");
}

TEST(PrimNames, NumberedNamesDoNotCollideWithGivenOnes) {
    PrimNames names;
    EXPECT_EQ(names.take("a", "X"), "a");
    EXPECT_EQ(names.take("a_1", "X"), "a_1");
    EXPECT_EQ(names.take("a", "X"), "a_2");
    EXPECT_EQ(names.take("a_2", "X"), "a_2_1");
    EXPECT_EQ(names.take("a", "X"), "a_3");
}

TEST(PrimNames, HundredThousandsOfOneNameTakeNoTime) {
    PrimNames names;
    std::unordered_set<std::string> seen;
    for (int i = 0; i < 300'000; ++i)
        ASSERT_TRUE(seen.insert(names.take(i % 3 == 2 ? "a_1" : "a", "X")).second);
}

} // namespace penumbra
