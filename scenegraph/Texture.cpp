#include "scenegraph/Texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace penumbra {

namespace {

/// Where texel `i` of `count` is taken from; -1: it is black.
int wrapped(std::int64_t i, int count, TextureWrap wrap) {
    if (i >= 0 && i < count) return int(i);
    switch (wrap) {
    case TextureWrap::repeat:
        return int((i % count + count) % count);
    case TextureWrap::mirror: {
        const std::int64_t twice = 2 * std::int64_t(count);
        const std::int64_t at = (i % twice + twice) % twice;
        return int(at < count ? at : twice - 1 - at);
    }
    case TextureWrap::clamp:
        return i < 0 ? 0 : count - 1;
    case TextureWrap::black:
        break;
    }
    return -1;
}

Rgb texelOf(const Texture& texture, int level, std::int64_t x, std::int64_t y) {
    const TextureImage& image = *texture.image;
    const int column = wrapped(x, image.width(level), texture.wrapS);
    const int row = wrapped(y, image.height(level), texture.wrapT);
    const Rgb texel = column < 0 || row < 0 ? Rgb() : image.texel(level, column, row);
    const Rgb value = texture.scale * texel + texture.bias;
    return {std::max(value.r, 0.0f), std::max(value.g, 0.0f), std::max(value.b, 0.0f)};
}

/// In texels of a level, from the upper left corner.
glm::dvec2 placeOf(const Texture& texture, glm::vec2 uv, int level) {
    constexpr double kFarthest = 1e6; // pictures away: nobody can tell what is there
    const glm::dvec2 at = glm::clamp(glm::dvec2(texture.turn * uv + texture.shift),
                                     glm::dvec2(-kFarthest), glm::dvec2(kFarthest));
    return {at.x * texture.image->width(level), (1 - at.y) * texture.image->height(level)};
}

/// A small convex polygon, cut by lines along the axes [SutherlandHodgman1974].
struct Outline {
    std::array<glm::dvec2, 8> points{};
    std::size_t count = 0;

    /// What lies at `limit` or beyond it on the side of `sign`.
    Outline cut(int axis, double limit, double sign) const {
        Outline kept;
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec2 a = points[i], b = points[(i + 1) % count];
            const double da = sign * (a[axis] - limit), db = sign * (b[axis] - limit);
            if (da >= 0) kept.points[kept.count++] = a;
            if ((da > 0 && db < 0) || (da < 0 && db > 0))
                kept.points[kept.count++] = a + da / (da - db) * (b - a);
        }
        return kept;
    }
    double area() const {
        double twice = 0;
        for (std::size_t i = 2; i < count; ++i) {
            const glm::dvec2 a = points[i - 1] - points[0], b = points[i] - points[0];
            twice += a.x * b.y - a.y * b.x;
        }
        return 0.5 * std::abs(twice);
    }
    std::pair<double, double> extent(int axis) const {
        std::pair<double, double> range{points[0][axis], points[0][axis]};
        for (std::size_t i = 1; i < count; ++i) {
            range.first = std::min(range.first, points[i][axis]);
            range.second = std::max(range.second, points[i][axis]);
        }
        return range;
    }
};

/// Sums of values times areas.
struct AreaSum {
    glm::dvec3 sum{0.0};
    double area = 0;

    void add(Rgb value, double weight) {
        sum += weight * glm::dvec3(value.r, value.g, value.b);
        area += weight;
    }
};

/// The part of an outline within one row of texels.
void addRow(const Texture& texture, int level, const Outline& strip, std::int64_t row,
            AreaSum& out) {
    const auto [low, high] = strip.extent(0);
    const auto first = std::int64_t(std::floor(low)), last = std::int64_t(std::floor(high));
    Outline rest = strip;
    for (std::int64_t x = first; x <= last && rest.count > 2; ++x) {
        out.add(texelOf(texture, level, x, row), rest.cut(0, double(x + 1), -1).area());
        rest = rest.cut(0, double(x + 1), 1);
    }
}

/// The finest level at which so much of the picture is no more than kMostAcross texels wide.
int levelFor(const Texture& texture, std::span<const glm::vec2, 3> triangle) {
    Outline fine;
    for (const glm::vec2 uv : triangle) fine.points[fine.count++] = placeOf(texture, uv, 0);
    const auto [left, right] = fine.extent(0);
    const auto [top, bottom] = fine.extent(1);
    int level = 0;
    for (double across = std::max(right - left, bottom - top);
         across > Texture::kMostAcross && level + 1 < texture.image->levels(); across /= 2)
        ++level;
    return level;
}

} // namespace

Rgb Texture::at(glm::vec2 uv) const {
    const glm::dvec2 place = placeOf(*this, uv, 0) - 0.5;
    const glm::dvec2 corner = glm::floor(place);
    const glm::vec2 part(place - corner);
    const auto x = std::int64_t(corner.x), y = std::int64_t(corner.y);
    const auto row = [&](std::int64_t j) {
        return (1 - part.x) * texelOf(*this, 0, x, j) + part.x * texelOf(*this, 0, x + 1, j);
    };
    return (1 - part.y) * row(y) + part.y * row(y + 1);
}

Rgb Texture::mean() const {
    return texelOf(*this, image->levels() - 1, 0, 0);
}

Rgb Texture::mean(std::span<const glm::vec2, 3> triangle) const {
    constexpr double kMostTexels = 1e4; // across, where even the last level repeats that often
    const int level = levelFor(*this, triangle);
    Outline outline;
    for (const glm::vec2 uv : triangle) outline.points[outline.count++] = placeOf(*this, uv, level);
    const auto [top, bottom] = outline.extent(1);
    const auto [left, right] = outline.extent(0);
    AreaSum sum;
    if (std::max(bottom - top, right - left) > kMostTexels) return mean();
    const auto first = std::int64_t(std::floor(top)), last = std::int64_t(std::floor(bottom));
    for (std::int64_t y = first; y <= last && outline.count > 2; ++y) {
        const Outline strip = outline.cut(1, double(y + 1), -1);
        if (strip.count > 2) addRow(*this, level, strip, y, sum);
        outline = outline.cut(1, double(y + 1), 1);
    }
    if (!(sum.area > 1e-12)) return at((triangle[0] + triangle[1] + triangle[2]) / 3.0f);
    return {float(sum.sum.x / sum.area), float(sum.sum.y / sum.area), float(sum.sum.z / sum.area)};
}

} // namespace penumbra
