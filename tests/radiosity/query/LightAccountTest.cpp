// Why it is dark at a point, read off the shadow-form-factor-list.
#include "radiosity/query/LightAccount.h"
#include "radiosity/query/LitSurface.h"
#include "radiosity/query/NearestDrawn.h"
#include "tests/support/EditedScenes.h"

#include <gtest/gtest.h>

#include <limits>

namespace penumbra {

namespace {

const MeshingOptions kFine{.patchSize = 1, .elementSize = 0.125f};

NodePtr lightAt(const std::string& name, double x, double y, double z, float nits) {
    return placed(name, moved(x, y, z),
                  {std::make_shared<Light>("light", RectShape{0.4f, 0.4f}, Rgb(nits))});
}

/// A floor of 4 x 4 m, a light 3 m over its middle and another to the side. A board of 1 x 1 m
/// hangs over the middle, one of 0.2 m deep over its right rim.
Solution boardsOverFloor() {
    return Solution(
        sceneOf({object("floor", floorData(-2, 2, -2, 2, 0)), lightAt("lamp", 0, 0, 3, 100),
                 lightAt("side", 1.5, 0, 3, 50),
                 object("board", boxData({-0.5f, -0.5f, 1}, {0.5f, 0.5f, 1.05f}, false)),
                 object("shelf", boxData({0.3f, -0.5f, 0.5f}, {0.5f, 0.5f, 0.52f}, false))}),
        kFine, {.directOnly = true});
}

std::vector<EmitterAccount> accountAt(const Solution& s, glm::vec3 point) {
    const DrawnHit at = nearestDrawn(s.patches(), point, 0.01f);
    EXPECT_TRUE(at.met());
    return accountForLight(s.patches(), s.solver.direct(), at);
}

const std::string& nameOf(const Solution& s, const LightLoss& loss) {
    return s.patches().objects[loss.object.value].path;
}

void expectNear(Rgb a, Rgb b, float allowed, const std::string& what) {
    EXPECT_LE(maxChannel(absolute(a - b)), allowed) << what << ": " << a.g << " " << b.g;
}

/// unoccluded = arrives + losses for every light, and what arrives is the direct light as drawn.
void expectAddsUp(const LitScene& lit, const DrawnHit& at) {
    Rgb arrives, drawn, most;
    for (const EmitterAccount& light : accountForLight(lit.patches(), lit.solver().direct(), at)) {
        Rgb sum = light.arrives;
        for (const LightLoss& loss : light.losses) {
            sum += loss.lux;
            EXPECT_GE(minChannel(loss.lux), 0);
        }
        expectNear(sum, light.unoccluded, 1e-5f * maxChannel(light.unoccluded), light.path);
        arrives += light.arrives;
        most += light.unoccluded;
    }
    for (std::size_t k = 0; k < 3; ++k)
        drawn += at.weights[k] * lit.solver().direct().vertices()[at.vertices[k]];
    expectNear(arrives, drawn, 1e-5f * maxChannel(most), "as drawn");
}

TEST(LightAccount, OfAPointInTheOpenNamesNobody) {
    const Solution s = boardsOverFloor();
    const auto lights = accountAt(s, {-1.5f, -1.5f, 0});
    ASSERT_EQ(lights.size(), 2u);
    for (const EmitterAccount& light : lights) {
        EXPECT_TRUE(light.losses.empty());
        EXPECT_EQ(light.unoccluded, light.arrives);
        EXPECT_GT(light.arrives.g, 0);
    }
    EXPECT_GT(lights[0].arrives.g, lights[1].arrives.g); // equal losses: who gives most comes first
}

TEST(LightAccount, OfAnUmbraChargesAllToTheOneObjectInTheWay) {
    const Solution s = boardsOverFloor();
    const auto lights = accountAt(s, {0, 0, 0});
    ASSERT_EQ(lights.size(), 2u);
    EXPECT_EQ(lights[0].path, "/lamp/light"); // who loses most comes first
    EXPECT_EQ(lights[0].arrives, Rgb());
    ASSERT_EQ(lights[0].losses.size(), 1u);
    EXPECT_EQ(nameOf(s, lights[0].losses[0]), "/board");
    // 0.16 m^2 of 100 nits from 3 m: E = L A cos cos / d^2 = 1.78 lux; the light's extent takes 1
    // %.
    EXPECT_NEAR(lights[0].unoccluded.g, 16.0 / 9.0, 0.02);
    expectNear(lights[0].losses[0].lux, lights[0].unoccluded, 1e-5f, "the board's");
}

TEST(LightAccount, ChargesAWallWithALightBehindItThatHasNoEntries) {
    // A ceiling over the floor, and the light above that.
    const Solution s(
        sceneOf({object("floor", floorData(-2, 2, -2, 2, 0)), lightAt("lamp", 0, 0, 3, 100),
                 object("ceiling", boxData({-6, -6, 1.5f}, {6, 6, 1.6f}, false))}),
        kFine, {.directOnly = true});
    const auto lights = accountAt(s, {0, 0, 0});
    ASSERT_EQ(lights.size(), 1u);
    EXPECT_EQ(lights[0].arrives, Rgb());
    EXPECT_NEAR(lights[0].unoccluded.g, 16.0 / 9.0, 0.02); // as without the ceiling, see above
    ASSERT_EQ(lights[0].losses.size(), 1u);
    EXPECT_EQ(nameOf(s, lights[0].losses[0]), "/ceiling");
    const DrawnHit at = nearestDrawn(s.patches(), {0, 0, 0}, 0.01f);
    for (const std::uint32_t v : at.vertices)
        EXPECT_FALSE(s.solver.direct()
                         .rows()[0][v / PatchSet::kBlock]
                         .entry(int(v % PatchSet::kBlock))
                         .present);
}

TEST(LightAccount, AddsUpInPenumbraeOfSeveralObjects) {
    const Solution s = boardsOverFloor();
    int mixed = 0, shared = 0;
    for (int i = -12; i <= 12; ++i) {
        const glm::vec3 p(0.11f * float(i), 0.23f, 0);
        const DrawnHit at = nearestDrawn(s.patches(), p, 0.01f);
        ASSERT_TRUE(at.met());
        expectAddsUp(s.lit, at);
        for (const EmitterAccount& light : accountAt(s, p)) {
            mixed += light.arrives.g > 0 && light.lost().g > 1e-3f;
            shared += light.losses.size() == 2 && light.losses[1].lux.g > 0;
        }
    }
    EXPECT_GT(mixed, 3); // else nothing was tried
    EXPECT_GT(shared, 0);
}

TEST(LightAccount, AddsUpAllOverARoomAfterEdits) {
    EditableRoom room(3);
    LitScene lit(placeScene(room.scene()), EditableRoom::meshing(), {.directOnly = true});
    for (int i = 0; i < 12; ++i) {
        room.edit();
        lit.follow(placeScene(room.scene()));
        lit.solver().settle();
        const PatchSet& set = lit.patches();
        for (std::uint32_t e = std::uint32_t(i); e < set.elements.size(); e += 17) {
            if (!set.receives(e)) continue;
            const auto& v = set.elements[e].vertices;
            expectAddsUp(lit, {e, {v[0], v[1], v[2]}, {0.2f, 0.3f, 0.5f}, 0});
        }
    }
}

TEST(LightAccount, SumsTheFacesOfALightThatGlows) {
    auto glow = paint(Rgb(0), Rgb(10));
    const Solution s(
        sceneOf({object("floor", floorData(-2, 2, -2, 2, 0)),
                 object("cube", boxData({-0.2f, -0.2f, 1}, {0.2f, 0.2f, 1.4f}, false, glow))}),
        kFine, {.directOnly = true});
    const auto lights = accountAt(s, {1, 0.3f, 0});
    ASSERT_EQ(lights.size(), 1u);
    EXPECT_GT(lights[0].arrives.g, 0);
}

TEST(NearestDrawn, IsTheSideThatShowsItsFront) {
    const Solution s = boardsOverFloor();
    const auto facing = [&](glm::vec3 point) {
        const DrawnHit at = nearestDrawn(s.patches(), point, 0.1f);
        return at.met() ? normalOf(s.patches(), at).z : 0;
    };
    EXPECT_EQ(facing({0.1f, 0.1f, 1.06f}), 1);
    EXPECT_EQ(facing({0.1f, 0.1f, 0.98f}), -1);
    EXPECT_EQ(facing({0.1f, 0.1f, 0.2f}), 0); // in the air
}

TEST(NearestDrawn, SaysWhereAndHowFar) {
    const Solution s = boardsOverFloor();
    const auto expectAt = [&](glm::vec3 point, glm::vec3 place) {
        const DrawnHit at = nearestDrawn(s.patches(), point, 0.2f);
        ASSERT_TRUE(at.met());
        EXPECT_LT(glm::distance(positionOf(s.patches(), at), place), 1e-5f);
        EXPECT_NEAR(at.distance, glm::distance(point, place), 1e-5f);
        EXPECT_NEAR(at.weights[0] + at.weights[1] + at.weights[2], 1, 1e-6f);
    };
    expectAt({-1.23f, 0.77f, 0.05f}, {-1.23f, 0.77f, 0});
    expectAt({-2.1f, 0.77f, 0.1f}, {-2, 0.77f, 0});     // beside an edge
    expectAt({-2.1f, -2.1f, 0.1f}, {-2, -2, 0});        // beside a corner
    expectAt({0.6f, 0.55f, 1.1f}, {0.5f, 0.5f, 1.05f}); // of a box
    EXPECT_FALSE(nearestDrawn(s.patches(), {-2.1f, 0, 0}, 0.05f).met());
}

TEST(NearestDrawn, OfCoplanarSurfacesTakesTheOneThatIsLit) {
    const Solution s(sceneOf({object("floor", floorData(-1, 1, -1, 1, 0)),
                              object("box", boxData({-0.5f, -0.5f, 0}, {0.5f, 0.5f, 0.4f}, false)),
                              lightAt("lamp", 0, 0, 3, 100)}),
                     kFine, {.directOnly = true});
    for (float x = -0.9f; x < 0.95f; x += 0.1f) {
        if (std::abs(x) < 0.5f) continue;
        const DrawnHit at = nearestDrawn(s.patches(), {x, 0.03f, 0}, 0.01f);
        ASSERT_TRUE(at.met());
        EXPECT_TRUE(s.patches().receives(at.element)) << x;
    }
}

} // namespace

} // namespace penumbra
