// Paths of sites, made once each, so that they compare and hash as one pointer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>

namespace penumbra {

class UsdPathTable;

/// One element of a path and what is above it. Lives in its table.
struct UsdPathElement {
    UsdPathTable* table = nullptr;
    const UsdPathElement* parent = nullptr; ///< null: the root
    const UsdPathElement* plain = nullptr;  ///< the same path without choices
    std::string name;                       ///< of a prim, or of a variant set
    std::string choice;                     ///< of the variant set
    bool isChoice = false;
    std::uint32_t id = 0;     ///< in the order of making
    std::uint32_t length = 0; ///< elements
    std::uint32_t levels = 0; ///< elements that are names
};

/// Where opinions about a prim stand in a layer: `/a/b`, or within variants, `/a{set=choice}b`.
/// Empty if there is no such path.
class UsdSitePath {
public:
    UsdSitePath() = default;
    explicit UsdSitePath(const UsdPathElement* element) : element_(element) {}

    explicit operator bool() const { return element_ != nullptr; }
    bool operator==(const UsdSitePath&) const = default;

    std::uint32_t id() const { return element_->id; }
    bool isRoot() const { return !element_->parent; }
    bool isChoice() const { return element_->isChoice; }
    /// The prim's name, or of a choice the variant set's.
    const std::string& name() const { return element_->name; }
    const std::string& choice() const { return element_->choice; }
    std::size_t length() const { return element_->length; }
    std::size_t levels() const { return element_->levels; }
    /// Without choices.
    UsdSitePath plain() const { return UsdSitePath(element_->plain); }
    UsdSitePath parent() const { return UsdSitePath(element_->parent); }
    /// The first `length` elements.
    UsdSitePath prefix(std::size_t length) const;
    bool hasPrefix(UsdSitePath other) const;
    /// `to` in the place of the prefix `from`.
    UsdSitePath replacePrefix(UsdSitePath from, UsdSitePath to) const;
    UsdSitePath child(std::string_view name) const;
    UsdSitePath withChoice(std::string_view set, std::string_view choice) const;
    /// This path and the last element of `other`.
    UsdSitePath append(UsdSitePath other) const;
    UsdSitePath root() const;
    /// A path of the same table. Empty if `text` is no absolute prim path without choices, or
    /// longer than UsdPathTable::kMaxLength.
    UsdSitePath fromText(std::string_view text) const;
    std::string text() const;

private:
    const UsdPathElement* element_ = nullptr;
};

/// All paths of a composition.
class UsdPathTable {
public:
    UsdPathTable();
    UsdPathTable(const UsdPathTable&) = delete;
    UsdPathTable& operator=(const UsdPathTable&) = delete;

    /// Elements of a path that is read from text: beyond, it is none.
    static constexpr std::size_t kMaxLength = 1024;

    UsdSitePath root() const { return UsdSitePath(&elements_.front()); }
    UsdSitePath path(std::string_view text);
    const UsdPathElement* child(const UsdPathElement* parent, std::string_view name,
                                std::string_view choice, bool isChoice);

private:
    struct Key {
        std::size_t hash; // computed once, and compared first
        const UsdPathElement* parent;
        std::string_view name, choice;
        bool isChoice;
        bool operator==(const Key&) const = default;
    };
    struct Hash {
        std::size_t operator()(const Key& key) const { return key.hash; }
    };
    static Key keyOf(const UsdPathElement* parent, std::string_view name, std::string_view choice,
                     bool isChoice);
    std::deque<UsdPathElement> elements_; // never move
    std::unordered_map<Key, const UsdPathElement*, Hash> children_;
};

} // namespace penumbra

template <>
struct std::hash<penumbra::UsdSitePath> {
    std::size_t operator()(penumbra::UsdSitePath path) const { return path.id(); }
};
