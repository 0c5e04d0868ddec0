#include "io/model/PrimNames.h"

#include "io/usd/layer/UsdPath.h"
#include "io/usd/layer/UsdPrimSpecs.h"
#include "io/usd/layer/UsdText.h"

#include <algorithm>

namespace penumbra {

namespace {

constexpr std::size_t kLongestName = 128;

} // namespace

std::string primName(std::string_view text, std::string_view fallback) {
    std::string name;
    for (const char c : text.substr(0, kLongestName)) {
        const auto byte = static_cast<unsigned char>(c);
        if ((byte & 0xc0) == 0x80) continue; // the rest of a character of several bytes
        name += byte < 0x80 && isUsdIdentifierPart(c) ? c : '_';
    }
    if (std::all_of(name.begin(), name.end(), [](char c) { return c == '_'; })) name = fallback;
    if (name.front() >= '0' && name.front() <= '9') name.insert(name.begin(), '_');
    return name;
}

std::string PrimNames::take(std::string_view wanted, std::string_view fallback) {
    std::string name = primName(wanted, fallback);
    const auto [entry, isNew] = taken_.try_emplace(name, 0);
    if (isNew) return name;
    std::size_t& last = entry->second; // stays where it is
    std::string unique;
    do unique = name + "_" + std::to_string(++last);
    while (!taken_.try_emplace(unique, 0).second);
    return unique;
}

std::string cleanText(std::string_view text) {
    std::string clean(text.substr(0, kLongestName * 4));
    for (std::size_t bad; (bad = firstBadUtf8(clean)) != std::string::npos;) clean[bad] = '?';
    for (char& c : clean)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
    return clean;
}

void keepDisplayName(UsdPrimSpec& spec, std::string_view original) {
    const std::string clean = cleanText(original);
    if (!clean.empty() && clean != spec.name)
        addMetadata(spec.metadata, "displayName", UsdKind::string, clean);
}

} // namespace penumbra
