// Value representations: the 64 bits by which a crate file says what a value is and where.
#pragma once

#include "io/usd/layer/UsdValue.h"

#include <cstdint>
#include <string_view>

namespace penumbra {

/// Types of values by their numbers in the file; those between vec2d and vec4i are told apart by
/// usdTypeOf().
enum class CrateType : std::uint8_t {
    invalid = 0,
    boolean = 1,
    uchar = 2,
    int32 = 3,
    uint32 = 4,
    int64 = 5,
    uint64 = 6,
    float16 = 7,
    float32 = 8,
    float64 = 9,
    string = 10,
    token = 11,
    asset = 12,
    matrix2d = 13,
    matrix4d = 15,
    quatd = 16,
    quath = 18,
    vec2d = 19,
    vec2h = 21,
    vec4i = 30,
    dictionary = 31,
    tokenListOp = 32,
    stringListOp = 33,
    pathListOp = 34,
    referenceListOp = 35,
    intListOp = 36,
    int64ListOp = 37,
    uintListOp = 38,
    uint64ListOp = 39,
    pathVector = 40,
    tokenVector = 41,
    specifier = 42,
    permission = 43,
    variability = 44,
    variantSelections = 45,
    timeSamples = 46,
    payload = 47,
    doubleVector = 48,
    layerOffsetVector = 49,
    stringVector = 50,
    valueBlock = 51,
    value = 52,
    unregistered = 53,
    unregisteredListOp = 54,
    payloadListOp = 55,
    timeCode = 56,
    pathExpression = 57,
    relocates = 58,
    spline = 59,
    animationBlock = 60,
};

/// Bit 63: array, 62: the payload is the value, 61: compressed, 60: array edit; bits 48 to 55:
/// type; below: payload, an offset in the file or the value itself.
class CrateRep {
public:
    constexpr CrateRep() = default;
    constexpr explicit CrateRep(std::uint64_t bits) : bits_(bits) {}

    bool array() const { return (bits_ >> 63) & 1; }
    bool inlined() const { return (bits_ >> 62) & 1; }
    bool compressed() const { return (bits_ >> 61) & 1; }
    bool arrayEdit() const { return (bits_ >> 60) & 1; }
    CrateType type() const { return CrateType((bits_ >> 48) & 0xff); }
    std::uint64_t payload() const { return bits_ & 0xffff'ffff'ffffu; }
    std::uint32_t low() const { return std::uint32_t(bits_); } ///< payload of inlined values

private:
    std::uint64_t bits_ = 0;
};

/// The type of numbers, strings and dictionaries; kind unknown for all other things, which are no
/// values of attributes.
UsdType usdTypeOf(CrateRep rep);

/// How the text format calls that type where a value has to say its own: `float3`, no `color3f`.
std::string_view usdTypeNameOf(CrateType type);

} // namespace penumbra
