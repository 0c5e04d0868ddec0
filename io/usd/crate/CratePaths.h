// The tree of a crate file's paths.
#pragma once

#include "io/usd/crate/CrateBytes.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra {

struct CrateVersion {
    std::uint8_t major = 0, minor = 0;
    bool atLeast(int other) const { return minor >= other; } ///< major is 0 in all of them
};

/// Paths by their index, each as its parent and its own element: the strings of a deep tree would
/// take the square of its depth.
class CratePaths {
public:
    /// invalid: an impossible name, or anything below one
    enum class Kind : std::uint8_t { empty, root, prim, property, variant, target, invalid };
    static constexpr std::uint32_t kNone = 0xffff'ffff;
    static constexpr std::uint32_t kMaxDepth = 1024;
    static constexpr std::uint32_t kMaxLength = 0xffff; ///< of the text; longer ones are invalid

    struct Node {
        std::uint32_t parent = kNone;
        std::uint32_t token = 0;  ///< of the element: `name`, `{set=choice}`, `[target]`
        std::uint32_t length = 0; ///< at most so many characters of text
        std::uint16_t depth = 0;
        Kind kind = Kind::empty; ///< entries that nothing fills stay the empty path
    };

    std::size_t size() const { return nodes_.size(); }
    const Node& operator[](std::uint32_t index) const { return nodes_[index]; }
    std::uint32_t root() const { return root_; } ///< kNone if the file has none

    /// Index of parent + element; kNone if the file has no such path.
    std::uint32_t child(std::uint32_t parent, Kind kind, std::uint32_t token) const;

    /// `/a/b.c`; variant selections are left out, as they are in targets. Empty for an empty or
    /// invalid path.
    std::string text(std::uint32_t index, std::span<const std::string_view> tokens) const;
    /// Whether the path goes through a variant.
    bool inVariant(std::uint32_t index) const;

    /// Reads the section of its own layout. `bytes` are the section's; before 0.4.0 records refer
    /// to each other by their offset in the file.
    static CratePaths read(CrateBytes section, CrateVersion version,
                           std::span<const std::string_view> tokens, CrateBudget& budget);

private:
    friend class CratePathReader;
    void index();

    std::vector<Node> nodes_;
    std::uint32_t root_ = kNone;
    // Children by parent, sorted by kind and token: those of i are [begin_[i], begin_[i + 1]).
    std::vector<std::uint32_t> begin_, children_;
};

} // namespace penumbra
