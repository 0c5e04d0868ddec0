#include "scenegraph/Backdrops.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

using Flags = std::vector<std::uint8_t>;

/// A square of a width, in the ground plane about the origin.
PieceSize square(float width) {
    PieceSize piece;
    piece.bounds.add(glm::vec3(-width / 2, -width / 2, 0));
    piece.bounds.add(glm::vec3(width / 2, width / 2, 0));
    piece.area = double(width) * double(width);
    return piece;
}

} // namespace

TEST(Backdrops, AGroundBeyondTheRoomIsOne) {
    const std::vector pieces{square(5), square(200), square(6)};
    EXPECT_EQ(backdropsAmong(pieces), (Flags{0, 1, 0}));
}

TEST(Backdrops, AGroundWithinAWiderGroundIsOneToo) {
    const std::vector pieces{square(200), square(3000), square(6)};
    EXPECT_EQ(backdropsAmong(pieces), (Flags{1, 1, 0}));
}

TEST(Backdrops, TheFloorOfAHallIsNone) {
    PieceSize walls = square(100); // as wide as the floor
    walls.area = 1200;
    EXPECT_EQ(backdropsAmong(std::vector{square(100), walls}), (Flags{0, 0}));
}

TEST(Backdrops, OfManyLikePiecesNoneIsOne) {
    EXPECT_EQ(backdropsAmong(std::vector(5, square(40))), Flags(5, 0));
}

TEST(Backdrops, SomethingIsAlwaysLeft) {
    EXPECT_EQ(backdropsAmong(std::vector{square(100)}), Flags{0});
    EXPECT_EQ(backdropsAmong(std::vector{square(100), square(0)}), (Flags{0, 0}));
    EXPECT_EQ(backdropsAmong({}), Flags{});
}

} // namespace penumbra
