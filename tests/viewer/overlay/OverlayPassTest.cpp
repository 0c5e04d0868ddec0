// What lies over the picture, and the block-wise uploads below it.
#include "viewer/overlay/OverlayPass.h"

#include "tests/viewer/gl/LitScenes.h"
#include "viewer/app/InteractiveRenderer.h"
#include "viewer/overlay/ColourMap.h"

#include <epoxy/gl.h>

#include <algorithm>

namespace penumbra {

namespace {

class OverlayPassTest : public WithContext {
protected:
    static constexpr int kSize = 64;

    /// What the display shows, lower row first.
    std::vector<glm::u8vec4> show(InteractiveRenderer& interactive, OverlayPicture overlay,
                                  float middleGrey = 10) {
        const View view = viewFrom(1, kSize, kSize);
        interactive.setOverlay(std::move(overlay));
        interactive.drawScene(listVisible(root, Frustum(view.worldToClip())), view, {}, kSize,
                              kSize);
        if (colour_.name() == 0) {
            colour_ = makeRenderbuffer();
            framebuffer_ = makeFramebuffer();
            glBindRenderbuffer(GL_RENDERBUFFER, colour_.name());
            glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, kSize, kSize);
            glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
            glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                      colour_.name());
        }
        interactive.show(framebuffer_.name(), middleGrey, ToneStyle::srgb);
        std::vector<glm::u8vec4> pixels(kSize * kSize);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.name());
        glReadPixels(0, 0, kSize, kSize, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
        return pixels;
    }

    static glm::u8vec4 at(const std::vector<glm::u8vec4>& pixels, int x) {
        return pixels[std::size_t(kSize / 2 * kSize + x)];
    }

private:
    GlObject colour_, framebuffer_;
};

const InteractiveOptions kExact{.samples = 1, .precision = HdrTarget::Precision::single};

/// A strip of quadrilaterals of 4 vertices each, more than a block of them.
LitMeshData strip(int count) {
    LitMeshData data;
    for (int i = 0; i < count; ++i) {
        const float left = -1 + 2 * float(i) / float(count);
        const float right = -1 + 2 * float(i + 1) / float(count);
        for (const glm::vec3 p : {glm::vec3(left, -1, 0), glm::vec3(right, -1, 0),
                                  glm::vec3(right, 1, 0), glm::vec3(left, 1, 0)})
            data.positions.push_back(p);
        const auto first = std::uint32_t(4 * i);
        for (const std::uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) data.indices.push_back(first + k);
        data.triangleMaterial.insert(data.triangleMaterial.end(), {0, 0});
    }
    data.normals.assign(data.positions.size(), {0, 0, 1});
    data.direct.assign(data.positions.size(), kDirect);
    data.indirect.assign(data.positions.size(), kIndirect);
    data.materials = {{kRho, {}}};
    return data;
}

int farthest(glm::u8vec4 a, glm::u8vec4 b) {
    const glm::ivec4 d = glm::abs(glm::ivec4(a) - glm::ivec4(b));
    return std::max({d.r, d.g, d.b});
}

TEST_F(OverlayPassTest, TheMeshIsDrawnOnTheSurfaceAndNowhereElse) {
    LitMeshData data = strip(4);
    data.trianglePatch = {0, 0, 0, 0, 1, 1, 1, 1};
    root.add(litNode(data));
    InteractiveRenderer interactive(kExact);
    OverlayPicture mesh;
    mesh.mesh = true;
    const std::vector<glm::u8vec4> plain = show(interactive, {});
    const std::vector<glm::u8vec4> lined = show(interactive, mesh);
    std::size_t strong = 0, weak = 0;
    const auto inside = [](std::size_t place) { return place >= 2 && place < kSize - 2; };
    for (std::size_t i = 0; i < plain.size(); ++i) {
        if (!inside(i % kSize) || !inside(i / kSize)) continue; // the strip ends there
        const int change = farthest(plain[i], lined[i]);
        strong += change > 60;
        weak += change > 1 && change <= 60;
    }
    EXPECT_EQ(strong, kSize - 4u) << "between the patches";
    EXPECT_EQ(weak, 2u * (kSize - 4)) << "within each";
    EXPECT_EQ(show(interactive, {}), plain);
}

TEST_F(OverlayPassTest, ColoursOfBlocksAreThoseOfTheDisplayWhateverTheExposure) {
    const auto geometry = litNode(strip(40)); // 160 vertices: blocks of 64, 64 and 32
    root.add(geometry);
    const glm::u8vec4 red(200, 10, 30, 255), blue(0, 40, 250, 255);
    OverlayPicture overlay;
    overlay.blocks[geometry.get()] = {red, {0, 0, 0, 0}, blue};
    for (const int samples : {1, 4}) {
        InteractiveRenderer interactive({.samples = samples});
        const std::vector<glm::u8vec4> plain = show(interactive, {});
        const std::vector<glm::u8vec4> over = show(interactive, overlay);
        const std::vector<glm::u8vec4> darker = show(interactive, overlay, 1000);
        EXPECT_LE(farthest(at(over, 3), red), 1);
        EXPECT_LE(farthest(at(darker, 3), red), 1);
        EXPECT_LE(farthest(at(over, kSize - 3), blue), 1);
        EXPECT_EQ(at(over, kSize / 2), at(plain, kSize / 2)) << "no colour: the picture";
        EXPECT_GT(farthest(at(darker, kSize / 2), at(plain, kSize / 2)), 20);
    }
}

TEST_F(OverlayPassTest, ALittleOfThePictureIsSeenThrough) {
    const auto geometry = litNode(strip(4));
    root.add(geometry);
    OverlayPicture overlay;
    overlay.blocks[geometry.get()] = {{255, 255, 255, 51}};
    InteractiveRenderer interactive(kExact);
    const glm::vec4 plain(at(show(interactive, {}), 20));
    const glm::vec4 over(at(show(interactive, overlay), 20));
    EXPECT_NEAR(over.g, 51 + 0.8f * plain.g, 2.0f);
}

TEST_F(OverlayPassTest, ExposureDoesNotMeasureTheOverlay) {
    const auto geometry = litNode(strip(4));
    root.add(geometry);
    OverlayPicture overlay;
    overlay.blocks[geometry.get()] = {{255, 255, 255, 255}};
    InteractiveRenderer interactive(kExact);
    show(interactive, {});
    const std::optional<std::vector<float>> plain = interactive.luminances(true);
    show(interactive, overlay);
    EXPECT_EQ(interactive.luminances(true), plain);
}

TEST_F(OverlayPassTest, WhatStandsInFrontHidesTheOverlay) {
    const auto geometry = litNode(strip(4));
    root.add(geometry);
    root.add(placed(moved(0, 0, 0.1), litNode(litSquare(), 8)));
    InteractiveRenderer interactive(kExact);
    const std::vector<glm::u8vec4> plain = show(interactive, {});
    OverlayPicture overlay;
    overlay.blocks[geometry.get()] = {{255, 0, 0, 255}};
    EXPECT_EQ(show(interactive, overlay), plain);
}

TEST_F(OverlayPassTest, ColoursForAnotherNumberOfBlocksAreNotDrawn) {
    const auto geometry = litNode(strip(4));
    root.add(geometry);
    InteractiveRenderer interactive(kExact);
    const std::vector<glm::u8vec4> plain = show(interactive, {});
    OverlayPicture overlay;
    overlay.blocks[geometry.get()] = {{255, 0, 0, 255}, {255, 0, 0, 255}};
    EXPECT_EQ(show(interactive, overlay), plain);
}

TEST_F(OverlayPassTest, OnlyBlocksWithNewLightAreUploaded) {
    const auto geometry = litNode(strip(40));
    root.add(geometry);
    InteractiveRenderer interactive(kExact);
    show(interactive, {});
    EXPECT_EQ(interactive.statistics().lightBytes, 0u);
    geometry->setBlock(2, [](LitMeshData& data) {
        for (std::size_t v = 128; v < 160; ++v) data.direct[v] = data.direct[v] * 1.0001f;
    });
    show(interactive, {});
    EXPECT_EQ(interactive.statistics().lightUploads, 1u);
    EXPECT_EQ(interactive.statistics().lightBytes, 32u * 2 * sizeof(Rgb));
}

} // namespace

} // namespace penumbra
