// Combining the list edits of several layers.
#pragma once

#include "io/usd/layer/UsdLayer.h"

#include <algorithm>
#include <string>
#include <unordered_set>
#include <vector>

namespace penumbra {

/// Applies the edits of one opinion to the list that weaker opinions have made: an explicit list
/// replaces it; otherwise items are deleted, added (at the end, if absent), prepended (moved to the
/// front), appended (moved to the back). `reorder` is left out: no list that we read depends on it.
inline void applyUsdListEdits(const UsdListEdits<std::string>& edits,
                              std::vector<std::string>& list) {
    const auto itemsOf = [&](UsdListOp op) -> const std::vector<std::string>* {
        for (const auto& edit : edits)
            if (edit.op == op) return &edit.items;
        return nullptr;
    };
    const auto drop = [&](const std::vector<std::string>& items) {
        const std::unordered_set<std::string_view> unwanted(items.begin(), items.end());
        std::erase_if(list, [&](const std::string& item) { return unwanted.contains(item); });
    };
    if (const auto* items = itemsOf(UsdListOp::explicitly)) list = *items;
    if (const auto* items = itemsOf(UsdListOp::remove)) drop(*items);
    if (const auto* items = itemsOf(UsdListOp::add)) {
        std::unordered_set<std::string> present(list.begin(), list.end());
        for (const std::string& item : *items)
            if (present.insert(item).second) list.push_back(item);
    }
    if (const auto* items = itemsOf(UsdListOp::prepend)) {
        drop(*items);
        list.insert(list.begin(), items->begin(), items->end());
    }
    if (const auto* items = itemsOf(UsdListOp::append)) {
        drop(*items);
        list.insert(list.end(), items->begin(), items->end());
    }
}

} // namespace penumbra
