// A session as a layer, and back.
#include "io/usd/recording/UsdRecording.h"

#include "io/image/PngEncoder.h"
#include "scenegraph/Mesh.h"
#include "scenegraph/Objects.h"
#include "tests/support/TemporaryFolder.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace penumbra {

namespace {

constexpr const char* kRoom = R"(#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 0.01
    upAxis = "Z"
)
def Xform "World"
{
    double penumbra:patchSize = 50
    def Material "Paint"
    {
        token outputs:surface.connect = </World/Paint/Surface.outputs:surface>
        def Shader "Surface"
        {
            uniform token info:id = "UsdPreviewSurface"
            color3f inputs:diffuseColor = (0.2, 0.3, 0.4)
            float inputs:metallic = 0.5
            token outputs:surface
        }
    }
    def Xform "Group"
    {
        double3 xformOp:translate = (100, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
        def Cube "Seat"
        {
            double size = 40
            rel material:binding = </World/Paint>
            bool penumbra:movable = 1
            double3 xformOp:translate = (10, 20, 30)
            float xformOp:rotateZ = -24
            uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateZ"]
        }
    }
    def Cube "Bin"
    {
        double size = 10
        color3f[] primvars:displayColor = [(0.5, 0.1, 0.1)]
    }
    def Cube "Stone"
    {
        double size = 10
    }
    def RectLight "Lamp"
    {
        color3f inputs:color = (1, 0.5, 0.25)
        float inputs:intensity = 100
        float inputs:exposure = 2
        double3 xformOp:translate = (0, 0, 200)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def Camera "Eye"
    {
        float focalLength = 20
        float2 clippingRange = (1, 10000)
        double3 xformOp:translate = (0, -300, 150)
        float xformOp:rotateX = 80
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateX"]
    }
}
)";

/// A folder with a scene in it, loaded, and a recording of it.
class UsdRecordingTest : public testing::Test {
protected:
    void SetUp() override {
        std::filesystem::create_directories(folder / "takes");
        open(kRoom);
    }

    void open(const std::string& text) {
        std::ofstream(folder / "room.usda") << text;
        scene = loadUsdScene(folder / "room.usda");
        recording = std::make_unique<UsdRecording>(scene, folder / "room.usda");
    }
    template <class T>
    std::shared_ptr<T> at(const std::vector<T>&) const;

    Transform& place(const std::string& prim) const {
        for (const auto& address : scene.addresses.transforms)
            if (address.prim == prim) return *address.node;
        throw std::runtime_error("no place " + prim);
    }
    Light& light() const { return *scene.addresses.lights.at(0).light; }
    Material& paint(const std::string& shader) const {
        for (const auto& address : scene.addresses.paints)
            if (address.shader == shader) return *address.material;
        throw std::runtime_error("no paint " + shader);
    }
    static glm::dmat4 eye(double x) { return glm::translate(glm::dmat4(1.0), {x, -3, 1.5}); }
    Lens lens() const {
        Lens metres = scene.addresses.eyes.empty() ? Lens{} : scene.addresses.eyes[0].node->lens();
        metres.clippingRange *= 0.01f;
        return metres;
    }
    void sample(double seconds, double x = 0) { recording->sample(seconds, eye(x), lens()); }

    /// The session, loaded again, at a time.
    LoadedScene replay(double seconds) {
        const auto layer = folder / "takes" / "take.usda";
        recording->write(layer);
        LoadedScene loaded = loadUsdScene(layer);
        if (loaded.animation) loaded.animation->setTime(1 + seconds * UsdRecording::kRate);
        EXPECT_TRUE(loaded.diagnostics.empty())
            << loaded.diagnostics.front().line() << recording->text(layer);
        return loaded;
    }

    const TemporaryFolder temporary;
    const std::filesystem::path folder = temporary.path();
    LoadedScene scene;
    std::unique_ptr<UsdRecording> recording;
};

double distance(const glm::dmat4& a, const glm::dmat4& b) {
    double most = 0;
    for (int i = 0; i < 4; ++i) most = std::max(most, glm::distance(a[i], b[i]));
    return most;
}

const Placed<Mesh>& meshAt(const PlacedScene& placed, const std::string& path) {
    for (const auto& mesh : placed.meshes)
        if (mesh.path == path) return mesh;
    throw std::runtime_error("no mesh " + path);
}

TEST_F(UsdRecordingTest, PlaysWhatWasMovedWhereAndWhenItWasMoved) {
    Transform& seat = place("/World/Group/Seat");
    const glm::dmat4 before = seat.matrix();
    sample(0);
    sample(1);
    seat.setMatrix(glm::rotate(glm::translate(before, {50, -10, 0}), 1.0, {0.6, 0, 0.8}));
    const glm::dmat4 after = placeScene(*scene.scene).objects[1].toWorld;
    sample(2);
    sample(3);
    const std::string path = "/World/Group/Seat";
    const auto toWorld = [&](double seconds) {
        const LoadedScene loaded = replay(seconds);
        return meshAt(placeScene(*loaded.scene), path).toWorld;
    };
    EXPECT_LT(distance(toWorld(0), toWorld(1.9)), 1e-15) << "it stood still until then";
    EXPECT_LT(distance(toWorld(2), meshAt(placeScene(*scene.scene), path).toWorld), 1e-12);
    EXPECT_LT(distance(toWorld(3), toWorld(2)), 1e-15);
    EXPECT_GT(distance(toWorld(0), toWorld(2)), 0.1);
    const LoadedScene loaded = replay(3);
    const PlacedScene placed = placeScene(*loaded.scene);
    EXPECT_EQ(placed.objects[meshAt(placed, path).object.value].path, path);
    EXPECT_DOUBLE_EQ(loaded.asked.patchSize.value_or(0), 0.5)
        << "what the default prim says still counts";
    EXPECT_EQ(loaded.scene->endTimeCode, 91);
    static_cast<void>(after);
}

TEST_F(UsdRecordingTest, WhatAReferenceBroughtIsWrittenWhereTheStageHasIt) {
    std::ofstream(folder / "set.usda") << kRoom;
    open("#usda 1.0\n(\n    defaultPrim = \"Room\"\n    metersPerUnit = 0.01\n    upAxis = "
         "\"Z\"\n)\n"
         "def \"Room\" (\n    references = @set.usda@</World>\n)\n{\n}\n");
    EXPECT_EQ(scene.files.size(), 2u);
    Transform& seat = place("/Room/Group/Seat");
    sample(0);
    sample(1);
    seat.setMatrix(glm::translate(seat.matrix(), {50, -10, 0}));
    paint("/Room/Paint/Surface").setReflectance(Rgb(0.1f, 0.6f, 0.2f));
    sample(2);
    const LoadedScene loaded = replay(2);
    const PlacedScene placed = placeScene(*loaded.scene);
    const auto& mesh = meshAt(placed, "/Room/Group/Seat");
    EXPECT_LT(distance(mesh.toWorld, meshAt(placeScene(*scene.scene), "/Room/Group/Seat").toWorld),
              1e-12);
    const Rgb colour = mesh.node->data().materials.at(0)->reflectance();
    EXPECT_LT(maxChannel(absolute(colour - Rgb(0.1f, 0.6f, 0.2f))), 1e-5f);
}

TEST_F(UsdRecordingTest, PlaysLightsThatWereDimmedRecolouredAndSwitchedOff) {
    const Rgb before = light().luminance();
    sample(1);
    light().setLuminance({30, 20, 60});
    sample(2);
    light().setLuminance(Rgb());
    sample(3);
    const auto nits = [&](double seconds) {
        const LoadedScene loaded = replay(seconds);
        return loaded.addresses.lights.at(0).light->luminance();
    };
    const auto expectNear = [](Rgb a, Rgb b) {
        EXPECT_LT(maxChannel(absolute(a - b)), 1e-5f * maxChannel(b) + 1e-6f);
    };
    expectNear(nits(0.5), before);
    expectNear(nits(2), {30, 20, 60});
    expectNear(nits(3), Rgb());
}

TEST_F(UsdRecordingTest, PlaysRepaintedMaterialsAndColoursOfMeshesWithoutOne) {
    Material& shared = paint("/World/Paint/Surface");
    const Rgb before = shared.reflectance();
    const auto colourOf = [&](double seconds, const char* path) {
        const LoadedScene loaded = replay(seconds);
        return meshAt(placeScene(*loaded.scene), path).node->materialOf(0)->reflectance();
    };
    sample(1);
    shared.setReflectance({0.9f, 0.1f, 0.2f});
    for (const auto& address : scene.addresses.paints)
        if (address.shader.empty() && address.meshes.at(0) == "/World/Bin")
            address.material->setReflectance({0.1f, 0.8f, 0.1f});
    sample(2);
    EXPECT_EQ(colourOf(0, "/World/Group/Seat"), before) << "metallic and all";
    EXPECT_EQ(colourOf(2, "/World/Group/Seat"), Rgb(0.9f, 0.1f, 0.2f));
    EXPECT_EQ(colourOf(0, "/World/Bin"), Rgb(0.5f, 0.1f, 0.1f));
    EXPECT_EQ(colourOf(2, "/World/Bin"), Rgb(0.1f, 0.8f, 0.1f));
    EXPECT_EQ(colourOf(2, "/World/Stone"), Rgb(0.5f)) << "untouched";
    EXPECT_TRUE(recording->missed().empty());
}

/// A wall whose colour is a texture's, times a scale; with connected inputs of other kinds.
std::string texturedWall(const std::string& texture, const std::string& more = "") {
    return R"(#usda 1.0
(
    metersPerUnit = 1
)
def Mesh "Wall" (
    prepend apiSchemas = ["MaterialBindingAPI"]
)
{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (
        interpolation = "vertex"
    )
    uniform token subdivisionScheme = "none"
    rel material:binding = </M>
}
def Material "M"
{
    token outputs:surface.connect = </M/S.outputs:surface>
    float inputs:metal = 0.5
    def Shader "S"
    {
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor.connect = </M/T.outputs:rgb>
        float inputs:metallic.connect = </M.inputs:metal>
)" + more + R"(
        token outputs:surface
    }
    def Shader "T"
    {
        uniform token info:id = "UsdUVTexture"
        asset inputs:file = @a.png@
        float2 inputs:st.connect = </M/R.outputs:result>
        token inputs:wrapS = "repeat"
        token inputs:wrapT = "repeat"
        token inputs:sourceColorSpace = "raw"
)" + texture +
           R"(
        float3 outputs:rgb
    }
    def Shader "R"
    {
        uniform token info:id = "UsdPrimvarReader_float2"
        string inputs:varname = "st"
        float2 outputs:result
    }
}
)";
}

/// What a material reflects, on the mean.
Rgb shownBy(const Material& material) {
    const auto& texture = material.textures().reflectance;
    return material.reflectance() * (texture ? texture->mean() : Rgb(1));
}

TEST_F(UsdRecordingTest, RepaintedTexturesAreReadAgainAsTheyWereShown) {
    const auto png = encodePng(2, 1, std::vector<std::uint8_t>{255, 0, 102, 51, 255, 102});
    std::ofstream(folder / "a.png", std::ios::binary)
        .write(reinterpret_cast<const char*>(png.data()), std::streamsize(png.size()));
    const std::string glow = "        color3f inputs:emissiveColor.connect = </M/T.outputs:rgb>";
    const struct {
        std::string texture, more;
        bool kept; ///< whether it is a texture still
    } cases[] = {{"", "", true},
                 {"        float4 inputs:scale = (0.5, 0.25, 1, 0.75)", "", true},
                 {"        float4 inputs:scale = (0.5, 0.25, 1, 1)\n"
                  "        float4 inputs:bias = (0.1, 0.2, 0, 0)",
                  "", false},
                 {"", glow, false}};
    for (const auto& [texture, more, kept] : cases) {
        SCOPED_TRACE(texture + more);
        open(texturedWall(texture, more));
        ASSERT_TRUE(scene.diagnostics.empty()) << scene.diagnostics.front().line();
        const Material& painted = paint("/M/S");
        const Rgb before = shownBy(painted);
        sample(1);
        paint("/M/S").setReflectance({0.3f, 0.6f, 0.2f});
        sample(2);
        const auto shown = [&](double seconds) {
            const LoadedScene loaded = replay(seconds);
            const Material& material =
                *meshAt(placeScene(*loaded.scene), "/Wall").node->materialOf(0);
            EXPECT_EQ(bool(material.textures().reflectance), kept);
            return shownBy(material);
        };
        EXPECT_LT(maxChannel(absolute(shown(0.5) - before)), 1e-5f);
        EXPECT_LT(maxChannel(absolute(shown(2) - shownBy(painted))), 1e-5f);
        EXPECT_GT(maxChannel(absolute(shown(2) - before)), 0.01f);
    }
}

TEST_F(UsdRecordingTest, TheFirstCameraOfTheFileWalksThePathThatWasWalked) {
    for (int i = 0; i <= 60; ++i) sample(i / 30.0, 0.1 * i);
    for (const double seconds : {0.0, 1.0, 2.0}) {
        const LoadedScene loaded = replay(seconds);
        const auto cameras = placeScene(*loaded.scene).cameras;
        ASSERT_EQ(cameras.size(), 1u);
        EXPECT_LT(distance(cameras[0].toWorld * glm::scale(glm::dmat4(1.0), glm::dvec3(100)),
                           eye(3 * seconds)),
                  1e-9);
        EXPECT_EQ(cameras[0].node->lens().focalLength, 20);
    }
}

TEST_F(UsdRecordingTest, AFileWithoutACameraGetsOne) {
    open("#usda 1.0\n(\n    metersPerUnit = 1\n)\ndef Cube \"C\"\n{\n}\n");
    sample(0, 1);
    sample(1, 2);
    const LoadedScene loaded = replay(1);
    const auto cameras = placeScene(*loaded.scene).cameras;
    ASSERT_EQ(cameras.size(), 1u);
    EXPECT_LT(distance(cameras[0].toWorld, eye(2)), 1e-12);
}

TEST_F(UsdRecordingTest, WhatTheFileItselfMovesStandsAsItStoodInTheSession) {
    std::string text = kRoom;
    const std::string still = "double3 xformOp:translate = (10, 20, 30)";
    text.replace(text.find(still), still.size(),
                 "double3 xformOp:translate.timeSamples = { 1: (10, 20, 30), 100: (99, 20, 30) }");
    open(text);
    const auto path = "/World/Group/Seat";
    const glm::dmat4 stood = meshAt(placeScene(*scene.scene), path).toWorld;
    sample(0);
    sample(2);
    const LoadedScene loaded = replay(2);
    EXPECT_LT(distance(meshAt(placeScene(*loaded.scene), path).toWorld, stood), 1e-12);
}

TEST_F(UsdRecordingTest, ShearedAndMirroredPlacesAreWrittenAsMatrices) {
    Transform& seat = place("/World/Group/Seat");
    sample(1);
    glm::dmat4 sheared = seat.matrix();
    sheared[1] += 0.5 * sheared[0];
    sheared[2] = -sheared[2];
    seat.setMatrix(sheared);
    const auto path = "/World/Group/Seat";
    sample(2);
    const LoadedScene loaded = replay(2);
    EXPECT_LT(distance(meshAt(placeScene(*loaded.scene), path).toWorld,
                       meshAt(placeScene(*scene.scene), path).toWorld),
              1e-12);
}

TEST_F(UsdRecordingTest, AnUntouchedSessionSaysNothingButTheCamera) {
    sample(0);
    sample(5);
    const std::string text = recording->text(folder / "take.usda");
    EXPECT_NE(text.find("@./room.usda@"), text.npos);
    EXPECT_EQ(text.find("Seat"), text.npos);
    EXPECT_EQ(text.find("timeSamples"), text.npos);
}

TEST_F(UsdRecordingTest, ASceneWithAnOddNameIsFoundAgain) {
    const auto odd = folder / "ro@o\"m.usda";
    std::filesystem::copy_file(folder / "room.usda", odd);
    const LoadedScene loaded = loadUsdScene(odd);
    const UsdRecording other(loaded, odd);
    other.write(folder / "odd.usda");
    EXPECT_EQ(loadUsdScene(folder / "odd.usda").files.back().lexically_normal(), odd);
}

} // namespace

} // namespace penumbra
