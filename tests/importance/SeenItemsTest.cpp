// What is in view and not hidden, read from an item buffer.
#include "importance/SeenItems.h"

#include <gmock/gmock.h>

#include <vector>

namespace penumbra {

namespace {

using testing::ElementsAre;

TEST(SeenPixels, AreSharedOutBySamples) {
    // 4 samples of a picture of 400 pixels.
    const std::vector<std::uint32_t> buffer{2, 0, 2, kNoItem};
    EXPECT_THAT(seenPixels(buffer, 3, 400), ElementsAre(100, 0, 200));
}

TEST(SeenPixels, OfNoBufferAreNone) {
    EXPECT_THAT(seenPixels({}, 2, 400), ElementsAre(0, 0));
}

} // namespace

} // namespace penumbra
