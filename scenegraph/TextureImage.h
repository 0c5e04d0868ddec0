// A picture on surfaces: pixels, and means of them.
#pragma once

#include "base/Rgb.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace penumbra {

/// An immutable picture in linear Rec. 709, with a pyramid of means of light: level 0 has the
/// pixels, each further level half as many columns and rows, the last one a single mean of all.
/// Texels of odd numbers are shared by area, so that every level has the same mean.
class TextureImage {
public:
    static constexpr int kLargest = 16384; ///< width and height

    /// Pixels of 8 bits, sRGB (IEC 61966-2-1) or linear. \param rgb three a pixel, top row first
    TextureImage(std::string name, int width, int height, std::vector<std::uint8_t> rgb, bool srgb);
    /// Linear pixels of any range; what is negative or no number counts as 0.
    TextureImage(std::string name, int width, int height, const std::vector<float>& rgb);
    /// The same picture from one of its levels on: coarser, and smaller.
    TextureImage(const TextureImage& finer, int level);

    const std::string& name() const { return name_; } ///< of its file
    int levels() const { return int(levels_.size()); }
    int width(int level = 0) const { return levels_[std::size_t(level)].width; }
    int height(int level = 0) const { return levels_[std::size_t(level)].height; }
    std::size_t texels(int level = 0) const {
        return std::size_t(width(level)) * std::size_t(height(level));
    }
    std::size_t bytes() const; ///< of all levels in memory

    /// \pre the texel is there; row 0 is the top one
    Rgb texel(int level, int x, int y) const;
    Rgb mean() const { return texel(levels() - 1, 0, 0); }

    /// Bytes that say all of it: 8 bits a channel as they came, or 16 bits.
    struct Packed {
        std::string name;
        std::int32_t width = 0, height = 0;
        std::uint8_t coding = 0; ///< 0: 8 bits linear, 1: 8 bits sRGB, 2: 16 bits
        float peak = 1;          ///< value of the largest number of 16 bits
        std::vector<std::uint8_t> fine;
        std::vector<std::uint16_t> roots;
    };
    Packed packed() const;
    /// \return null if the parts do not fit each other
    static std::shared_ptr<const TextureImage> unpacked(Packed packed);
    /// The pixels as they came in, if they have 8 bits; else empty.
    const std::vector<std::uint8_t>& pixels8() const { return fine_; }
    bool srgb() const { return srgb_; }

private:
    struct Level {
        int width = 0, height = 0;
        std::size_t first = 0; ///< in roots_; level 0 is in fine_ if that has anything
    };
    explicit TextureImage(Packed packed);
    void decodeAs(bool srgb);
    void buildLevels(int width, int height);
    void addLevel();
    std::uint16_t root(float value) const;

    std::string name_;
    bool srgb_ = false;
    std::vector<std::uint8_t> fine_;   ///< level 0, if that has 8 bits
    std::array<float, 256> decoded_{}; ///< values of its bytes
    /// Other levels, as roots: value = peak * (root / 65535)^2, which is finer where it is darker.
    std::vector<std::uint16_t> roots_;
    float peak_ = 1;
    std::vector<Level> levels_;
};

} // namespace penumbra
