// What tone curves promise.
#include "io/image/ToneCurve.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

class ToneCurves : public testing::TestWithParam<ToneStyle> {};

TEST_P(ToneCurves, ShowMiddleGreyAsItIs) {
    const Rgb grey = ToneCurve(GetParam()).shown(Rgb(kMiddleGrey));
    EXPECT_NEAR(grey.r, 0.18f, 2e-5f);
    EXPECT_NEAR(grey.g, 0.18f, 2e-5f);
    EXPECT_NEAR(grey.b, 0.18f, 2e-5f);
}

TEST_P(ToneCurves, KeepGreyGreyAndNeverGetDarkerOrLeaveTheDisplay) {
    const ToneCurve curve(GetParam());
    float before = 0;
    for (float stops = -20; stops < 20; stops += 0.125f) {
        const Rgb shown = curve.shown(Rgb(std::exp2(stops)));
        EXPECT_NEAR(shown.r, shown.g, 1e-5f);
        EXPECT_NEAR(shown.g, shown.b, 1e-5f);
        EXPECT_GE(shown.g, before - 1e-6f) << stops;
        EXPECT_LE(shown.g, 1);
        before = shown.g;
    }
    EXPECT_GT(before, 0.99f) << "the brightest is white";
    EXPECT_LT(curve.shown(Rgb(1e-6f)).g, 2e-6f) << "the darkest is black";
}

TEST_P(ToneCurves, AreReadBackFromTheirTable) {
    const ToneCurve curve(GetParam());
    const std::vector<float> table = curve.table();
    ASSERT_EQ(table.size(), std::size_t(ToneCurve::kTableSize));
    for (float value : {0.001f, 0.03f, 0.18f, 0.7f, 3.0f, 50.0f}) {
        const float at = (std::log2(value) - ToneCurve::kTableFirst) /
                         (ToneCurve::kTableLast - ToneCurve::kTableFirst) *
                         float(ToneCurve::kTableSize - 1);
        const auto low = std::size_t(at);
        const float t = at - float(low);
        const float read = (1 - t) * table[low] + t * table[low + 1];
        EXPECT_NEAR(read, curve.curve(value), 1e-4f * curve.curve(value) + 1e-6f) << value;
    }
}

INSTANTIATE_TEST_SUITE_P(All, ToneCurves,
                         testing::Values(ToneStyle::agx, ToneStyle::aces, ToneStyle::srgb),
                         [](const auto& style) {
                             return std::string(kToneStyleNames[std::size_t(style.param)]);
                         });

TEST(ToneCurve, AgxLetsBrightSaturatedColoursRunToWhiteAndSrgbDoesNot) {
    const Rgb blue(0.1f, 0.1f, 40.0f);
    const Rgb agx = ToneCurve(ToneStyle::agx).shown(blue);
    const Rgb srgb = ToneCurve(ToneStyle::srgb).shown(blue);
    EXPECT_GT(agx.r, 0.3f);
    EXPECT_LT(srgb.r, 0.11f);
}

TEST(ToneCurve, AgxEndsTenStopsBelowAndSixAndAHalfAboveMiddleGrey) {
    const ToneCurve curve(ToneStyle::agx);
    EXPECT_FLOAT_EQ(curve.curve(0.18f * std::exp2(6.5f)), 1);
    EXPECT_LT(curve.curve(0.18f * std::exp2(6.4f)), 1);
    EXPECT_NEAR(curve.curve(0.18f * std::exp2(-10.0f)), 0, 1e-6f);
    EXPECT_GT(curve.curve(0.18f * std::exp2(-9.0f)), 0);
}

TEST(ToneMap, ShowsMiddleGreyAs18PercentAndFaultyLuminancesWithinRange) {
    for (const ToneStyle style : {ToneStyle::agx, ToneStyle::aces, ToneStyle::srgb}) {
        const ToneMap tone = toneMap(250, style);
        EXPECT_NEAR(tone(Rgb(250)).g, 0.18, 1e-4);
        EXPECT_EQ(tone(Rgb(0)), Rgb(0));
        const float nan = std::numeric_limits<float>::quiet_NaN();
        const float infinity = std::numeric_limits<float>::infinity();
        for (const Rgb& faulty : {Rgb(nan, 1, 1), Rgb(infinity), Rgb(-1), Rgb(1, infinity, 0)}) {
            const Rgb shown = tone(faulty);
            for (const float channel : {shown.r, shown.g, shown.b})
                EXPECT_TRUE(channel >= 0 && channel <= 1);
        }
    }
}

} // namespace

} // namespace penumbra
