// Exposure that follows what is seen, as eyes do.
#pragma once

#include "io/image/Exposure.h"

#include <cmath>
#include <optional>
#include <span>

namespace penumbra {

/// The luminance that is shown as middle grey [nit]. It runs after what is measured in the picture,
/// in stops, exponentially in time, so that it does not depend on the frame rate:
///
///     g(t + dt) = target + (g(t) - target) e^(-dt / tau),   g = log2(middle grey)
///
/// with tau shorter towards the bright than towards the dark, as people adapt. Or it stays where a
/// person has set it.
class AutoExposure {
public:
    static constexpr double kBrighterSeconds = 0.25; ///< tau when the scene got brighter
    static constexpr double kDarkerSeconds = 0.6;    ///< tau when it got darker

    /// Takes in what is reflected to the eye [nit], by middleGreyOf(); nothing of it positive: no
    /// news. The first measurement is taken over at once.
    void measure(std::span<const float> luminances);

    /// Lets time pass. \param held true: it stays, so as not to move under a fade
    void advance(double seconds, bool held = false);

    /// What is shown as middle grey now, 2^-compensation of what was adapted to, or of the fixed.
    float middleGrey() const;

    /// A fixed middle grey [nit], or none: automatic. Going back to automatic begins where it is.
    void fix(std::optional<float> middleGrey);
    bool automatic() const { return !fixed_; }

    bool measured() const { return target_.has_value(); }
    /// middleGrey() without compensation.
    float uncompensated() const;

    /// Stops by which the picture is made brighter than it would be.
    float compensation() const { return compensation_; }
    void setCompensation(float stops) { compensation_ = stops; }

    /// Whether adaptation has come to rest, to a hundredth of a stop.
    bool settled() const;

private:
    std::optional<double> target_; ///< log2 of [nit]; none: nothing was measured yet
    double current_ = std::log2(double(kUnmeasuredGrey)); ///< the same
    std::optional<float> fixed_;                          ///< [nit]
    float compensation_ = 0;
};

} // namespace penumbra
