// The one exception family of Penumbra: what went wrong outside (file, option, peer, disk,
// display).
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

namespace penumbra {

/// Base of all errors that are the outside world's fault. what() is one line: where, what, what to
/// do. Faults of our own are asserts, not exceptions.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// A place in a text file. Line and column count from 1; 0 means "the file as a whole".
struct SourceLocation {
    std::string file;
    std::size_t line = 0;
    std::size_t column = 0;

    /// `file:line:column`, or only what is known of it.
    std::string text() const {
        if (line == 0) return file;
        if (column == 0) return file + ":" + std::to_string(line);
        return file + ":" + std::to_string(line) + ":" + std::to_string(column);
    }
};

/// A scene file that can't be read. what(): `file:line:column: error: text`.
class SceneFileError : public Error {
public:
    SceneFileError(SourceLocation where, const std::string& text)
        : Error(where.text() + ": error: " + text), where_(std::move(where)) {}
    const SourceLocation& where() const { return where_; }

private:
    SourceLocation where_;
};

} // namespace penumbra
