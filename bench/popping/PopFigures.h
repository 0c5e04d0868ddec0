// How visible it is that a picture changes when it should not.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace penumbra {

/// The smallest step in luminance from one picture of a 60 Hz display to the next that is just
/// seen, as a share of the luminance:
///
///     c = 1 / (0.417 S_5),  log10 S_5 = log10 S_p - (x < 0 ? 0.059 |x|^1.466 : 0.0848 x^2)
///     S_p = 5273.1 (1 + 49726 / L)^-0.439,  f_p = 1.618 (1 + 2.06 / L)^-0.115,  x = log2(1.6 /
///     f_p)
///
/// S_5 is our own fit to the transient channel of castleCSF at 5 Hz, taken at 1.6 cycles a degree;
/// 0.417 is what that channel makes of a step (ColorVideoVDP). \param luminance as displayed [nit]
double visibleStep(double luminance);

/// Luminances of pictures that follow each other, one a frame, and of what they should have been
/// [nit].
struct FramePair {
    std::vector<float> shown, exact;
};

/// Changes of the error e = shown - exact, so that true motion does not count, in visible steps.
struct PopFigures {
    double most = 0;    ///< of all pixels, of the largest step of each over time
    double p999 = 0;    ///< the 99.9th percentile of these
    double share = 0;   ///< of pixels with a step above 1
    double flicker = 0; ///< 99.9th percentile of excess variation: sum |de| - |e_end - e_0|
};

/// \param frames a run of them; steps between neighbours are counted
/// \param toDisplay nits on the display a nit of the scene
PopFigures popFigures(std::span<const FramePair> frames, double toDisplay);

/// The largest step of one pixel.
struct PixelStep {
    std::size_t pixel = 0, frame = 0; ///< from frame - 1 to frame
    double size = 0;                  ///< in visible steps
};
/// The pixels with the largest steps, the largest first, at most so many.
std::vector<PixelStep> worstSteps(std::span<const FramePair> frames, double toDisplay,
                                  std::size_t most);

/// The p-th percentile (in [0, 1]) of |e| in units of the contrast that is just seen of what does
/// not move, at the frequency that is seen best.
double visibleError(const FramePair& frame, double toDisplay, double p);

} // namespace penumbra
