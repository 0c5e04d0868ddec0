#include "io/usd/shade/UsdTextures.h"

#include "base/Error.h"
#include "base/Parallel.h"
#include "io/image/ImageReader.h"
#include "io/usd/shade/UsdConnections.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace penumbra {

namespace {

constexpr const char* kFile = "inputs:file";

std::string textAt(const UsdStage& stage, const UsdPrim& prim, const std::string& name,
                   const std::string& fallback, UsdTime time) {
    const UsdSource source = usdSourceOf(stage, prim, name);
    if (source.kind != UsdSource::Kind::value) return fallback;
    return UsdAttributes(*source.prim, time).text(source.attribute, fallback);
}

std::vector<double> tupleAt(const UsdStage& stage, const UsdPrim& prim, const std::string& name,
                            std::vector<double> fallback, UsdTime time) {
    const UsdSource source = usdSourceOf(stage, prim, name);
    if (source.kind != UsdSource::Kind::value) return fallback;
    auto found = UsdAttributes(*source.prim, time).tuple(source.attribute, fallback.size());
    const bool usable = !found.empty() && std::all_of(found.begin(), found.end(),
                                                      [](double v) { return std::abs(v) < 1e9; });
    return usable ? found : fallback;
}

TextureWrap wrapOf(const UsdAttributes& shader, const std::string& name, Diagnostics& diagnostics) {
    const std::string wrap = shader.text(name, "useMetadata");
    if (wrap == "repeat") return TextureWrap::repeat;
    if (wrap == "mirror") return TextureWrap::mirror;
    if (wrap == "clamp") return TextureWrap::clamp;
    if (wrap != "black" && wrap != "useMetadata")
        diagnostics.warn(shader.location(name), "unknown wrap mode '" + wrap + "': black is used");
    return TextureWrap::black;
}

PictureCoding codingOf(const UsdAttributes& shader, Diagnostics& diagnostics) {
    const std::string space = shader.text("inputs:sourceColorSpace", "auto");
    if (space == "sRGB") return PictureCoding::srgb;
    if (space == "raw") return PictureCoding::raw;
    if (space != "auto")
        diagnostics.warn(shader.location("inputs:sourceColorSpace"),
                         "unknown colour space '" + space + "': auto is used");
    return PictureCoding::automatic;
}

/// Puts UsdTransform2d before what the texture does to its coordinates: scale, then rotation, then
/// translation.
void addTransform(const UsdStage& stage, const UsdPrim& prim, UsdTime time, Texture& texture) {
    const auto scale = tupleAt(stage, prim, "inputs:scale", {1, 1}, time);
    const auto degrees = tupleAt(stage, prim, "inputs:rotation", {0}, time);
    const auto shift = tupleAt(stage, prim, "inputs:translation", {0, 0}, time);
    const double angle = degrees[0] * std::numbers::pi / 180;
    const double c = std::cos(angle), s = std::sin(angle);
    const glm::mat2 turn{glm::vec2(c * scale[0], s * scale[0]),
                         glm::vec2(-s * scale[1], c * scale[1])};
    texture.shift += texture.turn * glm::vec2(shift[0], shift[1]);
    texture.turn = texture.turn * turn;
}

/// Follows inputs:st to the primvar that it is read from.
std::string followCoordinates(const UsdStage& stage, const UsdAttributes& shader, Texture& texture,
                              Diagnostics& diagnostics) {
    UsdSource source = usdSourceOf(stage, shader.prim(), "inputs:st");
    for (int i = 0; i < kMostConnections && source.kind == UsdSource::Kind::computed; ++i) {
        const UsdAttributes attributes(*source.prim, shader.time());
        const std::string id = attributes.text("info:id", "");
        if (id == "UsdPrimvarReader_float2")
            return textAt(stage, *source.prim, "inputs:varname", "st", shader.time());
        if (id != "UsdTransform2d") break;
        addTransform(stage, *source.prim, shader.time(), texture);
        source = usdSourceOf(stage, *source.prim, "inputs:in");
    }
    diagnostics.warn(shader.location("inputs:st"),
                     "texture coordinates not understood: primvar 'st' is used");
    return "st";
}

std::vector<double> scaleOf(const UsdStage& stage, const UsdPrim& shader, UsdTime time) {
    return tupleAt(stage, shader, "inputs:scale", {1, 1, 1, 1}, time);
}

Rgb colourOf(const std::vector<double>& v) {
    return {float(v[0]), float(v[1]), float(v[2])};
}

} // namespace

const UsdTexture& UsdTextures::at(const UsdStage& stage, const UsdPrim& shader, UsdTime time,
                                  Diagnostics& diagnostics) {
    const auto [entry, fresh] = made_.try_emplace(shader.path);
    UsdTexture& known = entry->second;
    if (fresh && files_) known = make(stage, UsdAttributes(shader, time), diagnostics);
    if (fresh || !known.texture) return known;
    const Rgb scale = colourOf(scaleOf(stage, shader, time));
    if (scale == known.texture->scale) return known;
    auto texture = std::make_shared<Texture>(*known.texture);
    texture->scale = scale;
    known.texture = std::move(texture);
    return known;
}

void UsdTextures::readAhead(UsdTime time, std::span<const UsdPrim* const> shaders) {
    struct Picture {
        std::pair<std::string, int> key;
        std::string file;
        PictureCoding coding{};
        UsdAssetBytes bytes;
        std::shared_ptr<const TextureImage> image;
    };
    constexpr std::size_t kAtOnce = 16; // files that are in memory
    std::vector<Picture> pictures;
    const auto read = [&] {
        parallelFor(pictures.size(), 1, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) try {
                    Picture& picture = pictures[i];
                    picture.image = readImage(picture.bytes.bytes, picture.file, picture.coding);
                } catch (const Error&) { // said where it is asked for
                }
        });
        for (Picture& picture : pictures)
            if (picture.image) images_[picture.key] = std::move(picture.image);
        pictures.clear();
    };
    Diagnostics ignored;
    for (const UsdPrim* prim : shaders) {
        const UsdAttributes shader(*prim, time);
        const std::string file = shader.text(kFile, "");
        if (file.empty() || file.find("<UDIM>") != std::string::npos) continue;
        Picture picture;
        picture.file = file;
        picture.coding = codingOf(shader, ignored);
        try {
            picture.key = {files_->resolve(shader.location(kFile).file, file), int(picture.coding)};
            const auto same = [&](const Picture& other) { return other.key == picture.key; };
            if (images_.contains(picture.key) || std::ranges::any_of(pictures, same)) continue;
            picture.bytes = files_->bytes(picture.key.first);
        } catch (const Error&) {
            continue;
        }
        pictures.push_back(std::move(picture));
        if (pictures.size() == kAtOnce) read();
    }
    read();
}

UsdTexture UsdTextures::make(const UsdStage& stage, const UsdAttributes& shader,
                             Diagnostics& diagnostics) {
    Texture texture;
    texture.image = image(shader, diagnostics);
    if (!texture.image) return {};
    texture.wrapS = wrapOf(shader, "inputs:wrapS", diagnostics);
    texture.wrapT = wrapOf(shader, "inputs:wrapT", diagnostics);
    const auto scale = scaleOf(stage, shader.prim(), shader.time());
    texture.scale = colourOf(scale);
    texture.bias =
        colourOf(tupleAt(stage, shader.prim(), "inputs:bias", {0, 0, 0, 0}, shader.time()));
    const std::string primvar = followCoordinates(stage, shader, texture, diagnostics);
    return {std::make_shared<Texture>(texture), primvar, {shader.prim().path, float(scale[3])}};
}

/// Null, with a warning, if it can't be read.
std::shared_ptr<const TextureImage> UsdTextures::image(const UsdAttributes& shader,
                                                       Diagnostics& diagnostics) {
    const std::string file = shader.text(kFile, "");
    const SourceLocation where = shader.location(kFile);
    if (file.empty() || file.find("<UDIM>") != std::string::npos) {
        diagnostics.warn(where, file.empty()
                                    ? "a texture without a file left out"
                                    : "a texture in tiles (UDIM) left out: '" + file + "'");
        return nullptr;
    }
    try {
        const std::string identifier = files_->resolve(where.file, file);
        const PictureCoding coding = codingOf(shader, diagnostics);
        const auto [entry, fresh] = images_.try_emplace({identifier, int(coding)});
        if (!fresh && entry->second) return entry->second;
        const UsdAssetBytes bytes = files_->bytes(identifier);
        entry->second = readImage(bytes.bytes, file, coding);
        return entry->second;
    } catch (const Error& error) {
        diagnostics.warn(where, std::string("texture left out: ") + error.what());
    }
    return nullptr;
}

std::vector<glm::vec2> usdTexCoords(const UsdAttributes& prim, const std::string& name,
                                    const MeshData& mesh, const UsdCorners& corners,
                                    const std::vector<std::size_t>& faceOf,
                                    Diagnostics& diagnostics) {
    const std::string primvar = "primvars:" + name;
    const UsdResolved value = prim.value(primvar);
    const std::size_t components = value ? value->type.components() : 0;
    const std::vector<double> numbers = prim.numbers(primvar);
    if ((components != 2 && components != 3) || numbers.size() < components) {
        diagnostics.warn(prim.prim().location(),
                         "no texture coordinates '" + name + "': the mean of the texture is used");
        return {};
    }
    const auto indices = prim.integers(primvar + ":indices");
    const std::string interpolation = prim.interpolation(primvar, "constant");
    const auto place = [&](std::size_t face, std::size_t i, std::size_t corner) -> std::size_t {
        const auto count = std::size_t(mesh.faceVertexCounts[face]);
        if (interpolation == "faceVarying")
            return corners.firstCorner[faceOf[face]] +
                   (corners.leftHanded && i > 0 ? count - i : i);
        if (interpolation == "vertex" || interpolation == "varying")
            return std::size_t(mesh.faceVertexIndices[corner]);
        return interpolation == "uniform" ? faceOf[face] : 0;
    };
    std::vector<glm::vec2> uvs;
    std::size_t missing = 0;
    for (std::size_t face = 0; face < mesh.faceVertexCounts.size(); ++face)
        for (std::size_t i = 0; i < std::size_t(mesh.faceVertexCounts[face]); ++i) {
            std::size_t at = place(face, i, uvs.size());
            if (!indices.empty())
                at = at < indices.size() && indices[at] >= 0 ? std::size_t(indices[at])
                                                             : numbers.size();
            glm::vec2 uv(0);
            if (at < numbers.size() / components)
                uv = {float(numbers[at * components]), float(numbers[at * components + 1])};
            else
                ++missing;
            uvs.push_back(std::isfinite(uv.x) && std::isfinite(uv.y) ? uv : glm::vec2(0));
        }
    if (missing > 0)
        diagnostics.warn(prim.location(primvar), "corners without texture coordinates: (0, 0) used",
                         missing);
    return uvs;
}

} // namespace penumbra
