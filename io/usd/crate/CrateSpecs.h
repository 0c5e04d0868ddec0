// Which paths of a crate file have specs, and which of them lie below others.
#pragma once

#include "io/usd/crate/CrateFile.h"
#include "io/usd/layer/UsdDiagnostic.h"

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace penumbra {

/// Collects what is left out of a layer. So many faults that they can't be an accident refuse the
/// file: each takes time.
class CrateWarnings {
public:
    explicit CrateWarnings(std::string file) : file_(std::move(file)) {}
    void warn(const std::string& text) {
        if (++count_ > kMost) throw CrateRefused(0, "more than 10000 faults");
        const bool tooLong = text.size() > kLongest;
        diagnostics_.warn({file_, 0, 0}, tooLong ? text.substr(0, kLongest) + "..." : text);
    }
    std::vector<Diagnostic> take() { return diagnostics_.take(); }

private:
    static constexpr std::size_t kMost = 10'000;
    static constexpr std::size_t kLongest = 1000; // of one text
    std::string file_;
    Diagnostics diagnostics_;
    std::size_t count_ = 0;
};

/// What a spec is of. The other forms that there are (2 to 5, 9) are no longer written.
enum class CrateForm : std::uint32_t {
    attribute = 1,
    prim = 6,
    pseudoRoot = 7,
    relationship = 8,
    variant = 10,
    variantSet = 11,
};

/// One spec a path; specs without a path, without fields or of an unknown form are left out.
class CrateSpecs {
public:
    CrateSpecs(const CrateFile& file, CrateWarnings& warnings);

    /// Null if there is none.
    const CrateSpec* at(std::uint32_t path) const {
        return specOf_[path] == kNone ? nullptr : &file_.tables.specs[specOf_[path]];
    }

    /// Paths below `parent` that a list of names (tokens) means, in its order. A name is left out
    /// if there is no spec of that form, or if it is in the list twice.
    std::vector<std::uint32_t> prims(const std::vector<std::uint32_t>& names, std::uint32_t parent);
    std::vector<std::uint32_t> properties(const std::vector<std::uint32_t>& names,
                                          std::uint32_t parent);
    /// A variant of a set, or the set itself for an empty choice.
    /// \return CratePaths::kNone if it is not there, or was asked for before
    std::uint32_t variant(std::uint32_t parent, std::string_view set, std::string_view choice);

private:
    static constexpr std::uint32_t kNone = CratePaths::kNone;
    bool is(std::uint32_t path, CrateForm form) const;
    std::vector<std::uint32_t> children(const std::vector<std::uint32_t>& names,
                                        std::uint32_t parent, CratePaths::Kind kind);
    void missing(std::string_view name, std::uint32_t parent);

    const CrateFile& file_;
    CrateWarnings& warnings_;
    std::vector<std::uint32_t> specOf_;                                 ///< by path
    std::unordered_map<std::string_view, std::uint32_t> variantTokens_; ///< `{set=choice}`
    std::vector<bool> taken_;                                           ///< by path, of variants
};

} // namespace penumbra
