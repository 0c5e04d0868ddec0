#include "io/usd/crate/CrateRep.h"

#include <array>

namespace penumbra {

namespace {

// By number; empty where a type is no value that an attribute or a dictionary may have.
constexpr std::array<std::string_view, 58> kNames{
    "",       "bool",   "uchar",  "int",     "uint",   "int64",    "uint64",   "half",
    "float",  "double", "string", "token",   "asset",  "matrix2d", "matrix3d", "matrix4d",
    "quatd",  "quatf",  "quath",  "double2", "float2", "half2",    "int2",     "double3",
    "float3", "half3",  "int3",   "double4", "float4", "half4",    "int4",     "dictionary"};

} // namespace

std::string_view usdTypeNameOf(CrateType type) {
    if (type == CrateType::timeCode) return "timecode";
    if (type == CrateType::pathExpression) return "pathExpression";
    return std::size_t(type) < kNames.size() ? kNames[std::size_t(type)] : "";
}

UsdType usdTypeOf(CrateRep rep) {
    static const auto kTypes = [] {
        std::array<UsdType, kNames.size()> types;
        for (std::size_t i = 0; i < types.size(); ++i)
            types[i] = usdTypeNamed(usdTypeNameOf(CrateType(i)));
        return types;
    }();
    if (std::size_t(rep.type()) >= kTypes.size()) return {};
    UsdType type = kTypes[std::size_t(rep.type())];
    type.array = rep.array();
    return type;
}

} // namespace penumbra
