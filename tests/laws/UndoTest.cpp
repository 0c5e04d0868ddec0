// What is moved back gives the picture that there was, however often.
#include "tests/support/LitDifference.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace penumbra {

namespace {

/// A room with a box that can be moved about on the floor.
struct RoomWithABox {
    std::shared_ptr<Transform> box = objectOf(
        "box", {std::make_shared<Mesh>("mesh", boxData({-0.3f, -0.2f, 0}, {0.3f, 0.2f, 0.7f}, false,
                                                       paint({0.8f, 0.2f, 0.2f})))});
    Scene scene =
        sceneOf({object("room", boxData({-1, -1, 0}, {1, 1, 2}, true, paint({0.7f, 0.6f, 0.5f}))),
                 box, object("board", boxData({0.5f, -0.5f, 0.4f}, {0.9f, 0.5f, 0.5f}, false)),
                 ceilingLight({0, 0, 1.99f}, 0.8f, 0.6f, {10, 9, 8})});
    glm::dmat4 here = glm::rotate(moved(0.1, 0.4, 0), 0.3, {0, 0, 1});
    glm::dmat4 there =
        glm::rotate(moved(0.4, -0.3, 0), 1.1, {0, 0, 1}); // below the board, and in it

    RoomWithABox() { box->setMatrix(here); }
};

std::unique_ptr<LitScene> light(const Scene& scene, const MeshingOptions& meshing, double residual,
                                bool clusters = true) {
    auto lit = std::make_unique<LitScene>(
        placeScene(scene), meshing, SolverOptions{.residual = residual, .clusters = clusters});
    lit->solver().settle();
    return lit;
}

void moveTo(LitScene& lit, RoomWithABox& room, const glm::dmat4& place) {
    room.box->setMatrix(place);
    ASSERT_FALSE(lit.follow(placeScene(room.scene)).rebuilt);
    lit.solver().settle();
}

/// Entries of the vertices and of the nodes of the mesh, and who among the samples is seen. Private
/// vertices and parts are handed out in any order: difference() compares them by their addresses.
void expectSameMasks(const LitScene& a, const LitScene& b) {
    const std::size_t blocks = a.patches().firstPrivate / PatchSet::kBlock;
    for (std::size_t e = 0; e < a.patches().emitters.size(); ++e)
        for (std::size_t i = 0; i < blocks; ++i)
            EXPECT_TRUE(a.solver().emitterRows()[e][i].sameMasks(b.solver().emitterRows()[e][i]));
    int rows = 0;
    for (std::size_t p = 0; p < a.patches().parts.firstPatch; ++p) {
        const Row &one = a.solver().patchRows()[p], &other = b.solver().patchRows()[p];
        if (one.empty() || other.empty()) continue; // light never reached it
        ++rows;
        const RowBlock none;
        for (std::uint32_t i = 0; i < a.patches().parts.firstNode / PatchSet::kBlock; ++i)
            EXPECT_TRUE((one.has(i) ? one[i] : none).sameMasks(other.has(i) ? other[i] : none))
                << "sender " << p << " block " << i;
    }
    EXPECT_GT(rows, 20);
}

/// Direct light at the corners of elements: by corner, for the vertices that represent corners
/// which something covers are handed out in any order.
void expectSameDirectLight(const LitScene& a, const LitScene& b) {
    const auto lightA = a.solver().lighting().direct, lightB = b.solver().lighting().direct;
    for (std::uint32_t e = 0; e < a.patches().elements.size(); ++e) {
        ASSERT_EQ(a.patches().receives(e), b.patches().receives(e));
        if (!a.patches().receives(e)) continue;
        for (std::size_t k = 0; k < 4; ++k) {
            const Rgb one = lightA[a.patches().elements[e].vertices[k]];
            const Rgb other = lightB[b.patches().elements[e].vertices[k]];
            EXPECT_EQ(std::memcmp(&one, &other, sizeof one), 0) << "element " << e;
        }
    }
}

TEST(Undo, AMoveTakenBackGivesTheFormerPicture) {
    RoomWithABox room;
    const MeshingOptions sizes{.patchSize = 0.4f, .elementSize = 0.1f};
    const auto untouched = light(room.scene, sizes, 1e-4);
    const auto edited = light(room.scene, sizes, 1e-4);
    moveTo(*edited, room, room.there);
    EXPECT_NE(edited->solver().radiosity(), untouched->solver().radiosity());
    moveTo(*edited, room, room.here);
    expectSameMasks(*edited, *untouched);
    expectSameDirectLight(*edited, *untouched);
    EXPECT_EQ(difference(*edited, *untouched), "");
}

TEST(Undo, WhatIsHiddenAndShownAgainGivesTheFormerPicture) {
    RoomWithABox room;
    const auto choice = make<Switch>("choice", {room.box});
    ASSERT_TRUE(room.scene.root->remove(room.box));
    room.scene.root->add(choice);
    const MeshingOptions sizes{.patchSize = 0.4f, .elementSize = 0.1f};
    const auto untouched = light(room.scene, sizes, 1e-4);
    const auto edited = light(room.scene, sizes, 1e-4);
    for (const bool visible : {false, true}) {
        choice->setVisible(visible);
        ASSERT_FALSE(edited->follow(placeScene(room.scene)).rebuilt);
        edited->solver().settle();
    }
    expectSameMasks(*edited, *untouched);
    expectSameDirectLight(*edited, *untouched);
    EXPECT_EQ(difference(*edited, *untouched), "");
}

TEST(Undo, AThousandTimesForthAndBackDoesNotDrift) {
    RoomWithABox room;
    const MeshingOptions sizes{.patchSize = 1, .elementSize = 0.5f};
    const double residual = 1e-9; // far below what is asked for, so that rounding would show
    const auto untouched = light(room.scene, sizes, residual);
    const auto edited = light(room.scene, sizes, residual);
    for (int i = 0; i < 1000; ++i) {
        moveTo(*edited, room, room.there);
        moveTo(*edited, room, room.here);
    }
    expectSameMasks(*edited, *untouched);
    expectSameDirectLight(*edited, *untouched);
    const auto a = edited->solver().nodeIlluminance(), b = untouched->solver().nodeIlluminance();
    double most = 0;
    for (std::size_t n = 0; n < a.size(); ++n)
        for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(a[n][c] - b[n][c]));
    // Two solutions relaxed so far may differ by both certificates.
    EXPECT_LT(most, 2 * residual * untouched->solver().statistics().brightest);
}

} // namespace

} // namespace penumbra
