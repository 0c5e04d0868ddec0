// Rays against what is drawn, while things move.
#include "radiosity/mesh/DrawnSurface.h"
#include "radiosity/rows/HemisphereRays.h"
#include "tests/support/EditedScenes.h"

#include <gtest/gtest.h>

#include <memory>

namespace penumbra {

namespace {

TEST(DrawnSurface, OfFacesThatLieOnEachOtherTheSameIsMetWhateverTheOrderOfTheObjects) {
    const auto met = [](const std::string& first, const std::string& second) {
        const BuiltPatches built = meshed(sceneOf({object(first, floorData(0, 1, 0, 1, 0)),
                                                   object(second, floorData(0, 1, 0, 1, 0))}),
                                          {.patchSize = 1, .elementSize = 0.25f});
        const DrawnHit hit =
            DrawnSurface(built.patches).nearest({0.3f, 0.4f, 1}, {0, 0, -1}, 1e30f);
        EXPECT_TRUE(hit.met());
        return built.patches.objects[built.patches.elementObject[hit.element].value].path;
    };
    EXPECT_EQ(met("a", "b"), met("b", "a"));
}

TEST(DrawnSurface, ThatFollowedEditsIsThatOfTheSceneAsItStands) {
    const HemisphereRays rays(64);
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
        EditableRoom room(seed);
        LitScene lit(placeScene(room.scene()), EditableRoom::meshing(), {.directOnly = true});
        auto surface = std::make_unique<DrawnSurface>(lit.patches());
        std::string said;
        for (int edit = 0; edit < 12; ++edit) {
            said += room.edit();
            const LitScene::Followed followed = lit.follow(placeScene(room.scene()));
            if (followed.rebuilt || followed.added)
                surface = std::make_unique<DrawnSurface>(lit.patches());
            else
                surface->follow(followed.change.objects);
        }
        const DrawnSurface fresh(lit.patches());
        for (int i = 0; i < rays.count(); ++i)
            for (const Receiver& node : lit.patches().nodes) {
                if (isPadding(node)) continue;
                const glm::vec3 direction = rays.direction(i, node.normal);
                const DrawnHit a = surface->nearest(node.position, direction, 1e30f);
                const DrawnHit b = fresh.nearest(node.position, direction, 1e30f);
                ASSERT_EQ(a.element, b.element) << "seed " << seed << ": " << said;
                ASSERT_EQ(a.distance, b.distance);
                ASSERT_EQ(a.vertices, b.vertices);
            }
    }
}

} // namespace

} // namespace penumbra
