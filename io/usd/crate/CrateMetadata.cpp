#include "io/usd/crate/CrateMetadata.h"

#include "io/usd/crate/CrateFields.h"
#include "io/usd/crate/CrateListOps.h"
#include "io/usd/crate/CrateValues.h"
#include "io/usd/layer/UsdMetadataParser.h"
#include "io/usd/layer/UsdNumber.h"
#include "io/usd/layer/UsdPath.h"
#include "io/usd/layer/UsdScanner.h"
#include "io/usd/text/UsdTextOutput.h"

#include <cmath>
#include <limits>

namespace penumbra {

namespace {

constexpr std::size_t kMaxEntries = 256; // as in text

bool isText(UsdKind kind) {
    return kind == UsdKind::string || kind == UsdKind::token || kind == UsdKind::asset;
}
bool isNumeric(UsdKind kind) {
    return kind >= UsdKind::boolean && kind <= UsdKind::float64;
}

template <class T>
UsdValue::Storage integers(const std::vector<double>& numbers) {
    std::vector<T> converted;
    for (const double number : numbers) {
        const double end = std::ldexp(1.0, std::numeric_limits<T>::digits); // too large, exactly
        const bool fits = number >= double(std::numeric_limits<T>::lowest()) && number < end;
        converted.push_back(fits ? T(number) : T(0));
    }
    return converted;
}

UsdValue::Storage converted(const std::vector<double>& numbers, UsdKind kind) {
    switch (kind) {
    case UsdKind::boolean: {
        std::vector<std::uint8_t> flags;
        for (const double number : numbers) flags.push_back(number != 0);
        return flags;
    }
    case UsdKind::uchar:
        return integers<std::uint8_t>(numbers);
    case UsdKind::int32:
        return integers<std::int32_t>(numbers);
    case UsdKind::uint32:
        return integers<std::uint32_t>(numbers);
    case UsdKind::int64:
        return integers<std::int64_t>(numbers);
    case UsdKind::uint64:
        return integers<std::uint64_t>(numbers);
    case UsdKind::float16:
    case UsdKind::float32: {
        std::vector<float> floats;
        for (const double number : numbers)
            floats.push_back(kind == UsdKind::float16 ? roundToHalf(number) : roundToFloat(number));
        return floats;
    }
    default:
        return numbers;
    }
}

// Text that stands for one value, as the parser keeps it; anything else would break the text it is
// written into, and becomes a string.
UsdRaw rawOf(const std::string& text) {
    try {
        UsdScanner in(text, {});
        in.rawValue();
        if (in.atEnd()) return {text};
    } catch (const SceneFileError&) {
    }
    return {usdLiteral(text)};
}

UsdValue listValue(const std::vector<std::string>& items) {
    if (items.empty()) return {{}, UsdBlock{}};
    std::string text = "[";
    for (const std::string& item : items) text += (text.size() > 1 ? ", " : "") + item;
    return {{}, UsdRaw{text + "]"}};
}

void addListEdits(CrateFile& file, const std::string& key, CrateRep rep, UsdDictionary& metadata) {
    for (const auto& edit : crateWrittenEdits(file, rep))
        assign(metadata, {std::string(usdPrefix(edit.op)) + key, {}, listValue(edit.items)});
}

std::vector<std::string> vectorTexts(CrateFile& file, CrateRep rep) {
    if (rep.type() == CrateType::stringVector) return crateStrings(file, rep);
    std::vector<std::string> texts;
    for (const std::uint32_t token : crateTokens(file, rep))
        texts.push_back(file.copied(file.tables.tokens[token], rep.payload()));
    return texts;
}

// What is no value of an attribute, but a value of metadata all the same.
UsdValue metadataValue(CrateFile& file, CrateRep rep) {
    switch (rep.type()) {
    case CrateType::permission:
        return {{}, UsdRaw{rep.low() == 0 ? "public" : "private"}};
    case CrateType::specifier:
        return {{}, UsdRaw{rep.low() == 0 ? "def" : rep.low() == 1 ? "over" : "class"}};
    case CrateType::variability:
        return {{}, UsdRaw{rep.low() == 0 ? "varying" : "uniform"}};
    case CrateType::tokenVector:
    case CrateType::stringVector:
        return {{UsdKind::string, 1, 1, true}, vectorTexts(file, rep)};
    default:
        return crateValue(file, rep);
    }
}

// The representation within one of an unregistered type.
CrateRep unwrapped(CrateFile& file, CrateRep rep) {
    CrateBytes in = file.at(rep.payload());
    return takeCrateRep(file, in);
}

UsdType typeOfKey(std::string_view key) {
    return key == "comment" ? UsdType{UsdKind::string} : usdMetadataType(key);
}

} // namespace

bool fitUsdValue(UsdValue& value, UsdType declared) {
    if (std::holds_alternative<UsdRaw>(value.data)) return declared.kind == UsdKind::unknown;
    if (declared.kind == UsdKind::unknown && !value.blocked())
        value.data = UsdRaw{usdText(value)};
    else if (!value.blocked() && value.type != declared) {
        if (value.type.array != declared.array || value.type.rows != declared.rows ||
            value.type.columns != declared.columns || value.type.quaternion != declared.quaternion)
            return false;
        const bool bothText = isText(value.type.kind) && isText(declared.kind);
        const bool bothNumeric = isNumeric(value.type.kind) && isNumeric(declared.kind);
        if (!bothText && !bothNumeric) return false;
        if (bothNumeric) value.data = converted(value.numbers(), declared.kind);
    }
    value.type = declared;
    return true;
}

UsdValue crateNameOrder(CrateFile& file, CrateRep rep) {
    return {{UsdKind::string, 1, 1, true}, vectorTexts(file, rep)};
}

void addCrateMetadata(CrateFile& file, std::string_view field, CrateRep rep,
                      UsdDictionary& metadata) {
    constexpr std::size_t kLongest = 1024;
    const std::string key(usdMetadataKey(field.substr(0, kLongest)));
    if (field.size() > kLongest || !isUsdIdentifier(key) || usdListOpNamed(key))
        throw CrateFault(rep.payload(), "metadata of an impossible name");
    if (metadata.size() >= kMaxEntries)
        throw CrateFault(rep.payload(), "more than 256 entries of metadata");
    const bool unregistered = rep.type() == CrateType::unregistered;
    if (unregistered) rep = unwrapped(file, rep);
    const UsdType declared = typeOfKey(key);
    if (isCrateListOp(rep.type()) && declared.kind == UsdKind::unknown)
        return addListEdits(file, key, rep, metadata);
    UsdValue value = metadataValue(file, rep);
    const bool isDictionary = value.type.kind == UsdKind::dictionary;
    if (unregistered && value.text()) value = {{}, rawOf(*value.text())};
    if (!(isDictionary && declared.kind == UsdKind::unknown) && !fitUsdValue(value, declared))
        throw CrateFault(rep.payload(), "a value of another type than this metadata has");
    if (key == "framesPerSecond" && !value.blocked() && !(value.numbers()[0] > 0)) // as in text
        throw CrateFault(rep.payload(), "framesPerSecond must be positive");
    assign(metadata, {key, {}, std::move(value)});
}

} // namespace penumbra
