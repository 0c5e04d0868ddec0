// Light under textures: what the picture's means say, wherever things stand.
#include "radiosity/query/TracedPicture.h"
#include "tests/support/Scenes.h"
#include "tests/support/Textures.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

/// A closed room with a light, its wall x = 0 of a material, and a board.
Scene room(const std::shared_ptr<Material>& paper, double boardAt = 1.5) {
    MeshData box = boxData({0, 0, 0}, {4, 3, 2.5f}, true, paint(Rgb(0.5f)));
    box.materials.push_back(paper);
    box.faceMaterial = {1, 0, 0, 0, 0, 0};
    for (std::size_t face = 0; face < 6; ++face)
        for (const glm::vec2 uv :
             {glm::vec2(0, 0), glm::vec2(3, 0), glm::vec2(3, 3), glm::vec2(0, 3)})
            box.uvs.push_back(uv);
    auto board = placed("board", moved(boardAt, 1, 0.8),
                        {std::make_shared<Mesh>("mesh", boxData({0, 0, 0}, {0.5f, 0.5f, 0.05f},
                                                                false, paint(Rgb(0.4f))))});
    board->setBeginsObject(true);
    return sceneOf({object("room", box), board, ceilingLight({2, 1.5f, 2.4f}, 1, 1, Rgb(1000))});
}

const MeshingOptions kCoarse{.patchSize = 0.5f, .elementSize = 0.125f};

/// Mean illuminance, indirect, of the floor's vertices [lux].
Rgb floorLight(const Solution& solution) {
    Rgb sum;
    float count = 0;
    for (std::size_t v = 0; v < solution.patches().firstPrivate; ++v) {
        const Receiver& receiver = solution.patches().vertices[v].receiver;
        if (isPadding(receiver) || receiver.position.z > 0.01f) continue;
        sum += solution.lighting.indirect[v];
        count += 1;
    }
    return sum * (1 / count);
}

TEST(TexturedLight, OfFineTilesIsThatOfTheirMeanColour) {
    const Texture tiles{redAndWhite(16, 8)};
    const Rgb textured = floorLight(Solution(room(papered(tiles)), kCoarse));
    const Rgb plain = floorLight(Solution(room(paint(tiles.mean())), kCoarse));
    EXPECT_NEAR(textured.r, plain.r, 5e-3f * plain.r);
    EXPECT_NEAR(textured.g, plain.g, 5e-3f * plain.g);
    EXPECT_GT(textured.r, 1.02f * textured.g); // pink
}

TEST(TexturedLight, AfterAMoveIsThatOfANewStart) {
    const Texture tiles{redAndWhite(3, 8)};
    Solution moving(room(papered(tiles), 1.5), kCoarse);
    const auto means = moving.patches().textures.patches;
    const auto board = std::dynamic_pointer_cast<Transform>(moving.scene.root->children()[1]);
    board->setMatrix(moved(2.5, 1, 0.8));
    moving.lit.follow(placeScene(moving.scene));
    moving.lit.solver().settle();
    EXPECT_EQ(moving.patches().textures.patches, means); // read once
    const Solution fresh(room(papered(tiles), 2.5), kCoarse);
    const Lighting light = moving.solver.lighting();
    ASSERT_GE(light.direct.size(), std::size_t(fresh.patches().firstPrivate));
    for (std::size_t v = 0; v < fresh.patches().firstPrivate; ++v)
        EXPECT_EQ(light.direct[v], fresh.lighting.direct[v]);
}

TEST(TexturedLight, FollowsTheFactorOfAPicture) {
    const Texture tiles{redAndWhite(3, 8)};
    const auto paper = papered(tiles);
    Solution edited(room(paper), kCoarse);
    paper->setReflectance(Rgb(0.5f));
    edited.lit.follow(placeScene(edited.scene));
    edited.lit.solver().settle();
    edited.lighting = edited.solver.lighting();
    const Rgb found = floorLight(edited);
    const Rgb fresh = floorLight(Solution(room(papered(tiles, Rgb(0.5f))), kCoarse));
    EXPECT_NEAR(found.r, fresh.r, 0.01f * fresh.r);
    EXPECT_NEAR(found.g, fresh.g, 0.01f * fresh.g);
}

TEST(TexturedLight, EmittersSendTheMeanOfTheirPartOfThePicture) {
    // Left half red light, right half none.
    const auto image = picture(8, 8, false, [](int x, int) {
        return std::array<std::uint8_t, 3>{std::uint8_t(x < 4 ? 255 : 0), 0, 0};
    });
    auto screen = std::make_shared<Material>(
        "screen", MaterialTextures{nullptr, std::make_shared<Texture>(Texture{image})});
    screen->setEmission(Rgb(100));
    MeshData data = floorData(0, 1, 0, 1, 0, screen);
    data.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const PatchSet set = meshed(sceneOf({object("screen", data)}), {.patchSize = 1}).patches;
    double flux = 0;
    for (const Emitter& emitter : set.emitters) flux += emitter.area * emitter.exitance.r;
    EXPECT_NEAR(flux, 0.5 * 100 * glm::pi<double>(), 0.01);
}

TEST(TexturedLight, IsDrawnWithThePictureAtFullResolution) {
    // From straight above, each pixel of the picture fills several of the view.
    const auto image = picture(4, 4, true, [](int x, int y) {
        return std::array<std::uint8_t, 3>{std::uint8_t(40 + 50 * x), std::uint8_t(40 + 50 * y),
                                           100};
    });
    const Texture texture{image, TextureWrap::clamp, TextureWrap::clamp};
    MeshData data = floorData(-1, 1, -1, 1, 0, papered(texture));
    data.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const Solution solution(
        sceneOf({object("floor", data), ceilingLight({0, 0, 3}, 1, 1, Rgb(100))}), kCoarse);
    Lens lens;
    lens.focalLength = 2, lens.horizontalAperture = 2;
    const View view = makeView(lens, moved(0, 0, 2), 32, 32);
    const FrameLayers frame =
        traceFrame(solution.patches(), solution.rays, solution.lighting, view, 32, 32);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            const glm::vec2 uv((float(x) + 0.5f) / 32, 1 - (float(y) + 0.5f) / 32);
            const Rgb expected = texture.at(uv);
            const Rgb found = frame.albedo[frame.index(x, y)];
            EXPECT_NEAR(found.r, expected.r, 2e-3f);
            EXPECT_NEAR(found.g, expected.g, 2e-3f);
        }
}

} // namespace

} // namespace penumbra
