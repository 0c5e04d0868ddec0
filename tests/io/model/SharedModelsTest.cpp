// Models that others made: what comes of each is known.
#include "base/Error.h"
#include "tests/io/model/LayerParts.h"
#include "tests/io/usd/UsdTestFiles.h"

#include <gmock/gmock.h>

namespace penumbra {

namespace {

/// What a model becomes, or why it is refused.
struct Expected {
    const char* file;
    std::size_t meshes, faces, lights, cameras;
    double metersPerUnit;
    const char* refusal = "";
};

const Expected kModels[] = {
    {"Collada/cameras.dae", 0, 0, 0, 3, 1},
    {"Collada/lights.dae", 0, 0, 3, 0, 1},
    {"Collada/sphere.dae", 1, 400, 0, 0, 0.01},
    {"Collada/teapot_instancenodes.DAE", 2, 2048, 0, 0, 0.0254},
    {"FBX/cubes_with_mirroring_and_pivot.fbx", 4, 210, 0, 0, 1},
    {"FBX/global_settings.fbx", 2, 848, 2, 2, 5},
    {"FBX/maxPbrMaterial_metalRough.fbx", 1, 6, 0, 0, 1},
    {"FBX/phong_cube.fbx", 1, 6, 0, 0, 0.01},
    {"FBX/spider.fbx", 19, 1368, 1, 1, 0.01},
    {"OBJ/WusonOBJ.obj", 1, 3732, 0, 0, 1},
    {"OBJ/box_mat_with_spaces.obj", 1, 6, 0, 0, 1},
    {"OBJ/concave_polygon.obj", 1, 1, 0, 0, 1},
    {"OBJ/cube_with_vertexcolors.obj", 1, 12, 0, 0, 1},
    {"OBJ/spider.obj", 19, 1368, 0, 0, 1},
    {"PLY/Wuson.ply", 1, 3732, 0, 0, 1},
    {"STL/sphereWithHole.stl", 1, 285, 0, 0, 1},
    {"glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb", 115, 121496, 0, 1, 1},
    {"glTF2/BoxTextured-glTF-Binary/BoxTextured.glb", 1, 12, 0, 0, 1},
    {"glTF2/BoxTextured-glTF/BoxTextured.gltf", 1, 12, 0, 0, 1},
    {"glTF2/IndexOutOfRange/AllIndicesOutOfRange.gltf", 0, 0, 0, 0, 0, "indices out of range"},
    {"glTF2/IndexOutOfRange/IndexOutOfRange.gltf", 0, 0, 0, 0, 0, "indices out of range"},
    {"glTF2/MissingBin/BoxTextured.gltf", 0, 0, 0, 0, 0, "BoxTextured0.bin"},
    {"glTF2/RecursiveNodes/RecursiveNodes.gltf", 0, 0, 0, 0, 0, "below itself"},
    {"glTF2/TestNoRootNode/NoScene.gltf", 0, 0, 0, 0, 0, "No scene"},
    {"glTF2/TestNoRootNode/SceneWithoutNodes.gltf", 0, 0, 0, 0, 0, "nothing in it to show"},
    {"glTF2/cameras/Cameras.gltf", 1, 2, 0, 2, 1},
    {"glTF2/textureTransform/TextureTransformTest.gltf", 12, 24, 0, 0, 1},
    {"glTF2/wrongTypes/badArray.gltf", 0, 0, 0, 0, 0, "primitives"},
    {"glTF2/wrongTypes/badExtension.gltf", 0, 0, 0, 0, 0, "KHR_texture_transform"},
    {"glTF2/wrongTypes/badNumber.gltf", 0, 0, 0, 0, 0, "scale"},
    {"glTF2/wrongTypes/badObject.gltf", 0, 0, 0, 0, 0, "pbrMetallicRoughness"},
    {"glTF2/wrongTypes/badString.gltf", 0, 0, 0, 0, 0, "name"},
    {"glTF2/wrongTypes/badUint.gltf", 0, 0, 0, 0, 0, "index"},
};

std::optional<std::filesystem::path> modelsFolder() {
    const auto shared = sharedFolder();
    if (!shared || !std::filesystem::is_directory(*shared / "assets/models")) return std::nullopt;
    return *shared / "assets/models";
}

void expectModel(const ImportedModel& model, const Expected& expected) {
    EXPECT_EQ(model.meshes, expected.meshes);
    EXPECT_EQ(model.faces, expected.faces);
    EXPECT_EQ(model.lights, expected.lights);
    EXPECT_EQ(model.cameras, expected.cameras);
    EXPECT_NEAR(numberIn(model.layer.metadata, "metersPerUnit"), expected.metersPerUnit, 1e-9);
    EXPECT_EQ(differenceAfterWriting(model.layer), "");
}

TEST(SharedModels, EachIsImportedOrRefusedInOneLine) {
    const auto folder = modelsFolder();
    if (!folder) GTEST_SKIP() << "no shared models beside the project";
    for (const Expected& expected : kModels) {
        SCOPED_TRACE(expected.file);
        try {
            const auto model = importModel(*folder / expected.file);
            EXPECT_STREQ(expected.refusal, "") << "this was to be refused";
            expectModel(model, expected);
        } catch (const SceneFileError& error) {
            EXPECT_STRNE(expected.refusal, "") << error.what();
            EXPECT_THAT(error.what(), testing::HasSubstr(expected.refusal));
            EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
        }
    }
}

TEST(SharedModels, NoneIsForgotten) {
    const auto folder = modelsFolder();
    if (!folder) GTEST_SKIP() << "no shared models beside the project";
    std::size_t models = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(*folder))
        models += entry.is_regular_file() && modelFormatOf(entry.path());
    EXPECT_EQ(models, std::size(kModels));
}

} // namespace

} // namespace penumbra
