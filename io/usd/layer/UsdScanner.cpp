#include "io/usd/layer/UsdScanner.h"

#include "io/usd/layer/UsdPath.h"
#include "io/usd/layer/UsdText.h"

#include <algorithm>
#include <cstring>

namespace penumbra {

namespace {

constexpr std::size_t kMaxRawDepth = 64; // brackets within brackets of a value we don't know

} // namespace

UsdScanner::UsdScanner(std::string_view text, std::string file)
    : file_(std::move(file)), begin_(text.data()), end_(text.data() + text.size()),
      cursor_(text.data()), lineStart_(text.data()) {}

void UsdScanner::failAt(const char* where, const std::string& problem) const {
    throw SceneFileError(location(where), problem);
}

SourceLocation UsdScanner::location(const char* where) const {
    const UsdPosition p = position(where);
    return {file_, p.line, p.column};
}

UsdPosition UsdScanner::position(const char* where) const {
    if (where < lineStart_) {
        lineStart_ = begin_;
        line_ = 1;
    }
    while (const void* newline = std::memchr(lineStart_, '\n', std::size_t(where - lineStart_))) {
        lineStart_ = static_cast<const char*>(newline) + 1;
        ++line_;
    }
    return {line_, std::uint32_t(where - lineStart_) + 1};
}

std::string UsdScanner::found() const {
    if (atEnd()) return "the end of the file";
    if (*cursor_ == '\n' || *cursor_ == '\r') return "the end of the line";
    const std::string_view word = peekIdentifier();
    constexpr std::size_t kLongest = 40;
    if (word.size() > kLongest) return "'" + std::string(word.substr(0, kLongest)) + "...'";
    return "'" + (word.empty() ? std::string(1, *cursor_) : std::string(word)) + "'";
}

void UsdScanner::expect(char c, std::string_view purpose) {
    if (take(c)) return;
    fail("expected '" + std::string(1, c) + "' " + std::string(purpose) + ", found " + found());
}

void UsdScanner::skipBlockComment() {
    const char* close = std::strstr(cursor_ + 2, "*/");
    if (!close) fail("this comment is not closed by '*/'");
    cursor_ = close + 2;
}

void UsdScanner::skipComment() {
    const std::size_t rest = std::size_t(end_ - cursor_);
    const void* newline = std::memchr(cursor_, '\n', rest);
    cursor_ = newline ? static_cast<const char*>(newline) : end_;
}

void UsdScanner::skipBlanks() {
    while (true) {
        if (*cursor_ == ' ' || *cursor_ == '\t')
            ++cursor_;
        else if (*cursor_ == '#' || (*cursor_ == '/' && cursor_[1] == '/'))
            skipComment();
        else if (*cursor_ == '/' && cursor_[1] == '*')
            skipBlockComment();
        else
            return;
    }
}

bool UsdScanner::skipSpace() {
    bool newline = false;
    while (true) {
        skipBlanks();
        if (*cursor_ != '\n' && *cursor_ != '\r') return newline;
        newline = true;
        ++cursor_;
    }
}

bool UsdScanner::skipSeparators() {
    bool separated = skipSpace();
    while (take(';')) {
        separated = true;
        skipSpace();
    }
    return separated;
}

void UsdScanner::expectBlankAfter(std::string_view keyword) {
    if (*cursor_ == ' ' || *cursor_ == '\t' || *cursor_ == '\n' || *cursor_ == '\r') return;
    fail("expected a blank after '" + std::string(keyword) + "', found " + found());
}

std::string_view UsdScanner::peekIdentifier() const {
    const char* p = cursor_;
    if (isUsdIdentifierStart(*p))
        while (isUsdIdentifierPart(*p)) ++p;
    return {cursor_, std::size_t(p - cursor_)};
}

std::string_view UsdScanner::identifier() {
    const std::string_view word = peekIdentifier();
    cursor_ += word.size();
    return word;
}

std::string_view UsdScanner::propertyName() {
    const char* begin = cursor_;
    if (identifier().empty()) return {};
    while (take(':'))
        if (identifier().empty()) fail("expected a name after ':', found " + found());
    return {begin, std::size_t(cursor_ - begin)};
}

std::string_view UsdScanner::typeName() {
    const char* begin = cursor_;
    if (identifier().empty()) return {};
    while (*cursor_ == '.' || (*cursor_ == ':' && cursor_[1] == ':')) {
        cursor_ += *cursor_ == '.' ? 1 : 2;
        if (identifier().empty()) fail("malformed type name");
    }
    return {begin, std::size_t(cursor_ - begin)};
}

std::string UsdScanner::string() {
    const char quote = *cursor_;
    const bool isLong = cursor_[1] == quote && cursor_[2] == quote;
    cursor_ += isLong ? 3 : 1;
    std::string text = isLong ? longString(quote) : shortString(quote);
    if (const std::size_t nul = text.find('\0'); nul != std::string::npos)
        text.resize(nul); // as OpenUSD
    replaceBadUtf8(text); // escapes can make any byte
    return text;
}

std::string UsdScanner::shortString(char quote) {
    const char* open = cursor_ - 1;
    std::string text;
    while (true) {
        const char* run = cursor_;
        while (*cursor_ != quote && *cursor_ != '\\' && *cursor_ != '\n' && !atEnd()) ++cursor_;
        text.append(run, cursor_);
        if (take(quote)) return text;
        if (*cursor_ != '\\' || cursor_[1] == '\n') failAt(open, "this string is not closed");
        appendEscape(text);
    }
}

std::string UsdScanner::longString(char quote) {
    const char* open = cursor_ - 3;
    std::string text;
    while (true) {
        const char* run = cursor_;
        while (*cursor_ != quote && *cursor_ != '\\' && !atEnd()) ++cursor_;
        text.append(run, cursor_);
        if (atEnd()) failAt(open, "this string is not closed by three quotes");
        if (*cursor_ == '\\') {
            appendEscape(text);
        } else if (cursor_[1] == quote && cursor_[2] == quote) {
            cursor_ += 3;
            if (*cursor_ == quote) fail(std::string("a fourth quote; write \\").append(1, quote));
            return text;
        } else {
            text += *cursor_++;
        }
    }
}

namespace {

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}
bool isOctal(char c) {
    return c >= '0' && c <= '7';
}

} // namespace

// At a backslash: appends what the escape means. An unknown one is the character itself.
void UsdScanner::appendEscape(std::string& text) {
    ++cursor_;
    constexpr std::string_view kLetters = "ntrabfv";
    constexpr std::string_view kMeanings = "\n\t\r\a\b\f\v";
    int code = 0;
    if (*cursor_ == 'x' && hexDigit(cursor_[1]) >= 0) {
        ++cursor_;
        for (int i = 0; i < 2 && hexDigit(*cursor_) >= 0; ++i)
            code = code * 16 + hexDigit(*cursor_++);
        text += char(code);
    } else if (isOctal(*cursor_)) {
        for (int i = 0; i < 3 && isOctal(*cursor_); ++i) code = code * 8 + (*cursor_++ - '0');
        text += char(code & 0xff);
    } else if (const auto at = kLetters.find(*cursor_); at != std::string_view::npos && !atEnd()) {
        text += kMeanings[at];
        ++cursor_;
    } else if (!atEnd()) {
        text += *cursor_++;
    }
}

std::string UsdScanner::asset() {
    const char* open = cursor_;
    if (cursor_[1] == '@' && cursor_[2] == '@') return longAsset(open);
    const char* p = open + 1;
    while (*p != '@' && *p != '\n' && p != end_) ++p;
    if (*p != '@') failAt(open, "this asset path is not closed by '@'");
    cursor_ = p + 1;
    return checkedAsset({open + 1, p}, open);
}

// Up to two @ may come right before the closing three; `\@@@` is three @ of the path itself.
std::string UsdScanner::longAsset(const char* open) {
    std::string text;
    const char* p = open + 3;
    while (p != end_ && *p != '\n') {
        if (std::strncmp(p, "\\@@@", 4) == 0) {
            text += "@@@";
            p += 4;
        } else if (std::strncmp(p, "@@@", 3) == 0) {
            for (int i = 0; i < 2 && p[3] == '@'; ++i) text += *p++;
            cursor_ = p + 3;
            return checkedAsset(std::move(text), open);
        } else {
            text += *p++;
        }
    }
    failAt(open, "this asset path is not closed by '@@@'");
}

std::string UsdScanner::checkedAsset(std::string path, const char* open) const {
    if (std::any_of(path.begin(), path.end(),
                    [](char c) { return static_cast<unsigned char>(c) < 0x20; }))
        failAt(open, "there is a control character in this asset path");
    return path;
}

std::string_view UsdScanner::path() {
    const char* open = cursor_;
    const char* p = open + 1;
    while (*p != '>' && *p != '\n' && p != end_) ++p;
    if (*p != '>') failAt(open, "this path is not closed by '>'");
    cursor_ = p + 1;
    return {open + 1, std::size_t(p - open - 1)};
}

UsdNumber UsdScanner::number() {
    UsdNumber result;
    const char* after = scanUsdNumber(cursor_, result);
    if (!after) fail("expected a number, found " + found());
    if (isUsdIdentifierPart(*after) || *after == '.' || *after == '+') fail("malformed number");
    cursor_ = after;
    return result;
}

std::string_view UsdScanner::rawValue() {
    const char* begin = cursor_;
    const auto isWord = [](char c) {
        return isUsdIdentifierPart(c) || c == '.' || c == '-' || c == '+' || c == ':';
    };
    if (*cursor_ == '(' || *cursor_ == '[' || *cursor_ == '{')
        skipGroup();
    else if (atString())
        string();
    else if (*cursor_ == '@')
        asset();
    else if (*cursor_ == '<')
        path();
    else
        while (isWord(*cursor_)) ++cursor_;
    if (cursor_ == begin) fail("expected a value, found " + found());
    if (*begin == '@' && *cursor_ == '<') path(); // a reference
    return {begin, std::size_t(cursor_ - begin)};
}

void UsdScanner::skipGroup() {
    const char* open = cursor_;
    std::string closers;
    do {
        skipSpace();
        const char c = *cursor_;
        if (atEnd()) failAt(open, "this '" + std::string(1, *open) + "' is not closed");
        if (c == '(' || c == '[' || c == '{') {
            if (closers.size() == kMaxRawDepth) fail("brackets nested too deeply");
            closers += c == '(' ? ')' : c == '[' ? ']' : '}';
        } else if (c == closers.back()) {
            closers.pop_back();
        } else if (c == ')' || c == ']' || c == '}') {
            fail("expected '" + closers.substr(closers.size() - 1) + "', found " + found());
        } else if (atString()) {
            string();
            continue;
        } else if (c == '@') {
            asset();
            continue;
        }
        ++cursor_;
    } while (!closers.empty());
}

} // namespace penumbra
