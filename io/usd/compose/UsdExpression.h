// Variable expressions: `"./${SHOT}.usd"` in backticks, in asset paths and variant selections.
#pragma once

#include "io/usd/layer/UsdValue.h"

#include <string>
#include <string_view>

namespace penumbra {

/// Whether a string is an expression: it begins with a backtick.
inline bool isUsdExpression(std::string_view text) {
    return !text.empty() && text.front() == '`';
}

/// What an expression came to. Empty text: nothing, silently (`None`, or an empty string).
struct UsdEvaluated {
    std::string text;
    std::string error; ///< why there is none; empty if there is one
};

/// A string without backticks stays what it is. Expressions have strings with `${NAME}`, whole
/// numbers, True and False, None, lists, variables, and the functions if, and, or, not, eq, neq,
/// lt, leq, gt, geq, contains, at, len, defined. The value must be a string or None.
UsdEvaluated evaluateUsdText(const std::string& text, const UsdDictionary& variables);

} // namespace penumbra
