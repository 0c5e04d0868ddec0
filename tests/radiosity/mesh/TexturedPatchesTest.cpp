// Reflectance of patches and elements under textures.
#include "tests/support/Scenes.h"
#include "tests/support/Textures.h"

#include <gtest/gtest.h>

#include <cmath>

namespace penumbra {

namespace {

/// A wall of 4 x 2 m with texture coordinates from `low` to `high`.
MeshData wall(std::shared_ptr<Material> material, glm::vec2 low, glm::vec2 high) {
    MeshData mesh = floorData(0, 4, 0, 2, 0, std::move(material));
    mesh.uvs = {low, {high.x, low.y}, high, {low.x, high.y}};
    return mesh;
}

/// Box of a patch in the plane.
Bounds boxOf(const PatchSet& set, const Patch& patch) {
    Bounds box;
    for (std::uint32_t i = 0; i < patch.cornerCount; ++i)
        box.add(set.corners[patch.firstCorner + i]);
    return box;
}

/// The largest error of a patch's reflectance against the mean of the pixels on it, in units of
/// the latter; of 0.15 where that is darker, for the edge of a picture is sampled to 1/600 of a
/// patch here.
double largestError(const Texture& texture, glm::vec2 low, glm::vec2 high, float patchSize) {
    const Scene scene = sceneOf({object("wall", wall(papered(texture, Rgb(0.9f)), low, high))});
    const PatchSet set = meshed(scene, {.patchSize = patchSize}).patches;
    double worst = set.patches.empty() ? 1 : 0;
    for (std::uint32_t p = 0; p < set.patches.size(); ++p) {
        const Bounds box = boxOf(set, set.patches[p]);
        const glm::dvec2 scale = glm::dvec2(high - low) / glm::dvec2(4, 2);
        const glm::dvec2 corner = glm::dvec2(low) + scale * glm::dvec2(box.lower);
        const glm::dvec2 size = scale * glm::dvec2(box.size());
        const Rgb mean = pixelMean(texture, corner, {size.x, 0}, {0, size.y}, 600) * 0.9f;
        const Rgb found = patchReflectance(set, p);
        for (const auto& [a, b] :
             {std::pair{found.r, mean.r}, {found.g, mean.g}, {found.b, mean.b}})
            worst = std::max(worst, std::abs(double(a) - b) / std::max(double(b), 0.15));
    }
    return worst;
}

TEST(TexturedPatches, ReflectWhatTheirOwnPartOfThePictureDoes) {
    const Texture tiles{redAndWhite(8, 16)};
    // Patches of 0.4 m cover parts of tiles: 4 m are 8 tiles.
    EXPECT_LT(largestError(tiles, {0, 0}, {1, 0.5f}, 0.4f), 5e-3);
    // ... of many tiles
    EXPECT_LT(largestError(tiles, {0, 0}, {6.3f, 2.9f}, 0.4f), 5e-3);
    // ... or of a few pixels.
    EXPECT_LT(largestError(tiles, {0.1f, 0.2f}, {0.2f, 0.25f}, 0.4f), 5e-3);
}

TEST(TexturedPatches, SoTheyDoHoweverThePictureIsWrappedTurnedAndCoded) {
    const glm::vec2 low(-0.7f, -0.2f), high(2.2f, 1.4f);
    for (const bool srgb : {true, false})
        for (const TextureWrap wrap :
             {TextureWrap::repeat, TextureWrap::mirror, TextureWrap::clamp, TextureWrap::black}) {
            Texture texture{redAndWhite(4, 32, srgb), wrap, wrap};
            EXPECT_LT(largestError(texture, low, high, 0.5f), 5e-3) << srgb << int(wrap);
            texture.turn = glm::mat2(0.6f, 0.5f, -0.5f, 0.6f);
            texture.shift = {0.3f, -0.1f};
            texture.scale = {0.5f, 0.8f, 0.7f};
            texture.bias = {0.1f, 0.05f, 0};
            EXPECT_LT(largestError(texture, low, high, 0.5f), 5e-3) << srgb << int(wrap);
        }
}

TEST(TexturedPatches, AreAsBrightOnTheBackAndInAnyPose) {
    const Texture tiles{redAndWhite(4, 8)};
    MeshData data = wall(papered(tiles), {0, 0}, {1, 1});
    data.doubleSided = true;
    const auto solved = [&](const glm::dmat4& pose) {
        return meshed(sceneOf({placed("wall", pose, {std::make_shared<Mesh>("mesh", data)})}),
                      {.patchSize = 0.5f})
            .patches;
    };
    const PatchSet flat = solved(glm::dmat4(1.0));
    Rgb front, back;
    for (std::uint32_t p = 0; p < flat.patches.size(); ++p)
        (flat.patches[p].normal.z > 0 ? front : back) +=
            flat.patches[p].area * patchReflectance(flat, p);
    const Rgb mean = 8.0f * tiles.mean();
    EXPECT_NEAR(front.g, mean.g, 2e-3 * mean.g);
    EXPECT_NEAR(back.g, mean.g, 2e-3 * mean.g);
    const PatchSet mirrored = solved(glm::scale(moved(1, 2, 3), {-1, 1, 1}));
    ASSERT_EQ(mirrored.patches.size(), flat.patches.size());
    Rgb sum;
    for (std::uint32_t p = 0; p < mirrored.patches.size(); ++p)
        sum += mirrored.patches[p].area * patchReflectance(mirrored, p);
    EXPECT_NEAR(sum.g, 2 * mean.g, 4e-3 * mean.g);
}

TEST(TexturedPatches, NeverReflectAllLight) {
    const auto white = picture(2, 2, false, [](int, int) {
        return std::array<std::uint8_t, 3>{255, 255, 255};
    });
    const PatchSet set =
        meshed(sceneOf({object("wall", wall(papered({white}), {0, 0}, {1, 1}))})).patches;
    EXPECT_EQ(patchReflectance(set, 0), Rgb(Material::kMaxReflectance));
}

TEST(TexturedPatches, LeaveAllOthersAloneAndTakeNoMemoryWhereThereAreNone) {
    const PatchSet plain = meshed(sceneOf({object("floor", floorData(0, 1, 0, 1, 0))})).patches;
    EXPECT_TRUE(plain.textures.uvs.empty());
    EXPECT_TRUE(plain.textures.elements.empty());
    const PatchSet both =
        meshed(sceneOf({object("floor", floorData(0, 1, 0, 1, 0, paint({0.3f, 0.4f, 0.5f}))),
                        object("wall", wall(papered({redAndWhite(2, 4)}), {0, 0}, {1, 1}))}))
            .patches;
    for (std::uint32_t p = 0; p < both.patches.size(); ++p)
        if (both.objects[both.patches[p].object.value].path == "/floor") {
            EXPECT_EQ(patchReflectance(both, p), Rgb(0.3f, 0.4f, 0.5f));
        }
}

TEST(TexturedPatches, VerticesAreDoubleWhereCoordinatesJump) {
    // Two squares side by side, each with the whole picture on it: no element spans two places.
    MeshData mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
    mesh.faceVertexCounts = {4, 4};
    mesh.faceVertexIndices = {0, 1, 4, 3, 1, 2, 5, 4};
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.materials = {papered({redAndWhite(2, 8)})};
    const PatchSet set = meshed(sceneOf({object("floor", mesh)}), {.patchSize = 0.5f}).patches;
    std::map<std::uint32_t, glm::vec2> uvOfVertex;
    for (std::uint32_t e = 0; e < set.elements.size(); ++e)
        for (std::size_t k = 0; k < 4; ++k) {
            const glm::vec2 uv = set.textures.uvs[e][k];
            const auto [found, fresh] = uvOfVertex.try_emplace(set.elements[e].vertices[k], uv);
            EXPECT_LT(glm::distance(found->second, uv), 1e-4f);
            const glm::vec3 at = set.vertices[set.elements[e].vertices[k]].position;
            const float side = at.x - std::floor(at.x);
            if (side > 1e-3f && side < 0.999f) {
                EXPECT_NEAR(uv.x, side, 1e-4f);
            }
        }
}

} // namespace

} // namespace penumbra
