#include "io/usd/text/UsdLayerText.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <sstream>

namespace penumbra {

namespace {

template <class T>
std::string shortest(T value) {
    char digits[40];
    return {digits, std::to_chars(digits, digits + sizeof digits, value + T(0)).ptr}; // no -0
}

std::string tuple(std::initializer_list<std::string> parts) {
    std::string text = "(";
    for (const std::string& part : parts) text += (text.size() > 1 ? ", " : "") + part;
    return text + ")";
}

} // namespace

std::string usdText(double value) {
    return shortest(value);
}

std::string usdText(float value) {
    return shortest(value);
}

std::string usdText(glm::dvec3 v) {
    return tuple({usdText(v.x), usdText(v.y), usdText(v.z)});
}

std::string usdText(glm::vec2 v) {
    return tuple({usdText(v.x), usdText(v.y)});
}

std::string usdText(glm::vec3 v) {
    return tuple({usdText(v.x), usdText(v.y), usdText(v.z)});
}

std::string usdText(glm::dvec4 v) {
    return tuple({usdText(v.x), usdText(v.y), usdText(v.z), usdText(v.w)});
}

std::string usdText(const glm::dmat4& value) {
    return tuple({usdText(value[0]), usdText(value[1]), usdText(value[2]), usdText(value[3])});
}

std::string usdQuoted(std::string_view text) {
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') quoted += '\\';
        quoted += c == '\n' ? ' ' : c;
    }
    return quoted + "\"";
}

UsdLayerText::Prim& UsdLayerText::at(const std::string& path) {
    assert(path.starts_with('/'));
    Prim* prim = &root_;
    std::istringstream names(path.substr(1));
    for (std::string name; std::getline(names, name, '/');) {
        auto found = std::find_if(prim->children.begin(), prim->children.end(),
                                  [&](const auto& child) { return child.name == name; });
        if (found == prim->children.end()) {
            found = prim->children.insert(found, Prim());
            found->name = name;
        }
        prim = &*found;
    }
    return *prim;
}

void UsdLayerText::add(const std::string& prim, std::string line) {
    at(prim).lines.push_back(std::move(line));
}

void UsdLayerText::define(const std::string& prim, std::string type) {
    at(prim).specifier = "def " + std::move(type);
}

void UsdLayerText::write(std::string& out, const Prim& prim, std::size_t depth) {
    const std::string indent(4 * depth, ' ');
    for (const std::string& lines : prim.lines) {
        std::istringstream each(lines);
        for (std::string line; std::getline(each, line);) out += indent + line + "\n";
    }
    for (const Prim& child : prim.children) {
        if (out.back() == '\n' && !out.ends_with("{\n")) out += "\n";
        out.append(indent).append(child.specifier).append(" \"").append(child.name);
        out.append("\"\n").append(indent).append("{\n");
        write(out, child, depth + 1);
        out += indent + "}\n";
    }
}

std::string UsdLayerText::text() const {
    std::string out = "#usda 1.0\n(\n";
    for (const std::string& line : metadata_) out += "    " + line + "\n";
    out += ")\n";
    write(out, root_, 0);
    return out;
}

std::string usdAttribute(std::string_view type, std::string_view name,
                         const std::vector<std::pair<double, std::string>>& samples) {
    assert(!samples.empty());
    const std::string start = std::string(type) + " " + std::string(name);
    if (samples.size() == 1) return start + " = " + samples.front().second;
    std::string text = start + ".timeSamples = {\n";
    for (const auto& [time, value] : samples) text += "    " + usdText(time) + ": " + value + ",\n";
    return text + "}";
}

} // namespace penumbra
