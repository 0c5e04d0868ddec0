// The solution as it is drawn.
#include "radiosity/query/LitSurface.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

#include <numeric>

namespace penumbra {

namespace {

/// A floor of 1 x 1 m in 4 x 4 elements with made-up light: every vertex its own.
class LitFloor : public testing::Test {
protected:
    LitFloor()
        : built(meshed(sceneOf({object("floor", floorData(0, 1, 0, 1, 0))}),
                       {.patchSize = 1, .elementSize = 0.25f})) {
        for (std::size_t v = 0; v < built.patches.vertices.size(); ++v) {
            light.direct.push_back({float(v), 2 * float(v), 0});
            light.indirect.push_back({0, 1, float(v)});
        }
    }

    BuiltPatches built;
    Lighting light;
};

TEST_F(LitFloor, ReadAtAVertexIsTheVertexItself) {
    const LitSurface surface(built.patches, light);
    for (std::size_t v = 0; v < light.direct.size(); ++v) {
        const glm::vec3 p = built.patches.vertices[v].position;
        if (p.x == 0 || p.y == 0 || p.x == 1 || p.y == 1) continue; // the very rim may be missed
        const auto sample = surface.under(p, {0, 0, 1});
        ASSERT_TRUE(sample) << p.x << " " << p.y;
        EXPECT_NEAR(sample->direct.r, light.direct[v].r, 1e-3f);
        EXPECT_NEAR(sample->direct.g, light.direct[v].g, 1e-3f);
        EXPECT_NEAR(sample->indirect.b, light.indirect[v].b, 1e-3f);
        EXPECT_LT(glm::distance(sample->position, p), 1e-5f);
        EXPECT_EQ(sample->normal, glm::vec3(0, 0, 1));
    }
}

TEST_F(LitFloor, ReadInATriangleIsTheMeanOfItsCorners) {
    const LitSurface surface(built.patches, light);
    for (const Element& element : built.patches.elements) {
        glm::vec3 p(0);
        float expected = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            p += built.patches.vertices[element.vertices[k]].position / 3.0f;
            expected += light.direct[element.vertices[k]].r / 3.0f;
        }
        const auto sample = surface.under(p, {0, 0, 1});
        ASSERT_TRUE(sample);
        EXPECT_NEAR(sample->direct.r, expected, 1e-3f);
    }
}

TEST_F(LitFloor, IsMetFromItsFrontOnly) {
    const LitSurface surface(built.patches, light);
    const auto hit = surface.trace({0.3f, 0.6f, 2}, {0, 0, -1});
    ASSERT_TRUE(hit);
    EXPECT_FLOAT_EQ(hit->distance, 2);
    EXPECT_FALSE(surface.trace({0.3f, 0.6f, -2}, {0, 0, 1}));
    EXPECT_FALSE(surface.under({0.3f, 0.6f, 0}, {0, 0, -1}));
    EXPECT_FALSE(surface.under({0.3f, 0.6f, 0.1f}, {0, 0, 1})); // in the air
}

TEST_F(LitFloor, AsABranchOfTheSceneGraphHasTheSameVertices) {
    const LitBranch node(built.patches, light);
    ASSERT_EQ(node.children().size(), 1u);
    const auto& data = dynamic_cast<const LitGeometry&>(*node.children()[0]).data();
    EXPECT_EQ(data.positions.size(), 25u);
    EXPECT_EQ(data.indices.size(), 16u * 6);
    const float sum = std::accumulate(data.direct.begin(), data.direct.end(), 0.0f,
                                      [](float s, Rgb c) { return s + c.r; });
    EXPECT_EQ(sum, 24 * 25 / 2);
    for (std::size_t i = 0; i < data.indices.size(); i += 3) {
        const auto at = [&](std::size_t k) { return data.positions[data.indices[i + k]]; };
        EXPECT_GT(glm::cross(at(1) - at(0), at(2) - at(0)).z, 0);
    }
}

} // namespace

} // namespace penumbra
