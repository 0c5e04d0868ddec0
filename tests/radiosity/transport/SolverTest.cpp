// Southwell relaxation: the same bits on any number of threads, and a certificate that holds.
#include "base/Parallel.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <numbers>
#include <string>
#include <vector>

namespace penumbra {

namespace {

const MeshingOptions kCoarse{.patchSize = 0.25f, .elementSize = 0.125f};

Scene furnished() {
    return sceneOf(
        {object("room", boxData({-1, -1, -1}, {1, 1, 1}, true, paint({0.7f, 0.5f, 0.3f}))),
         object("box", boxData({-0.5f, -0.3f, -1}, {0.1f, 0.4f, -0.2f}, false)),
         object("board", floorData(0.3f, 0.9f, -0.5f, 0.5f, 0.1f)),
         ceilingLight({0, 0, 0.99f}, 0.8f, 0.6f, {10, 9, 8})});
}

bool sameBits(const std::vector<Rgb>& a, const std::vector<Rgb>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Rgb)) == 0;
}

TEST(Solver, GivesTheSameBitsOnOneThreadAndOnTwo) {
    const auto solve = [](unsigned threads) {
        const ThreadLimit limit(threads);
        return std::make_unique<Solution>(furnished(), kCoarse);
    };
    const auto one = solve(1), two = solve(2);
    EXPECT_TRUE(sameBits(one->lighting.direct, two->lighting.direct));
    EXPECT_TRUE(sameBits(one->lighting.indirect, two->lighting.indirect));
    EXPECT_TRUE(sameBits(one->solver.radiosity(), two->solver.radiosity()));
    EXPECT_EQ(one->solver.statistics().certificate, two->solver.statistics().certificate);
}

TEST(Solver, GivesTheSameBitsTwice) {
    const Solution first(furnished(), kCoarse), second(furnished(), kCoarse);
    EXPECT_TRUE(sameBits(first.lighting.indirect, second.lighting.indirect));
}

TEST(Solver, ReachesTheResidualThatIsAskedFor) {
    double last = 1e30;
    for (double residual : {1e-2, 1e-3, 1e-4}) {
        const Solution solution(furnished(), kCoarse, {.residual = residual});
        const SolveStatistics s = solution.solver.statistics();
        EXPECT_LE(s.certificate, residual * s.brightest);
        EXPECT_LT(s.certificate, last);
        last = s.certificate;
    }
}

/// A cube of which every wall emits 1 and reflects 0.5: the reflected radiosity is 1.
Scene furnaceScene() {
    const auto walls = paint(Rgb(0.5f), Rgb(1 / std::numbers::pi_v<float>));
    return sceneOf({object("room", boxData({-1, -1, -1}, {1, 1, 1}, true, walls))});
}

TEST(Solver, CertificateBoundsTheErrorWhereverItStops) {
    // The error against the same system of equations, solved to the end.
    for (const Scene& scene : {furnished(), furnaceScene()}) {
        const Solution settled(scene, kCoarse, {.residual = 1e-8});
        const std::vector<Rgb> exact = settled.solver.radiosity();
        for (std::uint64_t shots : {32u, 96u, 192u, 384u, 768u, 1536u}) {
            const Solution stopped(scene, kCoarse, {.residual = 1e-8, .mostShots = shots});
            const std::vector<Rgb> radiosity = stopped.solver.radiosity();
            double error = 0;
            for (std::size_t p = 0; p < exact.size(); ++p)
                error = std::max<double>(error, maxChannel(absolute(radiosity[p] - exact[p])));
            EXPECT_LE(error, stopped.solver.statistics().certificate + 1e-5) << shots << " shots";
        }
    }
}

TEST(Solver, AmbientTermStandsInForWhatIsStillOwed) {
    // Stopped early, a furnace is already about as bright in the mean as in the end: H = 2.
    const Solution solution(furnaceScene(), kCoarse, {.residual = 1e-9, .mostShots = 64});
    double sum = 0;
    const Lighting raw = solution.solver.lighting();
    for (std::size_t v = 0; v < raw.direct.size(); ++v) sum += raw.direct[v].r + raw.indirect[v].r;
    EXPECT_NEAR(sum / double(solution.patches().objects[0].vertices.count), 2, 0.05);
}

TEST(Solver, WithMemoryForNoRowFindsTheSameLight) {
    const Solution kept(furnished(), kCoarse), dropped(furnished(), kCoarse, {.memory = 1});
    EXPECT_TRUE(sameBits(kept.lighting.indirect, dropped.lighting.indirect));
    for (const Row& row : dropped.solver.patchRows()) EXPECT_TRUE(row.empty());
}

TEST(Solver, IsLinearInTheLight) {
    // Twice the luminance, twice the light: to the relaxation's threshold.
    const auto lit = [](float nits) {
        return std::make_unique<Solution>(
            sceneOf({object("room", boxData({-1, -1, -1}, {1, 1, 1}, true)),
                     ceilingLight({0, 0, 0.99f}, 0.8f, 0.6f, Rgb(nits))}),
            kCoarse);
    };
    const auto one = lit(1), two = lit(2);
    for (std::size_t v = 0; v < one->patches().vertices.size(); ++v)
        EXPECT_NEAR(two->at(v).r, 2 * one->at(v).r, 1e-4f * two->at(v).r + 1e-6f);
}

TEST(Solver, CountsWhatItDid) {
    const Solution solution(furnished(), kCoarse);
    const SolveStatistics s = solution.solver.statistics();
    EXPECT_GT(s.direct.rays.total(), solution.patches().vertices.size());
    EXPECT_GT(s.indirect.rays.total(), 0u);
    EXPECT_FLOAT_EQ(float(s.brightest), 10 * std::numbers::pi_v<float>);
    std::size_t entries = 0;
    for (const Row& row : solution.solver.emitterRows()) entries += sizeOf(row).entries;
    for (const Row& row : solution.solver.patchRows()) entries += sizeOf(row).entries;
    EXPECT_EQ(s.entries, entries);
}

TEST(Solver, ProgressNeverFallsAndNeverStandsForLong) {
    const Scene scene = furnished();
    LitScene lit(placeScene(scene), {.patchSize = 0.25f, .elementSize = 0.06f}, {});
    std::map<std::string, std::vector<double>> shown;
    while (lit.solver().work(
        2000, [&](const char* phase, double done) { shown[phase].push_back(done); })) {
    }
    for (const char* phase : {"indirect light", "fine shadows"}) {
        const std::vector<double>& done = shown[phase];
        ASSERT_GT(done.size(), 5u) << phase;
        for (std::size_t i = 1; i < done.size(); ++i) {
            EXPECT_GE(done[i], done[i - 1]) << phase;
            EXPECT_LE(done[i], done[i - 1] + 0.25) << phase;
        }
        EXPECT_LE(done.back(), 1) << phase;
        EXPECT_GT(done.back(), 0.9) << phase;
    }
}

TEST(Solver, WithoutLightIsDarkAndDone) {
    const Solution solution(sceneOf({object("floor", floorData(0, 1, 0, 1, 0))}), kCoarse);
    for (std::size_t v = 0; v < solution.patches().vertices.size(); ++v)
        EXPECT_EQ(solution.at(v), Rgb());
    EXPECT_EQ(solution.solver.state(), SolutionState::exact);
    EXPECT_EQ(solution.solver.done().rays, 0u) << "nothing sends any light";
}

} // namespace

} // namespace penumbra
