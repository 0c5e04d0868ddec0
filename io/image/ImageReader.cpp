#include "io/image/ImageReader.h"

#include "base/Error.h"
#include "base/Srgb.h"
#include "io/image/CommonPictures.h"
#include "io/image/PictureDecoder.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include <dlfcn.h>

namespace penumbra {

namespace {

/// OpenImageIO's name of a kind of file; empty: none that is read.
std::string formatOf(std::span<const std::byte> bytes, const std::string& name) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto begins = [&](std::string_view magic) { return text.starts_with(magic); };
    using namespace std::string_view_literals;
    if (begins("\x89PNG"sv)) return "png";
    if (begins("\xff\xd8\xff"sv)) return "jpeg";
    if (begins("\x76\x2f\x31\x01"sv)) return "openexr";
    if (begins("II*\0"sv) || begins("MM\0*"sv)) return "tiff";
    if (begins("#?"sv)) return "hdr";
    if (begins("BM"sv)) return "bmp";
    if (begins("RIFF"sv) && text.substr(0, 12).ends_with("WEBP"sv)) return "webp";
    std::string end = name.substr(std::min(name.size(), name.rfind('.')));
    std::transform(end.begin(), end.end(), end.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    return end == ".tga" ? "targa" : "";
}

std::uint32_t bigEndian(std::span<const std::byte> bytes) {
    std::uint32_t value = 0;
    for (const std::byte b : bytes.first(4)) value = value << 8 | std::uint32_t(b);
    return value;
}

std::uint32_t crc32(std::span<const std::byte> bytes) { // ISO 3309, as PNG has it
    std::uint32_t crc = 0xffffffffu;
    for (const std::byte b : bytes) {
        crc ^= std::uint32_t(b);
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
    }
    return ~crc;
}

/// A PNG file without all that has no part in its colours, checked: what libpng does not like it
/// writes to standard error itself, profiles that nobody asked for included.
std::vector<std::byte> plainPng(std::span<const std::byte> bytes, const std::string& name) {
    constexpr std::size_t kHead = 8, kAround = 12; // signature; length, type and sum of a chunk
    std::vector<std::byte> plain(bytes.begin(), bytes.begin() + kHead);
    bool ends = false;
    for (bytes = bytes.subspan(kHead); bytes.size() >= kAround && !ends;) {
        const std::size_t length = bigEndian(bytes);
        if (length > bytes.size() - kAround) break;
        const auto chunk = bytes.first(length + kAround);
        const auto body = chunk.subspan(4, length + 4);
        if (crc32(body) != bigEndian(chunk.last(4))) break;
        const std::string type(reinterpret_cast<const char*>(body.data()), 4);
        if (type == "IHDR" || type == "PLTE" || type == "IDAT" || type == "IEND")
            plain.insert(plain.end(), chunk.begin(), chunk.end());
        ends = type == "IEND";
        bytes = bytes.subspan(chunk.size());
    }
    if (!ends) throw Error(name + ": a damaged PNG file");
    return plain;
}

/// OpenImageIO's libraries are many, and take half a second and half a gigabyte of addresses: only
/// those who have pictures that are not common load them, from beside the program.
DecodePicture& decoder() {
    static DecodePicture* const loaded = [] {
        std::error_code failed;
        const auto program = std::filesystem::read_symlink("/proc/self/exe", failed);
        const std::string file = program.parent_path() / "libpenumbra_pictures.so";
        void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
        void* const found = library ? dlsym(library, kDecodePicture) : nullptr;
        if (!found) throw Error(std::string("pictures can't be read: ") + dlerror());
        return reinterpret_cast<DecodePicture*>(found);
    }();
    return *loaded;
}

} // namespace

std::shared_ptr<const TextureImage> readImage(std::span<const std::byte> bytes,
                                              const std::string& name, PictureCoding coding) {
    const std::string format = formatOf(bytes, name);
    if (format.empty()) throw Error(name + ": not a picture of a kind that is read");
    std::vector<std::byte> plain;
    if (format == "png") {
        if (bytes.size() < 8) throw Error(name + ": a damaged PNG file");
        bytes = plain = plainPng(bytes, name);
    }
    DecodedPicture picture;
    const bool common = format == "png" || format == "jpeg";
    if (auto decoded = common ? decodeCommon(bytes) : std::nullopt)
        picture = std::move(*decoded);
    else
        decoder()(bytes, name, format, picture);
    if (!picture.fault.empty()) throw Error(name + ": " + picture.fault);
    const bool fine = !picture.bytes.empty();
    const bool srgb = coding == PictureCoding::srgb ||
                      (coding == PictureCoding::automatic && fine && picture.channels >= 3);
    if (fine)
        return std::make_shared<TextureImage>(name, picture.width, picture.height,
                                              std::move(picture.bytes), srgb);
    if (srgb)
        for (float& v : picture.floats) v = linearFromSrgb(v);
    return std::make_shared<TextureImage>(name, picture.width, picture.height, picture.floats);
}

} // namespace penumbra
