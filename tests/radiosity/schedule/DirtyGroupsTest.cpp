// Groups of receivers that have to find again what they see.
#include "radiosity/schedule/DirtyGroups.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

Bounds cube(float at) {
    return {glm::vec3(at), glm::vec3(at + 0.5f)};
}

/// Four groups; group i sees the cube at i.
DirtyGroups lookingAtCubes() {
    DirtyGroups groups;
    groups.resize(4 * DirtyGroups::kSize);
    const std::vector<Bounds> ways{cube(0), cube(1), cube(2), cube(3)};
    groups.clean(ways);
    return groups;
}

std::vector<std::uint32_t> dirty(const DirtyGroups& groups) {
    const auto next = groups.next(std::size_t(-1), 64);
    return {next.begin(), next.end()};
}

TEST(DirtyGroups, AreAllOpenAtFirst) {
    DirtyGroups groups;
    groups.resize(2 * DirtyGroups::kSize);
    EXPECT_EQ(dirty(groups), (std::vector<std::uint32_t>{0, 1}));
    EXPECT_EQ(groups[1].anew, DirtyGroups::kAll);
    EXPECT_TRUE(lookingAtCubes().done());
}

TEST(DirtyGroups, AreOpenedByWhatLeavesOrEntersWhatTheySee) {
    DirtyGroups groups = lookingAtCubes();
    groups.addMoved(7, cube(1), cube(3));
    EXPECT_EQ(dirty(groups), (std::vector<std::uint32_t>{1, 3}));
    EXPECT_EQ(groups[1].moved, (std::vector<std::uint32_t>{7}));
    EXPECT_EQ(groups[1].anew, 0u);
    groups.addMoved(7, cube(3), {}); // hidden before its group was updated: counts once
    EXPECT_EQ(dirty(groups), (std::vector<std::uint32_t>{1, 3}));
    EXPECT_EQ(groups[3].moved, (std::vector<std::uint32_t>{7}));
}

TEST(DirtyGroups, KeepTheWaysOfReceiversThatWereNotFollowedAnew) {
    DirtyGroups groups = lookingAtCubes();
    groups.add(2, 1);
    groups.clean(std::vector{cube(5)});
    groups.addMoved(1, cube(2), {});
    EXPECT_EQ(dirty(groups), (std::vector<std::uint32_t>{2}));
    groups.add(2, DirtyGroups::kAll);
    groups.clean(std::vector{cube(5)});
    groups.addMoved(1, cube(2), {});
    EXPECT_TRUE(groups.done());
}

TEST(DirtyGroups, AreTakenAFewAtATime) {
    DirtyGroups groups = lookingAtCubes();
    groups.addAll({0, 4 * DirtyGroups::kSize});
    EXPECT_EQ(groups.next(1, 64).size(), 1u);
    EXPECT_EQ(groups.next(2 * 16 * 64, 64).size(), 2u);
    groups.clean(std::vector{cube(0)});
    EXPECT_EQ(groups.left(), 3u);
    EXPECT_EQ(groups.next(1, 64)[0], 1u);
}

} // namespace

} // namespace penumbra
