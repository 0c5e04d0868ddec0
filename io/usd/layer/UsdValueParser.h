// Typed values of the USD text format.
#pragma once

#include "io/usd/layer/UsdScanner.h"
#include "io/usd/layer/UsdValue.h"

namespace penumbra {

/// Reads the value at the scanner's cursor as `type`: a scalar, a tuple, an array or a dictionary.
/// `None` becomes a UsdBlock. A value of an unknown type is kept as text. Throws SceneFileError
/// where the text doesn't fit the type. Nested arrays are flattened; nesting is limited to 64
/// brackets and 128 dictionaries. Memory grows with the text, never with a number in it.
UsdValue parseUsdValue(UsdScanner& scanner, UsdType type);

/// Reads `{ type name = value ... }`.
UsdDictionary parseUsdDictionary(UsdScanner& scanner);

/// Reads a list in the way all lists are written: calls `element` for each item, up to the closing
/// bracket, which is taken. A comma must follow its element on the same line; a last comma is fine.
/// The opening bracket has been taken. Fails on an empty list with a newline in it, as OpenUSD
/// does.
template <class Element>
void parseUsdList(UsdScanner& scanner, char close, Element element) {
    const bool newline = scanner.skipSpace();
    if (scanner.peek() == close) {
        if (newline) scanner.fail("an empty list must not contain a newline");
        scanner.advance();
        return;
    }
    while (true) {
        element();
        scanner.skipBlanks();
        const bool comma = scanner.take(',');
        scanner.skipSpace();
        if (scanner.take(close)) return;
        if (!comma) {
            scanner.fail("expected ',' or '" + std::string(1, close) + "', found " +
                         scanner.found());
        }
    }
}

} // namespace penumbra
