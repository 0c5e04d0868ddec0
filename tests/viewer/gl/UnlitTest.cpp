// How a scene is drawn before radiosity: UnlitGeometry, UnlitLighting.
#include "viewer/gl/UnlitGeometry.h"
#include "viewer/gl/UnlitLighting.h"

#include "tests/scenegraph/SceneParts.h"

#include <gtest/gtest.h>

#include <numbers>

namespace penumbra {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;

TEST(UnlitGeometry, CutsFacesIntoTrianglesByMaterialAndLeavesHolesOpen) {
    MeshData mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}};
    mesh.faceVertexCounts = {4, 3, 4};
    mesh.faceVertexIndices = {0, 1, 2, 3, 1, 4, 5, 1, 4, 5, 2};
    mesh.materials = {std::make_shared<Material>("a"), std::make_shared<Material>("b")};
    mesh.faceMaterial = {1, 0, 1};
    mesh.scheme = SubdivisionScheme::catmullClark;
    mesh.holes = {2};
    const FaceTriangles triangles = faceTriangles(mesh);
    EXPECT_EQ(triangles.indices.size(), 9u);
    ASSERT_EQ(triangles.ranges.size(), 2u);
    EXPECT_EQ(triangles.ranges[0].material, 0u);
    EXPECT_EQ(triangles.ranges[0].indexCount, 3u);
    EXPECT_EQ(triangles.ranges[1].firstIndex, 3u);
    EXPECT_EQ(triangles.ranges[1].indexCount, 6u);
}

TEST(UnlitGeometry, TakesTheNormalsOfTheFileAsThoseOfTheFront) {
    MeshData mesh = square("square")->data(); // faces +z
    EXPECT_TRUE(frontNormals(mesh).empty()) << "flat";
    const glm::vec3 up(0, 0, 1), aside = glm::normalize(glm::vec3(1, 0, 1));
    mesh.normals = {up, aside, glm::vec3(0), up};
    EXPECT_EQ(frontNormals(mesh), (std::vector<glm::vec3>{up, aside, up, up}));
    mesh.normals = {-up, -aside, -aside, -up};
    EXPECT_EQ(frontNormals(mesh), (std::vector<glm::vec3>{up, aside, aside, up}));
}

TEST(UnlitLighting, ALightGivesItsIlluminanceFarAwayAndTheMeanSpreadsItsFlux) {
    // A rectangle of 1 m^2 and 100 nit sends pi * 100 lm, 100 cd straight ahead.
    Scene scene;
    scene.root->add(polygon("room", {{-2, -2, 0}, {2, -2, 0}, {2, 2, 4}, {-2, 2, 4}}));
    scene.root->add(placed("hook", glm::translate(glm::dmat4(1.0), {0, 0, 3}), {light("lamp")}));
    const UnlitLighting lighting = unlitLighting(placeScene(scene));
    ASSERT_EQ(lighting.lights.size(), 1u);
    EXPECT_FLOAT_EQ(lighting.lights[0].intensity.g, 100);
    EXPECT_EQ(lighting.lights[0].axis, glm::dvec3(0, 0, -1));
    EXPECT_NEAR(lighting.ambient.g, kPi * 100 / (6 * 16), 1e-3f) << "box of 4 m";
}

TEST(UnlitLighting, EmissiveFacesShineTooAndTheStrongestLightsAreTaken) {
    Scene scene;
    const auto screen = square("screen"); // 4 m^2, faces +z
    screen->data().materials[0]->setEmission(Rgb(10));
    scene.root->add(screen);
    for (int i = 0; i < 20; ++i)
        scene.root->add(
            std::make_shared<Light>("dim" + std::to_string(i), SphereShape{0.1f}, Rgb(float(i))));
    const UnlitLighting lighting = unlitLighting(placeScene(scene));
    ASSERT_EQ(lighting.lights.size(), UnlitLighting::kMostLights);
    EXPECT_FLOAT_EQ(lighting.lights[0].intensity.r, 40);
    EXPECT_EQ(lighting.lights[0].axis, glm::dvec3(0, 0, 1));
    EXPECT_EQ(lighting.lights[1].axis, glm::dvec3(0)) << "a sphere, all round";
    EXPECT_NEAR(lighting.lights[1].intensity.r, 19 * kPi * 0.01f, 1e-3f);
}

TEST(UnlitLighting, WithoutLightsThereIsAHeadlight) {
    Scene scene;
    scene.root->add(square("floor"));
    const UnlitLighting lighting = unlitLighting(placeScene(scene));
    EXPECT_TRUE(lighting.lights.empty());
    EXPECT_EQ(lighting.ambient, Rgb(100));
}

} // namespace

} // namespace penumbra
