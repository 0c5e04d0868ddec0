#include "radiosity/schedule/KernelEstimate.h"

#include <gtest/gtest.h>

#include <vector>

namespace penumbra {

namespace {

/// A row of receivers 0.1 m apart.
std::vector<Receiver> rowOf(std::size_t count) {
    std::vector<Receiver> receivers;
    for (std::size_t i = 0; i < count; ++i)
        receivers.push_back({{0.1f * float(i), 0, 0}, {0, 0, 1}});
    return receivers;
}

TEST(KernelEstimate, IsWhatAllSaidWhereTheyAgree) {
    const std::vector<Receiver> receivers = rowOf(8);
    const KernelEstimate share(receivers);
    EXPECT_EQ(share.at(3, 0b11111111, 0), 0);
    EXPECT_EQ(share.at(3, 0b11111111, 0b11111111), 1);
    EXPECT_EQ(share.at(3, 0, 0b11111111), 0); // nobody was asked
}

TEST(KernelEstimate, PassesFromOneSideOfAnEdgeToTheOtherAboutAHalf) {
    const std::vector<Receiver> receivers = rowOf(8);
    const KernelEstimate share(receivers);
    std::vector<float> shares;
    for (std::size_t r = 0; r < 8; ++r) shares.push_back(share.at(r, 0b11111111, 0b11110000));
    EXPECT_NEAR(shares[0], 0, 1e-5);
    EXPECT_NEAR(shares[7], 1, 1e-5);
    for (std::size_t r = 1; r < 8; ++r) EXPECT_GE(shares[r], shares[r - 1] - 1e-6f) << r;
    EXPECT_NEAR(shares[3] + shares[4], 1, 1e-5);
    EXPECT_GT(shares[3], 0.1); // beside the edge, on its dark side
}

TEST(KernelEstimate, DoesNotAskWhatFacesElsewhere) {
    std::vector<Receiver> receivers = rowOf(4);
    receivers[1].normal = {0, 0, -1}; // the back of a board
    const KernelEstimate share(receivers);
    EXPECT_NEAR(share.at(0, 0b0011, 0b0010), 0, 1e-5);
    EXPECT_NEAR(share.at(2, 0b1010, 0b0010), 0, 1e-5);
}

TEST(KernelEstimate, GoesByTheWholeBlockWhereNobodyNearWasAsked) {
    std::vector<Receiver> receivers = rowOf(32);
    const KernelEstimate share(receivers);
    EXPECT_NEAR(share.at(0, 0b1111u << 28, 0b0001u << 28), 0.25, 1e-5);
}

} // namespace

} // namespace penumbra
