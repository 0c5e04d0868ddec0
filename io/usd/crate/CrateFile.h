// A crate file that is being read: its bytes, its tables, and what may still be made of it.
#pragma once

#include "io/usd/crate/CrateTables.h"
#include "io/usd/text/UsdValueText.h"

#include <string>

namespace penumbra {

struct CrateFile {
    std::span<const std::byte> bytes;
    CrateBudget budget;
    CrateTables tables;

    /// Throws CrateFault if the bytes are no crate file.
    explicit CrateFile(std::span<const std::byte> file)
        : bytes(file), budget(file.size()), tables(readCrateTables(file, budget)) {}

    CrateBytes at(std::uint64_t byte) const {
        CrateBytes in(bytes);
        in.moveTo(byte);
        return in;
    }

    /// Texts by index. `byte` is where the index was found.
    std::string_view token(std::uint32_t index, std::uint64_t byte) const {
        if (index >= tables.tokens.size()) throw CrateFault(byte, "a token that is not there");
        return tables.tokens[index];
    }
    std::string_view string(std::uint32_t index, std::uint64_t byte) const {
        if (index >= tables.strings.size()) throw CrateFault(byte, "a string that is not there");
        return tables.tokens[tables.strings[index]];
    }
    /// A text that will be copied: long ones take more of the budget.
    std::string copied(std::string_view text, std::uint64_t byte) {
        budget.spend(CrateBudget::kText + text.size() / 16, byte);
        return std::string(text);
    }
    /// The asset path of a layer: one that text can hold.
    std::string layerAsset(std::uint32_t index, std::uint64_t byte) {
        const std::string_view text = string(index, byte);
        if (!isUsdAssetPath(text)) throw CrateFault(byte, "an impossible asset path");
        return copied(text, byte);
    }
    /// Empty for the empty path.
    std::string path(std::uint32_t index, std::uint64_t byte) {
        if (index >= tables.paths.size()) throw CrateFault(byte, "a path that is not there");
        const CratePaths::Node& node = tables.paths[index];
        budget.spend(CrateBudget::kText + node.depth + node.length / 16, byte);
        return tables.paths.text(index, tables.tokens);
    }
};

} // namespace penumbra
