// Whether some bytes are text at all.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace penumbra {

/// Offset of the first byte that isn't part of valid UTF-8 (RFC 3629), or npos.
std::size_t firstBadUtf8(std::string_view text);

/// Makes `text` valid: bytes that are not become '?'. \return whether there were any
bool replaceBadUtf8(std::span<char> text);

/// `text` for a message: control characters and invalid bytes become '?', long text is cut.
std::string printable(std::string_view text);

/// Refuses, in one line that says why and what to do, what can't be USD text: empty, binary,
/// packed, not UTF-8, with NUL bytes. Throws SceneFileError.
void checkUsdText(std::string_view text, const std::string& file);

} // namespace penumbra
