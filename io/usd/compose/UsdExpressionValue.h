// What parts of an expression come to, and the functions of them.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace penumbra {

using UsdExpressionScalar = std::variant<std::monostate, bool, std::int64_t, std::string>;

/// A scalar, None, or a list of scalars.
struct UsdExpressionValue {
    UsdExpressionScalar scalar;
    std::vector<UsdExpressionScalar> list;
    bool isList = false;
    bool operator==(const UsdExpressionValue&) const = default;
};

/// What is wrong with an expression.
struct UsdExpressionFault : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Throws unless the value is True or False.
bool isTrue(const UsdExpressionValue& value);

/// Calls any function but `defined`. \param taken if false, the arguments are empty, and only their
/// number is checked
UsdExpressionValue callUsdFunction(const std::string& name,
                                   const std::vector<UsdExpressionValue>& values, bool taken);

} // namespace penumbra
