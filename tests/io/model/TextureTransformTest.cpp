// KHR_texture_transform, as UsdTransform2d and on a surface.
#include "io/model/TextureTransform.h"
#include "io/image/PngEncoder.h"
#include "tests/io/model/LayerParts.h"
#include "tests/io/usd/UsdTestFiles.h"
#include "tests/support/ModelTexts.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

namespace penumbra {

namespace {

using testing::ElementsAre;

/// As KHR_texture_transform has it: offset * rotation * scale, for v that points down.
glm::dvec2 transformed(const GltfTextureTransform& by, glm::dvec2 uv) {
    const glm::dvec2 scaled = by.scale * uv;
    const double c = std::cos(by.rotation), s = std::sin(by.rotation);
    return {c * scaled.x + s * scaled.y + by.offset.x, -s * scaled.x + c * scaled.y + by.offset.y};
}

std::string png() {
    const auto bytes = encodePng(1, 1, std::vector<std::uint8_t>{255, 255, 255});
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string materialText(const std::string& transform, const std::string& slot = "baseColor") {
    const std::string texture =
        R"({"index": 0, "extensions": {"KHR_texture_transform": )" + transform + "}}";
    const std::string base =
        slot == "baseColor" ? R"(, "baseColorTexture": )" + texture : std::string();
    const std::string emissive =
        slot == "baseColor" ? std::string()
                            : R"(, "emissiveFactor": [1, 1, 1], "emissiveTexture": )" + texture;
    return R"({"name": "M", "pbrMetallicRoughness": {"metallicFactor": 0)" + base + "}" + emissive +
           "}";
}

class TextureTransform : public testing::Test {
protected:
    TemporaryFolder here;

    std::filesystem::path write(const std::string& materials) {
        here.write("a.png", png());
        std::string text =
            gltfText(R"([{"name": "N", "mesh": 0}])",
                     R"(, "extensionsUsed": ["KHR_texture_transform"], "textures": [{"source": 0}],
                         "images": [{"uri": "a.png"}], "materials": [)" +
                         materials + "]");
        const auto put = [&](const std::string& before, const std::string& more) {
            text.insert(text.find(before) + before.size(), more);
        };
        put(R"({"POSITION": 0)", R"(, "TEXCOORD_0": 2)"); // some numbers: those of the points
        put(R"("type": "SCALAR"})",
            R"(, {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC2"})");
        return here.write("a.gltf", text);
    }
};

} // namespace

TEST_F(TextureTransform, TakesEveryPointToWhereGltfTakesIt) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> some(-3, 3);
    for (int i = 0; i < 20; ++i) {
        const GltfTextureTransform by{
            {some(random), some(random)}, {some(random), some(random)}, some(random)};
        const std::string text = "{\"offset\": [" + std::to_string(by.offset.x) + ", " +
                                 std::to_string(by.offset.y) + "], \"scale\": [" +
                                 std::to_string(by.scale.x) + ", " + std::to_string(by.scale.y) +
                                 "], \"rotation\": " + std::to_string(by.rotation) + "}";
        const LoadedScene loaded = loadUsdScene(write(materialText(text)));
        const auto nodes = nodesByPath(*loaded.scene);
        const Mesh& square = *leafOf(nodes, "/a/N/Square")->mesh();
        const auto texture = square.materialOf(0)->textures().reflectance;
        ASSERT_TRUE(texture);
        for (int k = 0; k < 5; ++k) { // s = u, t = 1 - v
            const glm::dvec2 uv(some(random), some(random)), moved = transformed(by, uv);
            const glm::vec2 st = texture->turn * glm::vec2(uv.x, 1 - uv.y) + texture->shift;
            EXPECT_NEAR(st.x, moved.x, 1e-4);
            EXPECT_NEAR(st.y, 1 - moved.y, 1e-4);
        }
    }
}

TEST_F(TextureTransform, LeavesTheCoordinatesOfTheMeshAsTheyAre) {
    const auto model = importModel(write(materialText(R"({"scale": [2, 3], "rotation": 1})")));
    EXPECT_EQ(targetOf(model.layer, "/a/Materials/M/DiffuseTexture", "inputs:st"),
              "/a/Materials/M/DiffuseTransform.outputs:result");
    EXPECT_EQ(targetOf(model.layer, "/a/Materials/M/DiffuseTransform", "inputs:in"),
              "/a/Materials/M/DiffuseCoordinates.outputs:result");
    EXPECT_EQ(differenceAfterWriting(model.layer), "");
    const auto plain = importModel(write(materialText("{}")));
    EXPECT_FALSE(primAt(plain.layer, "/a/Materials/M/DiffuseTransform"));
}

TEST_F(TextureTransform, MayReadOtherCoordinatesThanTheTexture) {
    const auto model = importModel(write(materialText(R"({"offset": [0.5, 0], "texCoord": 1})")));
    EXPECT_EQ(textOf(model.layer, "/a/Materials/M/DiffuseCoordinates", "inputs:varname"), "st1");
}

TEST_F(TextureTransform, IsThatOfTheEmissionAsWell) {
    const auto model = importModel(write(materialText(R"({"scale": [2, 3]})", "emissive")));
    const auto scale = numbersOf(model.layer, "/a/Materials/M/EmissionTransform", "inputs:scale");
    EXPECT_THAT(scale, ElementsAre(2, 3));
}

TEST_F(TextureTransform, IsFoundAmongMaterialsOfTheSameName) {
    const std::string other = materialText(R"({"scale": [5, 5]})");
    const auto model = importModel(write(materialText(R"({"scale": [2, 3]})") + ", " + other));
    const auto scale = numbersOf(model.layer, "/a/Materials/M/DiffuseTransform", "inputs:scale");
    EXPECT_THAT(scale, ElementsAre(2, 3));
    EXPECT_FALSE(says(model, "alone: one is taken"));
}

TEST_F(TextureTransform, ThatDiffersInOffsetAloneAmongMaterialsOfTheSameNameIsNamed) {
    const std::string other = materialText(R"({"offset": [0.25, 0]})");
    const auto model = importModel(write(materialText(R"({"offset": [0.5, 0]})") + ", " + other));
    EXPECT_TRUE(says(model, "materials 'M' differ in emissive strength or texture offset alone"));
}

TEST_F(TextureTransform, WithNumbersOfNoUseIsLeftOut) {
    const auto model = importModel(write(materialText(R"({"offset": [1e30, 0]})")));
    EXPECT_TRUE(says(model, "material 'M': a texture's transform left out"));
    EXPECT_FALSE(primAt(model.layer, "/a/Materials/M/DiffuseTransform"));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(usdTransformOf({{0, 0}, {1, 1}, nan}));
}

} // namespace penumbra
