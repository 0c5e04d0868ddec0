#include "io/usd/compose/UsdExpressionValue.h"

#include <algorithm>

namespace penumbra {

namespace {

using Value = UsdExpressionValue;

[[noreturn]] void fail(const std::string& why) {
    throw UsdExpressionFault(why);
}

Value logic(bool all, const std::vector<Value>& values) {
    for (const Value& value : values) // those after the first that decides are empty
        if (isTrue(value) != all) return {!all, {}, false};
    return {all, {}, false};
}

Value length(const Value& value) {
    if (value.isList) return {std::int64_t(value.list.size()), {}, false};
    const auto* text = std::get_if<std::string>(&value.scalar);
    if (!text) fail("'len' of what is neither list nor string");
    return {std::int64_t(text->size()), {}, false};
}

Value contains(const Value& whole, const Value& part) {
    if (whole.isList)
        return {std::find(whole.list.begin(), whole.list.end(), part.scalar) != whole.list.end(),
                {},
                false};
    const auto* text = std::get_if<std::string>(&whole.scalar);
    const auto* piece = std::get_if<std::string>(&part.scalar);
    if (!text || !piece) fail("'contains' of what is neither list nor string");
    return {text->find(*piece) != std::string::npos, {}, false};
}

Value element(const Value& whole, const Value& index) {
    const auto* n = std::get_if<std::int64_t>(&index.scalar);
    const auto* text = std::get_if<std::string>(&whole.scalar);
    if (!n || (!whole.isList && !text)) fail("'at' needs a list or a string, and a number");
    const auto size = std::int64_t(whole.isList ? whole.list.size() : text->size());
    const std::int64_t i = *n < 0 ? *n + size : *n;
    if (i < 0 || i >= size) fail("'at' beyond the end");
    if (whole.isList) return {whole.list[std::size_t(i)], {}, false};
    return {std::string(1, (*text)[std::size_t(i)]), {}, false};
}

Value compare(const std::string& name, const Value& a, const Value& b) {
    if (name == "eq") return {a == b, {}, false};
    if (name == "neq") return {!(a == b), {}, false};
    if (a.isList || b.isList || a.scalar.index() != b.scalar.index())
        fail("values of different types compared");
    if (name == "lt") return {a.scalar < b.scalar, {}, false};
    if (name == "leq") return {a.scalar <= b.scalar, {}, false};
    if (name == "gt") return {a.scalar > b.scalar, {}, false};
    if (name == "geq") return {a.scalar >= b.scalar, {}, false};
    fail("unknown function '" + name + "'");
}

void checkCount(const std::string& name, std::size_t count) {
    std::size_t least = 2, most = 2;
    if (name == "if") most = 3;
    if (name == "and" || name == "or") most = 64;
    if (name == "not" || name == "len") least = most = 1;
    if (count < least || count > most) fail("wrong number of arguments of '" + name + "'");
}

} // namespace

bool isTrue(const UsdExpressionValue& value) {
    const auto* found = std::get_if<bool>(&value.scalar);
    if (!found || value.isList) fail("expected True or False");
    return *found;
}

UsdExpressionValue callUsdFunction(const std::string& name,
                                   const std::vector<UsdExpressionValue>& values, bool taken) {
    checkCount(name, values.size());
    if (!taken) return {};
    if (name == "if") {
        if (isTrue(values[0])) return values[1];
        return values.size() == 3 ? values[2] : Value{};
    }
    if (name == "and" || name == "or") return logic(name == "and", values);
    if (name == "not") return {!isTrue(values[0]), {}, false};
    if (name == "len") return length(values[0]);
    if (name == "contains") return contains(values[0], values[1]);
    if (name == "at") return element(values[0], values[1]);
    return compare(name, values[0], values[1]);
}

} // namespace penumbra
