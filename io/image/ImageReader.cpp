#include "io/image/ImageReader.h"

#include "base/Error.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

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

[[noreturn]] void refuse(OIIO::ImageInput& input, const std::string& name) {
    std::string why = input.geterror();
    why = why.substr(0, why.find('\n'));
    throw Error(name + ": not a picture that can be read" + (why.empty() ? "" : " (" + why + ")"));
}

void checkSize(const OIIO::ImageSpec& spec, const std::string& name) {
    const auto within = [](int n) { return n > 0 && n <= TextureImage::kLargest; };
    if (!within(spec.width) || !within(spec.height) || spec.depth > 1 || spec.nchannels < 1 ||
        spec.nchannels > 64 || std::size_t(spec.width) * std::size_t(spec.height) > kMostPixels)
        throw Error(name + ": a picture of " + std::to_string(spec.width) + " x " +
                    std::to_string(spec.height) + " pixels is too large");
}

float fromSrgb(float v) {
    return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

/// All pixels, three channels each.
template <class T>
std::vector<T> readPixels(OIIO::ImageInput& input, OIIO::TypeDesc type, const std::string& name) {
    const OIIO::ImageSpec& spec = input.spec();
    const int channels = std::min(spec.nchannels, 3);
    const std::size_t pixels = std::size_t(spec.width) * std::size_t(spec.height);
    std::vector<T> read(pixels * std::size_t(channels));
    if (!input.read_image(0, 0, 0, channels, type, read.data())) refuse(input, name);
    if (channels == 3) return read;
    std::vector<T> rgb; // grey, or grey and alpha
    rgb.reserve(3 * pixels);
    for (std::size_t i = 0; i < pixels; ++i)
        rgb.insert(rgb.end(), 3, read[i * std::size_t(channels)]);
    return rgb;
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
    OIIO::attribute("threads", 1); // all threads are ours, see base/Parallel.h
    const auto input = OIIO::ImageInput::create(format);
    if (!input) throw Error(name + ": OpenImageIO reads no " + format + " here");
    OIIO::Filesystem::IOMemReader memory(const_cast<std::byte*>(bytes.data()), bytes.size());
    OIIO::ImageSpec config, spec;
    config.attribute("oiio:UnassociatedAlpha", 1);
    if (!input->set_ioproxy(&memory) || !input->open(name, spec, config)) refuse(*input, name);
    checkSize(spec, name);
    const bool fine = spec.format.basetype == OIIO::TypeDesc::UINT8 && spec.channelformats.empty();
    const bool srgb = coding == PictureCoding::srgb ||
                      (coding == PictureCoding::automatic && fine && spec.nchannels >= 3);
    if (fine)
        return std::make_shared<TextureImage>(
            name, spec.width, spec.height,
            readPixels<std::uint8_t>(*input, OIIO::TypeDesc::UINT8, name), srgb);
    auto rgb = readPixels<float>(*input, OIIO::TypeDesc::FLOAT, name);
    if (srgb)
        for (float& v : rgb) v = fromSrgb(v);
    return std::make_shared<TextureImage>(name, spec.width, spec.height, rgb);
}

} // namespace penumbra
