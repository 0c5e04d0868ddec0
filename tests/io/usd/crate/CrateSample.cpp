#include "tests/io/usd/crate/CrateSample.h"

#include "tests/support/CrateWriter.h"

#include <bit>
#include <numeric>

namespace penumbra {

namespace {

enum Form : std::uint32_t {
    attribute = 1,
    prim = 6,
    pseudoRoot = 7,
    relationship = 8,
    variant = 10,
    variantSet = 11
};

std::uint64_t word(CrateWriter& out, const std::string& text) {
    return CrateWriter::inlined(11, out.token(text));
}

void addAttribute(CrateWriter& out, std::uint32_t owner, const std::string& name,
                  const std::string& type, CrateWriter::Fields fields) {
    fields.insert(fields.begin(), {"typeName", word(out, type)});
    out.spec(out.path(owner, name, true), attribute, fields);
}

// `{ string s = "x"; dictionary d = { double n = 1.5 } }`: values lie behind the distance to them.
std::uint64_t dictionary(CrateWriter& out) {
    const std::uint64_t inner = out.here();
    out.put(std::uint64_t(1)).put(out.string("n")).put(std::int64_t(8));
    out.put(CrateWriter::inlined(9, std::bit_cast<std::uint32_t>(1.5f)));
    const std::uint64_t at = out.here();
    out.put(std::uint64_t(2)).put(out.string("d")).put(std::int64_t(8));
    out.put(CrateWriter::rep(31, inner));
    out.put(out.string("s")).put(std::int64_t(8)).put(CrateWriter::inlined(10, out.string("x")));
    return CrateWriter::rep(31, at);
}

std::uint64_t reference(CrateWriter& out, const std::string& asset, std::uint32_t path) {
    const std::uint64_t at = out.here();
    out.put(std::uint8_t(32)).put(std::uint64_t(1)); // prepended
    out.put(out.string(asset)).put(path).put(10.0).put(2.0).put(std::uint64_t(0));
    return CrateWriter::rep(35, at);
}

void addNumbers(CrateWriter& out, std::uint32_t owner) {
    std::vector<std::int32_t> counting(20);
    std::iota(counting.begin(), counting.end(), 100000);
    counting[7] = -5;
    counting[8] = 300;
    addAttribute(out, owner, "i", "int[]", {{"default", out.packedArray(3, counting)}});
    addAttribute(out, owner, "f", "float[]", {{"default", out.packedArray(8, counting)}});
    const std::vector<float> points{0, 0.5f, 1, -2, 3e10f, 1e-3f};
    addAttribute(
        out, owner, "points", "point3f[]",
        {{"default", out.plainArray(24, points, 2)}, {"interpolation", word(out, "vertex")}});
    const std::uint64_t quaternion = out.here();
    out.put(1.0f).put(2.0f).put(3.0f).put(0.5f);
    addAttribute(out, owner, "q", "quatf", {{"default", CrateWriter::rep(17, quaternion)}});
    addAttribute(out, owner, "m", "matrix4d", {{"default", CrateWriter::inlined(15, 0x01fe0201)}});
    addAttribute(out, owner, "v", "int3", {{"default", CrateWriter::inlined(26, 0x00ff7f80)}});
    addAttribute(out, owner, "h", "half2", {{"default", CrateWriter::inlined(21, 0xc0003c01)}});
    const std::uint64_t wide = out.here();
    out.put(std::int64_t(9007199254740993));
    addAttribute(out, owner, "w", "int64", {{"default", CrateWriter::rep(5, wide)}});
    addAttribute(out, owner, "n", "int64", {{"default", CrateWriter::inlined(5, 0xfffffffe)}});
    addAttribute(out, owner, "t", "double",
                 {{"timeSamples", out.samples({1, 2.5}, {CrateWriter::inlined(9, 0x3f000000),
                                                         CrateWriter::inlined(51, 0)})}});
    addAttribute(
        out, owner, "names", "token[]",
        {{"variability", CrateWriter::inlined(44, 1)},
         {"default", out.plainArray(11, std::vector{out.token("a"), out.token("b\n\"")}, 2)}});
    addAttribute(out, owner, "file", "asset",
                 {{"custom", CrateWriter::inlined(1, 1)},
                  {"default", CrateWriter::inlined(12, out.token("a@b.png"))}});
}

} // namespace

const std::string_view kSampleText = R"(#usda 1.0
(
    doc = "a layer"
    upAxis = "Z"
    customLayerData = {
        dictionary d = {
            double n = 1.5
        }
        string s = "x"
    }
    unknown = [1, 2]
)

def Xform "A" (
    kind = "group"
    prepend references = @b.usd@</A/B> (offset = 10; scale = 2)
    variantSets = "look"
)
{
    int[] i = [100000, 100001, 100002, 100003, 100004, 100005, 100006, -5, 300, 100009, 100010, 100011, 100012, 100013, 100014, 100015, 100016, 100017, 100018, 100019]
    float[] f = [100000, 100001, 100002, 100003, 100004, 100005, 100006, -5, 300, 100009, 100010, 100011, 100012, 100013, 100014, 100015, 100016, 100017, 100018, 100019]
    point3f[] points = [(0, 0.5, 1), (-2, 3e10, 0.001)] (
        interpolation = "vertex"
    )
    quatf q = (0.5, 1, 2, 3)
    matrix4d m = ( (1, 0, 0, 0), (0, 2, 0, 0), (0, 0, -2, 0), (0, 0, 0, 1) )
    int3 v = (-128, 127, -1)
    half2 h = (1.0009765625, -2)
    int64 w = 9007199254740993
    int64 n = -2
    double t.timeSamples = {
        1: 0.5,
        2.5: None,
    }
    uniform token[] names = ["a", "b\n\""]
    custom asset file = @@@a@b.png@@@
    variantSet "look" = {
        "dark" {
            over "B"
            {
                prepend rel r = [</A/B>, </A.i>]
            }
        }
    }

    over "B"
    {
    }
}
)";

std::string sampleCrate(int minor) {
    CrateWriter out(minor);
    const std::uint32_t a = out.path(0, "A"), b = out.path(a, "B");
    const std::uint64_t unknown = out.here();
    out.put(std::int64_t(8)).put(CrateWriter::inlined(10, out.string("[1, 2]")));
    out.spec(0, pseudoRoot,
             {{"primChildren", out.tokens({"A"})},
              {"documentation", CrateWriter::inlined(10, out.string("a layer"))},
              {"upAxis", word(out, "Z")},
              {"customLayerData", dictionary(out)},
              {"unknown", CrateWriter::rep(53, unknown)}});
    out.spec(a, prim,
             {{"specifier", CrateWriter::inlined(42, 0)},
              {"typeName", word(out, "Xform")},
              {"kind", word(out, "group")},
              {"references", reference(out, "b.usd", b)},
              {"variantSetNames", out.listOp(33, 2, {out.string("look")})},
              {"primChildren", out.tokens({"B"})},
              {"variantSetChildren", out.tokens({"look"})},
              {"properties", out.tokens({"i", "f", "points", "q", "m", "v", "h", "w", "n", "t",
                                         "names", "file"})}});
    addNumbers(out, a);
    out.spec(b, prim, {{"specifier", CrateWriter::inlined(42, 1)}});
    out.spec(out.path(a, "{look=}"), variantSet, {{"variantChildren", out.tokens({"dark"})}});
    const std::uint32_t dark = out.path(a, "{look=dark}");
    out.spec(dark, variant, {{"primChildren", out.tokens({"B"})}});
    const std::uint32_t inner = out.path(dark, "B");
    out.spec(inner, prim,
             {{"specifier", CrateWriter::inlined(42, 1)}, {"properties", out.tokens({"r"})}});
    const std::uint32_t target = 3; // A.i: paths are numbered as they are made
    out.spec(out.path(inner, "r", true), relationship,
             {{"variability", CrateWriter::inlined(44, 1)},
              {"targetPaths", out.listOp(34, 32, {b, target})}});
    return out.bytes();
}

} // namespace penumbra
