#include "io/usd/layer/UsdNumber.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

namespace penumbra {

namespace {

bool isDigit(char c) {
    return c >= '0' && c <= '9';
}

// The digits of a number while they are read.
struct Digits {
    std::uint64_t mantissa = 0;  // the first kMaxDigits significant ones
    int count = 0;               // how many those are
    bool truncated = false;      // there were more
    std::int64_t order = 0;      // decimal exponent of the last digit in mantissa
    std::int64_t firstOrder = 0; // that of the first one: whether the number is huge or tiny

    static constexpr int kMaxDigits = 19; // 10^19 - 1 fits 64 bits

    void add(char c) {
        if (mantissa == 0 && c == '0') return;
        if (count == kMaxDigits) {
            truncated = true;
            return;
        }
        mantissa = mantissa * 10 + std::uint64_t(c - '0');
        ++count;
    }
};

// The exponent after `p`, which points behind the "e"; null if there are no digits. Saturates.
const char* scanExponent(const char* p, std::int64_t& exponent) {
    const bool negative = *p == '-';
    if (*p == '-' || *p == '+') ++p;
    if (!isDigit(*p)) return nullptr;
    constexpr std::int64_t kEnough = 1'000'000'000'000;
    for (; isDigit(*p); ++p) exponent = std::min(exponent * 10 + (*p - '0'), kEnough);
    if (negative) exponent = -exponent;
    return p;
}

// std::from_chars on [begin, end), which is known to be a number; huge ones become infinite.
double slowValue(const char* begin, const char* end, bool huge) {
    double value = 0;
    const auto result = std::from_chars(begin, end, value);
    if (result.ec == std::errc::result_out_of_range)
        value = huge ? std::numeric_limits<double>::infinity() : 0.0;
    return value;
}

// Powers of ten that a double holds exactly.
constexpr std::array kPowers{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                             1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

const char* scanWord(const char* p, UsdNumber& number) {
    if (std::strncmp(p, "inf", 3) == 0)
        number.value = std::numeric_limits<double>::infinity();
    else if (std::strncmp(p, "nan", 3) == 0 && !number.negative)
        number.value = std::numeric_limits<double>::quiet_NaN();
    else
        return nullptr;
    if (number.negative) number.value = -number.value;
    return p + 3;
}

void setExactInteger(const char* begin, const char* end, UsdNumber& number) {
    number.integral = std::from_chars(begin, end, number.magnitude).ec == std::errc{};
}

/// The value of [begin, end), of which the digits are known.
double valueOf(const Digits& digits, std::int64_t exponent, const char* begin, const char* end) {
    const std::int64_t power = digits.order + exponent;
    const bool exact =
        !digits.truncated && digits.mantissa <= (1ull << 53) && power >= -22 && power <= 22;
    if (!exact) return slowValue(begin, end, digits.firstOrder + exponent > 0);
    const double mantissa = double(digits.mantissa);
    return power < 0 ? mantissa / kPowers[std::size_t(-power)]
                     : mantissa * kPowers[std::size_t(power)];
}

/// The digits before and after the point; null for a lone point. \param p their first character
const char* scanDigits(const char* p, Digits& digits, bool& plain) {
    const char* const begin = p;
    for (; isDigit(*p); ++p) {
        digits.add(*p);
        if (digits.mantissa != 0) ++digits.firstOrder;
    }
    plain = *p != '.';
    if (plain) return p;
    for (++p; isDigit(*p); ++p) {
        digits.add(*p);
        if (!digits.truncated) --digits.order;
        if (digits.mantissa == 0) --digits.firstOrder;
    }
    return p == begin + 1 ? nullptr : p;
}

} // namespace

const char* scanUsdNumber(const char* text, UsdNumber& number) {
    number = {};
    number.negative = *text == '-';
    const char* const begin = text + (number.negative ? 1 : 0);
    Digits digits;
    bool plain = true;
    const char* p = scanDigits(begin, digits, plain);
    if (!p) return nullptr;
    if (p == begin) return scanWord(p, number);
    std::int64_t exponent = 0;
    if (*p == 'e' || *p == 'E') {
        plain = false;
        p = scanExponent(p + 1, exponent);
        if (!p) return nullptr;
    }
    number.value = valueOf(digits, exponent, begin, p);
    if (plain && !digits.truncated) {
        number.integral = true;
        number.magnitude = digits.mantissa;
    } else if (plain) {
        setExactInteger(begin, p, number);
    }
    if (number.negative) number.value = -number.value;
    return p;
}

float roundToHalf(double value) {
    if (!std::isfinite(value) || value == 0) return float(value);
    // 11 significant bits; below 2^-14 the spacing stays 2^-24.
    const int exponent = std::max(std::ilogb(value), -14);
    const double rounded =
        std::ldexp(std::nearbyint(std::ldexp(value, 10 - exponent)), exponent - 10);
    constexpr double kLargestHalf = 65504;
    if (std::abs(rounded) > kLargestHalf)
        return std::copysign(std::numeric_limits<float>::infinity(), float(value));
    return float(rounded);
}

float roundToFloat(double value) {
    if (std::abs(value) > double(std::numeric_limits<float>::max()))
        return std::copysign(std::numeric_limits<float>::infinity(), value < 0 ? -1.0f : 1.0f);
    return float(value);
}

} // namespace penumbra
