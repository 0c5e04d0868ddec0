// Dense meshes: they cost as their area does, keep the light that there is, and follow edits.
#include "radiosity/mesh/BuildPatches.h"
#include "scenegraph/Light.h"
#include "scenegraph/Transform.h"
#include "tests/support/BallData.h"
#include "tests/support/LitDifference.h"
#include "tests/support/Reference.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace penumbra {

namespace {

constexpr MeshingOptions kSizes{.patchSize = 0.4f, .elementSize = 0.1f};

std::shared_ptr<Material> glowing() {
    return paint(Rgb(0.5f), Rgb(1 / std::numbers::pi_v<float>));
}

Scene roomWith(MeshData ball, std::shared_ptr<Material> walls = paint(Rgb(0.6f))) {
    return sceneOf({object("room", boxData({-1, -1, -1}, {1, 1, 1}, true, std::move(walls))),
                    object("ball", std::move(ball))});
}

TEST(DenseMeshes, HaveAsManyPatchesHoweverManyTheirTriangles) {
    const auto patches = [](int rings) {
        return double(meshed(roomWith(ballData(rings, 0.5f)), kSizes).patches.patchCount());
    };
    const double coarse = patches(40), fine = patches(160);
    EXPECT_LT(fine, 1.2 * coarse);
    EXPECT_LT(fine, 1400); // 150 of the room
}

TEST(DenseMeshes, HaveVerticesThatTakeAMeanOfTheNodesAroundThem) {
    const PatchSet set = meshed(roomWith(ballData(40, 0.5f)), kSizes).patches;
    std::size_t blended = 0;
    for (std::uint32_t v = 0; v < set.vertices.size(); ++v) {
        const std::uint32_t blend = set.vertexCoordinates[v].blend;
        if (blend == PatchCoordinate::kNone) continue;
        ++blended;
        float sum = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            const auto [patches, weights] = set.blends[blend];
            sum += weights[k];
            if (weights[k] == 0) continue;
            const Receiver& node = set.nodes[set.patches[patches[k]].centreNode];
            EXPECT_GT(glm::dot(node.normal, set.vertices[v].receiver.normal), 0.5f);
        }
        EXPECT_NEAR(sum, 1, 1e-5f);
    }
    EXPECT_GT(blended, 3000u);
}

/// Vertices of the ball that receive light themselves, and those that take it from them.
struct Received {
    std::size_t receivers = 0, blended = 0;
};

Received receivedOn(const PatchSet& set) {
    Received received;
    const auto ball = std::ranges::find(set.objects, "/ball", &ObjectPart::path);
    for (std::uint32_t v = ball->vertices.first; v < ball->vertices.end(); ++v)
        if (!isPadding(set.vertices[v].receiver))
            ++(set.isBlended(v / PatchSet::kBlock) ? received.blended : received.receivers);
    return received;
}

TEST(DenseMeshes, ReceiveLightAtAsManyVerticesHoweverManyTheyHave) {
    const auto on = [](int rings) {
        return receivedOn(meshed(roomWith(ballData(rings, 0.5f)), kSizes).patches);
    };
    const Received coarse = on(40), fine = on(160);
    EXPECT_LT(double(fine.receivers), 1.3 * double(coarse.receivers));
    EXPECT_GT(fine.blended, 20 * fine.receivers);
}

TEST(DenseMeshes, TakeLightFromReceiversAroundOnTheSameSide) {
    const PatchSet set = meshed(roomWith(ballData(80, 0.5f)), kSizes).patches;
    for (std::uint32_t v = 0; v < set.vertices.size(); ++v) {
        const Vertex& vertex = set.vertices[v];
        if (isPadding(vertex.receiver) || !set.isBlended(v / PatchSet::kBlock)) continue;
        float sum = 0;
        set.forEachReceiver(v, [&](std::uint32_t r, float weight) {
            sum += weight;
            EXPECT_FALSE(set.isBlended(r / PatchSet::kBlock));
            EXPECT_LT(glm::distance(set.vertices[r].position, vertex.position), 0.3f);
            EXPECT_GT(glm::dot(set.vertices[r].receiver.normal, vertex.receiver.normal), 0.5f);
        });
        EXPECT_NEAR(sum, 1, 1e-5f) << v;
    }
}

/// Where nothing is in the way, light that is blended is that of the vertex itself: its normal and
/// place count, and not those of the receivers around.
TEST(DenseMeshes, AreLitDirectlyAsEachVertexLies) {
    SolverOptions direct;
    direct.directOnly = true;
    const Scene scene =
        sceneOf({object("ball", ballData(120, 0.3f)),
                 placed("light", moved(0, 0, 2),
                        {std::make_shared<Light>("light", RectShape{0.5f, 0.5f}, Rgb(20.0f))})});
    LitScene lit(placeScene(scene), kSizes, direct);
    lit.solver().settle();
    const PatchSet& set = lit.patches();
    const EmitterSender& emitter = lit.solver().direct().senders()[0];
    std::size_t blended = 0;
    for (std::uint32_t v = 0; v < set.vertices.size(); ++v) {
        const Receiver& receiver = set.vertices[v].receiver;
        if (isPadding(receiver) || !set.isBlended(v / PatchSet::kBlock)) continue;
        if (receiver.normal.z < 0.5f) continue; // the ball's own shadow begins at its equator
        ++blended;
        const Rgb wanted = emitter.formFactor(receiver) * set.emitters[0].exitance;
        EXPECT_NEAR(lit.solver().direct().vertices()[v].g, wanted.g, 1e-3f * wanted.g) << v;
    }
    EXPECT_GT(blended, 1000u);
}

TEST(DenseMeshes, InAFurnaceAreAsBrightAsItsWalls) {
    const Solution solution(roomWith(ballData(40, 0.5f, glowing()), glowing()), kSizes,
                            {.residual = 1e-6});
    // As in Furnace: visibility is sampled. Means over wall and ball are what clusters decide.
    double ball = 0, area = 0, all = 0;
    for (std::size_t e = 0; e < solution.patches().elements.size(); ++e) {
        const Element& element = solution.patches().elements[e];
        const double size = elementArea(solution.patches(), element);
        const double light = size * elementMean(element, solution.lighting).g;
        all += light;
        if (solution.patches().objects[solution.patches().elementObject[e].value].path != "/ball")
            continue;
        ball += light;
        area += size;
    }
    EXPECT_NEAR(all / solution.patches().area, 2, 0.02);
    EXPECT_NEAR(ball / area, 2, 0.02);
}

/// A lit room with a dense ball and a block, followed.
struct DenseRoom {
    std::shared_ptr<Transform> ball =
        objectOf("ball", {std::make_shared<Mesh>("mesh", ballData(24, 0.3f))});
    std::shared_ptr<Transform> block =
        objectOf("block", {std::make_shared<Mesh>(
                              "mesh", boxData({-0.2f, -0.2f, -0.2f}, {0.2f, 0.2f, 0.2f}, false))});
    Scene scene =
        sceneOf({object("room", boxData({-1, -1, -1}, {1, 1, 1}, true)), ball, block,
                 placed("lamp", moved(0, 0, 0.9),
                        {std::make_shared<Light>("light", RectShape{0.5f, 0.5f}, Rgb(20.0f))})});
    LitScene lit{placeScene(scene), kSizes, SolverOptions()};

    std::string differs() {
        lit.solver().settle();
        LitScene scratch(placeScene(scene), sizesOf(lit.patches()), SolverOptions());
        scratch.solver().settle();
        return difference(lit, scratch);
    }
    void follow() { lit.follow(placeScene(scene)); }
};

TEST(DenseMeshes, EqualThoseFromScratchWhereverTheyAre) {
    DenseRoom room;
    room.block->setMatrix(moved(0.5, 0.5, -0.8));
    room.follow();
    ASSERT_TRUE(std::ranges::any_of(room.lit.patches().patches,
                                    [](const Patch& patch) { return patch.cluster; }));
    for (const glm::dvec3 at : {glm::dvec3(0, 0, 0), glm::dvec3(0.1, -0.2, -0.71), // in the floor
                                glm::dvec3(0.3, 0.4, -0.7),                        // in the block
                                glm::dvec3(-0.5, 0.2, 0)}) {
        room.ball->setMatrix(moved(at.x, at.y, at.z));
        room.follow();
        EXPECT_EQ(room.differs(), "") << at.x << ", " << at.y << ", " << at.z;
    }
}

TEST(DenseMeshes, EqualThoseFromScratchWhenTheyComeGrowAndGo) {
    DenseRoom room;
    room.lit.solver().settle();
    const auto another = objectOf("another", {std::make_shared<Mesh>("mesh", ballData(20, 0.25f))});
    another->setMatrix(moved(-0.4, -0.4, -0.78));
    room.scene.root->add(another);
    room.follow();
    EXPECT_EQ(room.differs(), "") << "it has come";
    another->setMatrix(another->matrix() * scaled(1.2));
    room.follow();
    EXPECT_EQ(room.differs(), "") << "it has grown";
    room.scene.root->remove(another);
    room.follow();
    EXPECT_EQ(room.differs(), "") << "it has gone";
}

} // namespace

} // namespace penumbra
