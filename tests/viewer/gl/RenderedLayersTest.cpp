// The layers of a rendered frame: sizes, edges, strips.
#include "tests/viewer/gl/LitScenes.h"

#include "base/Error.h"

#include <glm/gtc/constants.hpp>

#include <cmath>

namespace penumbra {

namespace {

using RenderedLayers = WithContext;

TEST_F(RenderedLayers, NothingIsBlackInfinitelyFarAndNobodys) {
    const FrameLayers frame = render(viewFrom(1, 3, 2), 3, 2);
    for (std::size_t i = 0; i < frame.pixelCount(); ++i) {
        EXPECT_EQ(frame.beauty[i], Rgb(0));
        EXPECT_EQ(frame.alpha[i], 0);
        EXPECT_EQ(frame.normal[i], glm::vec3(0));
        EXPECT_EQ(frame.depth[i], FrameLayers::kNoDepth);
        EXPECT_EQ(frame.objectId[i].value, ObjectId::kNone);
    }
}

TEST_F(RenderedLayers, DepthIsAlongTheAxisAndNormalsAreInTheWorld) {
    // A wall at 3 m has depth 3 m in every pixel, though its corners are farther from the eye.
    root.add(placed(glm::scale(moved(0, 0, -3), glm::dvec3(10, 10, 10)), litNode(litSquare(), 42)));
    const FrameLayers frame = render(viewFrom(0, 16, 8), 16, 8);
    for (std::size_t i = 0; i < frame.pixelCount(); ++i) {
        EXPECT_NEAR(frame.depth[i], 3.0f, 1e-5f);
        EXPECT_NEAR(glm::distance(frame.normal[i], glm::vec3(0, 0, 1)), 0, 1e-6f);
        EXPECT_EQ(frame.objectId[i].value, 42u);
        EXPECT_EQ(frame.albedo[i], kRho);
        expectNear(frame.illuminance[i], kDirect + kIndirect, 1e-6f);
    }
}

TEST_F(RenderedLayers, NormalsStandUprightOnStretchedSurfaces) {
    // x is squeezed to a half after the square was turned by 45 degrees about y: the normal follows
    // the inverse transpose, (1, 0, 1) becoming (2, 0, 1).
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), glm::pi<double>() / 4, {0, 1, 0});
    root.add(placed(glm::scale(glm::dmat4(1.0), {0.5, 1, 1}) * turned, litNode(litSquare())));
    const FrameLayers frame = render(viewFrom(2, 9, 9), 9, 9);
    const glm::vec3 expected = glm::normalize(glm::vec3(2, 0, 1));
    EXPECT_NEAR(glm::distance(frame.normal[frame.index(4, 4)], expected), 0, 1e-6f);
}

TEST_F(RenderedLayers, TheTopRowComesFirst) {
    root.add(placed(moved(0, 1.5, 0), litNode(litSquare())));
    const FrameLayers frame = render(viewFrom(1, 4, 4), 4, 4);
    EXPECT_TRUE(frame.objectId[frame.index(1, 0)].valid());
    EXPECT_FALSE(frame.objectId[frame.index(1, 3)].valid());
}

TEST_F(RenderedLayers, EdgesAverageLightButNeverIdsDepthOrNormals) {
    const NodePtr bright = litNode(litSquare({Rgb(0), Rgb(1e6f)}), 1);
    const NodePtr dim = litNode(litSquare({Rgb(0), Rgb(1)}), 2);
    const glm::dmat4 tilted = glm::rotate(glm::dmat4(1.0), 0.3, {0, 0, 1});
    root.add(placed(glm::scale(tilted, glm::dvec3(0.5)), bright));
    root.add(placed(glm::scale(moved(0, 0, -1), glm::dvec3(10)), dim));
    const FrameLayers frame = render(viewFrom(1, 32, 32), 32, 32);
    const int samples = renderer.statistics().samples;
    ASSERT_GT(samples, 1);
    int edges = 0;
    for (std::size_t i = 0; i < frame.pixelCount(); ++i) {
        // k of n samples bright: the mean of linear values, (k 1e6 + (n - k)) / n
        const double covered = (frame.beauty[i].r - 1) / (1e6 - 1) * samples;
        EXPECT_NEAR(covered, std::round(covered), 1e-5);
        edges += frame.beauty[i].r > 1 && frame.beauty[i].r < 1e6f;
        EXPECT_EQ(frame.alpha[i], 1);
        EXPECT_TRUE(frame.objectId[i].value == 1 || frame.objectId[i].value == 2);
        EXPECT_NEAR(frame.depth[i], frame.objectId[i].value == 1 ? 1 : 2, 1e-5);
    }
    EXPECT_GT(edges, 8);
}

TEST_F(RenderedLayers, LightIsNotExtrapolatedAtEdges) {
    // From 0 at the lower edge to 1000 lx at the upper: below the one it would be negative.
    LitMeshData data = litSquare({Rgb(1), {}});
    data.direct = {Rgb(0), Rgb(0), Rgb(1000), Rgb(1000)};
    data.indirect.assign(4, Rgb(0));
    root.add(placed(glm::rotate(glm::dmat4(1.0), 0.2, {0, 0, 1}), litNode(std::move(data))));
    const FrameLayers frame = render(viewFrom(4, 24, 24), 24, 24);
    for (const Rgb& pixel : frame.beauty) {
        EXPECT_GE(pixel.r, 0);
        EXPECT_LE(pixel.r, 1000 / glm::pi<float>() * 1.00001f);
    }
}

TEST_F(RenderedLayers, BeautyIsTheSumOfItsParts) {
    root.add(placed(glm::rotate(glm::dmat4(1.0), 0.4, {1, 1, 0}), litNode(litSquare())));
    const FrameLayers frame = render(viewFrom(2, 24, 24), 24, 24);
    for (std::size_t i = 0; i < frame.pixelCount(); ++i)
        expectNear(frame.beauty[i], frame.direct[i] + frame.indirect[i], 1e-6f);
}

TEST_F(RenderedLayers, AnOddSizeAfterAnotherIsRight) {
    root.add(litNode(litSquare()));
    const std::pair<int, int> sizes[] = {{64, 64}, {1, 1}, {37, 91}, {300, 2}};
    for (const auto& [width, height] : sizes) {
        const FrameLayers frame = render(viewFrom(0.4, width, height), width, height);
        EXPECT_EQ(frame.width, width);
        EXPECT_EQ(frame.height, height);
        EXPECT_EQ(frame.beauty.size(), std::size_t(width * height));
        EXPECT_EQ(frame.objectId[frame.index(width / 2, height / 2)].value, 7u);
    }
}

TEST_F(RenderedLayers, StripsLeaveNoSeams) {
    Renderer striped({.stripPixels = 500});
    root.add(placed(glm::rotate(glm::dmat4(1.0), 0.4, {1, 1, 0}), litNode(litSquare())));
    const int width = 50, height = 37;
    const View view = viewFrom(1.2, width, height);
    const FrameLayers whole = render(view, width, height);
    const FrameLayers parts = renderFrame(*context, striped, root, view, width, height);
    EXPECT_EQ(striped.statistics().drawCalls, 2u * 4) << "10 rows each";
    for (std::size_t i = 0; i < whole.pixelCount(); ++i) {
        EXPECT_EQ(whole.objectId[i], parts.objectId[i]) << i;
        EXPECT_NEAR(whole.alpha[i], parts.alpha[i], 1e-6f) << i;
        if (!whole.objectId[i].valid()) continue; // infinity
        EXPECT_NEAR(whole.depth[i], parts.depth[i], 1e-5f) << i;
    }
}

TEST_F(RenderedLayers, WithoutMultisamplingEveryPixelIsAllOrNothing) {
    Renderer plain({.samples = 1});
    root.add(placed(glm::rotate(glm::dmat4(1.0), 0.3, {0, 0, 1}), litNode(litSquare())));
    const FrameLayers frame = renderFrame(*context, plain, root, viewFrom(2, 32, 32), 32, 32);
    EXPECT_EQ(plain.statistics().samples, 1);
    for (std::size_t i = 0; i < frame.pixelCount(); ++i)
        EXPECT_EQ(frame.alpha[i], frame.objectId[i].valid() ? 1 : 0);
}

TEST_F(RenderedLayers, MoreSamplesThanTheDriverHasAreFewer) {
    Renderer greedy({.samples = 1000});
    root.add(litNode(litSquare()));
    const FrameLayers frame = renderFrame(*context, greedy, root, viewFrom(1, 5, 5), 5, 5);
    EXPECT_LT(greedy.statistics().samples, 1000);
    EXPECT_EQ(frame.alpha[12], 1);
}

TEST_F(RenderedLayers, TheSameFrameGivesTheSameBits) {
    root.add(placed(glm::rotate(glm::dmat4(1.0), 0.4, {1, 1, 0}), litNode(litSquare())));
    const FrameLayers a = render(viewFrom(1.2, 40, 40), 40, 40);
    const FrameLayers b = render(viewFrom(1.2, 40, 40), 40, 40);
    EXPECT_EQ(a.beauty, b.beauty);
    EXPECT_EQ(a.depth, b.depth);
}

TEST_F(RenderedLayers, APictureTooLargeForTheDriverIsAnError) {
    EXPECT_THROW(render(viewFrom(1, 1 << 20, 1), 1 << 20, 1), Error);
}

} // namespace

} // namespace penumbra
