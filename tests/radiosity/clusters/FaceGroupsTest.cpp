// Which faces send light together.
#include "radiosity/clusters/FaceGroups.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

namespace penumbra {

namespace {

constexpr float kPatch = 0.4f, kElement = 0.05f;

using Outline = std::array<glm::vec3, 4>;

/// A strip of so many rectangles side by side, each this long along x and this wide along y.
std::vector<Outline> strip(int count, float length, float width) {
    std::vector<Outline> outlines;
    for (int i = 0; i < count; ++i) {
        const float low = width * float(i), high = width * float(i + 1);
        outlines.push_back({glm::vec3(0, low, 0), glm::vec3(length, low, 0),
                            glm::vec3(length, high, 0), glm::vec3(0, high, 0)});
    }
    return outlines;
}

std::vector<std::vector<std::uint32_t>> groupsOf(const std::vector<Outline>& outlines) {
    std::vector<FacePiece> faces;
    for (const Outline& outline : outlines) faces.push_back({outline, 0});
    return groupFaces(faces, kPatch, kElement);
}

TEST(GroupFaces, PutsSliversOfAMouldingTogether) {
    for (const float length : {0.15f, 0.35f, 0.7f}) {
        const auto groups = groupsOf(strip(32, length, 0.003f));
        ASSERT_EQ(groups.size(), 1u) << length;
        EXPECT_EQ(groups[0].size(), 32u) << length;
    }
}

TEST(GroupFaces, LetsAThreadBeAClusterOnItsOwn) {
    EXPECT_EQ(groupsOf(strip(1, 0.35f, 0.003f)).size(), 1u);
}

TEST(GroupFaces, LeavesRimsAndPanelsAlone) {
    EXPECT_TRUE(groupsOf(strip(1, 0.35f, 0.03f)).empty());
    EXPECT_TRUE(groupsOf(strip(2, 0.35f, 0.03f)).empty());
    EXPECT_TRUE(groupsOf(strip(8, 0.35f, 0.06f)).empty());
}

TEST(GroupFaces, KeepsClustersOfSmallFacesAsSmallAsLightIsReceived) {
    // 64 x 64 squares of a centimetre.
    std::vector<Outline> squares;
    for (int i = 0; i < 64; ++i)
        for (int j = 0; j < 64; ++j) {
            const glm::vec3 low(0.01f * float(i), 0.01f * float(j), 0);
            squares.push_back({low, low + glm::vec3(0.01f, 0, 0), low + glm::vec3(0.01f, 0.01f, 0),
                               low + glm::vec3(0, 0.01f, 0)});
        }
    std::size_t faces = 0;
    for (const auto& group : groupsOf(squares)) {
        faces += group.size();
        EXPECT_LE(group.size(), 200u); // half a patch, 0.2 m, from corner to corner
    }
    EXPECT_EQ(faces, squares.size());
}

} // namespace

} // namespace penumbra
