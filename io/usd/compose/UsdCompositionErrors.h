// What went wrong while composing: said, and gone on from.
#pragma once

#include "io/usd/layer/UsdDiagnostic.h"

#include <string>
#include <unordered_set>
#include <vector>

namespace penumbra {

/// Collects errors. Each is a warning for people, and keeps the prim that was being composed. What
/// is said again of a prim, because it is composed again, is left out.
class UsdCompositionErrors {
public:
    struct Error {
        std::string prim; ///< empty: the root layer stack
        std::string text; ///< with its place
    };

    explicit UsdCompositionErrors(Diagnostics& diagnostics) : diagnostics_(&diagnostics) {}
    void setPrim(std::string path) { prim_ = std::move(path); }
    void report(const SourceLocation& where, const std::string& text) {
        std::string line = where.text() + ": " + text;
        if (!known_.contains(prim_ + "\n" + line)) {
            diagnostics_->warn(where, text);
            if (list_.size() >= kMost) return;
            known_.insert(prim_ + "\n" + line);
            list_.push_back({prim_, std::move(line)});
        }
    }
    /// Something that isn't an error of the composition.
    void append(const std::vector<Diagnostic>& others) { diagnostics_->append(others); }
    const std::vector<Error>& list() const { return list_; }

    static constexpr std::size_t kMost = 10'000;

private:
    Diagnostics* diagnostics_;
    std::string prim_;
    std::vector<Error> list_;
    std::unordered_set<std::string> known_; // prim and text of those in the list
};

} // namespace penumbra
