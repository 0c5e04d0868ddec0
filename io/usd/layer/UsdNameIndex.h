// Finds things by name in a list that grows.
#pragma once

#include <bit>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

namespace penumbra {

/// Where in a list the item of a name is. A few items are searched, many are hashed; no name is
/// copied: most prims have few properties, and a layer may have a million prims.
class UsdNameIndex {
public:
    static constexpr std::size_t kNone = ~std::size_t(0);

    /// \param items have a `name`, which stays; since the last call some may have been added at
    /// the end, nothing else
    template <class Item>
    std::size_t find(const std::vector<Item>& items, std::string_view name) {
        constexpr std::size_t kFew = 16;
        if (items.size() > kFew) {
            if (2 * items.size() > slots_.size()) grow(items);
            for (; known_ < items.size(); ++known_) add(items, known_);
            const std::size_t found = slots_[slotOf(items, name)];
            return found == 0 ? kNone : found - 1;
        }
        for (std::size_t i = items.size(); i-- > 0;)
            if (items[i].name == name) return i;
        return kNone;
    }

private:
    template <class Item>
    void grow(const std::vector<Item>& items) {
        slots_.assign(std::bit_ceil(4 * items.size()), 0);
        known_ = 0;
    }
    template <class Item>
    void add(const std::vector<Item>& items, std::size_t i) {
        std::uint32_t& slot = slots_[slotOf(items, items[i].name)];
        if (slot == 0) slot = std::uint32_t(i + 1);
    }
    /// The slot of a name: where it is, or an empty one.
    template <class Item>
    std::size_t slotOf(const std::vector<Item>& items, std::string_view name) const {
        const std::size_t mask = slots_.size() - 1;
        std::size_t at = std::hash<std::string_view>()(name) & mask;
        while (slots_[at] != 0 && items[slots_[at] - 1].name != name) at = (at + 1) & mask;
        return at;
    }

    std::vector<std::uint32_t> slots_; ///< position + 1; 0: empty. A power of two of them
    std::size_t known_ = 0;            ///< items that are in slots_
};

} // namespace penumbra
