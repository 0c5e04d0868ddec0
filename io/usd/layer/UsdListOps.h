// Combining the list edits of several layers.
#pragma once

#include "io/usd/layer/UsdLayer.h"

#include <algorithm>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace penumbra {

/// Brings those items of `list` that `order` names into that order. Each takes along the items
/// behind it that `order` doesn't name; what stands before the first that is named stays there.
/// \param key of an item: a string; items are the same if their keys are
template <class Item, class Key>
void reorderUsdList(const std::vector<Item>& order, std::vector<Item>& list, Key key) {
    std::unordered_map<std::string, std::size_t> rank;
    for (const Item& item : order) rank.try_emplace(key(item), rank.size());
    std::vector<Item> result;
    std::vector<std::vector<Item>> runs(rank.size());
    std::vector<Item>* run = &result;
    for (Item& item : list) {
        const auto named = rank.find(key(item));
        if (named != rank.end()) run = &runs[named->second];
        run->push_back(std::move(item));
    }
    for (std::vector<Item>& one : runs)
        result.insert(result.end(), std::make_move_iterator(one.begin()),
                      std::make_move_iterator(one.end()));
    list = std::move(result);
}

/// Applies the edits of one opinion to the list that weaker opinions have made: an explicit list
/// replaces it; otherwise items are deleted, added (at the end, if absent), prepended (moved to the
/// front), appended (moved to the back), reordered.
template <class Item, class Key>
void applyUsdListEdits(const UsdListEdits<Item>& edits, std::vector<Item>& list, Key key) {
    const auto itemsOf = [&](UsdListOp op) -> const std::vector<Item>* {
        for (const auto& edit : edits)
            if (edit.op == op) return &edit.items;
        return nullptr;
    };
    const auto keysOf = [&](const std::vector<Item>& items) {
        std::unordered_set<std::string> keys;
        for (const Item& item : items) keys.insert(key(item));
        return keys;
    };
    const auto addAbsent = [&](const std::vector<Item>& items) {
        auto present = keysOf(list);
        for (const Item& item : items)
            if (present.insert(key(item)).second) list.push_back(item);
    };
    const auto drop = [&](const std::vector<Item>& items) {
        const auto unwanted = keysOf(items);
        std::erase_if(list, [&](const Item& item) { return unwanted.contains(key(item)); });
    };
    if (const auto* items = itemsOf(UsdListOp::explicitly)) {
        list.clear();
        addAbsent(*items);
    }
    if (const auto* items = itemsOf(UsdListOp::remove)) drop(*items);
    if (const auto* items = itemsOf(UsdListOp::add)) addAbsent(*items);
    if (const auto* items = itemsOf(UsdListOp::prepend)) {
        drop(*items);
        std::vector<Item> rest = std::move(list);
        list.clear();
        addAbsent(*items);
        list.insert(list.end(), rest.begin(), rest.end());
    }
    if (const auto* items = itemsOf(UsdListOp::append)) {
        drop(*items);
        addAbsent(*items);
    }
    if (const auto* items = itemsOf(UsdListOp::reorder)) reorderUsdList(*items, list, key);
}

inline void applyUsdListEdits(const UsdListEdits<std::string>& edits,
                              std::vector<std::string>& list) {
    applyUsdListEdits(edits, list,
                      [](const std::string& item) -> const std::string& { return item; });
}

} // namespace penumbra
