// What a view shows of the drawn surface, found once, lit again and again.
#pragma once

#include "base/Rgb.h"
#include "base/ViewMeter.h"
#include "importance/Pyramid.h"
#include "radiosity/mesh/PatchSet.h"
#include "radiosity/transport/Solver.h"
#include "scenegraph/Camera.h"

#include <array>
#include <cstdint>
#include <vector>

namespace penumbra {

/// The point of the drawn surface under the middle of every pixel, and so the picture for any state
/// of the light, as the renderer would interpolate it, at the cost of a few sums a pixel. Holds for
/// one placement of the objects.
class DrawnView {
public:
    /// Traces a ray a pixel. `patches` must outlive this.
    DrawnView(const PatchSet& patches, const View& view, int width, int height);

    int width() const { return width_; }
    int height() const { return height_; }

    /// What is seen, pixel by pixel, top row first; black where nothing is [nit].
    std::vector<Rgb> colours(const Lighting& light) const;
    /// Its luminance [nit].
    Plane luminances(const Lighting& light) const;
    /// The luminances by which the view is exposed, see base/ViewMeter.h.
    std::vector<float> metered(const Lighting& light) const;
    /// How many pixels each vertex has a part in, all parts of a pixel being 1.
    std::vector<float> vertexPixels() const;
    /// An item buffer of the blocks of vertices, see importance/SeenItems.h.
    std::vector<std::uint32_t> blocks() const;

private:
    struct Pixel {
        std::uint32_t element = Element::kNone;
        std::array<std::uint32_t, 3> vertices{};
        std::array<float, 3> weights{};
        glm::vec2 uv{}; ///< texture coordinates, if there are any
    };
    Rgb colour(const Pixel& pixel, const Lighting& light) const;

    void meterPoint(const Pixel& pixel, const Lighting& light, MeterCell& cell) const;

    const PatchSet& patches_;
    int width_, height_;
    std::vector<Pixel> pixels_;
};

/// Meters a view with one ray for every point of the grid.
std::vector<float> meterView(const PatchSet& patches, const View& view, const Lighting& light);

} // namespace penumbra
