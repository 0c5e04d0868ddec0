// Margins follow where things are and how finely they are cut, never how large the scene is: the
// light of a room is the same wherever it is, however large it is, and however its things came
// to be where they are.
#include "radiosity/rays/Margins.h"
#include "io/usd/scene/UsdAnimation.h"
#include "io/usd/scene/UsdScene.h"
#include "radiosity/query/LitSurface.h"
#include "tests/support/LitDifference.h"
#include "tests/support/Reference.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

constexpr MeshingOptions kCoarse{.patchSize = 0.6f, .elementSize = 0.15f};
constexpr SolverOptions kTight{.residual = 1e-4};

TEST(Margins, PlayedFramesAreThoseOfAFreshStartWhereAThingBeganFarOutside) {
    // A box comes in from 15 m away, and a light lies 0.1 mm above the ceiling: with margins of the
    // first frame's extent its light passed, with those of the last one it did not (45 %).
    const std::string file = dataFile("extent_of_first_frame.usda");
    const LoadedScene played = loadUsdScene(file);
    LitScene lit(placeScene(*played.scene), kCoarse, kTight);
    lit.solver().settle();
    for (const double frame : {1.0, 2.0, 3.0}) {
        played.animation->setTime(frame);
        lit.follow(placeScene(*played.scene));
        lit.solver().settle();
        const LoadedScene alone = loadUsdScene(file, {.time = frame});
        LitScene fresh(placeScene(*alone.scene), kCoarse, kTight);
        fresh.solver().settle();
        EXPECT_EQ(difference(lit, fresh), "") << "frame " << frame;
    }
}

TEST(Margins, OfAThingAreThoseItHasWithoutAnotherOneFarAway) {
    const auto room = [](bool chair) {
        Scene scene = sceneOf({object("room", boxData({0, 0, 0}, {4, 3, 2.5f}, true)),
                               ceilingLight({2, 1.5f, 2.45f}, 1, 0.6f)});
        if (chair) scene.root->add(object("far", boxData({300, 0, 0}, {301, 1, 1}, false)));
        return meshed(scene, kCoarse).patches;
    };
    const PatchSet without = room(false), with = room(true);
    ASSERT_EQ(without.objects[0].path, with.objects[0].path);
    const Range range = without.objects[0].vertices;
    ASSERT_EQ(range.count, with.objects[0].vertices.count);
    for (std::uint32_t v = 0; v < range.count; ++v)
        EXPECT_EQ(without.vertices[range.first + v].receiver.position,
                  with.vertices[with.objects[0].vertices.first + v].receiver.position);
}

/// A room with a box on its floor and one that hovers, `size` times as large, `away` from the
/// origin [m], and what some points of its surfaces receive [lux].
struct FurnishedRoom {
    double size = 1;
    glm::dvec3 away{0};

    std::vector<double> light() const {
        const glm::dmat4 place = moved(away.x, away.y, away.z) * scaled(size);
        const Solution solution(
            sceneOf({placed("place", place,
                            {object("room", boxData({0, 0, 0}, {4, 3, 2.5f}, true)),
                             object("chest", boxData({0.5f, 0.4f, 0}, {1.3f, 1.4f, 0.8f}, false)),
                             object("shelf", boxData({2, 2.6f, 1}, {3.2f, 3, 1.05f}, false)),
                             ceilingLight({2.2f, 1.5f, 2.45f}, 1, 0.6f, Rgb(100))})}),
            {.patchSize = float(0.6 * size), .elementSize = float(0.15 * size)}, kTight);
        const LitSurface surface(solution.patches(), solution.lighting);
        std::vector<double> light;
        const auto read = [&](glm::dvec3 at, glm::vec3 normal) {
            const auto found = surface.under(glm::vec3(place * glm::dvec4(at, 1)), normal);
            EXPECT_TRUE(found) << at.x << " " << at.y << " " << at.z;
            light.push_back(found ? luminance(found->direct + found->indirect) : 0);
        };
        for (const double x : {0.1, 0.45, 0.9, 1.35, 1.7, 2.5, 3.3, 3.9})
            for (const double y : {0.1, 0.35, 1.45, 2.2, 2.9}) {
                read({x, y, 0}, {0, 0, 1});
                read({x, 3, y * 0.8 + 0.03}, {0, -1, 0});
            }
        read({0.9, 0.9, 0.8}, {0, 0, 1});
        read({2.6, 2.8, 1}, {0, 0, -1});
        return light;
    }
};

/// \param mean, most of the differences, as a share of the light or of a twentieth of the mean
/// light
void expectSame(const FurnishedRoom& other, double mean, double most) {
    const std::vector<double> here = FurnishedRoom().light(), there = other.light();
    double sum = 0, largest = 0, level = 0;
    for (const double lux : here) level += lux / double(here.size());
    EXPECT_GT(level, 1);
    for (std::size_t i = 0; i < here.size(); ++i) {
        const double off = std::abs(there[i] - here[i]) / std::max(here[i], 0.05 * level);
        sum += off / double(here.size());
        largest = std::max(largest, off);
    }
    EXPECT_LT(sum, mean);
    EXPECT_LT(largest, most);
}

// A sample that runs along an edge falls on one side or the other: 1 of 64.

TEST(Margins, OfARoomAKilometreAwayGiveTheSameLight) {
    expectSame({.away = {1000, 0, 0}}, 1e-3, 0.02);
    expectSame({.away = {-700, 900, 300}}, 1e-3, 0.02);
}

TEST(Margins, OfARoomOfTenCentimetresGiveTheSameLight) {
    expectSame({.size = 0.025}, 1e-3, 0.02);
}

TEST(Margins, OfARoomOfAKilometreGiveTheSameLight) {
    expectSame({.size = 250}, 1e-3, 0.02);
}

TEST(Margins, HoldWhatIsLitFarAwayOffItsSurface) {
    // Rounding alone would put receivers a kilometre away on or below what they lie on.
    for (const double away : {0.0, 10.0, 1000.0, 30000.0}) {
        const Scene scene =
            sceneOf({placed("place", moved(away, away, away),
                            {object("floor", floorData(-0.37f, 0.73f, -0.41f, 0.69f, 0.123f))})});
        const PatchSet set = meshed(scene, {.patchSize = 0.05f, .elementSize = 0.025f}).patches;
        const float rounded = 10 * 0x1p-24f * float(away + 1); // see roundingAt()
        for (const Vertex& vertex : set.vertices) {
            if (isPadding(vertex.receiver)) continue;
            const float hover = vertex.receiver.position.z - vertex.position.z;
            EXPECT_GT(hover, 0);
            EXPECT_NEAR(hover, hoverAt(set.skin, vertex.position), rounded);
        }
    }
}

} // namespace

} // namespace penumbra
