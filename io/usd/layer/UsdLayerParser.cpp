// The prims of a layer: def, over, class, variantSet and what they contain.
#include "io/usd/layer/UsdLayer.h"

#include "io/usd/layer/UsdMetadataParser.h"
#include "io/usd/layer/UsdNameIndex.h"
#include "io/usd/layer/UsdPath.h"
#include "io/usd/layer/UsdPropertyParser.h"
#include "io/usd/layer/UsdText.h"
#include "io/usd/layer/UsdValueParser.h"

#include <charconv>
#include <iterator>

namespace penumbra {

namespace {

// An open brace: the body of a prim or variant, or the list of a variant set.
struct Frame {
    UsdPrimSpec* body = nullptr;  // null in a variant set
    UsdVariantSet* set = nullptr; // the set whose variants are listed
    bool isVariant = false;
    std::string path; // of the prim
    const char* open = nullptr;
    UsdNameIndex childIndex = {}, propertyIndex = {};
};

// The properties of each open brace, until it closes and their number is known: they then are one
// allocation of the right size. What was allocated here serves the next brace as deep.
class OpenProperties {
public:
    std::vector<UsdProperty>& at(std::size_t depth) {
        if (depth >= properties_.size()) properties_.resize(depth + 1);
        return properties_[depth];
    }
    void close(std::size_t depth, std::vector<UsdProperty>& into) {
        if (depth >= properties_.size()) return;
        std::vector<UsdProperty>& from = properties_[depth];
        into.reserve(from.size());
        std::move(from.begin(), from.end(), std::back_inserter(into));
        from.clear();
    }

private:
    std::vector<std::vector<UsdProperty>> properties_;
};

class LayerParser {
public:
    LayerParser(std::string_view text, const std::string& file, const UsdLayerLimits& limits)
        : in_(text, file), limits_(limits) {
        layer_.file = file;
    }

    UsdLayer parse() {
        header();
        in_.skipSpace();
        if (in_.peek() == '(') parseLayerMetadata(in_, layer_);
        while (true) {
            in_.skipSpace();
            if (stack_.empty() && in_.atEnd()) break;
            step();
        }
        layer_.diagnostics = diagnostics_.take();
        return std::move(layer_);
    }

private:
    // "#usda 1.0", at the first byte.
    void header() {
        in_.moveTo(in_.cursor() + 5); // "#usda": the caller has checked
        const char* begin = in_.cursor();
        while (in_.peek() == ' ' || in_.peek() == '\t') in_.advance();
        const char* digits = in_.cursor();
        while (!in_.atEnd() && in_.peek() != '\n') in_.advance();
        int major = 0;
        const auto first = std::from_chars(digits, in_.cursor(), major);
        if (digits == begin || first.ec != std::errc{} || *first.ptr != '.')
            in_.failAt(begin, "expected a version, as in '#usda 1.0'");
        const auto second = std::from_chars(first.ptr + 1, in_.cursor(), formatMinor_);
        if (second.ec != std::errc{} || major != 1)
            in_.failAt(digits, "USD text version " + std::string(digits, second.ptr) +
                                   " is not supported (this program reads 1.0 and 1.1)");
        if (formatMinor_ > 1)
            diagnostics_.warn(in_.location(digits), "USD text version 1." +
                                                        std::to_string(formatMinor_) +
                                                        " is newer than this program");
    }

    // One thing in the innermost open brace.
    void step() {
        if (in_.atEnd()) unclosed();
        if (in_.peek() == '}') {
            close();
            return;
        }
        if (!stack_.empty() && stack_.back().set) {
            variant();
            return;
        }
        const std::string_view word = in_.peekIdentifier();
        if (word == "def" || word == "over" || word == "class")
            prim(word);
        else if (word == "reorder" && reorder())
            return;
        else if (stack_.empty())
            in_.fail("expected 'def', 'over' or 'class', found " + in_.found());
        else if (word == "variantSet")
            variantSet();
        else
            property();
    }

    [[noreturn]] void unclosed() {
        const Frame& frame = stack_.back();
        const std::size_t line = in_.position(frame.open).line;
        in_.fail("the file ends, but the '{' of line " + std::to_string(line) + " (<" + frame.path +
                 ">) is not closed");
    }

    void close() {
        if (stack_.empty()) in_.fail("this '}' closes nothing");
        in_.advance();
        const bool isPrim = stack_.back().body && !stack_.back().isVariant;
        const Frame& frame = stack_.back();
        if (frame.set && frame.set->variants.empty()) in_.fail("a variant set without variants");
        if (frame.body) properties_.close(stack_.size(), frame.body->properties);
        stack_.pop_back();
        in_.skipBlanks();
        const bool lineEnds = in_.atEnd() || in_.peek() == '\n' || in_.peek() == '\r';
        if (isPrim && !lineEnds)
            in_.fail("expected a newline after a prim's '}', found " + in_.found());
    }

    void prim(std::string_view keyword) {
        const UsdPosition where = in_.position(in_.cursor());
        in_.identifier();
        in_.expectBlankAfter(keyword);
        in_.skipBlanks();
        UsdPrimSpec spec;
        spec.specifier = keyword == "def"    ? UsdSpecifier::def
                         : keyword == "over" ? UsdSpecifier::over
                                             : UsdSpecifier::classes;
        spec.where = where;
        spec.typeName = in_.typeName();
        in_.skipBlanks();
        spec.name = primName();
        const std::string path = usdChildPath(stack_.empty() ? "/" : stack_.back().path, spec.name);
        auto& siblings = stack_.empty() ? layer_.prims : stack_.back().body->children;
        UsdNameIndex& index = stack_.empty() ? rootIndex_ : stack_.back().childIndex;
        if (index.find(siblings, spec.name) != UsdNameIndex::kNone)
            throw SceneFileError({in_.file(), where.line, where.column},
                                 "a second prim <" + path + ">");
        if (++primCount_ > limits_.prims) in_.fail("too many prims");
        if (stack_.size() >= limits_.primDepth) in_.fail("prims nested too deeply");
        in_.skipSpace();
        if (in_.peek() == '(') parsePrimMetadata(in_, spec, path);
        in_.skipSpace();
        const char* open = in_.cursor();
        in_.expect('{', "to begin the prim's contents");
        siblings.push_back(std::move(spec));
        stack_.push_back({&siblings.back(), nullptr, false, path, open});
    }

    std::string primName() {
        if (!in_.atString()) in_.fail("expected the prim's name in quotes, found " + in_.found());
        const char* where = in_.cursor();
        std::string name = in_.string();
        if (!isUsdIdentifier(name))
            in_.failAt(where, "'" + printable(name) +
                                  "' can't be a prim's name (letters, digits and _ only)");
        return name;
    }

    void property() {
        Frame& frame = stack_.back();
        parseUsdProperty(in_, {properties_.at(stack_.size()), frame.propertyIndex}, frame.path,
                         formatMinor_, diagnostics_);
        endStatement();
    }

    void endStatement() {
        if (in_.skipSeparators() || in_.atEnd()) return;
        in_.fail("expected a newline or ';', found " + in_.found());
    }

    // `reorder rootPrims|nameChildren|properties = [...]`: kept as metadata. False: it is another
    // statement.
    bool reorder() {
        const char* begin = in_.cursor();
        in_.identifier();
        in_.skipBlanks();
        const std::string what(in_.identifier());
        const bool known =
            stack_.empty() ? what == "rootPrims" : what == "nameChildren" || what == "properties";
        in_.skipBlanks();
        if (!known || in_.peek() != '=') {
            in_.moveTo(begin);
            return false;
        }
        in_.advance();
        in_.skipBlanks();
        auto& metadata = stack_.empty() ? layer_.metadata : stack_.back().body->metadata;
        const UsdType names{UsdKind::string, 1, 1, true};
        assign(metadata, {"reorder " + what, {}, parseUsdValue(in_, names)});
        endStatement();
        return true;
    }

    // `variantSet "name" = {`
    void variantSet() {
        in_.identifier();
        in_.expectBlankAfter("variantSet");
        in_.skipBlanks();
        if (!in_.atString())
            in_.fail("expected the variant set's name in quotes, found " + in_.found());
        const std::string name = in_.string();
        if (name.empty()) in_.fail("a variant set needs a name");
        in_.skipBlanks();
        in_.expect('=', "after the variant set's name");
        in_.skipSpace();
        const char* open = in_.cursor();
        in_.expect('{', "to begin the variants");
        if (stack_.size() >= limits_.primDepth) in_.fail("variant sets nested too deeply");
        auto& sets = stack_.back().body->variantSets;
        sets.push_back({name, {}});
        stack_.push_back({nullptr, &sets.back(), false, stack_.back().path, open});
    }

    // `"name" (metadata) {`
    void variant() {
        if (!in_.atString())
            in_.fail("expected a variant's name in quotes or '}', found " + in_.found());
        if (stack_.size() >= limits_.primDepth) in_.fail("variants nested too deeply");
        if (++primCount_ > limits_.prims) in_.fail("too many variants");
        UsdPrimSpec spec;
        spec.specifier = UsdSpecifier::over;
        spec.where = in_.position(in_.cursor());
        spec.name = in_.string();
        if (spec.name.empty()) in_.fail("a variant needs a name");
        in_.skipSpace();
        if (in_.peek() == '(') parsePrimMetadata(in_, spec, stack_.back().path);
        in_.skipSpace();
        const char* open = in_.cursor();
        in_.expect('{', "to begin the variant's contents");
        auto& variants = stack_.back().set->variants;
        variants.push_back(std::move(spec));
        stack_.push_back({&variants.back(), nullptr, true, stack_.back().path, open});
    }

    UsdScanner in_;
    UsdLayerLimits limits_;
    UsdLayer layer_;
    Diagnostics diagnostics_;
    int formatMinor_ = 0;
    std::size_t primCount_ = 0;
    std::vector<Frame> stack_;
    OpenProperties properties_; // by the size of stack_
    UsdNameIndex rootIndex_;
};

} // namespace

UsdLayer parseUsdLayer(const std::string& text, const std::string& file,
                       const UsdLayerLimits& limits) {
    checkUsdText(text, file);
    return LayerParser(text, file, limits).parse();
}

} // namespace penumbra
