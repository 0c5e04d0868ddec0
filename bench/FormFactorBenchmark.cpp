// The two inner loops: closed-form form factors, and packets of shadow rays.
#include "bench/BenchScene.h"
#include "radiosity/rays/RayScene.h"
#include "radiosity/rows/FormFactor.h"

#include <benchmark/benchmark.h>

#include <array>
#include <bit>
#include <cmath>
#include <vector>

namespace penumbra {

namespace {

/// A unit square at `height` above receivers that lie around `x` on the ground, facing up or
/// tilted.
void squareAbove(benchmark::State& state, float height, float x, glm::vec3 normal) {
    const std::array<glm::vec3, 4> square{glm::vec3{-0.5f, -0.5f, height},
                                          {-0.5f, 0.5f, height},
                                          {0.5f, 0.5f, height},
                                          {0.5f, -0.5f, height}};
    std::array<glm::vec3, 64> points;
    for (std::size_t i = 0; i < points.size(); ++i)
        points[i] = {x + 0.01f * float(i % 8), 0.01f * float(i / 8), 0};
    if (!(polygonFormFactor(points[0], normal, square) > 0))
        return state.SkipWithError("the square is not seen");
    std::size_t i = 0;
    for (auto _ : state)
        benchmark::DoNotOptimize(polygonFormFactor(points[i++ % points.size()], normal, square));
}
// Time a call is what Google Benchmark prints.
BENCHMARK_CAPTURE(squareAbove, near, 0.5f, 0.0f, glm::vec3(0, 0, 1))->Name("formFactor/near");
BENCHMARK_CAPTURE(squareAbove, far, 10.0f, 0.0f, glm::vec3(0, 0, 1))->Name("formFactor/far");
BENCHMARK_CAPTURE(squareAbove, clipped, 0.5f, 0.0f, glm::vec3(1, 0, 0))->Name("formFactor/clipped");

/// One thread; every receiver of the office sends 16 rays to neighbouring points of a ceiling
/// square.
void coherentRays(benchmark::State& state) {
    const BuiltPatches built = BenchScene("office").mesh(0.4f);
    const RayScene scene(built.patches.rayMeshes);
    const Bounds& bounds = built.patches.bounds;
    const glm::vec3 middle = bounds.centre();
    std::vector<ShadowRays> packets;
    for (const Vertex& vertex : built.patches.vertices) {
        ShadowRays rays;
        for (int i = 0; i < 16; ++i) {
            const glm::vec2 offset(0.25f * float(i % 4), 0.25f * float(i / 4));
            const glm::vec3 target(middle.x + offset.x, middle.y + offset.y, bounds.upper.z - 0.3f);
            if (glm::dot(target - vertex.receiver.position, vertex.receiver.normal) > 0)
                rays.set(i, vertex.receiver.position, target);
        }
        if (rays.used != 0) packets.push_back(rays);
    }
    std::size_t i = 0;
    double rays = 0;
    for (auto _ : state) {
        ShadowRays& packet = packets[i++ % packets.size()];
        scene.occluded(packet);
        rays += std::popcount(packet.used);
    }
    state.counters["Mrays_per_s"] = benchmark::Counter(rays * 1e-6, benchmark::Counter::kIsRate);
}
BENCHMARK(coherentRays)->Name("occluded/coherent");

} // namespace

} // namespace penumbra
