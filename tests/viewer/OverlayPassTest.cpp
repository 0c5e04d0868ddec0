// What is otherwise not seen: OverlayPass, and the block-wise uploads that the age of light goes
// by.
#include "viewer/OverlayPass.h"

#include "LitScenes.h"
#include "viewer/InteractiveRenderer.h"

#include <algorithm>

namespace penumbra {

namespace {

class OverlayPassTest : public WithContext {
protected:
    static constexpr int kSize = 64;

    std::vector<Rgb> draw(InteractiveRenderer& interactive, Overlay overlay, double now) {
        const View view = viewFrom(1, kSize, kSize);
        interactive.setOverlay(overlay, 10, now);
        interactive.drawScene(listVisible(root, Frustum(view.worldToClip())), view, {}, kSize,
                              kSize);
        return interactive.readLuminances();
    }
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

TEST_F(OverlayPassTest, ElementsHaveTheirEdgesButNoDiagonals) {
    const std::vector<std::uint32_t> edges = elementEdges(litSquare());
    EXPECT_EQ(edges, (std::vector<std::uint32_t>{0, 1, 0, 3, 1, 2, 2, 3}));
    LitMeshData triangle = litSquare();
    triangle.indices = {0, 1, 2};
    EXPECT_EQ(elementEdges(triangle).size(), 6u);
}

TEST_F(OverlayPassTest, TheMeshIsDrawnOnTheSurfaceAndNowhereElse) {
    root.add(litNode(strip(4)));
    InteractiveRenderer interactive(kExact);
    const std::vector<Rgb> plain = draw(interactive, Overlay::none, 0);
    const std::vector<Rgb> lined = draw(interactive, Overlay::elements, 0);
    std::size_t changed = 0;
    for (std::size_t i = 0; i < plain.size(); ++i) changed += !(plain[i] == lined[i]);
    EXPECT_GE(changed, 3u * (kSize - 2)) << "three inner edges";
    EXPECT_LT(changed, plain.size() / 4);
    EXPECT_EQ(draw(interactive, Overlay::none, 0), plain);
}

TEST_F(OverlayPassTest, OnlyChangedBlocksAreUploadedAndTheseGlow) {
    const auto geometry = litNode(strip(40)); // 160 vertices: blocks of 64, 64 and 32
    root.add(geometry);
    InteractiveRenderer interactive(kExact);
    draw(interactive, Overlay::age, 0);
    EXPECT_EQ(interactive.statistics().lightBytes, 0u);
    const std::vector<Rgb> before = draw(interactive, Overlay::age, 100);
    geometry->setBlock(2, [](LitMeshData& data) {
        for (std::size_t v = 128; v < 160; ++v) data.direct[v] = data.direct[v] * 1.0001f;
    });
    const std::vector<Rgb> after = draw(interactive, Overlay::age, 100.05);
    EXPECT_EQ(interactive.statistics().lightUploads, 1u);
    EXPECT_EQ(interactive.statistics().lightBytes, 32u * 2 * sizeof(Rgb));
    const std::size_t row = std::size_t(kSize / 2) * kSize;
    EXPECT_GT(after[row + kSize - 3].r, 2 * before[row + kSize - 3].r) << "the last block";
    EXPECT_NEAR(after[row + 3].r, before[row + 3].r, 1e-3f) << "the first one";
}

} // namespace

} // namespace penumbra
