#include "radiosity/query/DrawnView.h"

#include "base/Parallel.h"
#include "importance/SeenItems.h"
#include "radiosity/query/DrawnSurface.h"

#include <numbers>

namespace penumbra {

DrawnView::DrawnView(const PatchSet& patches, const View& view, int width, int height)
    : patches_(patches), width_(width), height_(height),
      pixels_(std::size_t(width) * std::size_t(height)) {
    const DrawnSurface surface(patches);
    const glm::dmat4 clipToWorld = glm::inverse(view.worldToClip());
    const auto unprojected = [&](double x, double y, double depth) {
        const glm::dvec4 point = clipToWorld * glm::dvec4(x, y, depth, 1);
        return glm::dvec3(point) / point.w;
    };
    parallelFor(std::size_t(height), 4, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first * std::size_t(width); i < last * std::size_t(width); ++i) {
            const std::size_t column = i % std::size_t(width), row = i / std::size_t(width);
            const double x = 2 * (double(column) + 0.5) / width - 1;
            const double y = 1 - 2 * (double(row) + 0.5) / height;
            const glm::dvec3 from = unprojected(x, y, -1);
            const glm::vec3 direction(glm::normalize(unprojected(x, y, 1) - from));
            const DrawnHit hit = surface.nearest(glm::vec3(from), direction, 1e30f);
            pixels_[i] = {hit.element, hit.vertices, hit.weights, {}};
            if (hit.met()) pixels_[i].uv = uvOf(patches, hit);
        }
    });
}

Rgb DrawnView::colour(const Pixel& pixel, const Lighting& light) const {
    if (pixel.element == Element::kNone) return {};
    Rgb lux;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = pixel.vertices[k];
        lux += pixel.weights[k] * (light.direct[v] + light.indirect[v]);
    }
    const LitMaterial material = surfaceAt(patches_, pixel.element, pixel.uv);
    return material.emission + std::numbers::inv_pi_v<float> * (material.reflectance * lux);
}

std::vector<Rgb> DrawnView::colours(const Lighting& light) const {
    std::vector<Rgb> colours;
    colours.reserve(pixels_.size());
    for (const Pixel& pixel : pixels_) colours.push_back(colour(pixel, light));
    return colours;
}

Plane DrawnView::luminances(const Lighting& light) const {
    Plane plane(width_, height_);
    for (std::size_t i = 0; i < pixels_.size(); ++i)
        plane.values[i] = luminance(colour(pixels_[i], light));
    return plane;
}

void DrawnView::meterPoint(const Pixel& pixel, const Lighting& light, MeterCell& cell) const {
    if (pixel.element == Element::kNone) return;
    const LitMaterial material = surfaceAt(patches_, pixel.element, pixel.uv);
    const bool emits = maxChannel(material.emission) > 0;
    (emits ? cell.emitted : cell.reflected) += luminance(colour(pixel, light));
    (emits ? cell.emitting : cell.reflecting) += 1;
}

std::vector<float> DrawnView::metered(const Lighting& light) const {
    constexpr int kSide = MeterGrid::kSide;
    constexpr int kAcross = MeterGrid::kColumns * kSide, kDown = MeterGrid::kRows * kSide;
    std::vector<MeterCell> cells(std::size_t(MeterGrid::kColumns * MeterGrid::kRows));
    for (int y = 0; y < kDown; ++y)
        for (int x = 0; x < kAcross; ++x) {
            const auto column = std::size_t((2 * x + 1) * width_ / (2 * kAcross));
            const auto row = std::size_t((2 * y + 1) * height_ / (2 * kDown));
            const auto cell = std::size_t(y / kSide) * MeterGrid::kColumns + std::size_t(x / kSide);
            meterPoint(pixels_[row * std::size_t(width_) + column], light, cells[cell]);
        }
    return meteredLuminances(cells);
}

std::vector<float> meterView(const PatchSet& patches, const View& view, const Lighting& light) {
    constexpr int kAcross = MeterGrid::kColumns * MeterGrid::kSide;
    constexpr int kDown = MeterGrid::kRows * MeterGrid::kSide;
    return DrawnView(patches, view, kAcross, kDown).metered(light);
}

std::vector<float> DrawnView::vertexPixels() const {
    std::vector<float> pixels(patches_.vertices.size());
    for (const Pixel& pixel : pixels_)
        for (std::size_t k = 0; k < 3 && pixel.element != Element::kNone; ++k)
            pixels[pixel.vertices[k]] += pixel.weights[k];
    return pixels;
}

std::vector<std::uint32_t> DrawnView::blocks() const {
    std::vector<std::uint32_t> blocks;
    blocks.reserve(pixels_.size());
    for (const Pixel& pixel : pixels_)
        blocks.push_back(pixel.element == Element::kNone ? kNoItem
                                                         : pixel.vertices[0] / PatchSet::kBlock);
    return blocks;
}

} // namespace penumbra
