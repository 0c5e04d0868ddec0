// Values of USD attributes and metadata, held compactly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace penumbra {

/// What one component of a value is.
enum class UsdKind : std::uint8_t {
    unknown, ///< a type that we do not know: kept as text
    boolean,
    uchar,
    int32,
    uint32,
    int64,
    uint64,
    float16, ///< kept as float, rounded to what a half can hold
    float32,
    float64, ///< double and timecode
    string,
    token,
    asset,
    dictionary,
};

/// A type of the USD text format: `float3[]` is {float32, 1, 3, true}, `matrix4d` {float64, 4, 4,
/// false}. Quaternions have four columns: real, i, j, k.
struct UsdType {
    UsdKind kind = UsdKind::unknown;
    std::uint8_t rows = 1;
    std::uint8_t columns = 1;
    bool array = false;
    bool quaternion = false;

    std::size_t components() const { return std::size_t(rows) * columns; }
    bool operator==(const UsdType&) const = default;
};

/// The type called `name` (without brackets); kind unknown if there is none.
UsdType usdTypeNamed(std::string_view name);

struct UsdNamedValue;
using UsdDictionary = std::vector<UsdNamedValue>;

/// `None`: an authored absence, which hides weaker opinions.
struct UsdBlock {
    bool operator==(const UsdBlock&) const = default;
};
/// The text of a value whose type we do not know, as it is in the file.
struct UsdRaw {
    std::string text;
    bool operator==(const UsdRaw&) const = default;
};

/// One value. Scalars, tuples and arrays all lie in one flat vector of components, so that an array
/// of a million points is one allocation; `type` says how to read it.
struct UsdValue {
    using Storage =
        std::variant<std::monostate, UsdBlock, std::vector<std::uint8_t>, std::vector<std::int32_t>,
                     std::vector<std::uint32_t>, std::vector<std::int64_t>,
                     std::vector<std::uint64_t>, std::vector<float>, std::vector<double>,
                     std::vector<std::string>, UsdDictionary, UsdRaw>;
    UsdType type;
    Storage data;

    bool empty() const { return std::holds_alternative<std::monostate>(data); }
    bool blocked() const { return std::holds_alternative<UsdBlock>(data); }
    /// The components, if they are stored as T; null otherwise.
    template <class T>
    const std::vector<T>* as() const {
        return std::get_if<std::vector<T>>(&data);
    }
    /// Number of elements of an array; 1 for a scalar or a tuple.
    std::size_t size() const;
    /// All components as doubles; empty unless the value is numeric.
    std::vector<double> numbers() const;
    /// The only string of a scalar string, token or asset; null otherwise.
    const std::string* text() const;
    const UsdDictionary* dictionary() const { return std::get_if<UsdDictionary>(&data); }
    bool operator==(const UsdValue&) const;
};

/// An entry of a dictionary or of metadata.
struct UsdNamedValue {
    std::string name;
    std::string typeName; ///< as spelt in the file, without brackets; empty for metadata
    UsdValue value;
    bool operator==(const UsdNamedValue&) const;
};

/// The entry called `name`, or null.
const UsdValue* find(const UsdDictionary& dictionary, std::string_view name);
/// Adds an entry or replaces the one of that name: the last one wins.
void assign(UsdDictionary& dictionary, UsdNamedValue entry);

} // namespace penumbra
