// The walkthrough's pictures: InteractiveRenderer with HdrTarget, TonePass and LuminanceMeter.
#include "tests/viewer/gl/LitScenes.h"

#include "io/image/Exposure.h"
#include "io/image/PngWriter.h"
#include "radiosity/query/DrawnView.h"
#include "radiosity/query/LitSurface.h"
#include "scenegraph/Mesh.h"
#include "tests/support/Scenes.h"
#include "tests/support/Textures.h"
#include "viewer/app/InteractiveRenderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

namespace penumbra {

namespace {

class InteractiveRendererTest : public WithContext {
protected:
    static constexpr int kSize = 48;

    void draw(InteractiveRenderer& interactive, const View& view) {
        interactive.drawScene(listVisible(root, Frustum(view.worldToClip())), view, preview, kSize,
                              kSize);
    }
    UnlitLighting preview;
};

const InteractiveOptions kExact{.samples = 1, .precision = HdrTarget::Precision::single};

/// A square with a material of its own, facing +z.
std::shared_ptr<Mesh> paintedSquare(Rgb reflectance) {
    MeshData data;
    data.points = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    data.faceVertexCounts = {4};
    data.faceVertexIndices = {0, 1, 2, 3};
    data.materials = {std::make_shared<Material>("paint")};
    data.materials[0]->setReflectance(reflectance);
    return std::make_shared<Mesh>("square", std::move(data));
}

TEST_F(InteractiveRendererTest, DrawsTheLuminancesThatTheFrameRendererDraws) {
    LitMeshData data = litSquare({kRho, {3, 2, 1}});
    for (std::size_t i = 0; i < 4; ++i) data.direct[i] = Rgb(50 + 20 * float(i));
    root.add(placed(moved(0.3, 0.1, 0), litNode(std::move(data))));
    const View view = viewFrom(1.7, kSize, kSize);
    InteractiveRenderer interactive(kExact);
    draw(interactive, view);
    const std::vector<Rgb> screen = interactive.readLuminances();
    Renderer still({.samples = 1});
    const FrameLayers frame = renderFrame(*context, still, root, view, kSize, kSize);
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x)
            expectNear(screen[frame.index(x, kSize - 1 - y)], frame.beauty[frame.index(x, y)],
                       1e-5f);
    EXPECT_EQ(interactive.statistics().lit, 1u);
    EXPECT_EQ(interactive.statistics().uploads, 1u);
    draw(interactive, view);
    EXPECT_EQ(interactive.statistics().uploads, 0u) << "uploaded once";
}

/// Near a texture of which a picture uploads a part only.
TEST_F(InteractiveRendererTest, ShowsTexturesSharperPictureByPicture) {
    LitMeshData data =
        litSquare({Rgb(0.5f), {}, {std::make_shared<Texture>(Texture{redAndWhite(256, 4)}), {}}});
    data.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    root.add(litNode(std::move(data)));
    const View view = viewFrom(0.02, kSize, kSize);
    InteractiveRenderer sharp(kExact);
    draw(sharp, view);
    EXPECT_FALSE(sharp.statistics().blurred);
    const std::vector<Rgb> wanted = sharp.readLuminances();
    InteractiveOptions options = kExact;
    options.gradual = true;
    InteractiveRenderer gradual(options), finished(options);
    draw(gradual, view);
    EXPECT_TRUE(gradual.statistics().blurred);
    EXPECT_NE(gradual.readLuminances(), wanted);
    int pictures = 1;
    for (; gradual.statistics().blurred && pictures < 100; ++pictures) draw(gradual, view);
    EXPECT_LT(pictures, 20);
    draw(gradual, view);
    EXPECT_EQ(gradual.readLuminances(), wanted);
    draw(finished, view);
    finished.finishTextures();
    draw(finished, view);
    EXPECT_FALSE(finished.statistics().blurred);
    EXPECT_EQ(finished.readLuminances(), wanted);
}

TEST_F(InteractiveRendererTest, WhatIsNotLitYetIsSeenByHeadlightAndLights) {
    // Head on: ambient / 2 + ambient / 2; a light of 9 cd at 3 m without area gives 1 lux.
    root.add(paintedSquare(kRho));
    preview.ambient = Rgb(10);
    preview.lights.push_back({{0, 0, 3}, {0, 0, -1}, Rgb(9), 0});
    InteractiveRenderer interactive(kExact);
    draw(interactive, viewFrom(2, kSize + 1, kSize + 1));
    const std::vector<Rgb> screen = interactive.readLuminances();
    const Rgb centre = screen[std::size_t(kSize / 2) * kSize + kSize / 2];
    expectNear(centre, kRho * (11 / 3.14159265f), 2e-3f);
    EXPECT_EQ(interactive.statistics().unlit, 1u);
}

TEST_F(InteractiveRendererTest, WhatIsNotLitYetIsShadedByTheNormalsOfTheFile) {
    // All lean by 45 degrees: the headlight's half falls off by their cosine, on both sides, also
    // where the file has them the wrong way round or the thing is mirrored.
    preview.ambient = Rgb(10);
    const Rgb expected = kRho * (5 * (1 + std::sqrt(0.5f)) / 3.14159265f);
    const glm::dmat4 back = glm::rotate(glm::dmat4(1.0), 3.14159265358979, glm::dvec3(0, 1, 0));
    const glm::dmat4 mirrored = glm::scale(glm::dmat4(1.0), glm::dvec3(-1, 1, 1));
    for (const glm::dmat4& pose : {glm::dmat4(1.0), back, mirrored})
        for (const float sign : {1.0f, -1.0f}) {
            MeshData data = paintedSquare(kRho)->data();
            data.doubleSided = true;
            data.normals.assign(4, sign * glm::normalize(glm::vec3(1, 0, 1)));
            Group sheet("");
            sheet.add(placed(pose, std::make_shared<Mesh>("leaning", data)));
            InteractiveRenderer interactive(kExact);
            const View view = viewFrom(2, kSize + 1, kSize + 1);
            interactive.drawScene(listVisible(sheet, Frustum(view.worldToClip())), view, preview,
                                  kSize, kSize);
            const std::size_t centre = std::size_t(kSize / 2) * kSize + kSize / 2;
            expectNear(interactive.readLuminances()[centre], expected, 2e-2f);
        }
}

TEST_F(InteractiveRendererTest, TheBackOfAnUnlitSheetIsNotDrawnUnlessItIsDoubleSided) {
    MeshData both = paintedSquare(kRho)->data();
    both.doubleSided = true;
    const auto turned = glm::rotate(glm::dmat4(1.0), 3.14159265358979, glm::dvec3(0, 1, 0));
    auto place = placed(turned, paintedSquare(kRho));
    root.add(place);
    preview.ambient = Rgb(10);
    InteractiveRenderer interactive(kExact);
    const std::size_t centre = std::size_t(kSize / 2) * kSize + kSize / 2;
    draw(interactive, viewFrom(2, kSize, kSize));
    EXPECT_EQ(interactive.readLuminances()[centre], Rgb());
    place->add(std::make_shared<Mesh>("both", both));
    draw(interactive, viewFrom(2, kSize, kSize));
    EXPECT_GT(interactive.readLuminances()[centre].g, 0);
}

TEST_F(InteractiveRendererTest, LightsAndBackgroundDoNotCountForExposure) {
    LitMeshData wall = litSquare(); // 0.25 / pi * 205 = 16.31 nit of green
    LitMeshData emissive = litSquare({Rgb(0), Rgb(5000)});
    root.add(placed(moved(-0.5, 0, 0), litNode(std::move(wall))));
    root.add(placed(moved(1.2, 0, 0.2), litNode(std::move(emissive))));
    InteractiveRenderer interactive(kExact);
    draw(interactive, viewFrom(2, kSize, kSize));
    const auto luminances = interactive.luminances(true);
    ASSERT_TRUE(luminances);
    ASSERT_GT(luminances->size(), 100u);
    const float expected = luminance(kRho * (kDirect + kIndirect)) / 3.14159265f;
    for (const float y : *luminances) EXPECT_NEAR(y, expected, 1e-2f * expected);
    EXPECT_FALSE(interactive.luminances()) << "each measurement is given once";
}

TEST_F(InteractiveRendererTest, TheScreenShowsWhatTheToneCurveSays) {
    // Against the same curve, transfer function and dithering on the processor: no pixel differs
    // by more than a step, and hardly any by that, which is rounding.
    LitMeshData data = litSquare();
    for (std::size_t i = 0; i < 4; ++i) data.direct[i] = Rgb(float(i) * 700, 40 * float(3 - i), 9);
    root.add(litNode(std::move(data)));
    InteractiveRenderer interactive(kExact);
    draw(interactive, viewFrom(0.9, kSize, kSize));
    const std::vector<Rgb> luminances = interactive.readLuminances();
    for (const ToneStyle style : {ToneStyle::agx, ToneStyle::aces, ToneStyle::srgb}) {
        HdrTarget display(kSize, kSize, 1, HdrTarget::Precision::single); // any framebuffer
        display.begin(0);
        GLint framebuffer = 0;
        glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
        const float middleGrey = 20;
        interactive.show(unsigned(framebuffer), middleGrey, style);
        const std::vector<Rgb> signal = display.read();
        const ToneCurve curve(style);
        std::vector<Rgb> shown;
        for (const Rgb& c : luminances)
            shown.push_back(curve.shown(c * (kMiddleGrey / middleGrey)));
        const std::vector<std::uint8_t> expected = displayBytes(shown, kSize);
        std::size_t differ = 0;
        for (std::size_t i = 0; i < signal.size(); ++i) {
            const float channels[] = {signal[i].r, signal[i].g, signal[i].b};
            for (std::size_t c = 0; c < 3; ++c) {
                const float level = 255 * channels[c];
                EXPECT_NEAR(level, std::round(level), 1e-3f) << "whole steps";
                EXPECT_NEAR(level, expected[3 * i + c], 1.01f);
                differ += std::abs(level - float(expected[3 * i + c])) > 0.5f;
            }
        }
        EXPECT_LT(differ, signal.size() / 50) << kToneStyleNames[std::size_t(style)];
    }
}

TEST_F(InteractiveRendererTest, EdgesOfBrightEmittersAreAveragedAfterTheToneCurve) {
    // Means of luminances would be far beyond white wherever a sample meets the emitter.
    root.add(placed(moved(0.013, 0.02, 0), litNode(litSquare({Rgb(0), Rgb(10000)}))));
    InteractiveRenderer interactive({.samples = 4});
    draw(interactive, viewFrom(2, kSize, kSize));
    const DisplayedPicture picture = interactive.displayed(20, ToneStyle::srgb);
    int between = 0, white = 0;
    for (const std::uint8_t byte : picture.bytes) {
        between += byte > 60 && byte < 240;
        white += byte == 255;
    }
    EXPECT_GT(between, 3 * kSize / 2) << "along four edges";
    EXPECT_GT(white, 3 * kSize * kSize / 10);
}

TEST_F(InteractiveRendererTest, WhatIsSavedIsWhatIsShown) {
    root.add(placed(moved(0.2, 0.1, 0), litNode(litSquare({kRho, {3, 2, 1}}))));
    for (const int samples : {1, 4}) {
        InteractiveRenderer interactive({.samples = samples});
        draw(interactive, viewFrom(2, kSize, kSize));
        const DisplayedPicture picture = interactive.displayed(15, ToneStyle::agx);
        HdrTarget display(kSize, kSize, 1, HdrTarget::Precision::single); // any framebuffer
        display.begin(0);
        GLint framebuffer = 0;
        glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
        interactive.show(unsigned(framebuffer), 15, ToneStyle::agx);
        const std::vector<Rgb> signal = display.read();
        ASSERT_EQ(picture.bytes.size(), 3 * signal.size());
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x) {
                const Rgb shown = signal[std::size_t((kSize - 1 - y) * kSize + x)];
                const std::uint8_t* const saved = &picture.bytes[std::size_t(3 * (y * kSize + x))];
                EXPECT_EQ(saved[0], std::lround(255 * shown.r));
                EXPECT_EQ(saved[1], std::lround(255 * shown.g));
                EXPECT_EQ(saved[2], std::lround(255 * shown.b));
            }
    }
}

TEST_F(InteractiveRendererTest, TheWindowIsExposedAsPicturesWithoutOpenGLAre) {
    // A room with its light in view, metered on the graphics card and by rays.
    Scene scene;
    scene.root->add(object("room", boxData({-2, -2, 0}, {2, 2, 3}, true)));
    scene.root->add(ceilingLight({0, 1, 2.9}, 1, 0.5f, Rgb(900, 800, 500)));
    const Solution solution(std::move(scene), {.patchSize = 0.5f, .elementSize = 0.25f}, {});
    glm::dmat4 camera(1.0); // looks along +y, its up is z
    camera[1] = {0, 0, 1, 0}, camera[2] = {0, -1, 0, 0}, camera[3] = {0.3, -1.9, 1.5, 1};
    Lens lens;
    lens.focalLength = 1;
    lens.horizontalAperture = 2;
    const View view = makeView(lens, camera, 320, 180);
    const LitBranch lit(solution.patches(), solution.lighting);
    InteractiveRenderer interactive({.samples = 4});
    interactive.drawScene(listVisible(lit, Frustum(view.worldToClip())), view, preview, 320, 180);
    const auto card = interactive.luminances(true);
    ASSERT_TRUE(card);
    const auto rays = meterView(solution.patches(), view, solution.lighting);
    EXPECT_NEAR(exposureValueOf(middleGreyOf(*card).value()),
                exposureValueOf(middleGreyOf(rays).value()), 0.02);
}

TEST_F(InteractiveRendererTest, AViewOfLightsAloneIsMeteredByThem) {
    root.add(litNode(litSquare({Rgb(0), Rgb(5000)})));
    InteractiveRenderer interactive(kExact);
    draw(interactive, viewFrom(2, kSize, kSize));
    const auto luminances = interactive.luminances(true);
    ASSERT_TRUE(luminances && !luminances->empty());
    for (const float y : *luminances) EXPECT_NEAR(y, 5000, 1);
}

TEST_F(InteractiveRendererTest, MultisamplingAveragesLightAtEdges) {
    root.add(placed(moved(0.013, 0, 0), litNode(litSquare())));
    InteractiveRenderer interactive({.samples = 4});
    draw(interactive, viewFrom(2, kSize, kSize));
    const std::vector<Rgb> screen = interactive.readLuminances();
    std::vector<float> greens;
    for (int x = 0; x < kSize; ++x) greens.push_back(screen[std::size_t(24 * kSize + x)].g);
    const float full = *std::max_element(greens.begin(), greens.end());
    const auto between = std::count_if(greens.begin(), greens.end(),
                                       [&](float g) { return g > 0.1f * full && g < 0.9f * full; });
    EXPECT_GE(between, 1);
}

} // namespace

} // namespace penumbra
