// The tables of a crate file: what its values and specs refer to by index.
#pragma once

#include "io/usd/crate/CrateBytes.h"
#include "io/usd/crate/CrateCompression.h"
#include "io/usd/crate/CratePaths.h"
#include "io/usd/crate/CrateRep.h"

#include <string_view>
#include <vector>

namespace penumbra {

struct CrateField {
    std::uint32_t name = 0; ///< a token
    CrateRep value;
};

struct CrateSpec {
    std::uint32_t path = 0;
    std::uint32_t fieldSet = 0; ///< index of its first entry in CrateTables::fieldSets
    std::uint32_t form = 0;
};

inline constexpr std::uint32_t kEndOfFieldSet = 0xffff'ffff;

/// Indices within the tables are checked: tokens of strings, fields and paths, fields of sets. What
/// specs refer to is not.
struct CrateTables {
    CrateVersion version;
    CrateBuffer tokenBytes;
    std::vector<std::string_view> tokens; ///< valid UTF-8: other bytes became '?'
    std::vector<std::uint32_t> strings;   ///< token of each
    std::vector<CrateField> fields;
    std::vector<std::uint32_t> fieldSets; ///< field indices; each set is ended by kEndOfFieldSet
    CratePaths paths;
    std::vector<CrateSpec> specs;
    bool badText = false; ///< some token was not UTF-8
};

/// Reads header, contents and sections. Throws CrateFault.
CrateTables readCrateTables(std::span<const std::byte> file, CrateBudget& budget);

} // namespace penumbra
