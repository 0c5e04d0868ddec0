// The luminance that the eye is adapted to, and how it follows the picture.
#pragma once

#include <span>

namespace penumbra {

/// Luminance that the eye adapts to in a picture as a whole: the geometric mean, which follows what
/// most of the picture is like and not its few lights.
///
/// \param luminances of pixels [nit]; those below 1e-4 nit count as that
/// \return           [nit]; 1e-4 for an empty picture
///
/// Reinhard, Stark, Shirley & Ferwerda, SIGGRAPH 2002, equation 1.  [docs/references.md]
double meanAdaptation(std::span<const float> luminances);

/// Luminance that the eye is adapted to where it looks at a surface: the surface's own, for
/// adaptation reaches less than a degree around [Vangorp2015], and a two-hundredth of the
/// picture's, for some of that is scattered everywhere within the eye. \param surface, picture
/// [nit]; \return [nit], at least 1e-4
double localAdaptation(double surface, double picture);

/// The eye's state of adaptation as time passes: it nears what it looks at exponentially,
///
///     A += (Y - A) (1 - exp(-t / tau(Y)))     tau = 0.4 s * sigma + 0.1 s * (1 - sigma)
///
/// with sigma = 0.04 / (0.04 + Y), the share of the rods, which are the slower ones.
///
/// Krawczyk, Myszkowski & Seidel, "Perceptual effects in real-time tone mapping", SCCG 2005,
/// equations 5 to 7.  [docs/references.md]
class Adaptation {
public:
    /// \param luminance adapted to at first [nit], > 0
    explicit Adaptation(double luminance = 100) : luminance_(luminance) {}

    /// The eye has looked at a picture of mean `luminance` [nit], > 0, for `seconds` >= 0.
    void adapt(double luminance, double seconds);
    double luminance() const { return luminance_; } ///< [nit]

private:
    double luminance_;
};

} // namespace penumbra
