#include "io/image/PictureDecoder.h"

#include "io/image/ImageReader.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <stdexcept>

namespace penumbra {

namespace {

[[noreturn]] void refuse(OIIO::ImageInput& input) {
    std::string why = input.geterror();
    why = why.substr(0, why.find('\n'));
    throw std::runtime_error("not a picture that can be read" +
                             (why.empty() ? "" : " (" + why + ")"));
}

void checkSize(const OIIO::ImageSpec& spec) {
    const auto within = [](int n) { return n > 0 && n <= TextureImage::kLargest; };
    if (!within(spec.width) || !within(spec.height) || spec.depth > 1 || spec.nchannels < 1 ||
        spec.nchannels > 64 || std::size_t(spec.width) * std::size_t(spec.height) > kMostPixels)
        throw std::runtime_error("a picture of " + std::to_string(spec.width) + " x " +
                                 std::to_string(spec.height) + " pixels is too large");
}

/// All pixels, three channels each.
template <class T>
std::vector<T> readPixels(OIIO::ImageInput& input, OIIO::TypeDesc type) {
    const OIIO::ImageSpec& spec = input.spec();
    const int channels = std::min(spec.nchannels, 3);
    const std::size_t pixels = std::size_t(spec.width) * std::size_t(spec.height);
    std::vector<T> read(pixels * std::size_t(channels));
    if (!input.read_image(0, 0, 0, channels, type, read.data())) refuse(input);
    if (channels == 3) return read;
    std::vector<T> rgb; // grey, or grey and alpha
    rgb.reserve(3 * pixels);
    for (std::size_t i = 0; i < pixels; ++i)
        rgb.insert(rgb.end(), 3, read[i * std::size_t(channels)]);
    return rgb;
}

void decode(std::span<const std::byte> bytes, const std::string& name, const std::string& format,
            DecodedPicture& picture) {
    OIIO::attribute("threads", 1); // all threads are ours, see base/Parallel.h
    const auto input = OIIO::ImageInput::create(format);
    if (!input) throw std::runtime_error("OpenImageIO reads no " + format + " here");
    OIIO::Filesystem::IOMemReader memory(const_cast<std::byte*>(bytes.data()), bytes.size());
    OIIO::ImageSpec config, spec;
    config.attribute("oiio:UnassociatedAlpha", 1);
    if (!input->set_ioproxy(&memory) || !input->open(name, spec, config)) refuse(*input);
    checkSize(spec);
    picture.width = spec.width;
    picture.height = spec.height;
    picture.channels = spec.nchannels;
    if (spec.format.basetype == OIIO::TypeDesc::UINT8 && spec.channelformats.empty())
        picture.bytes = readPixels<std::uint8_t>(*input, OIIO::TypeDesc::UINT8);
    else
        picture.floats = readPixels<float>(*input, OIIO::TypeDesc::FLOAT);
}

} // namespace

} // namespace penumbra

/// A penumbra::DecodePicture.
extern "C" __attribute__((visibility("default"))) void
penumbraDecodePicture(std::span<const std::byte> bytes, const std::string& name,
                      const std::string& format, penumbra::DecodedPicture& picture) {
    try {
        penumbra::decode(bytes, name, format, picture);
    } catch (const std::exception& error) {
        picture.fault = error.what();
    }
}
