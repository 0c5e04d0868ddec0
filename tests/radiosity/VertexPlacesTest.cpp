// The blocks of vertices, as places that a viewer may look at.
#include "radiosity/VertexPlaces.h"

#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

#include <numbers>

namespace penumbra {

namespace {

/// A floor of 4 x 4 m with a lamp over it, and a box that can be moved.
struct Floor {
    Scene scene;
    std::shared_ptr<Transform> box = movable(
        "box",
        {std::make_shared<Mesh>("mesh", boxData({-0.5f, -0.5f, 0}, {0.5f, 0.5f, 1}, false))});
    std::shared_ptr<Material> cloth = paint(Rgb(0.5f));
    Floor() {
        scene.root->add(object("floor", floorData(-2, 2, -2, 2, 0, cloth)));
        scene.root->add(ceilingLamp({0, 0, 3}, 1, 1, Rgb(100)));
        box->setMatrix(moved(9, 0, 0));
        scene.root->add(box);
    }
};
constexpr MeshingOptions kMeshing{.patchSize = 0.5f, .elementSize = 0.125f};
constexpr SolverOptions kDirect{.directOnly = true};

/// All places of an object.
std::vector<std::uint32_t> placesOf(const VertexPlaces& places, const PatchSet& patches,
                                    const std::string& path) {
    std::vector<std::uint32_t> result;
    for (std::uint32_t b = 0; b < places.placeOf().size(); ++b) {
        const std::uint32_t place = places.placeOf()[b];
        if (patches.objects[patches.vertexBlockObject[b].value].path == path &&
            (result.empty() || result.back() != place))
            result.push_back(place);
    }
    return result;
}

TEST(VertexPlaces, CoverTheSurfaceOnce) {
    const Solution solution(Floor().scene, kMeshing, kDirect);
    const VertexPlaces places(solution.patches(), 8);
    double area = 0;
    Bounds box;
    const auto ofFloor = placesOf(places, solution.patches(), "/floor");
    for (std::uint32_t place : ofFloor) {
        const WorkPlace known = places.at(place, solution.lighting.direct);
        std::size_t blocks = 0;
        for (std::uint32_t other : places.placeOf()) blocks += other == place;
        area += double(known.area) * double(blocks); // of an average block
        box.add(known.box);
        EXPECT_NEAR(known.normal.z, 1, 1e-5);
        EXPECT_NEAR(known.reflectance, 0.5, 1e-5);
    }
    EXPECT_NEAR(area, 16, 0.01);
    EXPECT_NEAR(box.size().x, 4, 0.1);
}

TEST(VertexPlaces, ShowTheLightThatIsThere) {
    const Solution solution(Floor().scene, kMeshing, kDirect);
    const VertexPlaces places(solution.patches(), 2000);
    for (std::uint32_t place : placesOf(places, solution.patches(), "/floor")) {
        const WorkPlace known = places.at(place, solution.lighting.direct);
        double sum = 0, count = 0; // over all of its vertices
        for (std::uint32_t b = 0; b < places.placeOf().size(); ++b)
            for (std::uint32_t v = b * PatchSet::kBlock; v < (b + 1) * PatchSet::kBlock; ++v)
                if (places.placeOf()[b] == place &&
                    !isPadding(solution.patches().vertices[v].receiver))
                    sum += luminance(solution.lighting.direct[v]), count += 1;
        const double expected = 0.5 * sum / count / std::numbers::pi;
        EXPECT_NEAR(known.luminance, expected, 0.3 * expected);
    }
}

TEST(VertexPlaces, FollowWhatIsMoved) {
    Floor floor;
    LitScene lit(placeScene(floor.scene), kMeshing, kDirect);
    VertexPlaces places(lit.patches());
    const auto ofBox = placesOf(places, lit.patches(), "/box");
    ASSERT_FALSE(ofBox.empty());
    const std::vector<Rgb> dark(lit.patches().vertices.size());
    const float before = places.at(ofBox[0], dark).box.centre().x;
    floor.box->setMatrix(moved(5, 0, 0));
    const auto followed = lit.follow(placeScene(floor.scene));
    ASSERT_FALSE(followed.rebuilt);
    places.follow(followed.change.objects);
    EXPECT_NEAR(places.at(ofBox[0], dark).box.centre().x, before - 4, 1e-4);
}

TEST(VertexPlaces, ReflectAsTheyWereRepaintedAndAreAsLarge) {
    Floor floor;
    LitScene lit(placeScene(floor.scene), kMeshing, kDirect);
    VertexPlaces places(lit.patches());
    const std::uint32_t place = placesOf(places, lit.patches(), "/floor")[0];
    const float area = places.known(place).area;
    floor.cloth->setReflectance(Rgb(0.2f));
    const auto followed = lit.follow(placeScene(floor.scene));
    ASSERT_TRUE(followed.change.colours);
    places.measure();
    EXPECT_NEAR(places.known(place).reflectance, 0.2, 1e-5);
    EXPECT_EQ(places.known(place).area, area);
}

TEST(VertexPlaces, AreSpokenForByVerticesSpreadOverThem) {
    const Solution solution(Floor().scene, kMeshing, kDirect);
    const VertexPlaces places(solution.patches(), 1);
    const std::uint32_t place = placesOf(places, solution.patches(), "/floor")[0];
    Bounds box;
    const std::vector<std::size_t> vertices = places.spread(place);
    for (const std::size_t v : vertices) {
        EXPECT_EQ(places.placeOf()[v / PatchSet::kBlock], place);
        EXPECT_FALSE(isPadding(solution.patches().vertices[v].receiver));
        box.add(solution.patches().vertices[v].receiver.position);
    }
    EXPECT_GE(vertices.size(), 6u);
    EXPECT_LE(vertices.size(), 10u);
    EXPECT_GT(box.size().x, 2); // of 4 m
    EXPECT_GT(box.size().y, 2);
}

} // namespace

} // namespace penumbra
