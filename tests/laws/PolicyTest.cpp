// The scheduling policy changes when work is done, never the answer.
#include "importance/SchedulingPolicy.h"
#include "tests/support/EditedScenes.h"
#include "tests/support/LitDifference.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

constexpr SolverOptions kTight{.residual = 1e-5};

/// In the room, looking some way that changes with the turn.
Attention looking(const LitScene& lit, double turn) {
    const glm::vec3 centre = lit.patches().bounds.centre();
    glm::dmat4 camera(1.0);
    camera[0] = {std::cos(turn), std::sin(turn), 0, 0};
    camera[1] = {0, 0, 1, 0};
    camera[2] = {std::sin(turn), -std::cos(turn), 0, 0};
    camera[3] = glm::dvec4(centre, 1);
    const Viewpoint viewpoint(makeView({}, camera, 200, 150), 200, 150);
    return {viewpoint, Gaze(viewpoint), 10, {}, {}};
}

TEST(Policies, ComeToTheSameLight) {
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
        EditableRoom room(seed);
        SolverOptions plainly = kTight;
        plainly.policy = PolicyKind::plain;
        LitScene plain(placeScene(room.scene()), EditableRoom::meshing(), plainly);
        LitScene bound(placeScene(room.scene()), EditableRoom::meshing(), kTight);
        LitScene random(placeScene(room.scene()), EditableRoom::meshing(), kTight);
        LitScene seen(placeScene(room.scene()), EditableRoom::meshing(), kTight);
        std::string said;
        for (int i = 0; i < 3; ++i) {
            for (LitScene* lit : {&plain, &bound}) lit->solver().settle();
            random.solver().setDirectPolicy(std::make_shared<RandomPolicy>(seed));
            random.solver().settle();
            seen.solver().attend(looking(seen, i));
            for (int turns = 0; !seen.solver().step(1e-4); ++turns) // looks around meanwhile
                seen.solver().attend(looking(seen, i + 0.3 * turns));
            for (LitScene* lit : {&bound, &random, &seen}) {
                ASSERT_EQ(lit->solver().lighting().direct, plain.solver().lighting().direct)
                    << "seed " << seed << ": " << said;
                ASSERT_EQ(difference(*lit, plain), "") << "seed " << seed << ": " << said;
            }
            said += room.edit();
            for (LitScene* lit : {&plain, &bound, &random, &seen})
                lit->follow(placeScene(room.scene()));
        }
    }
}

TEST(Policies, WhatGoesDarkIsWorkAsWell) {
    // A plate that faces a light is turned over: its light goes to nothing, and the order that the
    // viewer makes finds that out before it is through.
    Scene scene;
    scene.root->add(object("floor", floorData(-2, 2, -2, 2, 0)));
    scene.root->add(ceilingLight({0, 0, 3}, 1, 1, Rgb(100)));
    const auto plate =
        objectOf("plate", {std::make_shared<Mesh>("mesh", floorData(-0.5f, 0.5f, -0.5f, 0.5f, 0))});
    plate->setMatrix(moved(0, 0, 1));
    scene.root->add(plate);
    LitScene lit(placeScene(scene), {.patchSize = 0.5f, .elementSize = 0.125f},
                 {.directOnly = true});
    lit.solver().attend(looking(lit, 0));
    lit.solver().settle();
    const auto lightOfPlate = [&] {
        double sum = 0;
        const PatchSet& patches = lit.patches();
        const Lighting light = lit.solver().lighting();
        for (std::uint32_t b = 0; b < patches.vertexBlockObject.size(); ++b)
            for (std::uint32_t v = b * PatchSet::kBlock; v < (b + 1) * PatchSet::kBlock; ++v)
                if (patches.objects[patches.vertexBlockObject[b].value].path == "/plate")
                    sum += luminance(light.direct[v]);
        return sum;
    };
    ASSERT_GT(lightOfPlate(), 1);
    glm::dmat4 over(1.0);
    over[1][1] = over[2][2] = -1; // half a turn about x
    over[3] = {0, 0, 1, 1};
    plate->setMatrix(over);
    ASSERT_FALSE(lit.follow(placeScene(scene)).rebuilt);
    lit.solver().settle();
    EXPECT_EQ(lightOfPlate(), 0);
}

} // namespace

} // namespace penumbra
