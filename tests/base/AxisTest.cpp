#include "base/Axis.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

TEST(LongestAxis, IsTheFirstOfEqualOnes) {
    EXPECT_EQ(longestAxis(glm::vec3(3, 2, 1)), 0);
    EXPECT_EQ(longestAxis(glm::vec3(1, 2, 1)), 1);
    EXPECT_EQ(longestAxis(glm::dvec3(1, 2, 3)), 2);
    EXPECT_EQ(longestAxis(glm::vec3(2, 2, 2)), 0);
    EXPECT_EQ(longestAxis(glm::vec3(1, 2, 2)), 1);
}

} // namespace

} // namespace penumbra
