// Reading layers from memory: numbers in bytes a second, prims in specs a second.
#include "bench/loading/LoadingFiles.h"
#include "io/usd/crate/CrateLayer.h"
#include "tests/support/CrateWriter.h"

#include <benchmark/benchmark.h>

#include <span>
#include <string>
#include <vector>

namespace penumbra {

namespace {

void check(benchmark::State& state, const UsdLayer& layer) {
    benchmark::DoNotOptimize(layer.prims.data());
    if (!layer.diagnostics.empty()) state.SkipWithError(layer.diagnostics[0].text.c_str());
}

void readCrate(benchmark::State& state, const std::string& file) {
    for (auto _ : state) check(state, readCrateLayer(std::as_bytes(std::span(file)), "bench.usdc"));
}

void readText(benchmark::State& state, const std::string& text) {
    for (auto _ : state) check(state, parseUsdLayer(text, "bench.usda"));
    state.SetBytesProcessed(std::int64_t(state.iterations() * text.size()));
}

/// One prim with one attribute.
std::string withAttribute(CrateWriter& out, const std::string& type, std::uint64_t value) {
    const std::uint32_t a = out.path(0, "A");
    out.spec(0, 7, {{"primChildren", out.tokens({"A"})}});
    out.spec(a, 6, {{"properties", out.tokens({"a"})}});
    const std::uint64_t typeName = CrateWriter::inlined(11, out.token(type));
    out.spec(out.path(a, "a", true), 1, {{"typeName", typeName}, {"default", value}});
    return out.bytes();
}

void cratePoints(benchmark::State& state) {
    const auto count = std::size_t(state.range(0));
    CrateWriter out;
    const std::vector<float> numbers(3 * count, 1.5f);
    const std::uint64_t array = out.plainArray(24, numbers, count);
    readCrate(state, withAttribute(out, "point3f[]", array));
    state.SetBytesProcessed(std::int64_t(state.iterations() * numbers.size() * sizeof(float)));
}

/// Vertex indices of a large mesh: integers that are much alike.
void crateIndices(benchmark::State& state) {
    std::vector<std::int32_t> numbers(std::size_t(state.range(0)));
    for (std::size_t i = 0; i < numbers.size(); ++i)
        numbers[i] = std::int32_t(i / 4 + (i % 4) * (i % 2 ? 1 : 700));
    CrateWriter out;
    const std::uint64_t array = out.packedArray(3, numbers);
    readCrate(state, withAttribute(out, "int[]", array));
    state.SetBytesProcessed(std::int64_t(state.iterations() * numbers.size() * sizeof(int)));
}

void crateSpecs(benchmark::State& state) {
    const auto prims = std::size_t(state.range(0));
    readCrate(state, primsCrate(prims));
    state.SetItemsProcessed(std::int64_t(state.iterations() * 4 * prims));
}

void textMesh(benchmark::State& state) {
    readText(state, meshText(std::size_t(state.range(0))));
}

void textPrims(benchmark::State& state) {
    const auto prims = std::size_t(state.range(0));
    readText(state, primsText(prims));
    state.SetItemsProcessed(std::int64_t(state.iterations() * 4 * prims));
}

BENCHMARK(cratePoints)->Name("crate/points")->Arg(10'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(crateIndices)->Name("crate/indices")->Arg(10'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(crateSpecs)->Name("crate/specs")->Arg(250'000)->Unit(benchmark::kMillisecond);
BENCHMARK(textMesh)->Name("text/mesh")->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(textPrims)->Name("text/prims")->Arg(250'000)->Unit(benchmark::kMillisecond);

} // namespace

} // namespace penumbra
