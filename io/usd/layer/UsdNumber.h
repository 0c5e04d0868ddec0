// Numbers of the USD text format, independent of the locale.
#pragma once

#include <cstdint>

namespace penumbra {

/// A number as it was written, before anybody asks for it as an int or a float.
struct UsdNumber {
    double value = 0;            ///< nearest double; +-inf if too large
    std::uint64_t magnitude = 0; ///< |number|, exact, if integral
    bool negative = false;
    bool integral = false; ///< digits only, and they fit 64 bits
};

/// Reads the number at `text`, which must be NUL-terminated:
///
///     ["-"] (digits ["." {digit}] | "." digits) [("e"|"E") ["+"|"-"] digits] | ["-"] "inf" | "nan"
///
/// Returns the position after it, or null if there is no number. Short decimals are computed with
/// one exact multiplication or division (Clinger, PLDI 1990), the others by std::from_chars.
const char* scanUsdNumber(const char* text, UsdNumber& number);

/// `value` as a half, a float of 11 significant bits, would hold it.
float roundToHalf(double value);

/// `value` as a float; too large becomes infinite, as the format has it.
float roundToFloat(double value);

} // namespace penumbra
