// From luminances to what a display can show.
#pragma once

#include "base/FrameLayers.h"
#include "base/Rgb.h"

#include <glm/glm.hpp>

#include <array>
#include <vector>

namespace penumbra {

enum class ToneStyle { agx, aces, srgb };
inline constexpr std::array<const char*, 3> kToneStyleNames{"AgX", "ACES", "sRGB"};

/// Luminance that is shown as it is, 18 % grey, by every curve.
inline constexpr float kMiddleGrey = 0.18f;

/// A tone curve, for linear Rec. 709 colours c in which 0.18 is middle grey:
///
///     shown = outset * f(inset * c),   f channel by channel, clamped to [0, 1]
///
/// - agx: f is a sigmoid over the logarithm, in which 10 stops below and 6.5 stops above middle
///   grey are shown, slope 2.4 at middle grey; the inset mixes a fifth of grey into each channel,
///   so that bright saturated colours run to white, and the outset takes it out again. After
///   [AgX], but with an inset of its own, in the display's primaries.
/// - aces: the fit of [Narkowicz2015], scaled so that middle grey stays.
/// - srgb: no curve, what is above 1 is cut off.
///
/// The graphics card reads f from table(), so that there is one definition of each curve.
class ToneCurve {
public:
    explicit ToneCurve(ToneStyle style);

    /// What is shown of a colour: linear, each channel in [0, 1].
    Rgb shown(Rgb colour) const;

    float curve(float value) const; ///< f
    const glm::mat3& inset() const { return inset_; }
    const glm::mat3& outset() const { return outset_; }

    /// f at kTableSize values whose log2 are evenly spaced from kTableFirst to kTableLast.
    std::vector<float> table() const;

    static constexpr int kTableSize = 4096;
    static constexpr float kTableFirst = -16, kTableLast = 16; ///< [stops above 1]

private:
    ToneStyle style_;
    glm::mat3 inset_{1.0f}, outset_{1.0f};
};

/// What a display shows when `middleGrey` [nit] is shown as 18 % grey. Not a number is shown black.
ToneMap toneMap(float middleGrey, ToneStyle style);

} // namespace penumbra
