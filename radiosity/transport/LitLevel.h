// How bright it is where there is light, and how large a bound is beside that.
#pragma once

#include <utility>
#include <vector>

namespace penumbra {

/// The illuminance that half of the lit area has, by area, of surfaces that reflect:
///
///     H_lit = area-weighted median of H over patches with H > 0 and rho > 0      [lux]
///
/// H is the largest of the three channels, with what is not sent yet as the ambient light that is
/// drawn for it: what a shade leaves may be less than relaxation was to find. A median, since
/// behind a shade a mean says how bright the few surfaces near the emitter are. Surfaces that no
/// light reaches do not count, nor what is far (see Patch) unless there is nothing else.
class LitLevel {
public:
    /// \param illuminance [lux]; at or below 0 it is not lit \param area [m^2]
    void add(double illuminance, double area);
    /// H_lit [lux]; 0: nothing is lit.
    double median() const;

private:
    std::vector<std::pair<double, double>> lit_; ///< illuminance and area
};

/// The certificate C as a share of what is lit, C / H_lit. C bounds what patches may still send
/// [lm/m^2], and so what surfaces may still receive [lux]. At 1 and more it says nothing: the
/// light may as well be twice as strong, or not there.
/// \return 0 if nothing is lit
inline double certificateOfLit(double certificate, double litIlluminance) {
    return litIlluminance > 0 ? certificate / litIlluminance : 0;
}

} // namespace penumbra
