// The smallest luminance step that is seen at a given adaptation.
#include "importance/ThresholdVersusIntensity.h"

#include <gtest/gtest.h>

#include <cmath>

namespace penumbra {

namespace {

TEST(ThresholdVersusIntensity, IsWebersLawInTheLight) {
    // Ferwerda et al. 1996: cones follow dL = 10^-1.255 L from about 80 nit up, that is 5.56 %.
    for (double luminance : {100.0, 1000.0, 10'000.0})
        EXPECT_NEAR(thresholdVersusIntensity(luminance) / luminance, 0.0556, 1e-4);
}

TEST(ThresholdVersusIntensity, IsTheAbsoluteThresholdOfTheRodsInTheDark) {
    EXPECT_NEAR(thresholdVersusIntensity(1e-6), 1.38e-3, 1e-5); // 10^-2.86
    EXPECT_EQ(thresholdVersusIntensity(1e-6), thresholdVersusIntensity(1e-5));
}

TEST(ThresholdVersusIntensity, IsWebersLawOfTheRodsAtDusk) {
    // Rods: dL = 10^-0.395 L, that is 40.3 %.
    EXPECT_NEAR(thresholdVersusIntensity(0.1) / 0.1, 0.403, 1e-3);
    EXPECT_NEAR(thresholdVersusIntensity(0.5) / 0.5, 0.403, 1e-3);
}

TEST(ThresholdVersusIntensity, RisesAndJoinsItsPieces) {
    // The publication's coefficients are rounded: two of the pieces overlap by up to 3 %.
    double before = thresholdVersusIntensity(1e-6);
    for (double l = -6; l < 5; l += 0.001) {
        const double threshold = thresholdVersusIntensity(std::pow(10.0, l));
        EXPECT_NEAR(threshold / before, 1, 0.03) << l;
        before = threshold;
    }
    for (double l = -3.8; l < 5; l += 0.1)
        EXPECT_GT(thresholdVersusIntensity(std::pow(10.0, l + 0.1)),
                  thresholdVersusIntensity(std::pow(10.0, l)));
}

} // namespace

} // namespace penumbra
