// The luminance that the eye is adapted to, and how it follows the picture.
#include "importance/Adaptation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace penumbra {

namespace {

TEST(MeanAdaptation, IsTheGeometricMean) {
    EXPECT_NEAR(meanAdaptation(std::vector<float>{1, 100}), 10, 1e-5);
    EXPECT_NEAR(meanAdaptation(std::vector<float>(1000, 42)), 42, 1e-3);
}

TEST(MeanAdaptation, IsHardlyMovedByALightInView) {
    std::vector<float> room(10'000, 30);
    for (int i = 0; i < 50; ++i) room[std::size_t(i)] = 2400; // half a percent of the picture
    EXPECT_NEAR(meanAdaptation(room), 30, 1);
}

TEST(MeanAdaptation, OfBlackIsDarkButNotNothing) {
    EXPECT_GT(meanAdaptation(std::vector<float>(10, 0)), 0);
    EXPECT_GT(meanAdaptation({}), 0);
}

TEST(LocalAdaptation, LiesBetweenTheSurfaceAndThePicture) {
    EXPECT_NEAR(localAdaptation(10, 30), 10.15, 1e-12);
    EXPECT_GT(localAdaptation(0, 0), 0);
}

TEST(Adaptation, InTheLightNearsWithTheConesTimeConstant) {
    // 63.2 % of the way after 0.1 s (Krawczyk et al. 2005); at 1000 nit rods do not count.
    Adaptation eye(1);
    eye.adapt(1000, 0.1);
    EXPECT_NEAR((eye.luminance() - 1) / 999, 1 - std::exp(-1.0), 1e-3);
}

TEST(Adaptation, InTheDarkNearsWithTheRodsTimeConstant) {
    Adaptation eye(10);
    eye.adapt(1e-4, 0.4);
    EXPECT_NEAR(eye.luminance() / 10, std::exp(-1.0), 1e-2);
}

TEST(Adaptation, DoesNotDependOnTheFrameRate) {
    Adaptation slow(5), fast(5);
    slow.adapt(80, 0.2);
    for (int frame = 0; frame < 40; ++frame) fast.adapt(80, 0.005);
    EXPECT_NEAR(slow.luminance(), fast.luminance(), 1e-9);
}

} // namespace

} // namespace penumbra
