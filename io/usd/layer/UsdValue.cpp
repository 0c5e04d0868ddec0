#include "io/usd/layer/UsdValue.h"

#include <algorithm>
#include <array>
#include <type_traits>

namespace penumbra {

namespace {

struct NamedType {
    std::string_view name;
    UsdType type;
};

using enum UsdKind;
constexpr std::array kTypes{
    NamedType{"bool", {boolean}},
    NamedType{"uchar", {uchar}},
    NamedType{"int", {int32}},
    NamedType{"uint", {uint32}},
    NamedType{"int64", {int64}},
    NamedType{"uint64", {uint64}},
    NamedType{"half", {float16}},
    NamedType{"float", {float32}},
    NamedType{"double", {float64}},
    NamedType{"timecode", {float64}},
    NamedType{"string", {string}},
    NamedType{"token", {token}},
    NamedType{"asset", {asset}},
    NamedType{"pathExpression", {string}},
    NamedType{"half2", {float16, 1, 2}},
    NamedType{"half3", {float16, 1, 3}},
    NamedType{"half4", {float16, 1, 4}},
    NamedType{"float2", {float32, 1, 2}},
    NamedType{"float3", {float32, 1, 3}},
    NamedType{"float4", {float32, 1, 4}},
    NamedType{"double2", {float64, 1, 2}},
    NamedType{"double3", {float64, 1, 3}},
    NamedType{"double4", {float64, 1, 4}},
    NamedType{"int2", {int32, 1, 2}},
    NamedType{"int3", {int32, 1, 3}},
    NamedType{"int4", {int32, 1, 4}},
    NamedType{"point3h", {float16, 1, 3}},
    NamedType{"point3f", {float32, 1, 3}},
    NamedType{"point3d", {float64, 1, 3}},
    NamedType{"vector3h", {float16, 1, 3}},
    NamedType{"vector3f", {float32, 1, 3}},
    NamedType{"vector3d", {float64, 1, 3}},
    NamedType{"normal3h", {float16, 1, 3}},
    NamedType{"normal3f", {float32, 1, 3}},
    NamedType{"normal3d", {float64, 1, 3}},
    NamedType{"color3h", {float16, 1, 3}},
    NamedType{"color3f", {float32, 1, 3}},
    NamedType{"color3d", {float64, 1, 3}},
    NamedType{"color4h", {float16, 1, 4}},
    NamedType{"color4f", {float32, 1, 4}},
    NamedType{"color4d", {float64, 1, 4}},
    NamedType{"texCoord2h", {float16, 1, 2}},
    NamedType{"texCoord2f", {float32, 1, 2}},
    NamedType{"texCoord2d", {float64, 1, 2}},
    NamedType{"texCoord3h", {float16, 1, 3}},
    NamedType{"texCoord3f", {float32, 1, 3}},
    NamedType{"texCoord3d", {float64, 1, 3}},
    NamedType{"quath", {float16, 1, 4, false, true}},
    NamedType{"quatf", {float32, 1, 4, false, true}},
    NamedType{"quatd", {float64, 1, 4, false, true}},
    NamedType{"matrix2d", {float64, 2, 2}},
    NamedType{"matrix3d", {float64, 3, 3}},
    NamedType{"matrix4d", {float64, 4, 4}},
    NamedType{"frame4d", {float64, 4, 4}},
    NamedType{"dictionary", {dictionary}},
};

} // namespace

UsdType usdTypeNamed(std::string_view name) {
    const auto* found = std::find_if(kTypes.begin(), kTypes.end(),
                                     [&](const NamedType& t) { return t.name == name; });
    return found == kTypes.end() ? UsdType{} : found->type;
}

std::size_t UsdValue::size() const {
    const auto count = [&](const auto& stored) -> std::size_t {
        using Stored = std::decay_t<decltype(stored)>;
        if constexpr (requires { stored.size(); }) {
            if constexpr (!std::is_same_v<Stored, UsdDictionary>)
                return stored.size() / type.components();
        }
        return std::is_same_v<Stored, std::monostate> ? 0 : 1;
    };
    return std::visit(count, data);
}

std::vector<double> UsdValue::numbers() const {
    const auto convert = [](const auto& stored) -> std::vector<double> {
        if constexpr (requires { static_cast<double>(stored[0]); })
            return std::vector<double>(stored.begin(), stored.end());
        else
            return {};
    };
    return std::visit(convert, data);
}

const std::string* UsdValue::text() const {
    const auto* strings = as<std::string>();
    return strings && strings->size() == 1 && !type.array ? &strings->front() : nullptr;
}

bool UsdValue::operator==(const UsdValue&) const = default;
bool UsdNamedValue::operator==(const UsdNamedValue&) const = default;

const UsdValue* find(const UsdDictionary& dictionary, std::string_view name) {
    for (const UsdNamedValue& entry : dictionary)
        if (entry.name == name) return &entry.value;
    return nullptr;
}

void assign(UsdDictionary& dictionary, UsdNamedValue entry) {
    for (UsdNamedValue& present : dictionary)
        if (present.name == entry.name) {
            present = std::move(entry);
            return;
        }
    dictionary.push_back(std::move(entry));
}

} // namespace penumbra
