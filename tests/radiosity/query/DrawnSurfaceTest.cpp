// Rays against what is drawn.
#include "radiosity/query/DrawnSurface.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

#include <string>

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

} // namespace

} // namespace penumbra
