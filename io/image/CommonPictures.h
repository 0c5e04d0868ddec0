// Pictures of the kinds that nearly all scenes have, by the libraries of these kinds alone.
#pragma once

#include "io/image/PictureDecoder.h"

#include <cstddef>
#include <optional>
#include <span>

namespace penumbra {

/// JPEG (libjpeg) and PNG (libpng) of 8 bits a channel, grey or coloured: the same bytes as by
/// OpenImageIO, whose libraries need not be loaded then.
/// \return nothing if there is anything unusual about the file: another colour space, more bits,
///         damage, too many pixels
std::optional<DecodedPicture> decodeCommon(std::span<const std::byte> bytes);

} // namespace penumbra
