#include "viewer/gl/TextureCache.h"

#include "base/Srgb.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace penumbra {

namespace {

constexpr int kReflectanceUnit = 4, kEmissionUnit = 5; ///< lower ones are those of shadow maps

GLint wrapMode(TextureWrap wrap) {
    switch (wrap) {
    case TextureWrap::mirror:
        return GL_MIRRORED_REPEAT;
    case TextureWrap::clamp:
        return GL_CLAMP_TO_EDGE;
    case TextureWrap::black:
        return GL_CLAMP_TO_BORDER;
    case TextureWrap::repeat:
        break;
    }
    return GL_REPEAT;
}

std::uint8_t toByte(float v, bool srgb) {
    if (srgb) v = srgbFromLinear(v);
    return std::uint8_t(std::lround(255 * std::clamp(v, 0.0f, 1.0f)));
}

/// The format of a picture in OpenGL's memory.
GLint formatOf(const TextureImage& image, bool compressed) {
    if (image.pixels8().empty()) return GL_RGB16F;
    const bool can = compressed && epoxy_has_gl_extension("GL_EXT_texture_compression_s3tc");
    if (image.srgb())
        return can && epoxy_has_gl_extension("GL_EXT_texture_sRGB")
                   ? GL_COMPRESSED_SRGB_S3TC_DXT1_EXT
                   : GL_SRGB8;
    return can ? GL_COMPRESSED_RGB_S3TC_DXT1_EXT : GL_RGB8;
}

/// Fills rows of a mip level that OpenGL has room for.
void uploadRows(const TextureImage& image, int level, GLint mip, int first, int count) {
    const GLsizei width = image.width(level);
    const bool bytes = !image.pixels8().empty();
    const auto upload = [&](const void* data) {
        glTexSubImage2D(GL_TEXTURE_2D, mip, 0, first, width, count, GL_RGB,
                        bytes ? GL_UNSIGNED_BYTE : GL_FLOAT, data);
    };
    if (level == 0 && bytes)
        return upload(image.pixels8().data() + 3 * std::size_t(first) * std::size_t(width));
    std::vector<std::uint8_t> fine;
    std::vector<float> wide;
    for (int y = first; y < first + count; ++y)
        for (int x = 0; x < width; ++x) {
            const Rgb texel = image.texel(level, x, y);
            for (const float v : {texel.r, texel.g, texel.b}) {
                if (bytes)
                    fine.push_back(toByte(v, image.srgb()));
                else
                    wide.push_back(std::min(v, 65504.0f)); // the largest 16-bit float
            }
        }
    upload(bytes ? static_cast<const void*>(fine.data()) : wide.data());
}

std::size_t bytesOfLevel(GLint mip) {
    GLint compressed = GL_FALSE, bytes = 0, width = 0, height = 0, bits = 0;
    glGetTexLevelParameteriv(GL_TEXTURE_2D, mip, GL_TEXTURE_COMPRESSED, &compressed);
    if (compressed) {
        glGetTexLevelParameteriv(GL_TEXTURE_2D, mip, GL_TEXTURE_COMPRESSED_IMAGE_SIZE, &bytes);
        return std::size_t(bytes);
    }
    glGetTexLevelParameteriv(GL_TEXTURE_2D, mip, GL_TEXTURE_WIDTH, &width);
    glGetTexLevelParameteriv(GL_TEXTURE_2D, mip, GL_TEXTURE_HEIGHT, &height);
    glGetTexLevelParameteriv(GL_TEXTURE_2D, mip, GL_TEXTURE_RED_SIZE, &bits);
    return 3 * std::size_t(bits / 8) * std::size_t(width) * std::size_t(height);
}

void setSampling(const Texture& texture) {
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrapMode(texture.wrapS));
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrapMode(texture.wrapT));
    if (epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic"))
        glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_MAX_ANISOTROPY_EXT, 4);
}

/// From texture coordinates to OpenGL's, in which the first row, our top one, is at 0.
glm::mat3 placeOf(const Texture& texture) {
    const glm::mat2& m = texture.turn;
    return {glm::vec3(m[0].x, -m[0].y, 0), glm::vec3(m[1].x, -m[1].y, 0),
            glm::vec3(texture.shift.x, 1 - texture.shift.y, 1)};
}

void setTexture(const ShaderProgram& program, const std::string& which, const Texture* texture,
                int unit, unsigned name) {
    program.set((which + "Map").c_str(), unit);
    program.set((which + "Textured").c_str(), texture ? 1 : 0);
    if (!texture) return;
    program.set((which + "Scale").c_str(), texture->scale);
    program.set((which + "Bias").c_str(), texture->bias);
    program.set((which + "Place").c_str(), placeOf(*texture));
    glActiveTexture(GLenum(GL_TEXTURE0 + unit));
    glBindTexture(GL_TEXTURE_2D, name);
    glActiveTexture(GL_TEXTURE0);
}

} // namespace

void TextureCache::dropDead() {
    std::erase_if(entries_, [&](const auto& entry) {
        const bool dead = entry.second.alive.expired();
        if (dead) bytes_ -= entry.second.bytes;
        return dead;
    });
}

void TextureCache::setMaterial(const ShaderProgram& program, Rgb reflectance, Rgb emission,
                               const MaterialTextures& textures) {
    program.set("reflectance", reflectance);
    program.set("emission", emission);
    const auto set = [&](const char* which, const std::shared_ptr<const Texture>& texture,
                         int unit) {
        setTexture(program, which, texture.get(), unit, texture ? nameOf(*texture) : 0);
    };
    set("reflectance", textures.reflectance, kReflectanceUnit);
    set("emission", textures.emission, kEmissionUnit);
}

unsigned TextureCache::nameOf(const Texture& texture) {
    const auto [entry, fresh] =
        entries_.try_emplace({texture.image.get(), texture.wrapS, texture.wrapT});
    if (fresh || entry->second.alive.expired()) {
        bytes_ -= entry->second.bytes;
        entry->second = begin(texture);
        bytes_ += entry->second.bytes;
    }
    return entry->second.texture.name();
}

/// A texture with its small levels, or with all of them.
TextureCache::Entry TextureCache::begin(const Texture& texture) const {
    constexpr std::size_t kSmall = 64 * 64; // texels
    const TextureImage& image = *texture.image;
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    Entry entry{.alive = texture.image, .texture = makeTexture()};
    while (std::max(image.width(entry.largest), image.height(entry.largest)) > most)
        ++entry.largest;
    entry.finest = image.levels();
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, entry.texture.name());
    setSampling(texture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, image.levels() - 1 - entry.largest);
    while (entry.finest > entry.largest && (!options_.gradual || entry.finest == image.levels() ||
                                            image.texels(entry.finest - 1) <= kSmall))
        addRows(entry, image, std::numeric_limits<std::size_t>::max());
    glBindTexture(GL_TEXTURE_2D, 0);
    return entry;
}

/// Adds to the level that is missing, in bands: a large one would hold up a picture.
/// \pre the texture is bound \return how many texels
std::size_t TextureCache::addRows(Entry& entry, const TextureImage& image,
                                  std::size_t texels) const {
    constexpr std::size_t kBand = 4; // rows of a compressed block
    const int level = entry.finest - 1, mip = level - entry.largest;
    const auto width = std::size_t(image.width(level)), height = std::size_t(image.height(level));
    if (entry.rows == 0) {
        const bool bytes = !image.pixels8().empty();
        glTexImage2D(GL_TEXTURE_2D, mip, formatOf(image, options_.compressed), GLsizei(width),
                     GLsizei(height), 0, GL_RGB, bytes ? GL_UNSIGNED_BYTE : GL_FLOAT, nullptr);
        entry.bytes += bytesOfLevel(mip);
    }
    const std::size_t bands = std::max<std::size_t>(1, texels / (kBand * width));
    const std::size_t left = height - std::size_t(entry.rows);
    const std::size_t count = bands > left / kBand ? left : kBand * bands;
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    uploadRows(image, level, mip, entry.rows, int(count));
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    entry.rows += int(count);
    if (std::size_t(entry.rows) == height) {
        entry.finest = level;
        entry.rows = 0;
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, mip);
    }
    return count * width;
}

bool TextureCache::refine(std::size_t texels) {
    glActiveTexture(GL_TEXTURE0);
    std::size_t done = 0;
    bool missing = true;
    while (missing && done < texels) {
        Entry* blurriest = nullptr;
        std::shared_ptr<const TextureImage> image;
        for (auto& [key, entry] : entries_) {
            auto alive = entry.alive.lock();
            if (!alive || entry.finest == entry.largest) continue;
            if (image && alive->texels(entry.finest) >= image->texels(blurriest->finest)) continue;
            blurriest = &entry;
            image = std::move(alive);
        }
        missing = blurriest != nullptr;
        if (!missing) break;
        bytes_ -= blurriest->bytes;
        glBindTexture(GL_TEXTURE_2D, blurriest->texture.name());
        done += addRows(*blurriest, *image, texels - done);
        bytes_ += blurriest->bytes;
    }
    glBindTexture(GL_TEXTURE_2D, 0);
    return missing;
}

} // namespace penumbra
