// Textures in the memory of the graphics card.
#pragma once

#include "scenegraph/Material.h"
#include "viewer/gl/GlObject.h"
#include "viewer/gl/ShaderProgram.h"

#include <cstddef>
#include <map>
#include <memory>
#include <tuple>

namespace penumbra {

/// Uploads each picture once, with its means as mip levels. Pictures of 8 bits stay sRGB or linear
/// bytes, and may be compressed to BC1 (6 : 1, where OpenGL can); others become 16-bit floats.
/// What is gone from the scene is dropped.
class TextureCache {
public:
    struct Options {
        bool compressed = false;
        /// Pictures begin with their small levels; refine() brings the others.
        bool gradual = false;
    };
    explicit TextureCache(Options options) : options_(options) {}

    void dropDead();
    /// Uploads about so many texels that are missing yet, of the blurriest pictures first.
    /// \return whether any are still missing
    bool refine(std::size_t texels);
    /// Gives a program in use the colours of a material and its textures.
    void setMaterial(const ShaderProgram& program, Rgb reflectance, Rgb emission,
                     const MaterialTextures& textures);

    std::size_t size() const { return entries_.size(); }
    std::size_t bytes() const { return bytes_; } ///< as OpenGL says, all levels

private:
    struct Entry {
        std::weak_ptr<const TextureImage> alive; ///< an address alone might be that of a later one
        GlObject texture;
        std::size_t bytes = 0;
        int largest = 0; ///< level that OpenGL has as its level 0
        int finest = 0;  ///< level that is there as a whole
        int rows = 0;    ///< that are there of the next finer one
    };
    unsigned nameOf(const Texture& texture);
    Entry begin(const Texture& texture) const;
    std::size_t addRows(Entry& entry, const TextureImage& image, std::size_t texels) const;

    Options options_;
    std::map<std::tuple<const TextureImage*, TextureWrap, TextureWrap>, Entry> entries_;
    std::size_t bytes_ = 0;
};

} // namespace penumbra
