#include "io/image/PngEncoder.h"
#include "tests/io/usd/UsdTestFiles.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

/// Two pixels beside each other: red, and grey.
std::string png() {
    const auto bytes = encodePng(2, 1, std::vector<std::uint8_t>{255, 0, 0, 128, 128, 128});
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

struct Case {
    std::string texture = "asset inputs:file = @a.png@\n token inputs:wrapS = \"repeat\"";
    std::string surface = "color3f inputs:diffuseColor.connect = </M/T.outputs:rgb>";
    std::string coordinates = "texCoord2f[] primvars:st = [(0, 0), (2, 0), (2, 1), (0, 1)] (\n"
                              "interpolation = \"faceVarying\")";
    std::string st = "float2 inputs:st.connect = </M/R.outputs:result>";
    std::string mesh = {};
};

LoadedScene load(const Case& c) {
    const TemporaryFolder folder;
    folder.write("a.png", png());
    const std::string text =
        "#usda 1.0\n(metersPerUnit = 1)\ndef Mesh \"m\" (prepend apiSchemas = "
        "[\"MaterialBindingAPI\"])\n{\n int[] faceVertexCounts = [4]\n int[] faceVertexIndices = "
        "[0, 1, 2, 3]\n point3f[] points = [(0,0,0), (1,0,0), (1,1,0), (0,1,0)]\n uniform token "
        "subdivisionScheme = \"none\"\n rel material:binding = </M>\n" +
        c.coordinates + "\n" + c.mesh +
        "\n}\ndef Material \"M\"\n{\n token outputs:surface.connect = </M/S.outputs:surface>\n def "
        "Shader \"S\"\n {\n uniform token info:id = \"UsdPreviewSurface\"\n" +
        c.surface +
        "\n token outputs:surface\n }\n def Shader \"T\"\n {\n uniform token info:id = "
        "\"UsdUVTexture\"\n" +
        c.texture + "\n" + c.st +
        "\n float3 outputs:rgb\n float outputs:a\n }\n def Shader \"X\"\n {\n uniform token "
        "info:id = \"UsdTransform2d\"\n float2 inputs:in.connect = </M/R.outputs:result>\n float2 "
        "inputs:scale = (2, 3)\n float inputs:rotation = 90\n float2 inputs:translation = (0.25, "
        "0.5)\n float2 outputs:result\n }\n def Shader \"R\"\n {\n uniform token info:id = "
        "\"UsdPrimvarReader_float2\"\n string inputs:varname = \"st\"\n float2 outputs:result\n "
        "}\n}\n";
    return loadUsdScene(folder.write("scene.usda", text));
}

const MeshData& meshOf(const LoadedScene& loaded) {
    return leafOf(nodesByPath(*loaded.scene), "/m")->mesh()->data();
}

const Material& materialOf(const LoadedScene& loaded) {
    return *meshOf(loaded).materials.at(0);
}

bool warned(const LoadedScene& loaded, const std::string& part) {
    for (const Diagnostic& d : loaded.diagnostics)
        if (d.text.find(part) != std::string::npos && d.where.line > 0) return true;
    return false;
}

} // namespace

TEST(UsdTextures, AreReadWithTheirCoordinates) {
    const LoadedScene loaded = load({});
    EXPECT_TRUE(loaded.diagnostics.empty()) << summary(loaded.diagnostics);
    const auto texture = materialOf(loaded).textures().reflectance;
    ASSERT_TRUE(texture);
    EXPECT_EQ(texture->image->texel(0, 0, 0), Rgb(1, 0, 0));
    EXPECT_NEAR(texture->image->texel(0, 1, 0).r, 0.2159f, 1e-4f); // 128 of sRGB
    EXPECT_EQ(texture->wrapS, TextureWrap::repeat);
    EXPECT_EQ(texture->wrapT, TextureWrap::black); // what UsdUVTexture says of no metadata
    EXPECT_EQ(meshOf(loaded).uvs, (std::vector<glm::vec2>{{0, 0}, {2, 0}, {2, 1}, {0, 1}}));
    EXPECT_EQ(materialOf(loaded).reflectance(), Rgb(1));
    EXPECT_EQ(materialOf(loaded).textures().emission, nullptr);
}

TEST(UsdTextures, TakeCoordinatesOfAnyInterpolationAndWinding) {
    Case c;
    c.coordinates = "texCoord2f[] primvars:st = [(0, 0), (0.5, 1)] (interpolation = \"vertex\")\n"
                    "int[] primvars:st:indices = [1, 0, 0, 1]";
    EXPECT_EQ(meshOf(load(c)).uvs, (std::vector<glm::vec2>{{0.5f, 1}, {0, 0}, {0, 0}, {0.5f, 1}}));
    c.coordinates = Case().coordinates;
    c.mesh = "uniform token orientation = \"leftHanded\"";
    EXPECT_EQ(meshOf(load(c)).uvs, (std::vector<glm::vec2>{{0, 0}, {0, 1}, {2, 1}, {2, 0}}));
}

TEST(UsdTextures, AreScaledTurnedAndShiftedByUsdTransform2d) {
    Case c;
    c.st = "float2 inputs:st.connect = </M/X.outputs:result>";
    const LoadedScene loaded = load(c);
    const Texture& texture = *materialOf(loaded).textures().reflectance;
    // (1, 1) scaled to (2, 3), turned by 90 degrees to (-3, 2), shifted
    const glm::vec2 uv = texture.turn * glm::vec2(1, 1) + texture.shift;
    EXPECT_NEAR(uv.x, -2.75f, 1e-5f);
    EXPECT_NEAR(uv.y, 2.5f, 1e-5f);
}

TEST(UsdTextures, KeepTheirScaleAsAFactorThatCanBeEdited) {
    Case c;
    c.texture += "\n float4 inputs:scale = (0.5, 0.25, 1, 1)";
    const LoadedScene loaded = load(c);
    EXPECT_EQ(materialOf(loaded).reflectance(), Rgb(0.5f, 0.25f, 1));
    EXPECT_EQ(materialOf(loaded).textures().reflectance->scale, Rgb(1));
    c.texture += "\n float4 inputs:bias = (0.1, 0, 0, 0)";
    const LoadedScene biased = load(c);
    EXPECT_EQ(materialOf(biased).reflectance(), Rgb(1));
    EXPECT_EQ(materialOf(biased).textures().reflectance->scale, Rgb(0.5f, 0.25f, 1));
    EXPECT_EQ(materialOf(biased).textures().reflectance->bias, Rgb(0.1f, 0, 0));
}

TEST(UsdTextures, EmitNits) {
    Case c;
    c.surface = "color3f inputs:emissiveColor.connect = </M/T.outputs:rgb>";
    c.texture += "\n float4 inputs:scale = (300, 200, 100, 1)";
    const LoadedScene loaded = load(c);
    EXPECT_EQ(materialOf(loaded).emission(), Rgb(300, 200, 100));
    EXPECT_TRUE(materialOf(loaded).textures().emission);
    EXPECT_NEAR(materialOf(loaded).meanEmission().r, 300 * (1 + 0.2159f) / 2, 0.1f);
}

TEST(UsdTextures, ThatCanNotBeUsedAreNamedAndTheirFallbackTaken) {
    const struct {
        const char *file, *warning;
    } cases[] = {{"@missing.png@", "missing.png"},
                 {"@tiles.<UDIM>.png@", "UDIM"},
                 {"@scene.usda@", "scene.usda: not a picture"}};
    for (const auto& [file, warning] : cases) {
        Case c;
        c.texture = std::string("asset inputs:file = ") + file +
                    "\n float4 inputs:fallback = (0.1, 0.2, 0.3, 1)";
        const LoadedScene loaded = load(c);
        EXPECT_TRUE(warned(loaded, warning)) << file << ": " << summary(loaded.diagnostics);
        EXPECT_EQ(materialOf(loaded).reflectance(), Rgb(0.1f, 0.2f, 0.3f));
        EXPECT_FALSE(materialOf(loaded).textures().any());
        EXPECT_TRUE(meshOf(loaded).uvs.empty());
    }
}

TEST(UsdTextures, OfOpacityAreNamedAndDrawnOpaque) {
    Case c;
    c.surface += "\n float inputs:opacity.connect = </M/T.outputs:a>";
    const LoadedScene loaded = load(c);
    EXPECT_TRUE(warned(loaded, "drawn opaque")) << summary(loaded.diagnostics);
    EXPECT_EQ(materialOf(loaded).reflectance(), Rgb(1));
    EXPECT_TRUE(materialOf(loaded).textures().reflectance);
}

TEST(UsdTextures, WithoutCoordinatesAreTheirMean) {
    Case c;
    c.coordinates = "";
    const LoadedScene loaded = load(c);
    EXPECT_TRUE(warned(loaded, "no texture coordinates 'st'")) << summary(loaded.diagnostics);
    EXPECT_FALSE(materialOf(loaded).textures().any());
    EXPECT_NEAR(materialOf(loaded).reflectance().r, (1 + 0.2159f) / 2, 1e-3f);
    EXPECT_TRUE(meshOf(loaded).uvs.empty());
}

} // namespace penumbra
