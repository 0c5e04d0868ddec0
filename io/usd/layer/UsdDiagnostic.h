// What a reader has to say about a file that it could read all the same.
#pragma once

#include "base/Error.h"

#include <cstddef>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace penumbra {

/// One warning. Repeats of one text are counted and keep the position of the first.
struct Diagnostic {
    SourceLocation where;
    std::string text;
    std::size_t count = 1;

    /// `file:line:column: warning: text`, with ` (N times)` if repeated.
    std::string line() const;
};

/// Collects warnings, merging those whose text is equal. Keeps at most kMaxTexts different ones, so
/// that a hostile file can't fill the memory with complaints; the rest share one entry.
class Diagnostics {
public:
    void warn(const SourceLocation& where, const std::string& text, std::size_t count = 1);
    void append(const std::vector<Diagnostic>& others);
    const std::vector<Diagnostic>& list() const { return list_; }
    std::vector<Diagnostic> take() {
        indexOf_.clear();
        return std::exchange(list_, {});
    }

    static constexpr std::size_t kMaxTexts = 1000;

private:
    std::vector<Diagnostic> list_;
    std::unordered_map<std::string, std::size_t> indexOf_;
};

/// One line for people, e.g. `5 warnings: 3 x missing file 'a.usda'; 2 x ...`: three are quoted,
/// first what is left out of the scene, then the commonest; empty if there is nothing to say.
std::string summary(const std::vector<Diagnostic>& diagnostics);

} // namespace penumbra
