#include "io/image/PngEncoder.h"

#include "base/Error.h"

#include <cassert>
#include <string>

#include <png.h>

namespace penumbra {

std::vector<std::byte> encodePng(int width, int height, std::span<const std::uint8_t> pixels) {
    assert(width > 0 && height > 0);
    assert(pixels.size() == 3 * std::size_t(width) * std::size_t(height));
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = png_uint_32(width);
    image.height = png_uint_32(height);
    image.format = PNG_FORMAT_RGB;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::vector<std::byte> file(size);
    if (!png_image_write_to_memory(&image, file.data(), &size, 0, pixels.data(), 0, nullptr))
        throw Error(std::string("can't encode as PNG: ") + image.message);
    file.resize(size);
    return file;
}

} // namespace penumbra
