#include "io/usd/layer/UsdMetadataParser.h"

#include "io/usd/layer/UsdPath.h"
#include "io/usd/layer/UsdValueParser.h"

#include <algorithm>
#include <array>
#include <unordered_set>

namespace penumbra {

namespace {

constexpr std::size_t kMaxEntries = 256; // of one block; real files stay below 30

struct KnownKey {
    std::string_view name;
    UsdType type;
};

using enum UsdKind;
// Keys whose type OpenUSD prescribes; lists of items are handled apart.
constexpr std::array kKnownKeys{
    KnownKey{"active", {boolean}},
    KnownKey{"allowedTokens", {token, 1, 1, true}},
    KnownKey{"assetInfo", {dictionary}},
    KnownKey{"autoPlay", {boolean}},
    KnownKey{"bindMaterialAs", {token}},
    KnownKey{"clips", {dictionary}},
    KnownKey{"colorConfiguration", {asset}},
    KnownKey{"colorManagementSystem", {token}},
    KnownKey{"colorSpace", {token}},
    KnownKey{"connectability", {token}},
    KnownKey{"customData", {dictionary}},
    KnownKey{"customLayerData", {dictionary}},
    KnownKey{"defaultPrim", {token}},
    KnownKey{"displayGroup", {string}},
    KnownKey{"displayName", {string}},
    KnownKey{"doc", {string}},
    KnownKey{"elementSize", {int32}},
    KnownKey{"endTimeCode", {float64}},
    KnownKey{"expressionVariables", {dictionary}},
    KnownKey{"framePrecision", {int32}},
    KnownKey{"framesPerSecond", {float64}},
    KnownKey{"hasOwnedSubLayers", {boolean}},
    KnownKey{"hidden", {boolean}},
    KnownKey{"instanceable", {boolean}},
    KnownKey{"interpolation", {token}},
    KnownKey{"kilogramsPerUnit", {float64}},
    KnownKey{"kind", {token}},
    KnownKey{"metersPerUnit", {float64}},
    KnownKey{"owner", {string}},
    KnownKey{"sdrMetadata", {dictionary}},
    KnownKey{"sessionOwner", {string}},
    KnownKey{"startTimeCode", {float64}},
    KnownKey{"timeCodesPerSecond", {float64}},
    KnownKey{"unauthoredValuesIndex", {int32}},
    KnownKey{"upAxis", {token}},
};

// A group in braces under an unknown key is a dictionary, if it reads as one.
UsdValue parseKnownOrRaw(UsdScanner& in, std::string_view key) {
    const UsdType type = usdMetadataType(key);
    if (type.kind != unknown || in.peek() != '{') return parseUsdValue(in, type);
    const char* begin = in.cursor();
    try {
        return parseUsdValue(in, {dictionary});
    } catch (const SceneFileError&) {
        in.moveTo(begin);
        return parseUsdValue(in, {});
    }
}

void store(UsdScanner& in, UsdDictionary& metadata, std::string key, UsdValue value) {
    if (metadata.size() >= kMaxEntries) in.fail("more than 256 entries of metadata");
    assign(metadata, {std::move(key), {}, std::move(value)});
}

// Reads `None`, one item, or items in brackets; `item` reads one.
template <class Item, class Read>
std::vector<Item> parseUsdItems(UsdScanner& scanner, Read item) {
    std::vector<Item> items;
    if (scanner.peekIdentifier() == "None")
        scanner.identifier();
    else if (scanner.take('['))
        parseUsdList(scanner, ']', [&] { items.push_back(item()); });
    else
        items.push_back(item());
    return items;
}

// Reads a block: `special(op, key)` may take a key's value and says whether it did.
template <class Special>
void parseBlock(UsdScanner& in, UsdDictionary& metadata, Special special) {
    in.expect('(', "to begin metadata");
    in.skipSeparators();
    bool separated = true;
    while (!in.take(')')) {
        if (!separated) in.fail("expected a newline, ';' or ')', found " + in.found());
        if (in.atString()) {
            store(in, metadata, "comment", {{string}, std::vector<std::string>{in.string()}});
            separated = in.skipSeparators();
            continue;
        }
        std::string key(in.identifier());
        auto op = UsdListOp::explicitly;
        std::string prefix;
        if (const auto named = usdListOpNamed(key)) {
            in.expectBlankAfter(key);
            in.skipBlanks();
            op = *named;
            prefix = key + " ";
            key = in.identifier();
        }
        if (key.empty()) in.fail("expected a metadata key or ')', found " + in.found());
        in.skipBlanks();
        in.expect('=', "after a metadata key");
        in.skipBlanks();
        if (!special(op, key)) {
            UsdValue value = prefix.empty() ? parseKnownOrRaw(in, key) : parseUsdValue(in, {});
            store(in, metadata, prefix + key, std::move(value));
        }
        separated = in.skipSeparators();
    }
}

// `(offset = n; scale = n; customData = {...})` behind a sublayer or a reference, if it is there.
void parseOffset(UsdScanner& in, UsdLayerOffset& offset, UsdDictionary* customData) {
    in.skipBlanks();
    if (in.peek() != '(') return;
    UsdDictionary others;
    parseBlock(in, others, [&](UsdListOp, const std::string& key) {
        if (key == "offset")
            offset.offset = in.number().value;
        else if (key == "scale")
            offset.scale = in.number().value;
        else if (key == "customData" && customData)
            *customData = parseUsdDictionary(in);
        else
            in.fail("unknown key '" + key + "' of a layer offset");
        return true;
    });
}

UsdSubLayer parseSubLayer(UsdScanner& in) {
    UsdSubLayer layer;
    layer.where = in.position(in.cursor());
    if (in.peek() != '@') in.fail("expected an @asset path@, found " + in.found());
    layer.asset = in.asset();
    parseOffset(in, layer.offset, nullptr);
    return layer;
}

// `<path>` of a prim: absolute as written, or relative to the prim `owner`, if there is one.
std::string parseArcPath(UsdScanner& in, const std::string& owner = {}) {
    const char* where = in.cursor();
    if (in.peek() != '<') in.fail("expected a <path>, found " + in.found());
    const std::string_view text = in.path();
    const auto path = absoluteUsdPath(text, owner.empty() ? "/" : owner);
    const bool absolute = text.starts_with('/') || !owner.empty();
    if (!path || !absolute || isUsdPropertyPath(*path))
        in.failAt(where, owner.empty() ? "expected the absolute path of a prim"
                                       : "expected the path of a prim");
    return *path;
}

// `{ </source>: </target>, ... }`; a target may be empty.
std::vector<UsdRelocate> parseRelocates(UsdScanner& in) {
    std::vector<UsdRelocate> relocates;
    in.expect('{', "to begin relocates");
    in.skipSpace();
    bool separated = true;
    while (!in.take('}')) {
        if (!separated) in.fail("expected ',' or '}', found " + in.found());
        UsdRelocate& one = relocates.emplace_back();
        one.where = in.position(in.cursor());
        one.source = parseArcPath(in);
        in.skipBlanks();
        in.expect(':', "after the source of a relocate");
        in.skipBlanks();
        const bool none = in.peek() == '<' && in.cursor()[1] == '>';
        if (none)
            in.path();
        else
            one.target = parseArcPath(in);
        in.skipBlanks();
        separated = in.take(',');
        in.skipSpace();
    }
    return relocates;
}

UsdReference parseReference(UsdScanner& in) {
    UsdReference reference;
    reference.where = in.position(in.cursor());
    if (in.peek() == '@') {
        reference.asset = in.asset();
        in.skipBlanks();
    } else if (in.peek() != '<') {
        in.fail("expected an @asset path@ or a <path>, found " + in.found());
    }
    if (in.peek() == '<') {
        const bool none = in.cursor()[1] == '>'; // the layer's defaultPrim
        if (none)
            in.path();
        else
            reference.path = parseArcPath(in);
    }
    parseOffset(in, reference.offset, &reference.customData);
    return reference;
}

std::string parseQuoted(UsdScanner& in) {
    if (!in.atString()) in.fail("expected a quoted string, found " + in.found());
    return in.string();
}

// apiSchemas always needs its brackets.
std::vector<std::string> parseSchemas(UsdScanner& in) {
    if (in.peek() != '[' && in.peekIdentifier() != "None")
        in.fail("expected '[' to begin the list of schemas, found " + in.found());
    return parseUsdItems<std::string>(in, [&] { return parseQuoted(in); });
}

bool parseArc(UsdScanner& in, UsdPrimSpec& prim, const std::string& owner, UsdListOp op,
              const std::string& key) {
    const auto paths = [&] {
        return parseUsdItems<std::string>(in, [&] { return parseArcPath(in, owner); });
    };
    const auto references = [&] {
        return parseUsdItems<UsdReference>(in, [&] { return parseReference(in); });
    };
    if (!isUsdArcKey(key)) return false;
    if (!prim.arcs) prim.arcs = std::make_unique<UsdArcs>();
    UsdArcs& arcs = *prim.arcs;
    arcs.where = in.position(in.cursor());
    if (key == "references") addListEdit(arcs.references, op, references());
    if (key == "payload") addListEdit(arcs.payloads, op, references());
    if (key == "inherits") addListEdit(arcs.inherits, op, paths());
    if (key == "specializes") addListEdit(arcs.specializes, op, paths());
    if (key == "apiSchemas") addListEdit(arcs.apiSchemas, op, parseSchemas(in));
    if (key == "variantSets")
        addListEdit(arcs.variantSetNames, op,
                    parseUsdItems<std::string>(in, [&] { return parseQuoted(in); }));
    if (key == "variants") {
        if (op != UsdListOp::explicitly) in.fail("'variants' is not a list");
        arcs.variants = parseUsdDictionary(in);
    }
    return true;
}

} // namespace

void parseLayerMetadata(UsdScanner& scanner, UsdLayer& layer) {
    parseBlock(scanner, layer.metadata, [&](UsdListOp op, const std::string& key) {
        if (key == "framesPerSecond") {
            const double rate = scanner.number().value;
            if (!(rate > 0))
                scanner.fail("framesPerSecond must be positive"); // OpenUSD refuses it, too
            store(scanner, layer.metadata, key, {{float64}, std::vector<double>{rate}});
            return true;
        }
        if (key == "relocates" && op == UsdListOp::explicitly) {
            layer.relocates = parseRelocates(scanner);
            return true;
        }
        if (key != "subLayers" || op != UsdListOp::explicitly) return false;
        layer.subLayers =
            parseUsdItems<UsdSubLayer>(scanner, [&] { return parseSubLayer(scanner); });
        return true;
    });
}

void parsePrimMetadata(UsdScanner& scanner, UsdPrimSpec& prim, const std::string& path) {
    parseBlock(scanner, prim.metadata, [&](UsdListOp op, const std::string& key) {
        return parseArc(scanner, prim, path, op, key);
    });
}

void parsePropertyMetadata(UsdScanner& scanner, UsdDictionary& metadata) {
    parseBlock(scanner, metadata, [](UsdListOp, const std::string&) { return false; });
}

bool isUsdArcKey(std::string_view key) {
    constexpr std::array<std::string_view, 7> kKeys{"references",  "payload",     "inherits",
                                                    "specializes", "variantSets", "variants",
                                                    "apiSchemas"};
    return std::find(kKeys.begin(), kKeys.end(), key) != kKeys.end();
}

UsdType usdMetadataType(std::string_view key) {
    const auto* known = std::find_if(kKnownKeys.begin(), kKnownKeys.end(),
                                     [&](const KnownKey& k) { return k.name == key; });
    return known == kKnownKeys.end() ? UsdType{} : known->type;
}

std::optional<UsdListOp> usdListOpNamed(std::string_view word) {
    if (word == "add") return UsdListOp::add;
    if (word == "prepend") return UsdListOp::prepend;
    if (word == "append") return UsdListOp::append;
    if (word == "delete") return UsdListOp::remove;
    if (word == "reorder") return UsdListOp::reorder;
    return std::nullopt;
}

std::string parseUsdPath(UsdScanner& scanner, const std::string& owner) {
    if (scanner.peek() != '<') scanner.fail("expected a <path>, found " + scanner.found());
    const char* where = scanner.cursor();
    auto path = absoluteUsdPath(scanner.path(), owner);
    if (!path) scanner.failAt(where, "malformed path");
    return *std::move(path);
}

std::vector<std::string> parseUsdTargets(UsdScanner& scanner, const std::string& owner) {
    const char* where = scanner.cursor();
    auto paths = parseUsdItems<std::string>(scanner, [&] { return parseUsdPath(scanner, owner); });
    std::unordered_set<std::string_view> seen;
    for (const std::string& path : paths)
        if (!seen.insert(path).second) scanner.failAt(where, "target <" + path + "> appears twice");
    return paths;
}

} // namespace penumbra
