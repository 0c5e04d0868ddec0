#include "io/usd/layer/UsdValueParser.h"

#include "io/usd/layer/UsdPath.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <type_traits>
#include <unordered_map>

namespace penumbra {

namespace {

constexpr int kMaxBrackets = 64;
constexpr int kMaxDictionaries = 128;
constexpr std::size_t kMaxComponents = 16; // a 4x4 matrix

class ValueParser {
public:
    ValueParser(UsdScanner& scanner, UsdType type) : in_(scanner), type_(type) {}

    UsdValue parse() {
        switch (type_.kind) {
        case UsdKind::boolean:
            return parseAs<std::uint8_t>([this] { return boolean(); });
        case UsdKind::uchar:
            return parseAs<std::uint8_t>([this] { return integer<std::uint8_t>(); });
        case UsdKind::int32:
            return parseAs<std::int32_t>([this] { return integer<std::int32_t>(); });
        case UsdKind::uint32:
            return parseAs<std::uint32_t>([this] { return integer<std::uint32_t>(); });
        case UsdKind::int64:
            return parseAs<std::int64_t>([this] { return integer<std::int64_t>(); });
        case UsdKind::uint64:
            return parseAs<std::uint64_t>([this] { return integer<std::uint64_t>(); });
        case UsdKind::float16:
            return parseAs<float>([this] { return roundToHalf(in_.number().value); });
        case UsdKind::float32:
            return parseAs<float>([this] { return roundToFloat(in_.number().value); });
        case UsdKind::float64:
            return parseAs<double>([this] { return in_.number().value; });
        case UsdKind::string:
        case UsdKind::token:
            return parseAs<std::string>([this] { return quoted(); });
        case UsdKind::asset:
            return parseAs<std::string>([this] { return asset(); });
        case UsdKind::dictionary:
        case UsdKind::unknown:
            break;
        }
        return {type_, UsdRaw{std::string(in_.rawValue())}};
    }

private:
    // `read` reads one component.
    template <class T, class Read>
    UsdValue parseAs(Read read) {
        std::vector<T> components;
        if (type_.array) {
            in_.expect('[', "to begin an array");
            array(components, read, 1);
        } else {
            if (in_.peek() == '[') in_.fail("an array where a single value is expected");
            element(components, read);
        }
        return {type_, std::move(components)};
    }

    template <class T, class Read>
    void array(std::vector<T>& components, Read read, int depth) {
        if (depth > kMaxBrackets) in_.fail("brackets nested too deeply");
        parseUsdList(in_, ']', [&] {
            if (in_.take('['))
                array(components, read, depth + 1);
            else
                element(components, read);
        });
    }

    template <class T, class Read>
    void element(std::vector<T>& components, Read read) {
        if (type_.components() == 1) {
            components.push_back(read());
            return;
        }
        std::array<T, kMaxComponents> tuple;
        T* next = tuple.data();
        if (type_.rows == 1) {
            row(next, read);
        } else {
            in_.expect('(', "to begin a matrix");
            for (int r = 0; r < type_.rows; ++r) {
                in_.skipSpace();
                row(next, read);
                in_.skipBlanks();
                endItem(r + 1 == type_.rows);
            }
        }
        components.insert(components.end(), std::make_move_iterator(tuple.data()),
                          std::make_move_iterator(next));
    }

    template <class T, class Read>
    void row(T*& next, Read read) {
        in_.expect('(', "to begin a tuple");
        for (int c = 0; c < type_.columns; ++c) {
            in_.skipSpace();
            *next++ = read();
            in_.skipBlanks();
            endItem(c + 1 == type_.columns);
        }
    }

    // The comma after a tuple's item; after the last one the closing bracket, comma or not.
    void endItem(bool last) {
        const bool comma = in_.take(',');
        if (!last && !comma) in_.fail("expected ',' in a tuple, found " + in_.found());
        if (!last) return;
        in_.skipSpace();
        in_.expect(')', "to end a tuple");
    }

    template <class T>
    T integer() {
        const char* where = in_.cursor();
        const UsdNumber n = in_.number();
        constexpr std::uint64_t kMax = std::uint64_t(std::numeric_limits<T>::max());
        if (n.integral) {
            const std::uint64_t limit = !n.negative ? kMax : std::is_signed_v<T> ? kMax + 1 : 0;
            if (n.magnitude > limit) in_.failAt(where, "this number is out of the type's range");
            return static_cast<T>(n.negative ? 0 - n.magnitude : n.magnitude);
        }
        // 2^digits is exact as a double, and the first value that is too large.
        const double end = std::ldexp(1.0, std::numeric_limits<T>::digits);
        const double whole = std::trunc(n.value);
        const bool inside = whole < end && whole >= (std::is_signed_v<T> ? -end : 0.0);
        if (!inside) in_.failAt(where, "this number is out of the type's range");
        return static_cast<T>(whole);
    }

    // true/false/yes/no in any case, quoted or not, or a number.
    std::uint8_t boolean() {
        const char* where = in_.cursor();
        const bool isQuoted = in_.atString();
        std::string word = isQuoted ? in_.string() : std::string(in_.peekIdentifier());
        std::transform(word.begin(), word.end(), word.begin(),
                       [](unsigned char c) { return char(c < 0x80 ? std::tolower(c) : c); });
        const bool isTrue = word == "true" || word == "yes" || (isQuoted && word == "1");
        const bool isFalse = word == "false" || word == "no" || (isQuoted && word == "0");
        if (isTrue || isFalse) {
            if (!isQuoted) in_.identifier();
            return isTrue ? 1 : 0;
        }
        if (isQuoted) in_.failAt(where, "expected a bool");
        const UsdNumber n = in_.number();
        return n.value != 0 ? 1 : 0;
    }

    std::string quoted() {
        if (!in_.atString()) in_.fail("expected a quoted string, found " + in_.found());
        return in_.string();
    }

    std::string asset() {
        if (in_.peek() == '@') return in_.asset();
        return quoted();
    }

    UsdScanner& in_;
    UsdType type_;
};

UsdDictionary parseDictionary(UsdScanner& in, int depth);

// `type[] name = value`, the one entry of a dictionary.
UsdNamedValue parseEntry(UsdScanner& in, int depth) {
    UsdNamedValue entry;
    entry.typeName = in.identifier();
    if (entry.typeName.empty()) in.fail("expected a type or '}', found " + in.found());
    UsdType type = usdTypeNamed(entry.typeName);
    in.skipBlanks();
    if (in.take('[')) {
        in.skipBlanks();
        in.expect(']', "after '['");
        type.array = true;
        in.skipBlanks();
    }
    entry.name = in.atString() ? in.string() : std::string(in.identifier());
    if (entry.name.empty()) in.fail("expected the name of an entry, found " + in.found());
    in.skipBlanks();
    in.expect('=', "after the name of an entry");
    in.skipBlanks();
    if (type.kind == UsdKind::dictionary)
        entry.value = {type, parseDictionary(in, depth + 1)};
    else
        entry.value = parseUsdValue(in, type);
    return entry;
}

UsdDictionary parseDictionary(UsdScanner& in, int depth) {
    if (depth > kMaxDictionaries) in.fail("dictionaries nested too deeply");
    in.expect('{', "to begin a dictionary");
    UsdDictionary dictionary;
    std::unordered_map<std::string, std::size_t> indexOf; // the last entry of a name wins
    bool separated = true;
    in.skipSeparators();
    while (!in.take('}')) {
        if (!separated) in.fail("expected a newline or ';', found " + in.found());
        UsdNamedValue entry = parseEntry(in, depth);
        const auto [place, isNew] = indexOf.try_emplace(entry.name, dictionary.size());
        if (isNew)
            dictionary.push_back(std::move(entry));
        else
            dictionary[place->second] = std::move(entry);
        separated = in.skipSeparators();
    }
    return dictionary;
}

} // namespace

UsdValue parseUsdValue(UsdScanner& scanner, UsdType type) {
    if (scanner.peekIdentifier() == "None") {
        scanner.identifier();
        return {type, UsdBlock{}};
    }
    if (type.kind == UsdKind::dictionary && !type.array) return {type, parseDictionary(scanner, 1)};
    return ValueParser(scanner, type).parse();
}

UsdDictionary parseUsdDictionary(UsdScanner& scanner) {
    return parseDictionary(scanner, 1);
}

} // namespace penumbra
