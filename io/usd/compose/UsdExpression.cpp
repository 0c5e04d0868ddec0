#include "io/usd/compose/UsdExpression.h"

#include "io/usd/compose/UsdExpressionValue.h"
#include "io/usd/layer/UsdPath.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <variant>
#include <vector>

namespace penumbra {

namespace {

constexpr int kMaxDepth = 32; // of brackets, and of variables whose values are expressions

using Value = UsdExpressionValue;
using Scalar = UsdExpressionScalar;

// Evaluates while it parses; what isn't taken (`taken` is false) is only checked for its form.
class Evaluator {
public:
    Evaluator(std::string_view text, const UsdDictionary& variables, int depth)
        : text_(text), variables_(variables), depth_(depth) {}

    Value whole() {
        Value value = expression(true);
        skip();
        if (at_ != text_.size()) fail("unexpected '" + std::string(1, text_[at_]) + "'");
        return value;
    }

private:
    [[noreturn]] static void fail(const std::string& why) { throw UsdExpressionFault(why); }

    void skip() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
    }
    char peek() {
        skip();
        return at_ < text_.size() ? text_[at_] : '\0';
    }
    bool take(char c) {
        if (peek() != c) return false;
        ++at_;
        return true;
    }
    void expect(char c) {
        if (!take(c)) fail(std::string("expected '") + c + "'");
    }
    std::string identifier() {
        const std::size_t begin = at_;
        while (at_ < text_.size() && isUsdIdentifierPart(text_[at_])) ++at_;
        return std::string(text_.substr(begin, at_ - begin));
    }

    Value expression(bool taken) {
        if (++depth_ > kMaxDepth) fail("nested too deeply");
        Value value = unnested(taken);
        --depth_;
        return value;
    }

    Value unnested(bool taken) {
        const char c = peek();
        if (c == '"' || c == '\'') return {string(taken), {}, false};
        if (c == '[') return list(taken);
        if (c == '$') return variable(taken);
        if (c == '-' || (c >= '0' && c <= '9')) return number();
        const std::string word = identifier();
        if (word == "True" || word == "true") return {true, {}, false};
        if (word == "False" || word == "false") return {false, {}, false};
        if (word == "None" || word == "none") return {};
        if (word.empty()) fail("expected a value");
        expect('(');
        return function(word, taken);
    }

    Value number() {
        std::int64_t n = 0;
        const char* begin = text_.data() + at_;
        const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), n);
        if (error != std::errc()) fail("a number out of range");
        at_ += std::size_t(end - begin);
        return {n, {}, false};
    }

    std::string name() {
        expect('$');
        if (at_ >= text_.size() || text_[at_] != '{') fail("expected '{' after '$'");
        ++at_;
        std::string name = identifier();
        if (at_ >= text_.size() || text_[at_] != '}' || name.empty())
            fail("a variable that is not closed");
        ++at_;
        return name;
    }

    Value variable(bool taken) {
        const std::string named = name();
        return taken ? valueOf(named) : Value{};
    }

    Value valueOf(const std::string& name) {
        const UsdValue* stored = find(variables_, name);
        if (!stored) fail("no variable '" + name + "'");
        Value value;
        value.isList = stored->type.array;
        std::vector<Scalar> found;
        if (const auto* texts = stored->as<std::string>())
            for (const std::string& text : *texts) found.emplace_back(text);
        else
            for (const double n : stored->numbers()) {
                if (stored->type.kind == UsdKind::boolean)
                    found.emplace_back(n != 0);
                else
                    found.emplace_back(std::int64_t(n));
            }
        if (value.isList)
            value.list = std::move(found);
        else if (!found.empty())
            value.scalar = std::move(found.front());
        const std::string* text = value.isList ? nullptr : stored->text();
        if (!text || !isUsdExpression(*text) || text->size() < 2) return value;
        const std::string inner = text->substr(1, text->size() - 2); // between the backticks
        return Evaluator(inner, variables_, depth_ + 1).whole();
    }

    std::string string(bool taken) {
        const char quote = text_[at_++];
        std::string result;
        while (at_ < text_.size() && text_[at_] != quote) {
            if (text_[at_] == '\\' && at_ + 1 < text_.size()) {
                result += text_[at_ + 1];
                at_ += 2;
            } else if (text_.substr(at_, 2) == "${") {
                const Value value = variable(taken);
                const auto* text = std::get_if<std::string>(&value.scalar);
                if (taken && (!text || value.isList)) fail("a variable in a string is no string");
                if (text) result += *text;
            } else {
                result += text_[at_++];
            }
        }
        if (at_ >= text_.size()) fail("a string that is not closed");
        ++at_;
        return result;
    }

    Value list(bool taken) {
        expect('[');
        Value value;
        value.isList = true;
        while (!take(']')) {
            Value item = expression(taken);
            if (item.isList) fail("a list in a list");
            value.list.push_back(std::move(item.scalar));
            if (peek() != ']') expect(',');
        }
        return value;
    }

    // Arguments after '('; `ask` says before each whether it is to be evaluated.
    template <class Ask>
    std::vector<Value> arguments(Ask ask) {
        std::vector<Value> values;
        while (!take(')')) {
            values.push_back(expression(ask(values)));
            if (peek() != ')') expect(',');
        }
        return values;
    }

    Value defined() {
        bool all = true;
        while (!take(')')) {
            std::string named = peek() == '$' ? name() : identifier();
            if (peek() == '"' || peek() == '\'') named = string(false);
            if (named.empty()) fail("expected the name of a variable");
            all = all && find(variables_, named);
            if (peek() != ')') expect(',');
        }
        return {all, {}, false};
    }

    Value function(const std::string& name, bool taken) {
        if (name == "defined") return defined();
        const auto values = arguments([&](const std::vector<Value>& before) {
            if (!taken) return false;
            if (name == "if" && before.size() == 1) return isTrue(before[0]);
            if (name == "if" && before.size() == 2) return !isTrue(before[0]);
            if (name == "and" || name == "or")
                return std::all_of(before.begin(), before.end(),
                                   [&](const Value& v) { return isTrue(v) == (name == "and"); });
            return true;
        });
        return callUsdFunction(name, values, taken);
    }

    std::string_view text_;
    const UsdDictionary& variables_;
    std::size_t at_ = 0;
    int depth_ = 0;
};

} // namespace

UsdEvaluated evaluateUsdText(const std::string& text, const UsdDictionary& variables) {
    if (!isUsdExpression(text)) return {text, {}};
    if (text.size() < 2 || text.back() != '`') return {{}, "the expression is not closed"};
    try {
        const Value value =
            Evaluator(std::string_view(text).substr(1, text.size() - 2), variables, 0).whole();
        if (const auto* found = std::get_if<std::string>(&value.scalar)) return {*found, {}};
        const bool none = !value.isList && std::holds_alternative<std::monostate>(value.scalar);
        return {{}, none ? "" : "its value is no string"};
    } catch (const UsdExpressionFault& fault) {
        return {{}, fault.what()};
    }
}

} // namespace penumbra
