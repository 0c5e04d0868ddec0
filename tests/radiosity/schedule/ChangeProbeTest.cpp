// What a few rays say of work, against what comes of it.
#include "radiosity/schedule/ChangeProbe.h"

#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

namespace penumbra {

namespace {

constexpr std::uint32_t kBlock = PatchSet::kBlock;

/// A floor of 4 x 4 m with a light over it, and a box in its light.
struct Stage {
    Scene scene;
    std::shared_ptr<Transform> box = objectOf(
        "box",
        {std::make_shared<Mesh>("mesh", boxData({-0.3f, -0.3f, 0}, {0.3f, 0.3f, 0.6f}, false))});
    Stage() {
        scene.root->add(object("floor", floorData(-2, 2, -2, 2, 0)));
        scene.root->add(ceilingLight({0, 0, 3}, 1, 1, Rgb(100)));
        scene.root->add(box);
        stand(moved(-1, 0, 0));
    }
    void stand(const glm::dmat4& at) { box->setMatrix(at); }
};

using Factors = std::array<float, kBlock>;
Factors factorsOf(const RowBlock& block) {
    Factors factors{};
    block.forEach([&](int r, float factor) { factors[std::size_t(r)] = factor; });
    return factors;
}

/// What was expected of a block, and what came: means of |change of F V| over its receivers.
struct Outcome {
    std::string object;
    double expected = 0, came = 0;
    double before = 0; ///< mean F V
    double share = 0;  ///< of the receivers, for which more than the least is expected
    int stay = 0;      ///< receivers with an entry that was expected to stay,
    int didNot = 0;    ///< and it did not
};

double meanOf(const ExpectedFactors& expected, std::span<const Receiver> receivers) {
    double sum = 0, count = 0;
    for (std::size_t r = 0; r < kBlock; ++r) {
        count += !isPadding(receivers[r]);
        if (expected.dirty >> r & 1) sum += expected.factor[r];
    }
    return count > 0 ? sum / count : 0;
}
double shareOf(const ExpectedFactors& expected, const RowBlock& row) {
    int many = 0;
    for (int r = 0; r < int(kBlock); ++r)
        many += (expected.dirty >> r & 1) != 0 &&
                expected.factor[std::size_t(r)] > 0.02f * std::max(1e-3f, row.entry(r).formFactor);
    return double(many) / double(kBlock);
}

/// Moves the box, probes every block of the emitter's row, and settles.
std::vector<Outcome> outcomes(Stage& stage, const glm::dmat4& to) {
    LitScene lit(placeScene(stage.scene), {.patchSize = 0.5f, .elementSize = 0.0625f},
                 {.directOnly = true});
    lit.solver().settle();
    stage.stand(to);
    EXPECT_FALSE(lit.follow(placeScene(stage.scene)).rebuilt);
    const PatchSet& set = lit.patches();
    const EmitterSender sender(set.emitters[0], 16, 64);
    std::vector<MovedObject> moved;
    for (std::uint32_t o = 0; o < set.objects.size(); ++o)
        if (set.objects[o].path == "/box") moved.push_back({o, true, boundsOf(set, {o})});
    ChangeProbe probe(lit.rays());
    std::vector<Outcome> result;
    std::vector<Factors> before;
    std::vector<std::uint64_t> dirty;
    const std::size_t blocks = set.firstPrivate / kBlock;
    for (std::uint32_t b = 0; b < blocks; ++b) {
        std::vector<Receiver> receivers;
        for (std::uint32_t v = b * kBlock; v < (b + 1) * kBlock; ++v)
            receivers.push_back(set.vertices[v].receiver);
        const bool own = set.vertexBlockObject[b].value == moved[0].object;
        const RowBlock& row = lit.solver().emitterRows()[0][b];
        const ExpectedFactors expected = probe.at(sender, {receivers, ~std::uint64_t(0)},
                                                  own ? ~std::uint64_t(0) : 0, moved, row);
        result.push_back({set.objects[set.vertexBlockObject[b].value].path,
                          meanOf(expected, receivers), 0, 0, shareOf(expected, row), 0, 0});
        before.push_back(factorsOf(row));
        dirty.push_back(expected.dirty);
    }
    EXPECT_LE(probe.takeRayCount().total(), 2 * kBlock * blocks);
    lit.solver().settle();
    for (std::uint32_t b = 0; b < blocks; ++b) {
        const Factors now = factorsOf(lit.solver().emitterRows()[0][b]);
        int count = 0;
        for (std::size_t r = 0; r < kBlock; ++r) {
            count += !isPadding(set.vertices[b * kBlock + r].receiver);
            result[b].came += std::abs(now[r] - before[b][r]);
            result[b].before += before[b][r];
            if ((dirty[b] >> r & 1) != 0) continue;
            result[b].stay += before[b][r] > 0;
            result[b].didNot += now[r] != before[b][r];
        }
        if (count > 0) result[b].came /= count, result[b].before /= count;
    }
    return result;
}

TEST(ChangeProbe, KnowsHowMuchAndWhereAShadowMoves) {
    Stage stage;
    double expected = 0, came = 0, missed = 0, inVain = 0;
    for (const Outcome& block : outcomes(stage, moved(-0.5, 0.2, 0))) {
        if (block.object != "/floor") continue;
        expected += block.expected;
        came += block.came;
        if (block.expected < 0.1 * block.came) missed += block.came;
        if (block.came < 0.1 * block.expected) inVain += block.expected;
    }
    ASSERT_GT(came, 0);
    EXPECT_NEAR(expected, came, 0.3 * came);
    EXPECT_LT(missed, 0.03 * came);
    EXPECT_LT(inVain, 0.15 * came); // mostly what is expected of every block, whatever is seen
}

TEST(ChangeProbe, WhatItSaysStaysDoesSoBitForBit) {
    int stay = 0, didNot = 0, open = 0;
    for (const double step : {0.0, 0.1, 0.2, 0.3, 0.4, 0.5}) {
        Stage stage;
        stage.stand(moved(-1.5, 0.3, 0.4)); // nothing touches anything
        // Samples that they hide are not asked, and entries in half-shadow have more of them.
        for (int i = 0; i < 4; ++i) {
            const float y = 0.6f * float(i) - 0.9f;
            stage.scene.root->add(
                object("beam" + std::to_string(i),
                       boxData({-2, y - 0.1f, 1.2f}, {2, y + 0.1f, 1.3f}, false)));
        }
        for (const Outcome& block : outcomes(stage, moved(0.3 + step, 0.1 + step, 0.4))) {
            if (block.object != "/floor") continue;
            stay += block.stay, didNot += block.didNot;
            open += block.share > 0;
        }
    }
    EXPECT_EQ(didNot, 0);
    EXPECT_GT(stay, 10000);
    EXPECT_GT(open, 0);
}

TEST(ChangeProbe, ExpectsWhatGoesDarkToChangeAsMuchAsItWasLit) {
    Stage stage;
    glm::dmat4 over(1.0); // half a turn about x: the top faces the floor
    over[1][1] = over[2][2] = -1;
    over[3] = {-1, 0, 0.7, 1};
    double expected = 0, came = 0;
    for (const Outcome& block : outcomes(stage, over)) {
        if (block.object != "/box") continue;
        expected += block.expected;
        came += block.came;
        if (block.came > 0.02) {
            EXPECT_GT(block.share, 0.5);
        }
    }
    ASSERT_GT(came, 0);
    EXPECT_NEAR(expected, came, 0.3 * came);
}

TEST(ChangeProbe, ExpectsLittleOfAThingThatHardlyMoves) {
    // Its own entries are evaluated anew: what they were is known, and most of it stays.
    Stage stage;
    double expected = 0, came = 0, before = 0;
    for (const Outcome& block : outcomes(stage, moved(-0.98, 0, 0))) {
        if (block.object != "/box") continue;
        expected += block.expected, came += block.came, before += block.before;
    }
    EXPECT_LT(came, 0.1 * before);
    EXPECT_LT(expected, came + 0.1 * before);
    EXPECT_GT(expected, 0.5 * came);
}

TEST(ChangeProbe, ExpectsLittleWhereNothingMoves) {
    Stage stage;
    for (const Outcome& block : outcomes(stage, moved(-1, 0, 1e-7))) {
        if (block.object != "/floor") continue;
        EXPECT_LE(block.share, 0.2);
    }
}

} // namespace

} // namespace penumbra
