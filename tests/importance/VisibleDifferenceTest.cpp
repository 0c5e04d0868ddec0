// What an observer sees of the difference between two pictures.
#include "importance/VisibleDifference.h"

#include "importance/ContrastSensitivity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace penumbra {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

Plane drawn(int width, int height, const std::function<double(int, int)>& luminance) {
    Plane picture(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) picture.at(x, y) = float(luminance(x, y));
    return picture;
}

/// Vertical bars. \param period [pixels]
Plane grating(double mean, double contrast, double period, int size = 256) {
    return drawn(size, size, [&](int x, int) {
        return mean * (1 + contrast * std::cos(kTurn * (x + 0.5) / period));
    });
}

/// A floor with the soft shadow of an edge, `soft` pixels wide, at `edge`.
Plane shadow(double lit, double edge, double soft, int size = 256) {
    return drawn(size, size, [&](int x, int) {
        return lit * (0.2 + 0.8 / (1 + std::exp(-(x - edge) / (0.2 * soft))));
    });
}

Plane scaled(Plane picture, float factor) {
    for (float& value : picture.values) value *= factor;
    return picture;
}

DifferenceSummary between(const Plane& test, const Plane& reference, double pixelsPerDegree = 32) {
    return summarise(visibleDifference(test, reference, pixelsPerDegree));
}

TEST(VisibleDifference, OfAPictureAndItselfIsNone) {
    const Plane picture = shadow(50, 100, 30);
    EXPECT_EQ(between(picture, picture).most, 0);
}

TEST(VisibleDifference, DoesNotDependOnWhichOfTheTwoIsTheTest) {
    const Plane a = shadow(50, 100, 30), b = shadow(50, 110, 10);
    EXPECT_EQ(visibleDifference(a, b, 32).values, visibleDifference(b, a, 32).values);
}

TEST(VisibleDifference, OfAGratingAtItsThresholdIsOneStep) {
    // A grating of contrast 1 / S is what castleCSF says is just seen. (Coarser ones read higher,
    // up to 1.6: a little of them falls into finer bands, which the eye is more sensitive in.)
    for (double luminance : {1.0, 10.0, 100.0})
        for (double frequency : {1.4, 2.0, 2.8, 4.0, 5.6, 8.0}) { // [cycles per degree]
            const double contrast = 1 / contrastSensitivity(frequency, luminance);
            const Plane even(256, 256, float(luminance));
            const DifferenceSummary seen =
                between(grating(luminance, contrast, 32 / frequency), even);
            EXPECT_NEAR(seen.p99, 1, 0.3) << luminance << " nit, " << frequency << " cpd";
        }
}

TEST(VisibleDifference, OfAFaintGainIsNotSeenAndAMissingShadowIs) {
    const Plane reference = shadow(50, 128, 30), lit(256, 256, 50);
    const DifferenceSummary gain = between(scaled(reference, 1.005f), reference);
    EXPECT_EQ(gain.visible, 0);
    EXPECT_LT(gain.most, 0.5);
    const DifferenceSummary missing = between(lit, reference);
    EXPECT_GT(missing.p99, 10);
    EXPECT_GT(missing.visible, 0.3);
}

TEST(VisibleDifference, OfAWholePictureThatIsTooDarkIsSeen) {
    const Plane reference = shadow(50, 128, 30);
    EXPECT_GT(between(scaled(reference, 0.6f), reference).mean, 1);
}

TEST(VisibleDifference, IsLessInTheDark) {
    const Plane dark(256, 256, 0.05f), bright(256, 256, 50);
    const double night = between(grating(0.05, 0.02, 16), dark).p99;
    const double day = between(grating(50, 0.02, 16), bright).p99;
    EXPECT_LT(night, 1);
    EXPECT_GT(day, 4 * night);
}

TEST(VisibleDifference, IsLessOnTopOfAPatternThatBothHave) {
    const auto patterned = [](double extra) {
        return drawn(256, 256, [&](int x, int) {
            return 50 * (1 + 0.4 * std::cos(kTurn * x / 9.0) + extra * std::cos(kTurn * x / 8.0));
        });
    };
    const double bare = between(grating(50, 0.02, 8), Plane(256, 256, 50)).p99;
    EXPECT_LT(between(patterned(0.02), patterned(0)).p99, 0.5 * bare);
}

TEST(VisibleDifference, IsAMatterOfDegreesNotOfPixels) {
    const DifferenceSummary fine = between(shadow(50, 140, 40), shadow(50, 128, 40), 32);
    const DifferenceSummary coarse = between(shadow(50, 70, 20, 128), shadow(50, 64, 20, 128), 16);
    EXPECT_NEAR(coarse.p99 / fine.p99, 1, 0.1);
}

TEST(VisibleDifference, IsWhereTheFaultIs) {
    const Plane even(256, 256, 50);
    Plane spot = even;
    for (int y = 60; y < 70; ++y)
        for (int x = 180; x < 190; ++x) spot.at(x, y) = 60;
    const Plane map = visibleDifference(spot, even, 32);
    EXPECT_GT(map.at(185, 65), 5);
    EXPECT_LT(map.at(40, 200), 0.1);
}

TEST(VisibleDifference, SwallowsLightsAndBlackness) {
    Plane picture(64, 48, 0), other = picture;
    picture.at(10, 10) = 1e9f;
    for (float value : visibleDifference(picture, other, 5).values)
        EXPECT_TRUE(std::isfinite(value));
    EXPECT_EQ(between(Plane(1, 1, 3), Plane(1, 1, 3)).most, 0);
}

TEST(DifferenceSummary, SaysHowMuchOfThePictureIsOff) {
    Plane map(10, 10, 0.5f);
    for (int x = 0; x < 10; ++x) map.at(x, 0) = 3;
    map.at(0, 0) = 9;
    const DifferenceSummary summary = summarise(map);
    EXPECT_NEAR(summary.mean, (90 * 0.5 + 9 * 3 + 9) / 100, 1e-6);
    EXPECT_NEAR(summary.visible, 0.1, 1e-9);
    EXPECT_EQ(summary.p99, 9);
    EXPECT_EQ(summary.most, 9);
    EXPECT_NEAR(summary.cubicMean, std::cbrt((90 * 0.125 + 9 * 27 + 729) / 100), 1e-6);
}

} // namespace

} // namespace penumbra
