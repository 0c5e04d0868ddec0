#include "io/usd/crate/UsdPackagePath.h"

#include <algorithm>
#include <vector>

namespace penumbra {

namespace {

bool endsInUsdz(std::string_view text) {
    constexpr std::string_view kEnding = ".usdz";
    if (text.size() < kEnding.size()) return false;
    const std::string_view end = text.substr(text.size() - kEnding.size());
    return std::equal(end.begin(), end.end(), kEnding.begin(),
                      [](char a, char b) { return a == b || a + ('a' - 'A') == b; });
}

// The bracket behind the innermost package, from `begin` on; npos if there is none.
std::size_t lastBracket(std::string_view identifier) {
    std::size_t bracket = identifier.size();
    while (true) {
        if (bracket == 0) return std::string_view::npos;
        bracket = identifier.rfind('[', bracket - 1);
        if (bracket == std::string_view::npos || endsInUsdz(identifier.substr(0, bracket)))
            return bracket;
    }
}

} // namespace

std::optional<UsdPackagePath> splitPackagePath(std::string_view identifier) {
    const std::size_t bracket = lastBracket(identifier);
    if (bracket == std::string_view::npos) return std::nullopt;
    // As many brackets close as are open: those behind the first belong to the package.
    std::size_t end = identifier.size();
    while (end > bracket && identifier[end - 1] == ']') --end;
    const std::size_t closing = identifier.size() - end;
    if (closing == 0) return std::nullopt;
    UsdPackagePath path;
    path.package = std::string(identifier.substr(0, bracket)) + std::string(closing - 1, ']');
    path.name = identifier.substr(bracket + 1, end - bracket - 1);
    return path;
}

std::string joinPackagePath(std::string_view package, std::string_view name) {
    std::size_t end = package.size();
    if (splitPackagePath(package))
        while (end > 0 && package[end - 1] == ']') --end;
    std::string path(package.substr(0, end));
    path.append("[").append(name).append("]");
    return path.append(package.substr(end));
}

std::string_view outermostPackage(std::string_view identifier) {
    if (!splitPackagePath(identifier)) return identifier;
    std::size_t bracket = identifier.find('[');
    while (!endsInUsdz(identifier.substr(0, bracket))) bracket = identifier.find('[', bracket + 1);
    return identifier.substr(0, bracket);
}

int packageDepth(std::string_view identifier) {
    int depth = 0;
    std::string rest(identifier);
    while (const auto path = splitPackagePath(rest)) {
        rest = path->package;
        if (++depth > kMaxPackageDepth) break;
    }
    return depth;
}

std::optional<std::string> pathInPackage(std::string_view from, std::string_view path) {
    std::vector<std::string_view> parts;
    const auto add = [&](std::string_view text) {
        while (true) {
            const std::size_t slash = text.find('/');
            const std::string_view part = text.substr(0, slash);
            if (part == "..") {
                if (parts.empty()) return false;
                parts.pop_back();
            } else if (!part.empty() && part != ".") {
                parts.push_back(part);
            }
            if (slash == std::string_view::npos) return true;
            text.remove_prefix(slash + 1);
        }
    };
    const std::size_t folder = from.rfind('/');
    if (folder != std::string_view::npos) add(from.substr(0, folder));
    if (!add(path)) return std::nullopt;
    std::string joined;
    for (const std::string_view part : parts) joined.append(joined.empty() ? "" : "/").append(part);
    return joined;
}

} // namespace penumbra
