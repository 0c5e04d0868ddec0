// One rendered picture with everything that is known about its pixels.
#pragma once

#include "base/ObjectId.h"
#include "base/Rgb.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

namespace penumbra {

/// What a display shows of a luminance [nit]: linear Rec. 709, each channel in [0, 1].
using ToneMap = std::function<Rgb(Rgb)>;

/// A picture and its layers, each width x height, top row first: pixel (x, y) is element
/// index(x, y). Two kinds of layers, because one may be averaged over a pixel and the other may
/// not:
///
/// * beauty, alpha, direct and indirect are means over the area of the pixel. In every pixel
///       beauty = emission + direct + indirect
///   and what is not covered by a surface counts as black, so colours are premultiplied by alpha;
/// * the others describe the one surface point under the centre of the pixel.
struct FrameLayers {
    FrameLayers() = default;

    /// A picture of nothing: black, and the background's values in the other layers.
    FrameLayers(int frameWidth, int frameHeight)
        : width(frameWidth), height(frameHeight), beauty(pixelCount()), alpha(pixelCount()),
          direct(pixelCount()), indirect(pixelCount()), albedo(pixelCount()),
          illuminance(pixelCount()), normal(pixelCount(), glm::vec3(0)),
          depth(pixelCount(), kNoDepth), objectId(pixelCount()) {}

    static constexpr float kNoDepth = std::numeric_limits<float>::infinity();

    int width = 0;
    int height = 0;
    std::vector<Rgb> beauty;        ///< luminance [nit = cd/m^2]
    std::vector<float> alpha;       ///< covered part of the pixel, 0 to 1
    std::vector<Rgb> direct;        ///< luminance by light straight from emitters [nit]
    std::vector<Rgb> indirect;      ///< luminance by interreflected light [nit]
    std::vector<Rgb> albedo;        ///< reflectance rho; background 0
    std::vector<Rgb> illuminance;   ///< direct and indirect together [lux]; background 0
    std::vector<glm::vec3> normal;  ///< unit, world frame; background 0
    std::vector<float> depth;       ///< distance along the viewing axis [m]; background kNoDepth
    std::vector<ObjectId> objectId; ///< background ObjectId::kNone

    /// For people: the mean of what a ToneMap shows of the pixel's samples, in [0, 1]; empty unless
    /// it was asked for. Means are taken after the tone curve, for that of luminances would show
    /// the edge of a light as bright as the light.
    std::vector<Rgb> shown;

    std::size_t pixelCount() const { return std::size_t(width) * std::size_t(height); }
    std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(width) + x; }
};

} // namespace penumbra
