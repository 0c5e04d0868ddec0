#include "radiosity/process/snapshot/TextureCodec.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace penumbra {

namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

using Image = std::shared_ptr<const TextureImage>;

std::size_t bytesOf(const TextureImage& image, int level) {
    return (level == 0 && !image.pixels8().empty() ? 3 : 6) * image.texels(level);
}

/// The levels at which pictures fit into so many bytes: the largest ones give way.
std::vector<int> levelsToSend(const std::vector<Image>& images, std::size_t mostBytes) {
    std::vector<int> levels(images.size(), 0);
    std::size_t total = 0;
    for (const Image& image : images) total += bytesOf(*image, 0);
    while (total > mostBytes) {
        std::size_t largest = 0;
        for (std::size_t i = 1; i < images.size(); ++i)
            if (bytesOf(*images[i], levels[i]) > bytesOf(*images[largest], levels[largest]))
                largest = i;
        if (levels[largest] + 1 == images[largest]->levels()) break;
        total -= bytesOf(*images[largest], levels[largest]);
        total += bytesOf(*images[largest], ++levels[largest]);
    }
    return levels;
}

void writeImage(ByteWriter& out, const TextureImage& image, int level) {
    const TextureImage::Packed packed =
        level == 0 ? image.packed() : TextureImage(image, level).packed();
    out.text(packed.name);
    out.put(packed.width);
    out.put(packed.height);
    out.put(packed.coding);
    out.put(packed.peak);
    out.list(packed.fine);
    out.list(packed.roots);
}

Image readImage(ByteReader& in) {
    TextureImage::Packed packed;
    packed.name = in.text();
    packed.width = in.get<std::int32_t>();
    packed.height = in.get<std::int32_t>();
    packed.coding = in.get<std::uint8_t>();
    packed.peak = in.get<float>();
    packed.fine = in.list<std::uint8_t>();
    packed.roots = in.list<std::uint16_t>();
    Image image = in.ok() ? TextureImage::unpacked(std::move(packed)) : nullptr;
    if (!image) in.fail();
    return image;
}

void writeTexture(ByteWriter& out, const std::shared_ptr<const Texture>& texture,
                  const std::map<Image, std::uint32_t>& numbers) {
    out.put(texture ? numbers.at(texture->image) : kNone);
    if (!texture) return;
    out.put(texture->wrapS);
    out.put(texture->wrapT);
    out.put(texture->scale);
    out.put(texture->bias);
    out.put(texture->turn);
    out.put(texture->shift);
}

bool sound(const Texture& texture) {
    const auto finite = [](auto... values) { return (std::isfinite(values) && ...); };
    const Rgb a = texture.scale, b = texture.bias;
    const glm::mat2& m = texture.turn;
    return texture.wrapS <= TextureWrap::black && texture.wrapT <= TextureWrap::black &&
           finite(a.r, a.g, a.b, b.r, b.g, b.b) && finite(m[0].x, m[0].y, m[1].x, m[1].y) &&
           finite(texture.shift.x, texture.shift.y);
}

std::shared_ptr<const Texture> readTexture(ByteReader& in, const std::vector<Image>& images) {
    const auto number = in.get<std::uint32_t>();
    if (!in.ok() || number == kNone) return nullptr;
    auto texture = std::make_shared<Texture>();
    texture->wrapS = in.get<TextureWrap>();
    texture->wrapT = in.get<TextureWrap>();
    texture->scale = in.get<Rgb>();
    texture->bias = in.get<Rgb>();
    texture->turn = in.get<glm::mat2>();
    texture->shift = in.get<glm::vec2>();
    if (!in.ok() || number >= images.size() || !sound(*texture)) {
        in.fail();
        return nullptr;
    }
    texture->image = images[number];
    return texture;
}

} // namespace

void writeTextures(ByteWriter& out, std::span<const MaterialTextures> materials,
                   std::size_t mostBytes) {
    std::map<Image, std::uint32_t> numbers;
    std::vector<Image> images;
    for (const MaterialTextures& textures : materials)
        for (const auto& texture : {textures.reflectance, textures.emission})
            if (texture && numbers.try_emplace(texture->image, std::uint32_t(images.size())).second)
                images.push_back(texture->image);
    const std::vector<int> levels = levelsToSend(images, mostBytes);
    out.put(std::uint64_t(images.size()));
    for (std::size_t i = 0; i < images.size(); ++i) writeImage(out, *images[i], levels[i]);
    for (const MaterialTextures& textures : materials) {
        writeTexture(out, textures.reflectance, numbers);
        writeTexture(out, textures.emission, numbers);
    }
}

std::vector<MaterialTextures> readTextures(ByteReader& in, std::size_t materials) {
    constexpr std::size_t kLeast = 3 * sizeof(std::uint64_t); // of a picture: its lists' lengths
    std::vector<Image> images;
    const std::size_t count = in.count(kLeast);
    for (std::size_t i = 0; i < count && in.ok(); ++i) images.push_back(readImage(in));
    std::vector<MaterialTextures> textures(materials);
    for (MaterialTextures& of : textures) {
        of.reflectance = readTexture(in, images);
        of.emission = readTexture(in, images);
    }
    return textures;
}

} // namespace penumbra
