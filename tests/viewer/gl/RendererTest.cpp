// What the renderer draws, leaves out and uploads.
#include "tests/viewer/gl/LitScenes.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace penumbra {

namespace {

using RendererTest = WithContext;

TEST_F(RendererTest, ALitSquareHasTheLuminanceOfItsIlluminance) {
    // L = rho / pi * (direct + indirect) + emission, evaluated by hand for the red channel:
    // 0.5 / pi * 110 + 3 = 20.50704
    root.add(litNode(litSquare({kRho, {3, 2, 1}})));
    const FrameLayers frame = render(viewFrom(1, 9, 9), 9, 9);
    const std::size_t centre = frame.index(4, 4);
    EXPECT_NEAR(frame.beauty[centre].r, 20.50704f, 1e-4f);
    const float inversePi = 1 / glm::pi<float>();
    expectNear(frame.beauty[centre], kRho * (kDirect + kIndirect) * inversePi + Rgb(3, 2, 1),
               1e-6f);
    expectNear(frame.direct[centre], kRho * kDirect * inversePi, 1e-6f);
    expectNear(frame.indirect[centre], kRho * kIndirect * inversePi, 1e-6f);
    EXPECT_EQ(frame.alpha[centre], 1);
}

TEST_F(RendererTest, LightIsInterpolatedInPerspective) {
    // A floor square seen edge-on from in front: linear on the surface, not on the screen. The ray
    // through a pixel's centre gives the point, and there the light is 1 + x.
    LitMeshData data = litSquare();
    for (std::size_t i = 0; i < 4; ++i) {
        data.direct[i] = Rgb(1 + data.positions[i].y);
        data.indirect[i] = Rgb(0);
    }
    root.add(placed(glm::rotate(glm::dmat4(1.0), -glm::half_pi<double>(), {1, 0, 0}),
                    litNode(std::move(data)))); // local y is now -z, away from the camera
    Lens lens;
    lens.focalLength = 1;
    lens.horizontalAperture = 2;
    const int size = 64;
    lens.clippingRange = {0.01f, 100};
    const FrameLayers frame = render(makeView(lens, moved(0, 0.5, 2), size, size), size, size);
    int seen = 0;
    for (int y = 0; y < size; ++y) {
        const std::size_t pixel = frame.index(size / 2, y);
        if (!frame.objectId[pixel].valid() || frame.alpha[pixel] < 1) continue;
        const double slope = 2 * (y + 0.5) / size - 1; // down for each step forward
        const double forward = 0.5 / slope;
        EXPECT_NEAR(frame.illuminance[pixel].r, 1 + (forward - 2), 1e-4);
        ++seen;
    }
    EXPECT_GT(seen, 8);
}

TEST_F(RendererTest, TheBackOfASheetIsNotDrawn) {
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), glm::pi<double>(), {0, 1, 0});
    root.add(placed(turned, litNode(litSquare())));
    const FrameLayers frame = render(viewFrom(1, 5, 5), 5, 5);
    EXPECT_EQ(frame.objectId[frame.index(2, 2)].value, ObjectId::kNone);
    EXPECT_EQ(frame.beauty[frame.index(2, 2)], Rgb(0));
}

TEST_F(RendererTest, OfTwoSheetsBackToBackEachSideShowsItsOwn) {
    const auto turn = glm::rotate(glm::dmat4(1.0), glm::pi<double>(), {0, 1, 0});
    auto group = std::make_shared<Group>("two-sided");
    group->add(litNode(litSquare({Rgb(0), {1, 0, 0}}), 1));
    group->add(placed(turn, litNode(litSquare({Rgb(0), {0, 1, 0}}), 1)));
    auto place = placed(glm::dmat4(1.0), group);
    root.add(place);
    EXPECT_EQ(render(viewFrom(1, 5, 5), 5, 5).beauty[12], Rgb(1, 0, 0));
    place->setMatrix(turn);
    EXPECT_EQ(render(viewFrom(1, 5, 5), 5, 5).beauty[12], Rgb(0, 1, 0));
}

TEST_F(RendererTest, MirroringKeepsTheFrontInFront) {
    root.add(placed(glm::scale(glm::dmat4(1.0), {-1, 1, 1}), litNode(litSquare())));
    const FrameLayers frame = render(viewFrom(1, 5, 5), 5, 5);
    EXPECT_EQ(frame.objectId[12].value, 7u);
    EXPECT_EQ(frame.normal[12], glm::vec3(0, 0, 1));
}

TEST_F(RendererTest, WhatIsOutOfViewCostsNoDrawCall) {
    root.add(litNode(litSquare()));
    root.add(placed(moved(100, 0, 0), litNode(litSquare())));
    root.add(placed(moved(0, 0, 50), litNode(litSquare()))); // behind the camera
    render(viewFrom(1, 5, 5), 5, 5);
    EXPECT_EQ(renderer.statistics().drawn, 1u);
    EXPECT_EQ(renderer.statistics().culled, 2u);
    EXPECT_EQ(renderer.statistics().drawCalls, 2u); // one a pass
    EXPECT_EQ(renderer.statistics().uploads, 1u);
}

TEST_F(RendererTest, WhatASwitchHidesIsNotDrawn) {
    auto light = std::make_shared<Switch>("switch");
    light->add(litNode(litSquare()));
    root.add(light);
    EXPECT_TRUE(render(viewFrom(1, 5, 5), 5, 5).objectId[12].valid());
    light->setVisible(false);
    EXPECT_FALSE(render(viewFrom(1, 5, 5), 5, 5).objectId[12].valid());
    EXPECT_EQ(renderer.statistics().drawn + renderer.statistics().culled, 0u);
}

TEST_F(RendererTest, EachTriangleHasItsOwnMaterial) {
    LitMeshData data = litSquare();
    data.materials = {{Rgb(0), {1, 0, 0}}, {Rgb(0), {0, 1, 0}}, {Rgb(0), {0, 0, 1}}};
    data.triangleMaterial = {2, 1}; // lower right blue, upper left green
    root.add(litNode(std::move(data)));
    const FrameLayers frame = render(viewFrom(1, 8, 8), 8, 8);
    EXPECT_EQ(frame.beauty[frame.index(6, 6)], Rgb(0, 0, 1));
    EXPECT_EQ(frame.beauty[frame.index(1, 1)], Rgb(0, 1, 0));
    EXPECT_EQ(renderer.statistics().drawCalls, 4u);
}

TEST_F(RendererTest, OnlyTheLightIsUploadedAgainWhenItChanges) {
    const auto node = litNode(litSquare());
    root.add(node);
    root.add(placed(moved(3, 0, -3), node)); // a second instance of the same node
    render(viewFrom(1, 5, 5), 5, 5);
    EXPECT_EQ(renderer.statistics().uploads, 1u);
    render(viewFrom(1, 5, 5), 5, 5);
    EXPECT_EQ(renderer.statistics().uploads, 0u);
    EXPECT_EQ(renderer.statistics().lightUploads, 0u);

    node->setIlluminance(std::vector<Rgb>(4, Rgb(0)), std::vector<Rgb>(4, Rgb(8)));
    const FrameLayers frame = render(viewFrom(1, 5, 5), 5, 5);
    EXPECT_EQ(renderer.statistics().uploads, 0u);
    EXPECT_EQ(renderer.statistics().lightUploads, 1u);
    EXPECT_EQ(frame.illuminance[12], Rgb(8));
}

TEST_F(RendererTest, ANewNodeIsNeverTakenForADeadOneAtItsAddress) {
    // The allocator gives the address of the node just freed to the next of the same size; not with
    // make_shared, where the cache's weak pointer keeps hold of the memory.
    for (float level = 1; level <= 8; ++level) {
        const NodePtr node(new LitGeometry("lit", ObjectId{0}, litSquare({Rgb(0), Rgb(level)})));
        root.add(node);
        EXPECT_EQ(render(viewFrom(1, 5, 5), 5, 5).beauty[12], Rgb(level));
        EXPECT_EQ(renderer.statistics().uploads, 1u);
        root.remove(node);
    }
}

TEST_F(RendererTest, DepthSeparatesWhatIsCloseTogetherFarAway) {
    // 1 mm apart at 500 m, near plane at 1 mm. The nearer one is drawn last: if both had the same
    // depth, it would not show.
    root.add(placed(glm::scale(moved(0, 0, -500.001), glm::dvec3(400)), litNode(litSquare(), 2)));
    root.add(placed(glm::scale(moved(0, 0, -500), glm::dvec3(400)), litNode(litSquare(), 1)));
    const FrameLayers frame = render(viewFrom(0, 16, 16, {0.001f, 1e6f}), 16, 16);
    EXPECT_EQ(frame.objectId[frame.index(8, 8)].value, 1u);
}

TEST_F(RendererTest, FarFromTheOriginNothingTrembles) {
    const double far = 1e7;
    root.add(placed(moved(far, 0, 0), litNode(litSquare())));
    Lens lens;
    lens.focalLength = 1;
    lens.horizontalAperture = 2;
    lens.clippingRange = {0.01f, 100};
    const FrameLayers frame = render(makeView(lens, moved(far + 0.5, 0, 1), 64, 64), 64, 64);
    EXPECT_NEAR(frame.depth[frame.index(32, 32)], 1.0f, 1e-6f);
    EXPECT_TRUE(frame.objectId[frame.index(47, 32)].valid());  // x = far + 0.984
    EXPECT_FALSE(frame.objectId[frame.index(48, 32)].valid()); // x = far + 1.016
}

/// A curve as hard as can be: white from 1 nit on.
Rgb cutOff(Rgb colour) {
    return {std::min(colour.r, 1.0f), std::min(colour.g, 1.0f), std::min(colour.b, 1.0f)};
}

TEST_F(RendererTest, EdgesOfBrightEmittersAreAveragedAfterTheToneCurve) {
    // 10,000 nit against black: a pixel that a share s of an edge crosses has s * 10,000 nit, far
    // beyond white, but is shown as s. The mean of the samples is also what alpha is.
    root.add(placed(moved(0.013, 0.02, 0), litNode(litSquare({Rgb(0), Rgb(10000)}))));
    const int size = 48;
    const View view = viewFrom(2, size, size);
    const FrameLayers frame = renderFrame(*context, renderer, root, view, size, size, cutOff);
    ASSERT_EQ(frame.shown.size(), frame.pixelCount());
    int between = 0;
    for (std::size_t i = 0; i < frame.pixelCount(); ++i) {
        EXPECT_NEAR(frame.shown[i].g, frame.alpha[i], 1e-5f);
        between += frame.shown[i].g > 0.2f && frame.shown[i].g < 0.8f;
    }
    EXPECT_GT(between, size / 2) << "along four edges";
    EXPECT_TRUE(render(view, size, size).shown.empty()) << "only if it is asked for";
}

TEST_F(RendererTest, AskingForWhatIsShownChangesNoOtherLayer) {
    root.add(placed(moved(0.3, 0.1, 0), litNode(litSquare({kRho, {3, 2, 1}}))));
    const View view = viewFrom(2, 33, 70);
    Renderer strips({.samples = 4, .stripPixels = 33 * 16});
    const FrameLayers plain = renderFrame(*context, renderer, root, view, 33, 70);
    const FrameLayers toned = renderFrame(*context, strips, root, view, 33, 70, cutOff);
    EXPECT_EQ(plain.beauty, toned.beauty);
    EXPECT_EQ(plain.alpha, toned.alpha);
    EXPECT_EQ(plain.depth, toned.depth);
    for (std::size_t i = 0; i < toned.pixelCount(); ++i) // inside, where all samples are alike
        if (toned.alpha[i] == 1) expectNear(toned.shown[i], cutOff(toned.beauty[i]), 1e-5f);
}

TEST_F(RendererTest, WithOneSampleAPixelIsShownAsItIs) {
    root.add(litNode(litSquare({Rgb(0), Rgb(0.5f)})));
    Renderer single({.samples = 1});
    const FrameLayers frame = renderFrame(*context, single, root, viewFrom(2, 9, 9), 9, 9, cutOff);
    EXPECT_EQ(frame.shown, frame.beauty);
    EXPECT_EQ(frame.shown[frame.index(4, 4)], Rgb(0.5f));
}

} // namespace

} // namespace penumbra
