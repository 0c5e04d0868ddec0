#include "io/usd/layer/UsdNumber.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <charconv>
#include <clocale>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

namespace penumbra {

namespace {

// The number at the start of `text`, which must be all of it.
UsdNumber scanned(const std::string& text) {
    UsdNumber number;
    const char* after = scanUsdNumber(text.c_str(), number);
    EXPECT_EQ(after, text.c_str() + text.size()) << text;
    return number;
}

} // namespace

TEST(UsdNumber, EveryFormOfTheFormatIsRead) {
    EXPECT_EQ(scanned("1.").value, 1.0);
    EXPECT_EQ(scanned(".5").value, 0.5);
    EXPECT_EQ(scanned("-.5").value, -0.5);
    EXPECT_EQ(scanned("007").value, 7.0);
    EXPECT_EQ(scanned("1e3").value, 1000.0);
    EXPECT_EQ(scanned("25E-2").value, 0.25);
    EXPECT_EQ(scanned("1e+2").value, 100.0);
    EXPECT_EQ(scanned("inf").value, std::numeric_limits<double>::infinity());
    EXPECT_EQ(scanned("-inf").value, -std::numeric_limits<double>::infinity());
    EXPECT_TRUE(std::isnan(scanned("nan").value));
    EXPECT_TRUE(std::signbit(scanned("-0").value));
}

TEST(UsdNumber, WhatIsNoNumberIsRefused) {
    for (const char* text :
         {"", "+1", "-", ".", "-.", "e5", "1e", "1e+", "INF", "NaN", "-nan", "x"}) {
        UsdNumber number;
        EXPECT_EQ(scanUsdNumber(text, number), nullptr) << text;
    }
}

TEST(UsdNumber, TooLargeIsInfiniteAndTooSmallIsZero) {
    // OpenUSD reads 1e400 as inf.
    EXPECT_EQ(scanned("1e400").value, std::numeric_limits<double>::infinity());
    EXPECT_EQ(scanned("-1e999999999999999999999").value, -std::numeric_limits<double>::infinity());
    EXPECT_EQ(scanned("1e-400").value, 0.0);
    EXPECT_EQ(scanned("0e999999999999").value, 0.0);
    EXPECT_EQ(scanned("0." + std::string(500, '0') + "1e-5").value, 0.0);
    EXPECT_EQ(scanned(std::string(500, '0') + "1").value, 1.0);
    EXPECT_EQ(scanned(std::string(500, '9')).value, std::numeric_limits<double>::infinity());
}

TEST(UsdNumber, IntegersStayExactBeyondTheReachOfDoubles) {
    EXPECT_EQ(scanned("9007199254740993").magnitude, 9007199254740993u);
    EXPECT_EQ(scanned("18446744073709551615").magnitude, std::numeric_limits<std::uint64_t>::max());
    EXPECT_TRUE(scanned("18446744073709551615").integral);
    EXPECT_FALSE(scanned("18446744073709551616").integral);
    EXPECT_FALSE(scanned("2.0").integral);
    EXPECT_TRUE(scanned("-3").negative);
}

TEST(UsdNumber, TheDecimalPointIsADotInEveryLocale) {
    const std::string before = std::setlocale(LC_NUMERIC, nullptr);
    for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "C.UTF-8"}) { // those that are installed
        std::setlocale(LC_NUMERIC, name);
        EXPECT_EQ(scanned("1.5").value, 1.5) << name;
        EXPECT_EQ(scanned("1.23456789012345678901e10").value, 1.23456789012345678901e10) << name;
    }
    std::setlocale(LC_NUMERIC, before.c_str());
}

// The fast path for short decimals must round as std::from_chars does.
RC_GTEST_PROP(UsdNumber, DecimalsAreTheNearestDouble, ()) {
    const auto digits = *rc::gen::arbitrary<std::uint64_t>();
    const int shift = *rc::gen::inRange(0, 64);
    const int exponent = *rc::gen::inRange(-330, 310);
    const std::string text = std::to_string(digits >> shift) + "." +
                             std::to_string(*rc::gen::inRange(0, 100000)) + "e" +
                             std::to_string(exponent);
    double wanted = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), wanted);
    RC_PRE(result.ec == std::errc{});
    RC_ASSERT(scanned(text).value == wanted);
}

RC_GTEST_PROP(UsdNumber, WhatIsPrintedWithSeventeenDigitsComesBack, ()) {
    const double value = std::bit_cast<double>(*rc::gen::arbitrary<std::uint64_t>());
    RC_PRE(std::isfinite(value));
    char text[64];
    const auto end = std::to_chars(text, text + sizeof text, value).ptr;
    RC_ASSERT(scanned(std::string(text, end)).value == value);
}

TEST(UsdNumber, HalvesKeepElevenBits) {
    EXPECT_EQ(roundToHalf(0.1), 0.0999755859375f); // IEEE 754 binary16 nearest to 0.1
    EXPECT_EQ(roundToHalf(65504), 65504.0f);
    EXPECT_EQ(roundToHalf(70000), std::numeric_limits<float>::infinity());
    EXPECT_EQ(roundToHalf(0), 0.0f);
    EXPECT_EQ(roundToHalf(-std::ldexp(1.0, -24)), -std::ldexp(1.0f, -24)); // the smallest one
    EXPECT_EQ(roundToFloat(1e39), std::numeric_limits<float>::infinity());
    EXPECT_EQ(roundToFloat(-1e39), -std::numeric_limits<float>::infinity());
}

} // namespace penumbra
