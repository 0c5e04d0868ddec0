// USD text in the making: lines, their depth, and what prims and properties both have.
#pragma once

#include "io/usd/text/UsdValueText.h"

#include <string>
#include <string_view>
#include <vector>

namespace penumbra {

/// `prepend ` and the like, with a blank behind; empty for an explicit list.
std::string_view usdPrefix(UsdListOp op);

/// `reorder nameChildren = ...` and the like: statements that the model keeps among the metadata.
bool isUsdReorder(const UsdNamedValue& entry);

struct UsdTextOutput {
    std::string text;
    std::size_t depth = 0; ///< of lines, in steps of four blanks

    /// Begins a line.
    std::string& line() { return text.append(4 * depth, ' '); }
    /// A line each, without statements.
    void metadata(const UsdDictionary& entries);

    /// `None`, one item, or items in brackets, each written by `write(item)`.
    template <class Item, class Write>
    void list(const std::vector<Item>& items, bool brackets, Write write) {
        if (items.empty()) {
            text += "None";
            return;
        }
        brackets = brackets || items.size() > 1;
        if (brackets) text += '[';
        for (const Item& item : items) {
            if (&item != &items.front()) text += ", ";
            write(item);
        }
        if (brackets) text += ']';
    }
};

/// Writes the statements of one property.
void writeUsdProperty(UsdTextOutput& out, const UsdProperty& property);

} // namespace penumbra
