#include "base/Frame.h"

#include <gtest/gtest.h>

namespace penumbra {
namespace {

TEST(Frame, IsOrthonormalAndRightHandedWhateverTheDirection) {
    for (const glm::vec3 way : {glm::vec3(1, 0, 0), glm::vec3(0, -1, 0), glm::vec3(0, 0, 1),
                                glm::vec3(0.7f, 0.1f, -0.2f), glm::vec3(-1, 1e-4f, 0)}) {
        const glm::vec3 n = glm::normalize(way);
        const Frame frame(n);
        EXPECT_NEAR(glm::length(frame.u), 1, 1e-6);
        EXPECT_NEAR(glm::dot(frame.u, n), 0, 1e-6);
        EXPECT_NEAR(glm::distance(glm::cross(frame.u, frame.v), n), 0, 1e-6);
    }
}

} // namespace
} // namespace penumbra
