// How little contrast the eye can see.
#pragma once

namespace penumbra {

/// Reciprocal of the contrast at which a still grating is just seen, achromatic, within
/// a Gaussian window of 1.5 degrees. Contrast is amplitude over mean luminance.
///
///     log10 S = log10 S_p - (x < 0 ? 0.200 |x|^1.269 : 0.1203 x^2)     x = log2(frequency / f_p)
///     S_p = 378.2 (1 + 37.21 / L)^-0.364          f_p = 2.942 (1 + 27.38 / L)^-0.197
///
/// Our own fit to the achromatic sustained channel of castleCSF as tabulated with ColorVideoVDP:
/// 0.017 in log10 off (r.m.s., at most 0.06) for 0.05 to 1000 nit and 0.2 to 16 cycles per degree;
/// beyond that a continuation.
///
/// \param frequency [cycles per degree], > 0
/// \param luminance mean of the grating, which the eye is adapted to [nit], > 0
///
/// Ashraf, Mantiuk, Chapiro & Wuerger, Journal of Vision 24(4):5, 2024; Mantiuk, Hanji, Ashraf,
/// Asano & Chapiro, ACM TOG 43(4), 2024.  [docs/references.md]
double contrastSensitivity(double frequency, double luminance);

/// The same at the frequency that is seen best, in one term: for scheduling.
///
///     S = 364.2 (1 + 29.994 / L)^-0.394        2.2 % off for 0.01 to 2000 nit
double peakContrastSensitivity(double luminance);

} // namespace penumbra
