#include "io/image/CommonPictures.h"

#include "io/image/ImageReader.h"

#include <jpeglib.h>
#include <png.h>

#include <csetjmp>
#include <cstdint>
#include <vector>

namespace penumbra {

namespace {

bool fits(std::size_t width, std::size_t height) {
    const auto most = std::size_t(TextureImage::kLargest);
    return width > 0 && height > 0 && width <= most && height <= most &&
           width * height <= kMostPixels;
}

/// What libjpeg calls when it gives up. It knows no exceptions.
struct JpegFaults {
    jpeg_error_mgr manager; // first, so that libjpeg's pointer is ours
    std::jmp_buf leave;
};

void leaveJpeg(j_common_ptr info) {
    std::longjmp(reinterpret_cast<JpegFaults*>(info->err)->leave, 1);
}

void keepQuiet(j_common_ptr) {}

/// libjpeg's state. What is jumped back to has nothing to be destroyed below it.
class Jpeg {
public:
    explicit Jpeg(std::span<const std::byte> bytes) : bytes_(bytes) {
        info_.err = jpeg_std_error(&faults_.manager);
        faults_.manager.error_exit = leaveJpeg;
        faults_.manager.output_message = keepQuiet;
    }
    ~Jpeg() { jpeg_destroy_decompress(&info_); }
    Jpeg(const Jpeg&) = delete;
    Jpeg& operator=(const Jpeg&) = delete;

    bool begin() {
        if (setjmp(faults_.leave) != 0) return false;
        jpeg_create_decompress(&info_);
        jpeg_mem_src(&info_, reinterpret_cast<const unsigned char*>(bytes_.data()),
                     static_cast<unsigned long>(bytes_.size()));
        jpeg_read_header(&info_, TRUE);
        const bool grey = info_.jpeg_color_space == JCS_GRAYSCALE;
        const bool coloured =
            info_.jpeg_color_space == JCS_YCbCr || info_.jpeg_color_space == JCS_RGB;
        if ((!grey && !coloured) || !fits(info_.image_width, info_.image_height)) return false;
        channels_ = grey ? 1 : 3;
        info_.out_color_space = JCS_RGB;
        jpeg_start_decompress(&info_);
        return true;
    }
    /// \param rgb has room for all pixels
    bool read(std::uint8_t* rgb) {
        if (setjmp(faults_.leave) != 0) return false;
        while (info_.output_scanline < info_.output_height) {
            JSAMPROW row = rgb + 3 * std::size_t(info_.output_scanline) * info_.output_width;
            jpeg_read_scanlines(&info_, &row, 1);
        }
        jpeg_finish_decompress(&info_);
        return faults_.manager.num_warnings == 0;
    }
    int width() const { return int(info_.output_width); }
    int height() const { return int(info_.output_height); }
    int channels() const { return channels_; }

private:
    std::span<const std::byte> bytes_;
    jpeg_decompress_struct info_{};
    JpegFaults faults_{};
    int channels_ = 0;
};

std::optional<DecodedPicture> decodeJpeg(std::span<const std::byte> bytes) {
    Jpeg jpeg(bytes);
    if (!jpeg.begin()) return std::nullopt;
    DecodedPicture picture;
    picture.width = jpeg.width(), picture.height = jpeg.height();
    picture.channels = jpeg.channels();
    picture.bytes.resize(3 * std::size_t(picture.width) * std::size_t(picture.height));
    if (!jpeg.read(picture.bytes.data())) return std::nullopt;
    return picture;
}

std::optional<DecodedPicture> decodePng(std::span<const std::byte> bytes) {
    struct Image : png_image {
        Image() : png_image{} { version = PNG_IMAGE_VERSION; }
        ~Image() { png_image_free(this); }
    } image;
    if (!png_image_begin_read_from_memory(&image, bytes.data(), bytes.size())) return std::nullopt;
    if ((image.format & PNG_FORMAT_FLAG_LINEAR) != 0 || !fits(image.width, image.height))
        return std::nullopt;
    const bool alpha = (image.format & PNG_FORMAT_FLAG_ALPHA) != 0;
    DecodedPicture picture;
    picture.width = int(image.width), picture.height = int(image.height);
    picture.channels = ((image.format & PNG_FORMAT_FLAG_COLOR) != 0 ? 3 : 1) + (alpha ? 1 : 0);
    image.format = alpha ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB; // not laid over a background
    const std::size_t pixels = std::size_t(image.width) * image.height, size = alpha ? 4 : 3;
    picture.bytes.resize(size * pixels);
    if (!png_image_finish_read(&image, nullptr, picture.bytes.data(), 0, nullptr))
        return std::nullopt;
    if (alpha) {
        for (std::size_t i = 0; i < pixels; ++i)
            for (std::size_t k = 0; k < 3; ++k) picture.bytes[3 * i + k] = picture.bytes[4 * i + k];
        picture.bytes.resize(3 * pixels);
    }
    return picture;
}

} // namespace

std::optional<DecodedPicture> decodeCommon(std::span<const std::byte> bytes) {
    if (bytes.size() < 2) return std::nullopt;
    return bytes[0] == std::byte{0xff} ? decodeJpeg(bytes) : decodePng(bytes);
}

} // namespace penumbra
