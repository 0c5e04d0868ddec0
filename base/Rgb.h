// Three linear Rec. 709 channels: a type of its own, so that a colour is never taken for a
// position.
#pragma once

#include <algorithm>
#include <numbers>

namespace penumbra {

/// A quantity of light or a reflectance for each linear Rec. 709 channel. The unit is its user's.
struct Rgb {
    float r = 0, g = 0, b = 0;

    constexpr Rgb() = default;
    constexpr Rgb(float red, float green, float blue) : r(red), g(green), b(blue) {}
    constexpr explicit Rgb(float grey) : r(grey), g(grey), b(grey) {}

    constexpr Rgb& operator+=(Rgb o) { return *this = {r + o.r, g + o.g, b + o.b}; }
    constexpr Rgb& operator-=(Rgb o) { return *this = {r - o.r, g - o.g, b - o.b}; }
    constexpr Rgb& operator*=(float s) { return *this = {r * s, g * s, b * s}; }

    friend constexpr Rgb operator+(Rgb a, Rgb b) { return a += b; }
    friend constexpr Rgb operator-(Rgb a, Rgb b) { return a -= b; }
    friend constexpr Rgb operator*(Rgb a, float s) { return a *= s; }
    friend constexpr Rgb operator*(float s, Rgb a) { return a *= s; }
    friend constexpr Rgb operator*(Rgb a, Rgb b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
    friend constexpr bool operator==(Rgb, Rgb) = default;
};

/// Photometric weight of the three channels, Rec. ITU-R BT.709-6 item 3.2.
constexpr float luminance(Rgb c) {
    return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
}
constexpr float maxChannel(Rgb c) {
    return std::max({c.r, c.g, c.b});
}
constexpr float minChannel(Rgb c) {
    return std::min({c.r, c.g, c.b});
}
constexpr Rgb absolute(Rgb c) {
    return {c.r < 0 ? -c.r : c.r, c.g < 0 ? -c.g : c.g, c.b < 0 ? -c.b : c.b};
}

/// What a Lambertian surface of this luminance emits: M = pi L. \param luminance [cd/m^2]
/// \return exitance [lm/m^2]
constexpr Rgb lambertianExitance(Rgb luminance) {
    return std::numbers::pi_v<float> * luminance;
}

} // namespace penumbra
