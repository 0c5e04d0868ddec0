#include "io/usd/layer/UsdPath.h"

#include <algorithm>

namespace penumbra {

namespace {

// `prop`, `ns:prop`, or `rel[/target].attr`, whose tail is only checked for balance.
bool isPropertyTail(std::string_view text) {
    const std::size_t bracket = text.find('[');
    if (!isUsdPropertyName(text.substr(0, bracket))) return false;
    if (bracket == std::string_view::npos) return true;
    int depth = 0;
    for (const char c : text.substr(bracket)) {
        depth += c == '[' ? 1 : c == ']' ? -1 : 0;
        if (depth < 0 || c == '{' || c == ' ') return false;
    }
    return depth == 0;
}

// Appends the elements of a relative prim path to `path`.
bool appendElements(std::string_view elements, std::string& path) {
    while (true) {
        const std::size_t slash = elements.find('/');
        const std::string_view element = elements.substr(0, slash);
        if (element == "..") {
            if (path == "/") return false;
            path = std::string(usdParentPath(path));
        } else if (isUsdIdentifier(element)) {
            path = usdChildPath(path, element);
        } else {
            return false;
        }
        if (slash == std::string_view::npos) return true;
        elements.remove_prefix(slash + 1);
    }
}

// Where the property part's dot stands; the dots of ".." don't count.
std::size_t propertyDot(std::string_view text) {
    std::size_t at = 0;
    while ((at = text.find('.', at)) != std::string_view::npos) {
        if (text.substr(at, 2) != "..") return at;
        at += 2;
    }
    return at;
}

} // namespace

bool isUsdIdentifier(std::string_view name) {
    return !name.empty() && isUsdIdentifierStart(name.front()) &&
           std::all_of(name.begin(), name.end(), isUsdIdentifierPart);
}

bool isUsdPropertyName(std::string_view name) {
    while (true) {
        const std::size_t colon = name.find(':');
        if (!isUsdIdentifier(name.substr(0, colon))) return false;
        if (colon == std::string_view::npos) return true;
        name.remove_prefix(colon + 1);
    }
}

std::optional<std::string> absoluteUsdPath(std::string_view text, std::string_view owner) {
    if (text.empty()) return std::nullopt;
    if (text == ".") return std::string(owner);
    const std::size_t dot = propertyDot(text);
    std::string_view prim = text.substr(0, dot);
    std::string path(text.front() == '/' ? std::string_view("/") : owner);
    if (text.front() == '/') prim.remove_prefix(1);
    if (!prim.empty() && !appendElements(prim, path)) return std::nullopt;
    if (dot == std::string_view::npos) return path;
    const std::string_view property = text.substr(dot + 1);
    if (path == "/" || !isPropertyTail(property)) return std::nullopt;
    return path + "." + std::string(property);
}

bool isUsdPropertyPath(std::string_view path) {
    return path.find('.') != std::string_view::npos;
}

std::string_view usdPrimPart(std::string_view path) {
    return path.substr(0, path.find('.'));
}

std::string_view usdPropertyPart(std::string_view path) {
    const std::size_t dot = path.find('.');
    return dot == std::string_view::npos ? std::string_view() : path.substr(dot + 1);
}

std::string_view usdParentPath(std::string_view path) {
    const std::size_t slash = path.rfind('/');
    return path.substr(0, slash == 0 || slash == std::string_view::npos ? 1 : slash);
}

std::string usdChildPath(std::string_view parent, std::string_view name) {
    std::string path(parent);
    if (path != "/") path += '/';
    return path += name;
}

bool isUsdPathWithin(std::string_view path, std::string_view above) {
    return path.starts_with(above) && (path.size() == above.size() || path[above.size()] == '/');
}

std::string movedUsdPath(std::string_view path, std::string_view from, std::string_view to) {
    return std::string(to).append(path.substr(from.size()));
}

} // namespace penumbra
