// What is shown of a surface while its light changes.
#include "viewer/preview/LightFade.h"

#include "tests/viewer/gl/LitScenes.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace penumbra {

namespace {

using Known = LightShare::Known;

/// Two triangles in a strip of `blocks` blocks of vertices each: triangle i joins three
/// consecutive vertices, so that the last of a block and the first of the next share some.
LitMeshData strip(std::size_t blocks) {
    LitMeshData data;
    const std::size_t count = blocks * LitGeometry::kBlock;
    data.normals.assign(count, {0, 0, 1});
    data.direct.assign(count, Rgb(100));
    data.indirect.assign(count, Rgb(20));
    for (std::uint32_t v = 0; v < count; ++v) {
        data.positions.emplace_back(float(v), float(v % 2), 0);
        if (v < 2) continue;
        data.indices.insert(data.indices.end(), {v - 2, v - 1, v});
        data.triangleMaterial.push_back(0);
    }
    data.materials.emplace_back();
    return data;
}

LightShares exactShares(std::size_t blocks, std::size_t lights) {
    return LightShares(lights, {.factor = std::vector<float>(blocks * LitGeometry::kBlock, 0.5f),
                                .known = std::vector<Known>(blocks, Known::exact),
                                .exitance = std::vector<Rgb>(blocks)});
}

/// A strip whose light is edited and shown.
struct Surface {
    explicit Surface(std::size_t blocks = 1, std::size_t lights = 1)
        : geometry("strip", ObjectId{0}, strip(blocks), exactShares(blocks, lights)),
          fade(geometry), lightCount(lights) {
        if (lights > 0) fade.setLights(lights);
        show(0);
    }
    void publish(std::size_t block, float direct, Known known = Known::exact, float indirect = 20) {
        geometry.setBlock(block, [&](LitMeshData& data, LightShares& shares) {
            for (std::size_t v = 0; v < LitGeometry::kBlock; ++v) {
                data.direct[block * LitGeometry::kBlock + v] = Rgb(direct);
                data.indirect[block * LitGeometry::kBlock + v] = Rgb(indirect);
            }
            for (LightShare& light : shares) light.known[block] = known;
        });
    }
    void show(double time, bool fresh = true, double seconds = 0.25) {
        fade.advance(geometry, {time, seconds, lightCount, fresh});
    }
    float direct(std::size_t vertex = 5) const { return fade.shown().direct[vertex].r; }

    PublishedGeometry geometry;
    LightFade fade;
    std::size_t lightCount;
};

TEST(LightFade, GoesFromOneLightToTheNextBySmoothstepInTime) {
    Surface surface;
    surface.publish(0, 200);
    surface.show(1);
    EXPECT_EQ(surface.direct(), 100) << "starts where it is";
    surface.show(1.125);
    EXPECT_NEAR(surface.direct(), 150, 1e-3);
    surface.show(1.1875); // three quarters: 3/4^2 (3 - 3/2) = 27/32
    EXPECT_NEAR(surface.direct(), 100 + 100 * 27 / 32.0, 1e-3);
    surface.show(1.25);
    EXPECT_EQ(surface.direct(), 200) << "and ends there exactly";
    EXPECT_FALSE(surface.fade.changing());
}

TEST(LightFade, ABlockThatIsNotReadyStaysAsItIs) {
    Surface surface;
    surface.publish(0, 200, Known::stale);
    for (double t = 1; t < 2; t += 0.1) surface.show(t);
    EXPECT_EQ(surface.direct(), 100);
    surface.publish(0, 210, Known::exact);
    surface.show(2);
    surface.show(2.25);
    EXPECT_EQ(surface.direct(), 210);
}

TEST(LightFade, NothingIsTakenBeforeTheMarksAreComplete) {
    Surface surface;
    surface.publish(0, 200);
    surface.show(1, false);
    surface.show(2, false);
    EXPECT_EQ(surface.direct(), 100);
    surface.show(3, true);
    surface.show(4, true);
    EXPECT_EQ(surface.direct(), 200);
}

TEST(LightFade, AVertexWaitsForTheBlocksOfAllItsTriangles) {
    Surface surface(2);
    surface.publish(0, 200);
    surface.publish(1, 200, Known::stale);
    surface.show(1);
    surface.show(2);
    EXPECT_EQ(surface.direct(61), 200) << "shares no triangle with the other block";
    EXPECT_EQ(surface.direct(62), 100);
    EXPECT_EQ(surface.direct(63), 100);
    EXPECT_EQ(surface.direct(64), 100);
    surface.publish(1, 200);
    surface.show(3);
    surface.show(4);
    EXPECT_EQ(surface.direct(63), 200);
    EXPECT_EQ(surface.direct(64), 200);
    EXPECT_FALSE(surface.fade.changing());
}

TEST(LightFade, WithoutLiveLightsEveryVertexIsAlwaysReady) {
    Surface surface(1, 0);
    surface.publish(0, 200);
    surface.show(1);
    surface.show(1.25);
    EXPECT_EQ(surface.direct(), 200);
    EXPECT_TRUE(surface.fade.shown().factors.empty());
}

TEST(LightFade, IndirectLightFollowsAtOnceWhateverDirectLightWaitsFor) {
    Surface surface;
    surface.publish(0, 200, Known::stale, 40);
    surface.show(1);
    surface.show(1.125);
    EXPECT_NEAR(surface.fade.shown().indirect[5].r, 30, 1e-3);
    surface.show(1.25);
    EXPECT_EQ(surface.fade.shown().indirect[5].r, 40);
    EXPECT_EQ(surface.direct(), 100);
}

TEST(LightFade, IndirectLightThatMayNotFadeYetFinishesItsFadeAndWaits) {
    Surface surface;
    const auto show = [&](double time, bool indirect) {
        surface.fade.advance(surface.geometry, {.time = time, .lights = 1, .indirect = indirect});
        return surface.fade.shown().indirect[5].r;
    };
    surface.publish(0, 100, Known::exact, 40);
    EXPECT_EQ(show(1, false), 20);
    EXPECT_TRUE(surface.fade.changing());
    EXPECT_EQ(show(2, true), 20) << "begins to fade";
    surface.publish(0, 100, Known::exact, 60);
    EXPECT_NEAR(show(2.125, false), 30, 1e-3f);
    EXPECT_EQ(show(2.25, false), 40);
    EXPECT_EQ(show(3, true), 40);
    EXPECT_EQ(show(3.25, false), 60);
    EXPECT_FALSE(surface.fade.changing());
}

TEST(LightFade, IndirectLightThatChangesByLessThanCanBeSeenIsUploadedOnce) {
    Surface surface;
    std::set<std::uint64_t> revisions{surface.fade.shown().blockRevisions[0]};
    surface.publish(0, 100, Known::exact, 20.01f); // 20 lux before
    for (double t = 1; t < 2; t += 0.05) {
        surface.show(t);
        revisions.insert(surface.fade.shown().blockRevisions[0]);
    }
    EXPECT_EQ(surface.fade.shown().indirect[5].r, 20.01f);
    EXPECT_EQ(revisions.size(), 2u) << "before and after";
}

TEST(LightFade, IndirectLightOnItsWayHasNothingElseUploaded) {
    Surface surface;
    surface.show(0);
    const ShownLight& shown = surface.fade.shown();
    const std::uint64_t before = shown.blockRevisions[0];
    surface.publish(0, 100, Known::exact, 40);
    for (double t = 1; t < 1.2; t += 0.05) surface.show(t);
    const std::uint64_t between = shown.blockRevisions[0];
    EXPECT_GT(between, before + 1);
    EXPECT_TRUE(shown.onlyIndirectSince(0, before));
    surface.publish(0, 110, Known::exact, 40); // direct light as well
    surface.show(1.2);
    surface.show(1.22);
    EXPECT_FALSE(shown.onlyIndirectSince(0, before));
    EXPECT_FALSE(shown.onlyIndirectSince(0, between));
    for (double t = 1.25; t < 1.6; t += 0.05) surface.show(t);
    const std::uint64_t direct = shown.blockRevisions[0];
    surface.publish(0, 110, Known::exact, 60);
    for (double t = 2; t < 2.2; t += 0.05) surface.show(t);
    EXPECT_FALSE(shown.onlyIndirectSince(0, before)) << "the direct light came in between";
    EXPECT_TRUE(shown.onlyIndirectSince(0, direct));
}

TEST(LightFade, LightsThatBecomeKnownChangeNothingOfWhatIsSeen) {
    Surface surface;
    surface.fade.setLights(1);
    EXPECT_LT(surface.fade.shown().factors[5][0], 0);
    surface.show(1);
    EXPECT_EQ(surface.fade.shown().factors[5][0], 0.5f);
    EXPECT_EQ(surface.direct(), 100);
    EXPECT_FALSE(surface.fade.changing());
}

TEST(LightFade, WhoIsNotReadyStaysBehindAndFollows) {
    Surface surface(3);
    surface.publish(2, 100, Known::stale);
    EXPECT_TRUE(surface.fade.leaveBehind(surface.geometry, {1, 0.25, 1, true}));
    surface.show(1);
    const ShownLight& shown = surface.fade.shown();
    EXPECT_EQ(shown.behind[5], 0);
    EXPECT_EQ(shown.behind[127], 1) << "a neighbour of the block";
    EXPECT_EQ(shown.behind[140], 1);
    surface.publish(2, 300);
    surface.show(2);
    surface.show(2.125);
    EXPECT_NEAR(shown.behind[140], 0.5f, 1e-6f);
    EXPECT_NEAR(surface.direct(140), 200, 1e-3f) << "with the light that it is the share of";
    surface.show(2.25);
    EXPECT_EQ(shown.behind[140], 0);
    EXPECT_FALSE(surface.fade.anyBehind());
}

/// Factors 0.5 before and 0.8 now, which preview lighting gives in full: with the share o of what
/// was before in a vertex, f + o (0.8 - 0.5) is 0.8 whenever the vertex follows. \param light of
/// all previewed lights now; before it was 100
void expectTheLightOfNow(float light) {
    Surface surface(3);
    const auto frame = [&](double time) {
        const double s = std::clamp(time / 0.25, 0.0, 1.0);
        return LightFade::Frame{time, 0.25, 1, true, float(1 - s * s * (3 - 2 * s)), true};
    };
    const auto publish = [&](std::size_t block, Known known) {
        surface.geometry.setBlock(block, [&](LitMeshData& data, LightShares& shares) {
            for (std::size_t v = 0; v < LitGeometry::kBlock; ++v) {
                shares[0].factor[block * LitGeometry::kBlock + v] = 0.8f;
                data.direct[block * LitGeometry::kBlock + v] = Rgb(light);
            }
            shares[0].known[block] = known;
        });
    };
    publish(0, Known::exact);
    for (const std::size_t block : {1u, 2u}) publish(block, Known::stale);
    EXPECT_TRUE(surface.fade.leaveBehind(surface.geometry, frame(0)));
    for (int t = 0; t <= 60; ++t) {
        const double time = t / 100.0;
        if (t == 10) publish(1, Known::exact), publish(2, Known::exact);
        surface.fade.advance(surface.geometry, frame(time));
        const ShownLight& shown = surface.fade.shown();
        for (const std::size_t v : {5u, 100u, 180u}) {
            const float old = shown.behind[v] + (1 - shown.behind[v]) * frame(time).rest;
            ASSERT_NEAR(shown.factors[v][0] + old * 0.3f, 0.8f, 1e-4) << v << " at " << time;
        }
    }
    EXPECT_FALSE(surface.fade.anyBehind());
}

TEST(LightFade, WhoFollowsLateHasTheLightOfNowAllTheTime) {
    expectTheLightOfNow(160);
}

TEST(LightFade, WhatIsAsBrightAsBeforeByOtherLightsHasTheLightOfNowAllTheTime) {
    expectTheLightOfNow(100);
}

TEST(LightFade, AVertexThatComesToStandForACornerBeginsWithTheLightThere) {
    Surface surface(2, 0);
    const std::uint32_t corner = 5, own = 2 * LitGeometry::kBlock + 3;
    surface.geometry.setTopology([&](LitMeshData& data) {
        const std::size_t count = 3 * LitGeometry::kBlock;
        data.positions.resize(count, data.positions[corner]);
        data.normals.resize(count, glm::vec3(0, 0, 1));
        data.direct.resize(count, Rgb(10));
        data.indirect.resize(count, Rgb(20));
        for (std::uint32_t& v : data.indices)
            if (v == corner) v = own;
    });
    surface.show(1);
    EXPECT_EQ(surface.direct(own), 100) << "what was shown at the corner";
    surface.show(1.25);
    EXPECT_EQ(surface.direct(own), 10);
}

TEST(LightFade, AVertexThatIsGivenToAnotherCornerBeginsWithTheLightThere) {
    // Vertices are handed out again in the same update in which they are given back.
    Surface surface(3, 0);
    surface.publish(0, 300), surface.publish(1, 500);
    surface.show(1), surface.show(2);
    const std::uint32_t own = 2 * LitGeometry::kBlock + 3;
    surface.geometry.setTopology([&](LitMeshData& data) {
        for (std::uint32_t& v : data.indices) v = v == own ? 5 : v == 70 ? own : v;
    });
    surface.show(3);
    EXPECT_EQ(surface.direct(own), 500) << "of vertex 70, whose corners it has now";
    EXPECT_EQ(surface.direct(5), 300) << "it has its old corners, too";
    ASSERT_EQ(surface.fade.shown().adopted.size(), 1u);
    EXPECT_EQ(surface.fade.shown().adopted[0].vertex, own);
    EXPECT_EQ(surface.fade.shown().adopted[0].from, 70u);
}

/// A strip in which the last corner, of vertex 5 in the first block, comes to be drawn with vertex
/// 70 of the second, which others have as well.
struct ReturnedCorner : Surface {
    explicit ReturnedCorner(std::size_t lights) : Surface(2, lights) {
        setLast(5);
        show(0);
    }
    void setLast(std::uint32_t vertex) {
        geometry.setTopology([&](LitMeshData& data) { data.indices.back() = vertex; });
    }
    /// What is shown there.
    float corner() const {
        const ShownLight& shown = fade.shown();
        const auto last = std::uint32_t(geometry.data().indices.size() - 1);
        for (const auto& [entry, copy] : shown.corners.entries)
            if (entry == last) return shown.direct[geometry.data().positions.size() + copy].r;
        return shown.direct[geometry.data().indices.back()].r;
    }
};

TEST(LightFade, ACornerThatIsDrawnWithASharedVertexAgainGoesToItsLightWithoutAJump) {
    ReturnedCorner surface(0);
    surface.publish(0, 300), surface.publish(1, 500);
    surface.show(1), surface.show(2);
    surface.setLast(70);
    surface.show(3);
    EXPECT_EQ(surface.corner(), 300) << "what was shown there";
    EXPECT_EQ(surface.direct(70), 500) << "others have it as it is";
    ASSERT_EQ(surface.fade.shown().corners.copies.size(), 1u);
    EXPECT_EQ(surface.fade.shown().corners.copies[0], 70u);
    surface.show(3.125);
    EXPECT_NEAR(surface.corner(), 400, 1e-3f);
    EXPECT_TRUE(surface.fade.changing());
    surface.setLast(5); // touched again
    surface.show(3.125);
    EXPECT_NEAR(surface.corner(), 400, 1e-3f);
    surface.show(3.375);
    EXPECT_EQ(surface.corner(), 300);
    EXPECT_TRUE(surface.fade.shown().corners.empty());
    EXPECT_FALSE(surface.fade.changing());
}

TEST(LightFade, ACornerThatIsDrawnWithASharedVertexAgainWaitsForItsLight) {
    // The vertex was covered, and its new light comes later than the triangles: a corner that went
    // to the old light first would be dark in between.
    ReturnedCorner surface(1);
    surface.publish(0, 300), surface.publish(1, 0);
    surface.show(1), surface.show(2);
    surface.setLast(70);
    surface.publish(1, 280, Known::stale);
    surface.show(3), surface.show(3.2);
    EXPECT_EQ(surface.corner(), 300);
    surface.publish(1, 280);
    surface.show(4), surface.show(4.125);
    EXPECT_NEAR(surface.corner(), 290, 1e-3f);
    surface.show(4.25);
    EXPECT_EQ(surface.corner(), 280);
}

TEST(LightFade, ACornerThatIsDrawnWithASharedVertexAgainFadesWithItEachTime) {
    // Its light comes in two parts. A vertex that takes the first one alone is dark in between.
    ReturnedCorner surface(0);
    surface.publish(0, 300), surface.publish(1, 0);
    surface.show(1), surface.show(2);
    surface.setLast(70);
    surface.publish(1, 10);
    surface.show(3), surface.show(3.01);
    const float then = surface.corner();
    EXPECT_GT(then, 295);
    surface.publish(1, 300);
    surface.show(3.01), surface.show(3.135);
    EXPECT_NEAR(surface.corner(), (then + 300) / 2, 1e-3f);
    surface.show(3.26);
    EXPECT_EQ(surface.corner(), 300);
}

TEST(LightFade, ACornerThatIsDrawnWithASharedVertexAgainKeepsNoLightOfLiveLights) {
    // At both it is brought up to date to the same: 300 and 0.5 of the light's 100, 120 and 0.25.
    ReturnedCorner surface(1);
    const auto publish = [&](std::size_t block, float direct, float factor) {
        surface.geometry.setBlock(block, [&](LitMeshData& data, LightShares& shares) {
            for (std::size_t v = block * LitGeometry::kBlock; v < (block + 1) * LitGeometry::kBlock;
                 ++v)
                data.direct[v] = Rgb(direct), shares[0].factor[v] = factor;
            shares[0].exitance.assign(2, Rgb(100));
        });
    };
    publish(0, 300, 0.5f), publish(1, 120, 0.25f);
    surface.show(1), surface.show(2);
    surface.setLast(70);
    surface.show(3);
    EXPECT_EQ(surface.corner(), 275) << "250 of other lights, and what the vertex has of this one";
    EXPECT_EQ(surface.fade.shown().factors.back()[0], 0.25f);
}

TEST(LightFade, GoesOnFromWhatWasShownWhenTheSurfaceComesAnew) {
    Surface before, after;
    before.publish(0, 300);
    before.show(1);
    before.show(1.125);
    after.fade.takeOver(before.fade);
    after.show(1.125);
    EXPECT_NEAR(after.direct(), 200, 1e-3f);
    after.show(1.375);
    EXPECT_EQ(after.direct(), 100) << "the light that it carries";
}

TEST(LightFade, OnlyBlocksThatChangeAreUploaded) {
    Surface surface(3);
    const std::vector<std::uint64_t> before = surface.fade.shown().blockRevisions;
    surface.publish(1, 200);
    for (double t = 1; t < 2; t += 0.05) surface.show(t);
    EXPECT_EQ(surface.fade.shown().blockRevisions[0], before[0]);
    EXPECT_GT(surface.fade.shown().blockRevisions[1], before[1]);
    EXPECT_EQ(surface.fade.shown().blockRevisions[2], before[2]);
}

RC_GTEST_PROP(LightFadeProperty, AFadeIsMonotoneAndAsFastAsSmoothstepAtMost, ()) {
    Surface surface;
    surface.publish(0, 200);
    surface.show(0);
    float last = surface.direct();
    double time = 0;
    while (time < 0.3) {
        const double step = *rc::gen::inRange(1, 40) * 1e-3;
        time += step;
        surface.show(time);
        const float now = surface.direct();
        RC_ASSERT(now >= last - 1e-4f);
        RC_ASSERT(now - last <= float(100 * 1.5 * step / 0.25) + 1e-3f);
        last = now;
    }
    RC_ASSERT(last == 200);
}

RC_GTEST_PROP(LightFadeProperty, TheFrameRateMakesNoDifference, ()) {
    // Fades start at the frame in which light comes; from there on only the time counts.
    Surface often, seldom;
    double time = 0;
    for (int i = 0; i < 4; ++i) {
        const float light = float(*rc::gen::inRange(0, 500));
        often.publish(0, light), seldom.publish(0, light);
        often.show(time), seldom.show(time);
        const double until = time + *rc::gen::inRange(10, 400) * 1e-3;
        for (; time < until; time += 0.004) often.show(time);
        time = until;
    }
    often.show(time), seldom.show(time);
    RC_ASSERT(std::abs(often.direct() - seldom.direct()) < 1e-2f);
}

RC_GTEST_PROP(LightFadeProperty, NothingJumpsHoweverItIsInterrupted, ()) {
    Surface surface(2);
    double time = 0;
    std::vector<float> last(128, 100);
    for (int i = 0; i < 60; ++i) {
        const auto block = std::size_t(*rc::gen::inRange(0, 2));
        if (*rc::gen::inRange(0, 3) == 0)
            surface.publish(block, float(*rc::gen::inRange(0, 500)),
                            *rc::gen::element(Known::exact, Known::stale, Known::no));
        const double step = *rc::gen::inRange(0, 20) * 1e-3;
        time += step;
        surface.show(time, *rc::gen::inRange(0, 4) != 0);
        for (std::size_t v = 0; v < last.size(); ++v) {
            const float now = surface.direct(v);
            RC_ASSERT(std::abs(now - last[v]) <= float(500 * 1.5 * step / 0.25) + 1e-2f);
            last[v] = now;
        }
    }
    surface.publish(0, 70), surface.publish(1, 70);
    surface.show(time + 1), surface.show(time + 2);
    RC_ASSERT(surface.direct(3) == 70);
    RC_ASSERT(surface.direct(100) == 70);
    RC_ASSERT(!surface.fade.changing());
}

} // namespace

} // namespace penumbra
