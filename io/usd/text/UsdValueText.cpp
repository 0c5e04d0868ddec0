#include "io/usd/text/UsdValueText.h"

#include "io/usd/layer/UsdPath.h"

#include <charconv>
#include <cmath>

namespace penumbra {

namespace {

template <class T>
void appendNumber(std::string& out, T number) {
    if constexpr (std::is_floating_point_v<T>)
        if (std::isnan(number)) { // never -nan
            out += "nan";
            return;
        }
    char digits[40];
    out.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}

void appendComponent(std::string& out, const std::string& text, UsdKind kind) {
    out += kind == UsdKind::asset ? usdAssetLiteral(text) : usdLiteral(text);
}
template <class T>
void appendComponent(std::string& out, T number, UsdKind) {
    if constexpr (sizeof(T) == 1)
        appendNumber(out, unsigned(number));
    else
        appendNumber(out, number);
}

/// Writes elements: single components, tuples, and tuples of tuples.
template <class T>
class ElementWriter {
public:
    ElementWriter(std::string& out, const std::vector<T>& components, UsdType type)
        : out_(out), components_(components), type_(type) {}

    void write() {
        if (!type_.array) {
            if (components_.size() >= type_.components()) element(0);
            return;
        }
        out_ += '[';
        for (std::size_t i = 0; i + type_.components() <= components_.size();
             i += type_.components()) {
            if (i > 0) out_ += ", ";
            element(i);
        }
        out_ += ']';
    }

private:
    void element(std::size_t first) {
        if (type_.components() == 1) {
            appendComponent(out_, components_[first], type_.kind);
            return;
        }
        if (type_.rows == 1) return row(first);
        out_ += "( ";
        for (std::size_t r = 0; r < type_.rows; ++r) {
            if (r > 0) out_ += ", ";
            row(first + r * type_.columns);
        }
        out_ += " )";
    }
    void row(std::size_t first) {
        out_ += '(';
        for (std::size_t c = 0; c < type_.columns; ++c) {
            if (c > 0) out_ += ", ";
            appendComponent(out_, components_[first + c], type_.kind);
        }
        out_ += ')';
    }

    std::string& out_;
    const std::vector<T>& components_;
    UsdType type_;
};

// What stands for one character within quotes; `escapeQuote` for the quote itself.
void appendEscaped(std::string& out, char c, bool lines) {
    constexpr std::string_view kHex = "0123456789abcdef";
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
        out += '\\';
        out += c;
    } else if ((c == '\n' && lines) || (byte >= 0x20 && byte != 0x7f)) {
        out += c;
    } else if (c == '\n' || c == '\t' || c == '\r') {
        out += c == '\n' ? "\\n" : c == '\t' ? "\\t" : "\\r";
    } else {
        out += "\\x";
        out += kHex[byte >> 4];
        out += kHex[byte & 15];
    }
}

} // namespace

std::string usdLiteral(std::string_view text) {
    const bool lines = text.find('\n') != std::string_view::npos;
    const char* quotes = lines ? "\"\"\"" : "\"";
    std::string literal = quotes;
    for (const char c : text) appendEscaped(literal, c, lines);
    return literal + quotes;
}

// The only escape between @ is that of @@@ itself.
bool isUsdAssetPath(std::string_view path) {
    for (const char c : path)
        if (static_cast<unsigned char>(c) < 0x20) return false;
    if (path.find('@') == std::string_view::npos) return true;
    // Before the closing @@@ a backslash would be read as that of `\@@@`.
    for (const std::string_view end : {"\\", "\\@", "\\@@"})
        if (path.ends_with(end)) return false;
    return true;
}

std::string usdAssetLiteral(std::string_view path) {
    if (!isUsdAssetPath(path)) return usdLiteral(path);
    if (path.find('@') == std::string_view::npos) return std::string("@").append(path).append("@");
    std::string literal = "@@@";
    for (std::size_t i = 0; i < path.size(); ++i) {
        if (path.substr(i, 3) == "@@@") {
            literal += "\\@@@";
            i += 2;
        } else {
            literal += path[i];
        }
    }
    return literal + "@@@";
}

void appendUsdText(std::string& out, const UsdDictionary& dictionary, std::size_t depth) {
    out += "{\n";
    for (const UsdNamedValue& entry : dictionary) {
        out.append(4 * (depth + 1), ' ').append(entry.typeName);
        if (entry.value.type.array) out += "[]";
        out += ' ';
        out += isUsdIdentifier(entry.name) ? entry.name : usdLiteral(entry.name);
        out += " = ";
        appendUsdText(out, entry.value, depth + 1);
        out += '\n';
    }
    out.append(4 * depth, ' ').append("}");
}

void appendUsdText(std::string& out, const UsdValue& value, std::size_t depth) {
    const auto write = [&](const auto& stored) {
        using Stored = std::decay_t<decltype(stored)>;
        if constexpr (std::is_same_v<Stored, UsdBlock>)
            out += "None";
        else if constexpr (std::is_same_v<Stored, UsdRaw>)
            out += stored.text;
        else if constexpr (std::is_same_v<Stored, UsdDictionary>)
            appendUsdText(out, stored, depth);
        else if constexpr (!std::is_same_v<Stored, std::monostate>)
            ElementWriter(out, stored, value.type).write();
    };
    std::visit(write, value.data);
}

std::string usdText(const UsdValue& value, std::size_t depth) {
    std::string text;
    appendUsdText(text, value, depth);
    return text;
}

} // namespace penumbra
