// Small lit scenes and views for the tests of the renderer.
#pragma once

#include "radiosity/process/store/PublishedGeometry.h"
#include "scenegraph/Camera.h"
#include "scenegraph/Group.h"
#include "scenegraph/Transform.h"
#include "tests/scenegraph/SceneParts.h"
#include "viewer/gl/OffscreenContext.h"
#include "viewer/gl/Renderer.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <memory>

namespace penumbra {

inline constexpr Rgb kRho{0.5f, 0.25f, 0.75f};
inline constexpr Rgb kDirect{100, 200, 50}; ///< [lux]
inline constexpr Rgb kIndirect{10, 5, 20};  ///< [lux]

/// A square of side 2 around the origin of the plane z = 0, facing +z, evenly lit.
inline LitMeshData litSquare(LitMaterial material = {kRho, {}}) {
    LitMeshData data;
    data.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    data.normals.assign(4, {0, 0, 1});
    data.direct.assign(4, kDirect);
    data.indirect.assign(4, kIndirect);
    data.indices = {0, 1, 2, 0, 2, 3};
    data.triangleMaterial = {0, 0};
    data.materials = {material};
    return data;
}

inline std::shared_ptr<PublishedGeometry> litNode(LitMeshData data, std::uint32_t object = 7) {
    return std::make_shared<PublishedGeometry>("lit", ObjectId{object}, std::move(data));
}

inline std::shared_ptr<Transform> placed(const glm::dmat4& matrix, NodePtr child) {
    auto transform = std::make_shared<Transform>("place");
    transform->setMatrix(matrix);
    transform->add(std::move(child));
    return transform;
}

/// From (0, 0, distance) towards the origin; at distance 1 a unit of length is the half width.
inline View viewFrom(double distance, int width, int height, glm::vec2 range = {0.01f, 1000}) {
    Lens lens;
    lens.focalLength = 1;
    lens.horizontalAperture = 2;
    lens.clippingRange = range;
    return makeView(lens, moved(0, 0, distance), width, height);
}

/// One context for the whole test program: making it takes longer than a frame.
class WithContext : public testing::Test {
protected:
    static void SetUpTestSuite() { context = std::make_unique<OffscreenContext>(); }
    static void TearDownTestSuite() { context.reset(); }

    FrameLayers render(const View& view, int width, int height) {
        return renderFrame(*context, renderer, root, view, width, height);
    }

    static inline std::unique_ptr<OffscreenContext> context;
    Renderer renderer;
    Group root{""};
};

inline void expectNear(Rgb actual, Rgb expected, float relative) {
    EXPECT_NEAR(actual.r, expected.r, relative * std::abs(expected.r));
    EXPECT_NEAR(actual.g, expected.g, relative * std::abs(expected.g));
    EXPECT_NEAR(actual.b, expected.b, relative * std::abs(expected.b));
}

} // namespace penumbra
