#include "tests/io/usd/UsdTestFiles.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

const std::string kSquare =
    " int[] faceVertexCounts = [4]\n int[] faceVertexIndices = [0, 1, 2, 3]\n point3f[] points = "
    "[(0, 0, 0), "
    "(1, 0, 0), (1, 1, 0), (0, 1, 0)]\n uniform token subdivisionScheme = \"none\"\n";

// A square bound to a material whose preview surface has those inputs.
LoadedScene surfaced(const std::string& inputs, const std::string& others = "") {
    return loadText("def Mesh \"m\"\n{\n" + kSquare +
                    " rel material:binding = </M>\n}\ndef Material \"M\"\n{\n"
                    " token outputs:surface.connect = </M/S.outputs:surface>\n def Shader \"S\"\n "
                    "{\n  uniform token info:id = "
                    "\"UsdPreviewSurface\"\n" +
                    inputs + "\n  token outputs:surface\n }\n" + others + "}\n");
}

std::shared_ptr<Material> materialOf(const LoadedScene& loaded, const std::string& path = "/m") {
    const auto nodes = nodesByPath(*loaded.scene);
    const PlacedNode* placed = leafOf(nodes, path);
    return placed && placed->mesh() ? placed->mesh()->data().materials.at(0) : nullptr;
}

Rgb reflectance(const std::string& inputs, const std::string& others = "") {
    return materialOf(surfaced(inputs, others))->reflectance();
}

void expectNear(Rgb a, Rgb b) {
    EXPECT_NEAR(a.r, b.r, 1e-6);
    EXPECT_NEAR(a.g, b.g, 1e-6);
    EXPECT_NEAR(a.b, b.b, 1e-6);
}

} // namespace

TEST(UsdMaterial, ReflectanceIsDiffuseWithoutMetalAndTransparency) {
    expectNear(reflectance(""), Rgb(0.18f));
    expectNear(reflectance("color3f inputs:diffuseColor = (0.2, 0.4, 0.6)"), {0.2f, 0.4f, 0.6f});
    expectNear(
        reflectance("color3f inputs:diffuseColor = (0.2, 0.4, 0.6)\nfloat inputs:metallic = 0.5"),
        {0.1f, 0.2f, 0.3f});
    expectNear(
        reflectance("color3f inputs:diffuseColor = (0.2, 0.4, 0.6)\nfloat inputs:opacity = 0.5"),
        {0.1f, 0.2f, 0.3f});
    expectNear(reflectance("color3f inputs:diffuseColor = (0.2, 0.4, 0.6)\nfloat inputs:metallic = "
                           "0.5\nint inputs:useSpecularWorkflow = 1"),
               {0.2f, 0.4f, 0.6f});
    expectNear(reflectance("color3f inputs:diffuseColor = (1, 5, nan)"), {0.98f, 0.98f, 0});
}

TEST(UsdMaterial, EmissionIsInNits) {
    const auto material = materialOf(surfaced("color3f inputs:emissiveColor = (17, 12, 4)"));
    EXPECT_EQ(material->emission(), Rgb(17, 12, 4));
    EXPECT_EQ(material->name(), "M");
}

TEST(UsdMaterial, ConnectionsLeadToTheValue) {
    // To the material's own interface.
    expectNear(reflectance("color3f inputs:diffuseColor.connect = </M.inputs:paint>",
                           "color3f inputs:paint = (0.1, 0.2, 0.3)\n"),
               {0.1f, 0.2f, 0.3f});
    // Through a node graph.
    expectNear(reflectance("color3f inputs:diffuseColor.connect = </M/N.outputs:c>",
                           "def NodeGraph \"N\"\n{\n color3f outputs:c.connect = </M/N.inputs:c>\n "
                           "color3f inputs:c = (0.3, 0.2, 0.1)\n}\n"),
               {0.3f, 0.2f, 0.1f});
    // In a circle: the default.
    expectNear(
        reflectance(
            "color3f inputs:diffuseColor.connect = </M.inputs:a>",
            "color3f inputs:a.connect = </M.inputs:b>\ncolor3f inputs:b.connect = </M.inputs:a>\n"),
        Rgb(0.18f));
}

TEST(UsdMaterial, TexturesAreReplacedByTheirFallback) {
    const std::string connect = "color3f inputs:diffuseColor.connect = </M/T.outputs:rgb>\ncolor3f "
                                "inputs:emissiveColor.connect = </M/T.outputs:rgb>";
    const std::string texture = "def Shader \"T\"\n{\n uniform token info:id = \"UsdUVTexture\"\n "
                                "asset inputs:file = @a.png@\n";
    expectNear(reflectance(connect, texture + "}\n"), Rgb(0.5f));
    expectNear(reflectance(connect, texture + "float4 inputs:fallback = (0.1, 0.2, 0.3, 1)\n}\n"),
               {0.1f, 0.2f, 0.3f});
    EXPECT_EQ(materialOf(surfaced(connect, texture + "}\n"))->emission(), Rgb());
    // the picture that is not there, and the two inputs that it was to colour
    EXPECT_EQ(countOf(surfaced(connect, texture + "}\n"), "texture"), 3u);
}

TEST(UsdMaterial, WhatIsFullyTransparentIsLeftOut) {
    EXPECT_FALSE(materialOf(surfaced("float inputs:opacity = 0")));
    EXPECT_FALSE(
        materialOf(surfaced("float inputs:opacity = 0.3\nfloat inputs:opacityThreshold = 0.5")));
    EXPECT_TRUE(
        materialOf(surfaced("float inputs:opacity = 0.6\nfloat inputs:opacityThreshold = 0.5")));
}

TEST(UsdMaterial, BindingsAreInheritedAndTheNearestWins) {
    const std::string material =
        "{\n token outputs:surface.connect = <S.outputs:surface>\n def Shader \"S\"\n {\n uniform "
        "token info:id = \"UsdPreviewSurface\"\n }\n}\n";
    const LoadedScene loaded = loadText(
        "def Material \"A\"\n" + material + "def Material \"B\"\n" + material +
        "def Xform \"x\"\n{\n rel material:binding = </A>\n def Mesh \"m\"\n {\n" + kSquare +
        " }\n def Mesh \"n\"\n {\n rel material:binding = </B>\n" + kSquare +
        " }\n}\ndef Xform \"strong\"\n{\n rel material:binding = </A> (bindMaterialAs = "
        "\"strongerThanDescendants\")\n def Mesh \"n\"\n {\n rel material:binding = </B>\n" +
        kSquare + " }\n}\ndef Mesh \"lost\"\n{\n rel material:binding = </none>\n" + kSquare +
        "}\n");
    EXPECT_EQ(materialOf(loaded, "/x/m")->name(), "A");
    EXPECT_EQ(materialOf(loaded, "/x/n")->name(), "B");
    EXPECT_EQ(materialOf(loaded, "/strong/n")->name(), "A");
    EXPECT_EQ(materialOf(loaded, "/x/m"), materialOf(loaded, "/strong/n")); // one material, shared
    EXPECT_EQ(materialOf(loaded, "/lost")->name(), "neutral");
    EXPECT_EQ(countOf(loaded, "</none>"), 1u);
}

TEST(UsdMaterial, OtherShadersAreSaid) {
    const LoadedScene loaded = loadText(
        "def Mesh \"m\"\n{\n" + kSquare +
        " rel material:binding = </M>\n color3f[] primvars:displayColor = [(0.1, 0.2, 0.3)]\n}\n"
        "def Material \"M\"\n{\n token outputs:surface.connect = </M/S.outputs:out>\n def Shader "
        "\"S\"\n {\n"
        " uniform token info:id = \"ND_standard_surface\"\n }\n}\n");
    expectNear(materialOf(loaded)->reflectance(), {0.1f, 0.2f, 0.3f});
    EXPECT_EQ(countOf(loaded, "'ND_standard_surface' not understood"), 1u);
}

} // namespace penumbra
