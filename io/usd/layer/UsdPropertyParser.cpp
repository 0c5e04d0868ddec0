#include "io/usd/layer/UsdPropertyParser.h"

#include "io/usd/layer/UsdMetadataParser.h"
#include "io/usd/layer/UsdValueParser.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

namespace {

// The words before a property's name.
struct Declaration {
    std::optional<UsdListOp> op;
    bool custom = false;
    bool uniform = false;
    bool varying = false;
    bool relationship = false;
    std::string typeName;
    UsdType type;
    UsdPosition where;
};

// The words before a declaration's type, each followed by a blank. The word at the cursor is read
// once: most declarations have none of these.
class Keywords {
public:
    explicit Keywords(UsdScanner& in) : in_(in), word_(in.peekIdentifier()) {}
    std::string_view word() const { return word_; }
    bool take(std::string_view keyword) {
        if (word_ != keyword) return false;
        in_.identifier();
        in_.expectBlankAfter(keyword);
        in_.skipBlanks();
        word_ = in_.peekIdentifier();
        return true;
    }

private:
    UsdScanner& in_;
    std::string_view word_; // at the cursor
};

Declaration parseDeclaration(UsdScanner& in) {
    Declaration d;
    d.where = in.position(in.cursor());
    Keywords keywords(in);
    if (const auto op = usdListOpNamed(keywords.word())) {
        d.op = op;
        keywords.take(keywords.word());
    }
    d.custom = keywords.take("custom");
    d.varying = keywords.take("varying");
    if (!d.varying) d.uniform = keywords.take("uniform") || keywords.take("config");
    d.relationship = keywords.take("rel");
    if (d.varying && !d.relationship) in.fail("'varying' is for relationships only");
    if (d.relationship && d.uniform) in.fail("a relationship can't be uniform");
    if (d.relationship) return d;
    d.typeName = in.identifier();
    if (d.typeName.empty()) in.fail("expected a property, a prim or '}', found " + in.found());
    d.type = usdTypeNamed(d.typeName);
    in.skipBlanks();
    if (in.take('[')) {
        in.skipBlanks();
        in.expect(']', "after '[' of an array type");
        d.type.array = true;
        in.skipBlanks();
    }
    return d;
}

class PropertyParser {
public:
    PropertyParser(UsdScanner& in, const UsdPropertyTable& table, const std::string& owner,
                   int formatMinor, Diagnostics& diagnostics)
        : in_(in), table_(table), owner_(owner), formatMinor_(formatMinor),
          diagnostics_(diagnostics) {}

    void parse() {
        const Declaration declaration = parseDeclaration(in_);
        const char* where = in_.cursor();
        const std::string_view name = in_.propertyName();
        if (name.empty()) in_.fail("expected the name of a property, found " + in_.found());
        UsdProperty& property = declare(declaration, name, where);
        const auto op = declaration.op.value_or(UsdListOp::explicitly);
        if (property.relationship) {
            relationship(property, op);
            return;
        }
        const bool dot = in_.take('.');
        const std::string_view suffix = dot ? in_.identifier() : std::string_view();
        if (dot && suffix.empty()) in_.fail("expected a word after '.', found " + in_.found());
        if (declaration.op && suffix != "connect")
            in_.fail("only relationships and connections can be list-edited");
        in_.skipBlanks();
        if (suffix.empty())
            attribute(property);
        else if (suffix == "timeSamples")
            timeSamples(property);
        else if (suffix == "connect")
            connection(property, op);
        else if (suffix == "spline")
            spline(property, where);
        else
            in_.failAt(where, "unknown attribute field '." + std::string(suffix) + "'");
    }

private:
    // The property of that name, new or declared before.
    UsdProperty& declare(const Declaration& d, std::string_view name, const char* where) {
        const std::size_t known = table_.index.find(table_.properties, name);
        if (known == UsdNameIndex::kNone) {
            UsdProperty& fresh = table_.properties.emplace_back();
            fresh.name = name;
            fresh.typeName = d.typeName;
            fresh.type = d.type;
            fresh.relationship = d.relationship;
            fresh.where = d.where;
        }
        UsdProperty& property =
            known == UsdNameIndex::kNone ? table_.properties.back() : table_.properties[known];
        const bool same = property.relationship == d.relationship &&
                          property.typeName == d.typeName && property.type == d.type;
        if (!same)
            in_.failAt(where, std::string("'").append(name) +
                                  "' was declared with another type on line " +
                                  std::to_string(property.where.line));
        property.custom = property.custom || d.custom;
        property.uniform = property.uniform || d.uniform;
        property.varying = property.varying || d.varying;
        return property;
    }

    void relationship(UsdProperty& property, UsdListOp op) {
        in_.skipBlanks();
        if (in_.take('=')) {
            in_.skipBlanks();
            addListEdit(property.targets, op, parseUsdTargets(in_, owner_));
        }
        metadata(property);
    }

    void attribute(UsdProperty& property) {
        if (in_.take('=')) {
            in_.skipBlanks();
            property.value = parseUsdValue(in_, property.type);
        }
        metadata(property);
    }

    void connection(UsdProperty& property, UsdListOp op) {
        in_.expect('=', "after '.connect'");
        in_.skipBlanks();
        addListEdit(property.targets, op, parseUsdTargets(in_, owner_));
        metadata(property);
    }

    void metadata(UsdProperty& property) {
        in_.skipBlanks();
        if (in_.peek() != '(') return;
        UsdDictionary entries;
        parsePropertyMetadata(in_, entries);
        if (property.metadata.empty())
            property.metadata = std::move(entries);
        else
            for (UsdNamedValue& entry : entries) assign(property.metadata, std::move(entry));
    }

    void timeSamples(UsdProperty& property) {
        in_.expect('=', "after '.timeSamples'");
        in_.skipBlanks();
        if (in_.peekIdentifier() == "None") {
            in_.identifier();
            property.samples.clear();
            return;
        }
        in_.expect('{', "to begin time samples");
        std::vector<UsdTimeSample> samples;
        in_.skipSpace();
        bool separated = true;
        while (!in_.take('}')) {
            if (!separated) in_.fail("expected ',' or '}', found " + in_.found());
            samples.push_back(sample(property.type));
            in_.skipBlanks();
            separated = in_.take(',');
            in_.skipSpace();
        }
        property.samples = sorted(std::move(samples));
        property.hasSamples = true;
    }

    UsdTimeSample sample(UsdType type) {
        UsdTimeSample result;
        const char* where = in_.cursor();
        result.time = in_.number().value;
        if (!std::isfinite(result.time)) in_.failAt(where, "the time of a sample must be finite");
        in_.skipBlanks();
        in_.expect(':', "after the time of a sample");
        in_.skipBlanks();
        result.value = parseUsdValue(in_, type);
        return result;
    }

    // By time; of several at one time the last one stays.
    static std::vector<UsdTimeSample> sorted(std::vector<UsdTimeSample> samples) {
        std::stable_sort(samples.begin(), samples.end(),
                         [](const auto& a, const auto& b) { return a.time < b.time; });
        std::size_t kept = 0;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const bool lastOfItsTime =
                i + 1 == samples.size() || samples[i + 1].time != samples[i].time;
            if (!lastOfItsTime) continue;
            if (kept != i) samples[kept] = std::move(samples[i]);
            ++kept;
        }
        samples.resize(kept);
        return samples;
    }

    void spline(UsdProperty& property, const char* where) {
        if (formatMinor_ == 0) in_.failAt(where, "splines need a file of version '#usda 1.1'");
        in_.expect('=', "after '.spline'");
        in_.skipBlanks();
        in_.rawValue();
        diagnostics_.warn(in_.location(where), "spline of '" + property.name + "' ignored");
    }

    UsdScanner& in_;
    UsdPropertyTable table_;
    const std::string& owner_;
    int formatMinor_;
    Diagnostics& diagnostics_;
};

} // namespace

void parseUsdProperty(UsdScanner& scanner, const UsdPropertyTable& table, const std::string& owner,
                      int formatMinor, Diagnostics& diagnostics) {
    PropertyParser(scanner, table, owner, formatMinor, diagnostics).parse();
}

} // namespace penumbra
