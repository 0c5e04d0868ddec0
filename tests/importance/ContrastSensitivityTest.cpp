// How little contrast the eye can see.
#include "importance/ContrastSensitivity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace penumbra {

namespace {

struct Published {
    double luminance, frequency, log10Sensitivity; // [nit], [cycles per degree]
};
// Achromatic, sustained, Gaussian window of 1.5 degrees: from the table of castleCSF that comes
// with ColorVideoVDP (csf_lut_weber_fixed_size.json, o0_c1).
constexpr Published kCastle[] = {
    {0.08289, 0.3492, 1.3298}, {0.08289, 1.2197, 1.5497}, {0.08289, 3.4584, 1.1972},
    {0.8606, 0.3492, 1.4484},  {0.8606, 0.9902, 1.8955},  {0.8606, 3.4584, 1.8152},
    {0.8606, 7.9609, 1.2806},  {0.8606, 14.877, 0.6385},  {8.9354, 0.3492, 1.6064},
    {8.9354, 0.9902, 2.0945},  {8.9354, 3.4584, 2.2731},  {8.9354, 7.9609, 1.9110},
    {8.9354, 14.877, 1.3984},  {92.770, 0.3492, 1.7162},  {92.770, 0.9902, 2.1741},
    {92.770, 3.4584, 2.5092},  {92.770, 7.9609, 2.2514},  {92.770, 14.877, 1.8170},
    {377.73, 0.3492, 1.7411},  {377.73, 3.4584, 2.5529},  {377.73, 14.877, 1.8946},
};

TEST(ContrastSensitivity, IsWithinAFifthOfThePublishedTable) {
    double squares = 0;
    for (const Published& p : kCastle) {
        const double error =
            std::log10(contrastSensitivity(p.frequency, p.luminance)) - p.log10Sensitivity;
        EXPECT_NEAR(error, 0, 0.08) << p.luminance << " nit, " << p.frequency << " cpd";
        squares += error * error;
    }
    EXPECT_LT(std::sqrt(squares / std::size(kCastle)), 0.035);
}

TEST(ContrastSensitivity, AgreesWithTheStandardForDisplays) {
    // DICOM PS3.14, after Barten: at 4 cycles per degree a step of the greyscale standard display
    // function is the peak-to-peak modulation just seen, L(j + 1) - L(j) = 2 L / S. Polynomial of
    // the standard; the standard's target is 2 degrees wide, the fit's observers are others.
    const auto display = [](double j) {
        const double x = std::log(j);
        const double above =
            -1.3011877 +
            x * (8.0242636e-2 + x * (1.3646699e-1 + x * (-2.5468404e-2 + x * 1.3635334e-3)));
        const double below =
            1 +
            x * (-2.5840191e-2 +
                 x * (-1.0320229e-1 + x * (2.8745620e-2 + x * (-3.1978977e-3 + x * 1.2992634e-4))));
        return std::pow(10.0, above / below);
    };
    ASSERT_NEAR(display(1), 0.05, 1e-4);
    ASSERT_NEAR(display(1023), 3993.4, 0.1);
    for (double j : {60.0, 150.0, 300.0, 500.0}) { // 0.9, 5, 31, 153 nit
        const double step = display(j + 1) / display(j) - 1;
        const double ratio = contrastSensitivity(4, display(j)) / (2 / step);
        EXPECT_GT(ratio, 0.5) << display(j);
        EXPECT_LT(ratio, 2.0) << display(j);
    }
}

TEST(ContrastSensitivity, AtItsPeakIsTheShortcut) {
    for (double luminance : {0.1, 1.0, 10.0, 100.0, 1000.0}) {
        double best = 0;
        for (double frequency = 0.2; frequency < 16; frequency *= 1.02)
            best = std::max(best, contrastSensitivity(frequency, luminance));
        // 0.06 in log10 is what the longer formula may be off.
        EXPECT_NEAR(std::log10(peakContrastSensitivity(luminance) / best), 0, 0.06) << luminance;
    }
}

TEST(ContrastSensitivity, PeaksAsPublished) {
    // Largest values of the same table.
    EXPECT_NEAR(1 / peakContrastSensitivity(0.08289), 0.0277, 0.001);
    EXPECT_NEAR(1 / peakContrastSensitivity(0.8606), 0.0111, 0.0004);
    EXPECT_NEAR(1 / peakContrastSensitivity(8.9354), 0.00498, 0.0002);
    EXPECT_NEAR(1 / peakContrastSensitivity(92.77), 0.00309, 0.0001);
}

} // namespace

} // namespace penumbra
