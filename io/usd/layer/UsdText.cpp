#include "io/usd/layer/UsdText.h"

#include "io/usd/layer/UsdScanner.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace penumbra {

namespace {

bool isContinuation(unsigned char c) {
    return (c & 0xc0) == 0x80;
}

// Length of the UTF-8 sequence at the start of `text`, 0 if it is invalid: no overlong forms, no
// surrogates, nothing above U+10FFFF (RFC 3629, section 4).
std::size_t sequenceLength(std::string_view text) {
    const auto byte = [&](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i])
                               : static_cast<unsigned char>(0);
    };
    const unsigned char lead = byte(0);
    if (lead < 0x80) return 1;
    if (lead >= 0xc2 && lead <= 0xdf) return isContinuation(byte(1)) ? 2 : 0;
    if (lead >= 0xe0 && lead <= 0xef) {
        const unsigned char lowest = lead == 0xe0 ? 0xa0 : 0x80;
        const unsigned char highest = lead == 0xed ? 0x9f : 0xbf;
        const bool good = byte(1) >= lowest && byte(1) <= highest && isContinuation(byte(2));
        return good ? 3 : 0;
    }
    if (lead >= 0xf0 && lead <= 0xf4) {
        const unsigned char lowest = lead == 0xf0 ? 0x90 : 0x80;
        const unsigned char highest = lead == 0xf4 ? 0x8f : 0xbf;
        const bool good = byte(1) >= lowest && byte(1) <= highest && isContinuation(byte(2)) &&
                          isContinuation(byte(3));
        return good ? 4 : 0;
    }
    return 0;
}

[[noreturn]] void refuse(const std::string& file, const std::string& why) {
    throw SceneFileError({file, 0, 0}, why);
}

} // namespace

std::size_t firstBadUtf8(std::string_view text) {
    std::size_t i = 0;
    while (i < text.size()) {
        std::uint64_t eight = 0;
        while (i + 8 <= text.size()) { // eight ASCII bytes at a time
            std::memcpy(&eight, text.data() + i, 8);
            if (eight & 0x8080808080808080u) break;
            i += 8;
        }
        if (i == text.size()) break;
        const std::size_t length = sequenceLength(text.substr(i));
        if (length == 0) return i;
        i += length;
    }
    return std::string_view::npos;
}

bool replaceBadUtf8(std::span<char> text) {
    std::size_t bad = 0;
    const std::size_t size = text.size();
    while ((bad = firstBadUtf8({text.data(), text.size()})) != std::string_view::npos) {
        text[bad] = '?';
        text = text.subspan(bad + 1);
    }
    return text.size() != size;
}

std::string printable(std::string_view text) {
    constexpr std::size_t kLongest = 80;
    std::string result;
    std::size_t i = 0;
    while (i < text.size() && result.size() < kLongest) {
        const std::size_t length = sequenceLength(text.substr(i));
        const auto first = static_cast<unsigned char>(text[i]);
        if (length == 0 || first < 0x20 || first == 0x7f)
            result += '?';
        else
            result += text.substr(i, length);
        i += length == 0 ? 1 : length;
    }
    return i < text.size() ? result + "..." : result;
}

void checkUsdText(std::string_view text, const std::string& file) {
    if (text.empty()) refuse(file, "the file is empty");
    if (text.starts_with("PXR-USDC"))
        refuse(file, "this is binary USD (convert it to text: usdcat -o x.usda '" + file + "')");
    if (text.starts_with("PK\x03\x04"))
        refuse(file, "this is a zip package, USDZ perhaps (convert it to text: usdcat -o x.usda '" +
                         file + "')");
    if (text.starts_with("\xef\xbb\xbf"))
        refuse(file, "the file begins with a byte order mark (save it as UTF-8 without one)");
    if (!text.starts_with("#usda"))
        refuse(file, "this is not USD text: it doesn't begin with '#usda 1.0'");
    const std::size_t bad = std::min(firstBadUtf8(text), text.find('\0'));
    if (bad == std::string_view::npos) return;
    const UsdScanner scanner(text, file);
    scanner.failAt(text.data() + bad,
                   text[bad] ? "this byte is not valid UTF-8" : "a NUL byte in a text file");
}

} // namespace penumbra
