#include "io/usd/scene/UsdLight.h"

#include "tests/io/usd/UsdTestFiles.h"

#include <gtest/gtest.h>

#include <numbers>

namespace penumbra {

namespace {

constexpr double kPi = std::numbers::pi;

LoadedScene withLight(const std::string& type, const std::string& body,
                      const std::string& unit = "1") {
    return loadText("(metersPerUnit = " + unit + ")\ndef " + type + " \"l\"\n{\n" + body + "\n}\n");
}

// Red luminance of the light </l>.
float nits(const LoadedScene& loaded) {
    const auto nodes = nodesByPath(*loaded.scene);
    const PlacedNode* placed = leafOf(nodes, "/l");
    return placed && placed->light() ? placed->light()->luminance().r : -1;
}

float nits(const std::string& type, const std::string& body, const std::string& unit = "1") {
    return nits(withLight(type, body, unit));
}

const std::string kScale =
    "float3 xformOp:scale = (3, 2, 1)\nuniform token[] xformOpOrder = [\"xformOp:scale\"]\n";

} // namespace

TEST(UsdLight, BlackBodiesHaveTheColoursThatOpenUsdGivesThem) {
    // Kelvin, r, g, b of UsdLuxBlackbodyTemperatureAsRgb, OpenUSD 24.11.
    const double table[][4] = {{1000, 4.30550, .11836, 0},      {1500, 3.12852, .46823, 0},
                               {2000, 2.52057, .64689, .02040}, {2700, 1.93532, .80357, .19169},
                               {3000, 1.77103, .84429, .27203}, {4000, 1.41403, .92404, .53331},
                               {5000, 1.21351, .96054, .76214}, {6500, 1.04333, .98362, 1.03461},
                               {8000, .94715, .99180, 1.23682}, {10000, .87184, .99469, 1.43000}};
    for (const auto& [kelvin, r, g, b] : table) {
        const Rgb c = blackbodyColour(kelvin);
        EXPECT_NEAR(c.r, r, 0.006) << kelvin;
        EXPECT_NEAR(c.g, g, 0.006) << kelvin;
        EXPECT_NEAR(c.b, b, 0.006) << kelvin;
        EXPECT_NEAR(luminance(c), 1, 1e-5) << kelvin;
    }
    EXPECT_EQ(blackbodyColour(10), blackbodyColour(1000));
    EXPECT_EQ(blackbodyColour(1e9), blackbodyColour(10000));
    EXPECT_EQ(blackbodyColour(std::nan("")), blackbodyColour(1000));
}

TEST(UsdLight, LuminanceIsIntensityTimesTwoToTheExposure) {
    EXPECT_FLOAT_EQ(nits("RectLight", ""), 1);
    EXPECT_FLOAT_EQ(nits("RectLight", "float inputs:intensity = 250\nfloat inputs:exposure = 3"),
                    2000);
    EXPECT_FLOAT_EQ(
        nits("DiskLight", "color3f inputs:color = (0.5, 1, 1)\nfloat inputs:intensity = 10"), 5);
    EXPECT_FLOAT_EQ(nits("SphereLight", "float inputs:intensity.timeSamples = { 1: 10, 11: 20 }"),
                    10);
}

TEST(UsdLight, NormalizeDividesByTheAreaInTheWorld) {
    const std::string normalize = "bool inputs:normalize = 1\nfloat inputs:intensity = 1000\n";
    EXPECT_FLOAT_EQ(
        nits("RectLight", normalize + kScale + "float inputs:width = 2\nfloat inputs:height = 0.5"),
        float(1000 / 6.0));
    EXPECT_FLOAT_EQ(nits("DiskLight", normalize + "float inputs:radius = 0.1"),
                    float(1000 / (kPi * 0.01)));
    EXPECT_FLOAT_EQ(nits("SphereLight", normalize + "float inputs:radius = 0.1"),
                    float(1000 / (4 * kPi * 0.01)));
    // In scene units, whatever they are in metres.
    EXPECT_FLOAT_EQ(nits("RectLight", normalize, "0.01"), 1000);
}

TEST(UsdLight, AnEllipsoidsAreaIsThatOfTheFormula) {
    // Oblate spheroid, half axes 2, 2, 1: 2 pi a^2 (1 + (1 - e^2) / e * artanh e), e^2 = 3/4.
    const double e = std::sqrt(0.75);
    const double area = 2 * kPi * 4 * (1 + (1 - e * e) / e * std::atanh(e));
    EXPECT_NEAR(
        nits(
            "SphereLight",
            "bool inputs:normalize = 1\nfloat inputs:radius = 1\nfloat3 xformOp:scale = (2, 2, 1)\n"
            "uniform token[] xformOpOrder = [\"xformOp:scale\"]"),
        1 / area, 1e-3 / area);
}

TEST(UsdLight, ATubeSendsTheFluxOfItsCylinder) {
    const LoadedScene loaded = withLight(
        "CylinderLight",
        "float inputs:length = 1.2\nfloat inputs:radius = 0.5\nfloat inputs:intensity = 7");
    const auto nodes = nodesByPath(*loaded.scene);
    const Mesh* tube = nodes.at("/l").mesh();
    ASSERT_TRUE(tube);
    EXPECT_EQ(tube->faceCount(), 24u);
    EXPECT_NEAR(surfaceArea(*tube, glm::dmat4(1)), 2 * kPi * 0.5 * 1.2, 1e-5);
    EXPECT_EQ(tube->data().materials.at(0)->emission(), Rgb(7));
    EXPECT_EQ(tube->data().materials.at(0)->reflectance(), Rgb(0));
    // Faces look outwards: the normal of the first one has a positive part along its own position.
    const auto& p = tube->data().points;
    const auto& i = tube->data().faceVertexIndices;
    const glm::vec3 a = p[std::size_t(i[0])];
    const glm::vec3 n = glm::cross(p[std::size_t(i[1])] - a, p[std::size_t(i[2])] - a);
    EXPECT_GT(n.y * a.y + n.z * a.z, 0);
}

TEST(UsdLight, AMeshLightAddsItsLuminanceToItsMaterial) {
    const LoadedScene loaded =
        loadText("def Mesh \"m\" (prepend apiSchemas = [\"MeshLightAPI\"])\n{\n float "
                 "inputs:intensity = 40\n int[] faceVertexCounts = [4]\n"
                 " int[] faceVertexIndices = [0, 1, 2, 3]\n point3f[] points = [(0, 0, 0), (1, 0, "
                 "0), (1, 1, 0), (0, 1, 0)]\n"
                 " uniform token subdivisionScheme = \"none\"\n}\n");
    const Mesh* mesh = nodesByPath(*loaded.scene).at("/m").mesh();
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->data().materials.at(0)->emission(), Rgb(40));
    EXPECT_EQ(mesh->data().materials.at(0)->reflectance(), Rgb(0.5f));
}

TEST(UsdLight, WhatIsIgnoredIsSaid) {
    EXPECT_EQ(countOf(withLight("RectLight", "float intensity = 77"), "old light attribute"), 1u);
    EXPECT_EQ(countOf(withLight("RectLight", "float inputs:shaping:cone:angle = 30"), "shaping"),
              1u);
    EXPECT_EQ(countOf(withLight("RectLight", "float inputs:shaping:cone:angle = 180"), "shaping"),
              0u);
    EXPECT_EQ(countOf(withLight("RectLight", "asset inputs:texture:file = @a.exr@"), "texture"),
              1u);
    EXPECT_EQ(countOf(withLight("DistantLight", ""), "DistantLight not supported"), 1u);
    EXPECT_EQ(countOf(withLight("DomeLight", ""), "DomeLight not supported"), 1u);
}

TEST(UsdLight, LightsWithoutAreaOrWithNonsenseAreTamed) {
    for (const char* body :
         {"float inputs:width = 0", "float inputs:height = -1", "float inputs:width = nan",
          "float3 xformOp:scale = (0, 1, 1)\nuniform token[] xformOpOrder = [\"xformOp:scale\"]"})
        EXPECT_EQ(countOf(withLight("RectLight", body), "without area"), 1u) << body;
    EXPECT_EQ(nits("RectLight", "float inputs:intensity = -5"), 0);
    EXPECT_EQ(nits("RectLight", "float inputs:intensity = nan"), 0);
    EXPECT_EQ(nits("RectLight", "float inputs:exposure = 1e9"), 0);
}

TEST(UsdLight, InvisibleLightsAreDark) {
    EXPECT_EQ(nits("RectLight", "token visibility = \"invisible\""), -1);
}

TEST(UsdLight, AShapeThatIsToBeAMeshLightIsLeftDarkWithAWord) {
    const LoadedScene loaded =
        loadText("def Cube \"c\" (prepend apiSchemas = [\"MeshLightAPI\"])\n{\n}\n");
    EXPECT_EQ(countOf(loaded, "MeshLightAPI of a Cube left out"), 1u);
}

} // namespace penumbra
