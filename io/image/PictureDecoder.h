// What reads the pixels of pictures: a library of its own, loaded when the first picture is read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace penumbra {

struct DecodedPicture {
    std::string fault; ///< why it could not be read; empty: it could
    int width = 0, height = 0;
    int channels = 0;                ///< of the file
    std::vector<std::uint8_t> bytes; ///< red, green and blue of all pixels, top row first; or
    std::vector<float> floats;       ///< the same of files with more than 8 bits
};

/// \param bytes of the whole file
/// \param name of it
/// \param format OpenImageIO's name of it
using DecodePicture = void(std::span<const std::byte> bytes, const std::string& name,
                           const std::string& format, DecodedPicture& picture);

/// The name under which the library has it.
inline constexpr const char* kDecodePicture = "penumbraDecodePicture";

} // namespace penumbra
