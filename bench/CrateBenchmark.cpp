// Reading crate files: arrays of numbers, packed integers, and specs.
#include "io/usd/crate/CrateLayer.h"
#include "tests/support/CrateWriter.h"

#include <benchmark/benchmark.h>

#include <numeric>
#include <string>
#include <vector>

namespace penumbra {

namespace {

std::uint64_t word(CrateWriter& out, const std::string& text) {
    return CrateWriter::inlined(11, out.token(text));
}

/// One prim with one attribute.
std::string withAttribute(CrateWriter& out, const std::string& type, std::uint64_t value) {
    const std::uint32_t a = out.path(0, "A");
    out.spec(0, 7, {{"primChildren", out.tokens({"A"})}});
    out.spec(a, 6, {{"properties", out.tokens({"a"})}});
    out.spec(out.path(a, "a", true), 1, {{"typeName", word(out, type)}, {"default", value}});
    return out.bytes();
}

void read(benchmark::State& state, const std::string& file) {
    for (auto _ : state) {
        const UsdLayer layer = readCrateLayer(std::as_bytes(std::span(file)), "bench.usdc");
        benchmark::DoNotOptimize(layer.prims.data());
        if (!layer.diagnostics.empty()) state.SkipWithError(layer.diagnostics[0].text.c_str());
    }
}

/// Points of a large mesh.
void points(benchmark::State& state) {
    const auto count = std::size_t(state.range(0));
    CrateWriter out;
    const std::vector<float> numbers(3 * count, 1.5f);
    const std::uint64_t array = out.plainArray(24, numbers, count);
    read(state, withAttribute(out, "point3f[]", array));
    state.SetBytesProcessed(std::int64_t(state.iterations() * numbers.size() * sizeof(float)));
}

/// Vertex indices of a large mesh: integers that are much alike.
void indices(benchmark::State& state) {
    std::vector<std::int32_t> numbers(std::size_t(state.range(0)));
    for (std::size_t i = 0; i < numbers.size(); ++i)
        numbers[i] = std::int32_t(i / 4 + (i % 4) * (i % 2 ? 1 : 700));
    CrateWriter out;
    const std::uint64_t array = out.packedArray(3, numbers);
    read(state, withAttribute(out, "int[]", array));
    state.SetBytesProcessed(std::int64_t(state.iterations() * numbers.size() * sizeof(int)));
}

/// Prims with three attributes each, as rigs and scattered things have them.
void specs(benchmark::State& state) {
    const auto prims = std::size_t(state.range(0));
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
    read(state, out.bytes());
    state.SetItemsProcessed(std::int64_t(state.iterations() * 4 * prims));
}

BENCHMARK(points)->Name("crate/points")->Arg(10'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(indices)->Name("crate/indices")->Arg(10'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(specs)->Name("crate/specs")->Arg(250'000)->Unit(benchmark::kMillisecond);

} // namespace

} // namespace penumbra
