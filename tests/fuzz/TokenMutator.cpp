#include "tests/fuzz/TokenMutator.h"

#include <array>
#include <cctype>
#include <numeric>

namespace penumbra {

namespace {

using Tokens = std::vector<std::string>;

bool isWord(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == ':' || c == '.' ||
           c == '-' || c == '+';
}

/// Where the token that begins at `at` ends: words, blanks, and what stands in quotes, @ or <>.
std::size_t endOfToken(std::string_view text, std::size_t at) {
    const char first = text[at];
    std::size_t end = at + 1;
    if (isWord(first)) {
        while (end < text.size() && isWord(text[end])) ++end;
    } else if (std::isspace(static_cast<unsigned char>(first))) {
        while (end < text.size() && std::isspace(static_cast<unsigned char>(text[end]))) ++end;
    } else if (const std::string_view quotes = "\"\"@@<>''"; quotes.find(first) % 2 == 0) {
        const std::size_t close = text.find(quotes[quotes.find(first) + 1], end);
        if (close != std::string_view::npos && close - at < 200) end = close + 1;
    }
    return end;
}

Tokens tokensOf(std::string_view text) {
    Tokens tokens;
    for (std::size_t at = 0; at < text.size(); at += tokens.back().size())
        tokens.emplace_back(text.substr(at, endOfToken(text, at) - at));
    return tokens;
}

struct Stretch {
    std::size_t begin = 0, end = 0; ///< of tokens
};

/// From an opening bracket to the one that closes it; one token where there is none.
Stretch bracketed(const Tokens& tokens, FuzzRandom& random) {
    std::vector<Stretch> all;
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        if (tokens[i] == "(" || tokens[i] == "[" || tokens[i] == "{") open.push_back(i);
        if ((tokens[i] == ")" || tokens[i] == "]" || tokens[i] == "}") && !open.empty()) {
            all.push_back({open.back(), i + 1});
            open.pop_back();
        }
    }
    if (all.empty() || random.one(2)) {
        const std::size_t begin = random.below(tokens.size());
        return {begin, std::min(tokens.size(), begin + 1 + random.below(8))};
    }
    return random.of(all);
}

std::string joined(const Tokens& tokens) {
    return std::accumulate(tokens.begin(), tokens.end(), std::string());
}

using Place = Tokens::difference_type;

void nest(Tokens& tokens, const Stretch& at, FuzzRandom& random) {
    const std::string_view brackets = "()[]{}";
    const std::size_t kind = 2 * random.below(3),
                      levels = 1 + random.below(random.one(8) ? 300 : 4);
    tokens.insert(tokens.begin() + Place(at.end), std::string(levels, brackets[kind + 1]));
    tokens.insert(tokens.begin() + Place(at.begin), std::string(levels, brackets[kind]));
}

/// Another token of the same kind, from elsewhere in the text.
void exchange(Tokens& tokens, FuzzRandom& random) {
    const std::size_t at = random.below(tokens.size());
    for (int tries = 0; tries < 50; ++tries) {
        const std::string& other = random.of(tokens);
        if (other[0] != tokens[at][0] && !(isWord(other[0]) && isWord(tokens[at][0]))) continue;
        if (other == tokens[at]) continue;
        tokens[at] = other;
        return;
    }
}

void extreme(Tokens& tokens, FuzzRandom& random) {
    static const std::array<const char*, 16> numbers{"0",
                                                     "-1",
                                                     "1e999",
                                                     "-1e-999",
                                                     "nan",
                                                     "inf",
                                                     "-inf",
                                                     "2147483648",
                                                     "9223372036854775808",
                                                     "1e7",
                                                     "0.1",
                                                     "-0",
                                                     "1e-40",
                                                     ".5",
                                                     "3.",
                                                     "18446744073709551616"};
    for (int tries = 0; tries < 50; ++tries) {
        std::string& token = tokens[random.below(tokens.size())];
        if (!std::isdigit(static_cast<unsigned char>(token[0]))) continue;
        token = random.of(numbers);
        return;
    }
}

} // namespace

std::string mutatedText(std::string_view text, const std::vector<std::string>& pool,
                        FuzzRandom& random) {
    Tokens tokens = tokensOf(text);
    if (tokens.empty()) return "#usda 1.0\n" + random.of(pool);
    const Stretch part = bracketed(tokens, random);
    const Tokens copy(tokens.begin() + Place(part.begin), tokens.begin() + Place(part.end));
    const Place to = Place(random.below(tokens.size() + 1));
    switch (random.below(8)) {
    case 0:
        tokens.erase(tokens.begin() + Place(part.begin), tokens.begin() + Place(part.end));
        break;
    case 1:
        tokens.insert(tokens.begin() + to, copy.begin(), copy.end());
        break;
    case 2:
        nest(tokens, part, random);
        break;
    case 3:
        exchange(tokens, random);
        break;
    case 4:
        extreme(tokens, random);
        break;
    default: // the commonest: something that means something
        tokens.insert(tokens.begin() + to, random.of(pool));
        break;
    }
    return joined(tokens);
}

const std::vector<std::string>& layerStatements() {
    static const std::vector<std::string> statements{
        "def Xform \"a\"\n{\n}\n",
        "over \"b\" (\n)\n{\n}\n",
        "class \"c\"\n{\n}\n",
        "int i = 1\n",
        "custom uniform token t = \"x\"\n",
        "float[] f = [1, 2.5, -3e4]\n",
        "point3f[] points = [(0, 0, 0), (1, 2, 3)] (\n interpolation = \"vertex\"\n)\n",
        "matrix4d m = ( (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1) )\n",
        "quath q = (1, 0, 0, 0)\n",
        "double x.timeSamples = {\n 0: 1,\n 2: None,\n}\n",
        "string s = '''a\n\"b'''\n",
        "string u = \"\\x41\\u00e9\\\"\"\n",
        "asset a = @@@x@y@@@\n",
        "asset[] l = [@a.png@, @b.<UDIM>.exr@]\n",
        "rel r = [</a>, </a/b.i>, <../b>]\n",
        "prepend rel r = </b>\n",
        "delete rel r = </b>\n",
        "add rel r.timeSamples = { 0: </a> }\n",
        "float x.connect = </a.y>\n",
        "dictionary d = {\n int i = 1\n dictionary e = {\n }\n}\n",
        "reorder nameChildren = [\"b\", \"a\"]\n",
        "reorder properties = [\"x\"]\n",
        "variantSet \"v\" = {\n \"x\" {\n int i = 2\n }\n}\n",
        "doc = \"text\"\n",
        "customData = { bool b = 1 }\n",
        "subLayers = [@1.usda@ (offset = 1; scale = 2)]\n",
        "relocates = { </a/b>: </a/c> }\n",
        "timecode t = 3\n",
        "pathExpression p = \"//a\"\n",
        "opaque o\n",
        "half3 h = (1, 2, 3)\n",
        "uint64 w = 18446744073709551615\n",
        "bool b = true\n",
        "# comment\n",
        "/* comment */",
        "None",
        std::string(1, '\0'),
        "\xc3",
        "é",
        "spline"};
    return statements;
}

const std::vector<std::string>& arcStatements() {
    static const std::vector<std::string> statements{
        " prepend references = @1.usda@</a>\n",
        " references = [@2.usda@, </b>]\n",
        " append references = </a/b> (offset = 3; scale = .5)\n",
        " delete references = </b>\n",
        " payload = @1.usda@</b>\n",
        " prepend payload = @3.usda@</a/c>\n",
        " inherits = </c>\n",
        " append inherits = </a/b>\n",
        " specializes = </c>\n",
        " prepend specializes = [</b>, </c>]\n",
        " variantSets = [\"v\", \"w\"]\n",
        " variants = {\n string v = \"x\"\n string w = \"y\"\n }\n",
        "variantSet \"v\" = {\n\"x\" (\n references = </b>\n) {\n over \"b\" {\n int i = 3\n "
        "}\n}\n\"y\" {\n}\n}\n",
        " instanceable = true\n",
        " active = false\n",
        " kind = \"component\"\n",
        " relocates = { </a/b>: </a/d>, </a/c>: <> }\n",
        " subLayers = [@1.usda@, @2.usda@ (offset = 10)]\n",
        " subLayers = [@`\"${F}.usda\"`@]\n",
        " expressionVariables = { string F = \"2\" }\n",
        " references = @`if(defined(F), \"${F}.usda\", \"1.usda\")`@</a>\n",
        " references = @../outside.usda@</a>\n",
        " payload = @/etc/passwd@\n",
        " references = @./1.usda:SDF_FORMAT_ARGS:a=b@</a>\n",
        " references = @0.usda@</a>\n",
        " defaultPrim = \"a\"\n",
        "def \"a\" (\n)\n{\n}\n",
        "over \"b\" (\n)\n{\n}\n",
        "class \"c\" (\n)\n{\n}\n",
        "def Mesh \"b\"\n{\n int[] faceVertexCounts = [3]\n int[] faceVertexIndices = [0, 1, 2]\n "
        "point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]\n rel material:binding = </c>\n}\n",
        "def PointInstancer \"b\"\n{\n int[] protoIndices = [0, 0]\n point3f[] positions = [(0, 0, "
        "0), (1, 0, 0)]\n rel prototypes = </a/c>\n}\n",
        "def SphereLight \"c\"\n{\n float inputs:radius = .5\n}\n",
        "double3 xformOp:translate = (1, 2, 3)\nuniform token[] xformOpOrder = "
        "[\"xformOp:translate\"]\n",
        "rel r = [</a/b>, <../c>]\n",
        "float x.timeSamples = {\n 0: 1,\n 10: 2,\n}\n",
        "float x.connect = </a/b.y>\n",
        "reorder nameChildren = [\"c\", \"a\"]\n",
        "\n---\n#usda 1.0\n"};
    return statements;
}

} // namespace penumbra
