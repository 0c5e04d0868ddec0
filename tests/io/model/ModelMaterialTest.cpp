// Materials and pictures of models.
#include "io/image/PngEncoder.h"
#include "tests/io/model/LayerParts.h"
#include "tests/io/usd/UsdTestFiles.h"
#include "tests/support/ModelTexts.h"

#include <gmock/gmock.h>

namespace penumbra {

namespace {

using testing::Each;
using testing::ElementsAre;

const std::string kNode = R"([{"name": "N", "mesh": 0}])";
/// The eight bytes that every PNG begins with, and one more.
const std::string kPng("\x89PNG\r\n\x1a\n.", 9);

class ModelMaterial : public testing::Test {
protected:
    TemporaryFolder here;

    ImportedModel gltf(const std::string& more, const ImportOptions& options = {}) {
        return importModel(here.write("a.gltf", gltfText(kNode, more)), options);
    }
    static std::vector<float> floats(const ImportedModel& model, const std::string& prim,
                                     const std::string& attribute) {
        const auto numbers = numbersOf(model.layer, prim, attribute);
        return {numbers.begin(), numbers.end()};
    }
};

TEST_F(ModelMaterial, BaseColourAndEmissionReachTheSurface) {
    // Emission is in cd/m2: the factor times KHR_materials_emissive_strength.
    gltf(R"(, "extensionsUsed": ["KHR_materials_emissive_strength"], "materials": [{"name": "Glow",
         "pbrMetallicRoughness": {"baseColorFactor": [0.25, 0.5, 0.75, 1], "metallicFactor": 0},
         "emissiveFactor": [1, 0.5, 0], "extensions":
         {"KHR_materials_emissive_strength": {"emissiveStrength": 300}}}])");
    const LoadedScene scene = loadUsdScene(here.file("a.gltf"));
    const auto nodes = nodesByPath(*scene.scene);
    const PlacedNode* square = leafOf(nodes, "/a/N/Square");
    ASSERT_TRUE(square && square->mesh());
    const Material& material = *square->mesh()->materialOf(0);
    EXPECT_EQ(material.name(), "Glow");
    EXPECT_FLOAT_EQ(material.reflectance().g, 0.5f);
    EXPECT_FLOAT_EQ(material.emission().r, 300);
    EXPECT_FLOAT_EQ(material.emission().g, 150);
}

TEST_F(ModelMaterial, EmissionWithoutAUnitIsNamed) {
    here.write("a.mtl", "newmtl Lit\nKd 0.5 0.5 0.5\nKe 17 12 4\n");
    const auto model = importModel(
        here.write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl Lit\nf 1 2 3\n"));
    EXPECT_TRUE(says(model, "1 is taken as 1 cd/m2"));
    EXPECT_THAT(floats(model, "/a/Materials/Lit/Surface", "inputs:emissiveColor"),
                ElementsAre(17, 12, 4));
    EXPECT_THAT(model.files, testing::Contains(here.path() / "a.mtl"));
}

TEST_F(ModelMaterial, ATextureIsNamedByItsPathFromTheLayer) {
    here.write("pictures/wood 1.png", kPng);
    here.write("a.mtl", "newmtl Wood\nKd 0.8 0.4 0.2\nmap_Kd pictures\\wood 1.png\n");
    const auto file = here.write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\n"
                                          "usemtl Wood\nf 1/1 2/1 3/1\n");
    std::filesystem::create_directory(here.path() / "out");
    const auto model = importModel(file, {.layer = here.path() / "out/a.usda"});
    const std::string wood = "/a/Materials/Wood";
    EXPECT_EQ(textOf(model.layer, wood + "/DiffuseTexture", "inputs:file"),
              "../pictures/wood 1.png");
    EXPECT_EQ(targetOf(model.layer, wood + "/Surface", "inputs:diffuseColor"),
              wood + "/DiffuseTexture.outputs:rgb");
    EXPECT_EQ(targetOf(model.layer, wood + "/DiffuseTexture", "inputs:st"),
              wood + "/DiffuseCoordinates.outputs:result");
    EXPECT_EQ(textOf(model.layer, wood + "/DiffuseCoordinates", "inputs:varname"), "st");
    EXPECT_THAT(floats(model, wood + "/DiffuseTexture", "inputs:scale"),
                ElementsAre(0.8f, 0.4f, 0.2f, 1));
    EXPECT_THAT(floats(model, wood + "/DiffuseTexture", "inputs:fallback"),
                ElementsAre(0.4f, 0.2f, 0.1f, 1));
    EXPECT_EQ(differenceAfterWriting(model.layer), "");
}

TEST_F(ModelMaterial, APictureThatIsNotThereIsNamed) {
    const auto model = gltf(R"(, "materials": [{"name": "M", "pbrMetallicRoughness":
        {"metallicFactor": 0, "baseColorFactor": [0.5, 0.5, 0.5, 1],
         "baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0}], "images": [{"uri": "gone.png"}])");
    EXPECT_TRUE(says(model, "picture 'gone.png' is not there"));
    EXPECT_THAT(floats(model, "/a/Materials/M/Surface", "inputs:diffuseColor"), Each(0.5f));
}

TEST_F(ModelMaterial, APictureWhoseNameIsNoUtf8IsLeftOut) { // a layer could not be read again
    here.write("wood\xff.png", kPng);
    here.write("a.mtl", "newmtl Wood\nKd 0.8 0.4 0.2\nmap_Kd wood\xff.png\n");
    const auto model = importModel(
        here.write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl Wood\nf 1 2 3\n"));
    EXPECT_TRUE(says(model, "'wood?.png' left out: its path is not valid UTF-8"));
    EXPECT_EQ(differenceAfterWriting(model.layer), "");
}

TEST_F(ModelMaterial, PicturesOfAnythingElseAreNamed) {
    const auto model = gltf(R"(, "materials": [{"name": "M", "normalTexture": {"index": 0}}],
        "textures": [{"source": 0}], "images": [{"uri": "bumps.png"}])");
    EXPECT_TRUE(says(model, "anything but colour and emission left out"));
}

TEST_F(ModelMaterial, APictureWithinTheModelIsHandedOverOrNamed) {
    const std::string more = R"(, "materials": [{"name": "M", "pbrMetallicRoughness":
        {"metallicFactor": 0, "baseColorTexture": {"index": 0}}}], "textures": [{"source": 0}],
        "images": [{"uri": "data:image/png;base64,)" +
                             base64(kPng) + R"("}])";
    const auto model = gltf(more, {.layer = here.path() / "b.usda"});
    ASSERT_EQ(model.images.size(), 1u);
    EXPECT_EQ(model.images[0].name, "b-picture1.png");
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(model.images[0].bytes.data()),
                          model.images[0].bytes.size()),
              kPng);
    EXPECT_EQ(textOf(model.layer, "/a/Materials/M/DiffuseTexture", "inputs:file"),
              "./b-picture1.png");
    const auto odd = gltf(more, {.layer = here.path() / "b\xff.usda"});
    EXPECT_TRUE(odd.images.empty());
    EXPECT_TRUE(says(odd, "is not valid UTF-8"));
}

TEST_F(ModelMaterial, APictureWithinAModelThatIsOpenedItselfIsReadInPlace) {
    const auto bytes = encodePng(2, 1, std::vector<std::uint8_t>{255, 0, 0, 128, 128, 128});
    const std::string png(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto model = gltf(R"(, "materials": [{"name": "M", "pbrMetallicRoughness":
        {"metallicFactor": 0, "baseColorTexture": {"index": 0}}}], "textures": [{"source": 0}],
        "images": [{"uri": "data:image/png;base64,)" +
                            base64(png) + R"("}])");
    EXPECT_EQ(textOf(model.layer, "/a/Materials/M/DiffuseTexture", "inputs:file"),
              "./a.gltf[picture1.png]");
    const LoadedScene scene = loadUsdScene(here.file("a.gltf"));
    const auto nodes = nodesByPath(*scene.scene);
    const Material& material = *leafOf(nodes, "/a/N/Square")->mesh()->materialOf(0);
    // The square has no coordinates: red and grey (0.216) together.
    EXPECT_NEAR(material.reflectance().r, (1 + 0.216) / 2, 0.01);
    EXPECT_NEAR(material.reflectance().g, 0.216 / 2, 0.01);
}

TEST_F(ModelMaterial, OneMaterialOfManyMeshesIsThereOnce) {
    const auto model = importModel(
        here.write("a.gltf", gltfText(R"([{"children": [1, 2]}, {"mesh": 0}, {"mesh": 0}])",
                                      R"(, "materials": [{"name": "M"}])")));
    EXPECT_EQ(model.materials, 1u);
    for (const char* node : {"/a/Node/Square", "/a/Node/Square_1"})
        EXPECT_EQ(targetOf(model.layer, std::string(node) + "/Square", "material:binding"),
                  "/a/Materials/M");
    EXPECT_TRUE(says(model, "material 'M' is metal")); // as glTF has it where nothing is said
}

TEST_F(ModelMaterial, BothSidesAreShownWhereTheMaterialSaysSo) {
    const auto model = gltf(R"(, "materials": [{"name": "M", "doubleSided": true}])");
    EXPECT_THAT(numbersOf(model.layer, "/a/N/Square", "doubleSided"), ElementsAre(1));
    const auto one = gltf(R"(, "materials": [{"name": "M"}])");
    EXPECT_TRUE(numbersOf(one.layer, "/a/N/Square", "doubleSided").empty());
}

TEST_F(ModelMaterial, OpacityScalesTheAlphaOfTheTexture) {
    here.write("leaf.png", kPng);
    const auto model = gltf(R"(, "materials": [{"name": "M", "alphaMode": "BLEND",
        "pbrMetallicRoughness": {"metallicFactor": 0, "baseColorFactor": [0.5, 1, 1, 0.25],
         "baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0}], "images": [{"uri": "leaf.png"}])");
    EXPECT_EQ(targetOf(model.layer, "/a/Materials/M/Surface", "inputs:opacity"),
              "/a/Materials/M/DiffuseTexture.outputs:a");
    EXPECT_THAT(floats(model, "/a/Materials/M/DiffuseTexture", "inputs:scale"),
                ElementsAre(0.5f, 1, 1, 0.25f));
}

TEST_F(ModelMaterial, WhatIsCutOutIsSo) {
    const auto model = gltf(R"(, "materials": [{"name": "M", "alphaMode": "MASK",
        "alphaCutoff": 0.25, "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.5]}},
        {"name": "Other"}])");
    EXPECT_THAT(floats(model, "/a/Materials/M/Surface", "inputs:opacityThreshold"),
                ElementsAre(0.25f));
    EXPECT_THAT(floats(model, "/a/Materials/M/Surface", "inputs:opacity"), ElementsAre(0.5f));
}

} // namespace

} // namespace penumbra
