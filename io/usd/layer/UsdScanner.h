// Tokens of the USD text format.
#pragma once

#include "base/Error.h"
#include "io/usd/layer/UsdNumber.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace penumbra {

/// A position in one file, small enough to be kept with every prim and property.
struct UsdPosition {
    std::uint32_t line = 0;   ///< from 1
    std::uint32_t column = 0; ///< from 1, in bytes
};

/// Walks over a text that lies in memory whole. The text is NUL-terminated and contains no other
/// NUL (the reader of the file sees to that), so a single character can be read without asking
/// whether the end is near. Errors are thrown as SceneFileError.
class UsdScanner {
public:
    /// \param text  must outlive the scanner; text.data()[text.size()] == 0
    /// \param file  the name that errors carry
    UsdScanner(std::string_view text, std::string file);

    [[noreturn]] void fail(const std::string& problem) const { failAt(cursor_, problem); }
    [[noreturn]] void failAt(const char* where, const std::string& problem) const;
    SourceLocation location(const char* where) const;
    /// Cheap if asked for in the order of the text: it goes on from the position asked for last.
    UsdPosition position(const char* where) const;
    const std::string& file() const { return file_; }

    const char* cursor() const { return cursor_; }
    void moveTo(const char* where) { cursor_ = where; }
    bool atEnd() const { return cursor_ == end_; }
    char peek() const { return *cursor_; }
    void advance() { ++cursor_; }
    /// Takes `c` if it is next.
    bool take(char c) {
        if (*cursor_ != c || atEnd()) return false;
        ++cursor_;
        return true;
    }
    /// Takes `c` or fails with `expected 'c' <purpose>, found ...`.
    void expect(char c, std::string_view purpose);
    /// What is at the cursor, for error texts: `'x'` or `the end of the file`.
    std::string found() const;

    /// Skips blanks and comments on this line (a block comment may span lines).
    void skipBlanks();
    /// Skips blanks, comments and newlines; returns whether there was a newline.
    bool skipSpace();
    /// Skips space and semicolons; returns whether there was a newline or a semicolon.
    bool skipSeparators();
    /// A keyword must be followed by at least one blank character before anything else.
    void expectBlankAfter(std::string_view keyword);

    /// The identifier at the cursor; empty if there is none.
    std::string_view identifier();
    /// Identifiers joined by single colons; fails if malformed, empty if there is none.
    std::string_view propertyName();
    /// `Mesh`, `ns::Type`, `a.b`; empty if there is none.
    std::string_view typeName();
    /// Reads the identifier at the cursor without taking it.
    std::string_view peekIdentifier() const;

    bool atString() const { return *cursor_ == '"' || *cursor_ == '\''; }
    /// A quoted string, single or triple, with its escapes resolved; what they make that is
    /// no UTF-8 is '?'.
    std::string string();
    /// `@path@` or `@@@path@@@`.
    std::string asset();
    /// The text between `<` and `>`.
    std::string_view path();
    /// A number; the character after it must not continue a word.
    UsdNumber number();
    /// Skips one value of unknown type: a word, number, string, asset, path or bracketed group.
    std::string_view rawValue();

private:
    void skipBlockComment();
    void skipComment();
    std::string shortString(char quote);
    std::string longString(char quote);
    std::string longAsset(const char* open);
    std::string checkedAsset(std::string path, const char* open) const;
    void appendEscape(std::string& text);
    void skipGroup();

    std::string file_;
    const char* begin_;
    const char* end_;
    const char* cursor_;

    // The position that was located last: [text offset of a line's start, its number].
    mutable const char* lineStart_;
    mutable std::uint32_t line_ = 1;
};

} // namespace penumbra
