#include "viewer/overlay/ColourMap.h"

#include <gtest/gtest.h>

#include <cmath>

namespace penumbra {

namespace {

/// CIE 1976 lightness of an sRGB colour (IEC 61966-2-1), in [0, 100].
double lightness(glm::vec3 colour) {
    const auto linear = [](double c) {
        return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    };
    const double y = 0.2126 * linear(double(colour.r)) + 0.7152 * linear(double(colour.g)) +
                     0.0722 * linear(double(colour.b));
    return y > 216.0 / 24389 ? 116 * std::cbrt(y) - 16 : y * 24389 / 27;
}

TEST(ColourMap, ViridisRisesEvenlyInLightnessSoThatHueIsNotNeeded) {
    const double dark = lightness(viridis(0)), bright = lightness(viridis(1));
    EXPECT_GT(bright - dark, 70);
    constexpr int kSteps = 32;
    for (int i = 0; i < kSteps; ++i) {
        const double step =
            lightness(viridis(float(i + 1) / kSteps)) - lightness(viridis(float(i) / kSteps));
        EXPECT_NEAR(step, (bright - dark) / kSteps, 0.4 * (bright - dark) / kSteps) << i;
    }
}

TEST(ColourMap, WhatIsOutsideCountsAsTheNearerEnd) {
    EXPECT_EQ(viridis(-1), viridis(0));
    EXPECT_EQ(viridis(2), viridis(1));
    EXPECT_EQ(viridis(std::nanf("")), viridis(0));
    EXPECT_NEAR(viridis(1).r * 255, 253, 0.5);
}

TEST(ColourMap, NoTwoKindsLookAlikeToPeopleWhoCantSeeRedOrGreen) {
    // What dichromats see differ in, roughly: lightness, and blue against yellow.
    for (std::size_t a = 0; a < kKinds; ++a)
        for (std::size_t b = 0; b < a; ++b) {
            const glm::vec3 p = kindColour(a), q = kindColour(b);
            const double light = std::abs(lightness(p) - lightness(q));
            const double blue =
                100 * std::abs(double(p.b - (p.r + p.g) / 2 - q.b) + double((q.r + q.g) / 2));
            EXPECT_GT(std::hypot(light, blue), 12) << a << ' ' << b;
        }
}

} // namespace

} // namespace penumbra
