// Reading in the background.
#include "viewer/input/SceneLoader.h"

#include "base/Error.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace penumbra {

namespace {

std::optional<ReadyScene> waitFor(SceneLoader& loader) {
    for (int i = 0; i < 3000 && loader.busy(); ++i) {
        if (auto ready = loader.take()) return ready;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return std::nullopt;
}

TEST(SceneLoader, BringsTheSceneOnceWithAllThatWalkingNeeds) {
    SceneLoader loader(PENUMBRA_SOURCE_DIR "/scenes/cornell.usda");
    const auto ready = waitFor(loader);
    ASSERT_TRUE(ready);
    EXPECT_FALSE(ready->placed.meshes.empty());
    EXPECT_TRUE(ready->rays);
    EXPECT_FALSE(loader.busy());
    EXPECT_FALSE(loader.take());
}

TEST(SceneLoader, SaysWhatIsWrongWithAFile) {
    SceneLoader loader("no-such-file.usda");
    EXPECT_THROW(waitFor(loader), Error);
}

} // namespace

} // namespace penumbra
