#include "bench/loading/LoadingFiles.h"

#include "tests/support/CrateWriter.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <iterator>
#include <vector>

namespace penumbra {

namespace {

struct Grid {
    std::vector<float> points;
    std::vector<std::int32_t> counts, indices;
};

Grid grid(std::size_t points) {
    const auto side = std::size_t(std::sqrt(double(points)));
    Grid grid;
    for (std::size_t y = 0; y < side; ++y)
        for (std::size_t x = 0; x < side; ++x) {
            const float u = float(x) / float(side), v = float(y) / float(side);
            grid.points.insert(grid.points.end(), {10 * u, 10 * v, std::sin(30 * u * v)});
        }
    for (std::size_t y = 0; y + 1 < side; ++y)
        for (std::size_t x = 0; x + 1 < side; ++x) {
            const auto at = std::int32_t(y * side + x), row = std::int32_t(side);
            grid.counts.push_back(4);
            grid.indices.insert(grid.indices.end(), {at, at + 1, at + row + 1, at + row});
        }
    return grid;
}

std::uint64_t word(CrateWriter& out, const std::string& text) {
    return CrateWriter::inlined(11, out.token(text));
}

void appendNumbers(std::string& text, const std::vector<std::int32_t>& numbers) {
    for (const std::int32_t number : numbers)
        fmt::format_to(std::back_inserter(text), "{}, ", number);
    text.resize(text.size() - 2);
}

} // namespace

std::string meshText(std::size_t points) {
    const Grid mesh = grid(points);
    std::string text = "#usda 1.0\n(\n    defaultPrim = \"A\"\n)\ndef Mesh \"A\"\n{\n"
                       "    int[] faceVertexCounts = [";
    appendNumbers(text, mesh.counts);
    text += "]\n    int[] faceVertexIndices = [";
    appendNumbers(text, mesh.indices);
    text += "]\n    point3f[] points = [";
    for (std::size_t i = 0; i < mesh.points.size(); i += 3)
        fmt::format_to(std::back_inserter(text), "({}, {}, {}), ", mesh.points[i],
                       mesh.points[i + 1], mesh.points[i + 2]);
    text.resize(text.size() - 2);
    return text + "]\n}\n";
}

std::string meshCrate(std::size_t points) {
    const Grid mesh = grid(points);
    CrateWriter out;
    const std::uint64_t counts = out.packedArray(3, mesh.counts);
    const std::uint64_t indices = out.packedArray(3, mesh.indices);
    const std::uint64_t places = out.plainArray(24, mesh.points, mesh.points.size() / 3);
    const std::uint32_t a = out.path(0, "A");
    out.spec(0, 7, {{"defaultPrim", word(out, "A")}, {"primChildren", out.tokens({"A"})}});
    out.spec(a, 6,
             {{"specifier", CrateWriter::inlined(42, 0)},
              {"typeName", word(out, "Mesh")},
              {"properties", out.tokens({"faceVertexCounts", "faceVertexIndices", "points"})}});
    const auto array = [&](const char* name, const char* type, std::uint64_t value) {
        out.spec(out.path(a, name, true), 1, {{"typeName", word(out, type)}, {"default", value}});
    };
    array("faceVertexCounts", "int[]", counts);
    array("faceVertexIndices", "int[]", indices);
    array("points", "point3f[]", places);
    return out.bytes();
}

std::string primsText(std::size_t prims) {
    std::string text = "#usda 1.0\n";
    for (std::size_t i = 0; i < prims; ++i)
        fmt::format_to(std::back_inserter(text),
                       "\ndef Sphere \"prim_{}\"\n{{\n    token visibility = \"inherited\"\n"
                       "    double3 xformOp:translate = (1, 2, 3)\n    double radius = 1\n}}\n",
                       i);
    return text;
}

std::string primsCrate(std::size_t prims) {
    CrateWriter out;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < prims; ++i) names.push_back("prim_" + std::to_string(i));
    out.spec(0, 7, {{"primChildren", out.tokens(names)}});
    const std::uint64_t properties = out.tokens({"visibility", "xformOp:translate", "radius"});
    const std::uint32_t prim = out.fieldSet({{"specifier", CrateWriter::inlined(42, 0)},
                                             {"typeName", word(out, "Sphere")},
                                             {"properties", properties}});
    const std::uint32_t visibility =
        out.fieldSet({{"typeName", word(out, "token")}, {"default", word(out, "inherited")}});
    const std::uint32_t translate = out.fieldSet(
        {{"typeName", word(out, "double3")}, {"default", CrateWriter::inlined(23, 0x030201)}});
    const std::uint32_t radius = out.fieldSet(
        {{"typeName", word(out, "double")}, {"default", CrateWriter::inlined(9, 0x3f800000)}});
    for (const std::string& name : names) {
        const std::uint32_t path = out.path(0, name);
        out.rawSpec(path, prim, 6);
        out.rawSpec(out.path(path, "visibility", true), visibility, 1);
        out.rawSpec(out.path(path, "xformOp:translate", true), translate, 1);
        out.rawSpec(out.path(path, "radius", true), radius, 1);
    }
    return out.bytes();
}

} // namespace penumbra
