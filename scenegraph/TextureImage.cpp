#include "scenegraph/TextureImage.h"

#include "base/Srgb.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace penumbra {

namespace {

constexpr float kMostRoot = 65535;

float usable(float v) {
    constexpr float kMost = 1e30f;
    return v > 0 ? std::min(v, kMost) : 0;
}

/// How much of the fine texels [first, first + 3) a coarse one covers, in units of fine ones.
struct Cover {
    int first = 0;
    std::array<float, 4> weight{};

    Cover(int coarse, int coarseCount, int fineCount) {
        const double ratio = double(fineCount) / coarseCount; // 1, 2, or up to 3
        const double low = coarse * ratio, high = low + ratio;
        first = int(low);
        for (int i = 0; i < 4; ++i) {
            const double from = std::max(low, double(first + i));
            const double to = std::min(high, double(first + i + 1));
            weight[std::size_t(i)] = first + i < fineCount ? float(std::max(0.0, to - from)) : 0;
        }
    }
};

} // namespace

TextureImage::TextureImage(std::string name, int width, int height, std::vector<std::uint8_t> rgb,
                           bool srgb)
    : name_(std::move(name)), fine_(std::move(rgb)) {
    assert(fine_.size() == 3 * std::size_t(width) * std::size_t(height));
    decodeAs(srgb);
    buildLevels(width, height);
}

TextureImage::TextureImage(std::string name, int width, int height, const std::vector<float>& rgb)
    : name_(std::move(name)) {
    assert(rgb.size() == 3 * std::size_t(width) * std::size_t(height));
    float most = 0;
    for (const float v : rgb) most = std::max(most, usable(v));
    peak_ = most > 0 ? most : 1;
    roots_.reserve(rgb.size() * 4 / 3 + 64);
    for (const float v : rgb) roots_.push_back(root(usable(v)));
    buildLevels(width, height);
}

TextureImage::TextureImage(const TextureImage& finer, int level)
    : name_(finer.name_), peak_(finer.peak_) {
    if (level == 0 && !finer.fine_.empty()) {
        fine_ = finer.fine_;
        decodeAs(finer.srgb_);
    } else {
        const Level& from = finer.levels_[std::size_t(level)];
        const auto first = finer.roots_.begin() + std::ptrdiff_t(from.first);
        roots_.assign(first, first + std::ptrdiff_t(3 * finer.texels(level)));
    }
    buildLevels(finer.width(level), finer.height(level));
}

TextureImage::TextureImage(Packed packed)
    : name_(std::move(packed.name)), fine_(std::move(packed.fine)), roots_(std::move(packed.roots)),
      peak_(packed.peak) {
    if (!fine_.empty()) decodeAs(packed.coding == 1);
    buildLevels(packed.width, packed.height);
}

TextureImage::Packed TextureImage::packed() const {
    Packed packed{name_, width(), height(), 2, peak_, fine_, {}};
    if (!fine_.empty())
        packed.coding = srgb_ ? 1 : 0;
    else
        packed.roots.assign(roots_.begin(), roots_.begin() + std::ptrdiff_t(3 * texels()));
    return packed;
}

std::shared_ptr<const TextureImage> TextureImage::unpacked(Packed packed) {
    const auto within = [](int n) { return n > 0 && n <= kLargest; };
    if (!within(packed.width) || !within(packed.height) || packed.coding > 2) return nullptr;
    if (!std::isfinite(packed.peak) || !(packed.peak > 0)) return nullptr;
    const std::size_t values = 3 * std::size_t(packed.width) * std::size_t(packed.height);
    const bool isFine = packed.coding < 2;
    if (packed.fine.size() != (isFine ? values : 0)) return nullptr;
    if (packed.roots.size() != (isFine ? 0 : values)) return nullptr;
    return std::shared_ptr<const TextureImage>(new TextureImage(std::move(packed)));
}

void TextureImage::decodeAs(bool srgb) {
    srgb_ = srgb;
    for (std::size_t i = 0; i < decoded_.size(); ++i) {
        const float v = float(i) / 255;
        decoded_[i] = srgb ? linearFromSrgb(v) : v;
    }
}

std::uint16_t TextureImage::root(float value) const {
    return std::uint16_t(std::lround(kMostRoot * std::sqrt(std::min(value / peak_, 1.0f))));
}

std::size_t TextureImage::bytes() const {
    return fine_.size() + roots_.size() * sizeof(std::uint16_t);
}

Rgb TextureImage::texel(int level, int x, int y) const {
    const Level& from = levels_[std::size_t(level)];
    const std::size_t at = 3 * (std::size_t(y) * std::size_t(from.width) + std::size_t(x));
    if (level == 0 && !fine_.empty())
        return {decoded_[fine_[at]], decoded_[fine_[at + 1]], decoded_[fine_[at + 2]]};
    const auto value = [&](std::size_t k) {
        const float part = float(roots_[from.first + at + k]) * (1 / kMostRoot);
        return peak_ * part * part;
    };
    return {value(0), value(1), value(2)};
}

void TextureImage::buildLevels(int width, int height) {
    levels_.push_back({width, height, 0});
    while (levels_.back().width > 1 || levels_.back().height > 1) addLevel();
    roots_.shrink_to_fit();
}

/// Box means of the last level.
void TextureImage::addLevel() {
    const int finer = levels() - 1;
    const Level from = levels_.back();
    const Level to{std::max(1, from.width / 2), std::max(1, from.height / 2), roots_.size()};
    std::vector<Cover> across;
    for (int x = 0; x < to.width; ++x) across.emplace_back(x, to.width, from.width);
    const float share = float(double(to.width) * to.height / (double(from.width) * from.height));
    for (int y = 0; y < to.height; ++y) {
        const Cover down(y, to.height, from.height);
        for (const Cover& over : across) {
            Rgb sum;
            for (int j = 0; j < 4; ++j)
                for (int i = 0; i < 4 && down.weight[std::size_t(j)] > 0; ++i) {
                    const float weight = down.weight[std::size_t(j)] * over.weight[std::size_t(i)];
                    if (weight > 0) sum += weight * texel(finer, over.first + i, down.first + j);
                }
            sum *= share;
            for (const float v : {sum.r, sum.g, sum.b}) roots_.push_back(root(v));
        }
    }
    levels_.push_back(to);
}

} // namespace penumbra
