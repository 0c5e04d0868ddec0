#include "base/Bits.h"

#include <gmock/gmock.h>

#include <cstdint>
#include <vector>

namespace penumbra {
namespace {

std::vector<int> listed(std::uint64_t mask) {
    std::vector<int> places;
    for (int i : bitsOf(mask)) places.push_back(i);
    return places;
}

TEST(Bits, AreListedFromTheLowestOn) {
    EXPECT_THAT(listed(0), testing::IsEmpty());
    EXPECT_THAT(listed(0b101001), testing::ElementsAre(0, 3, 5));
    EXPECT_THAT(listed(std::uint64_t(1) << 63 | 1), testing::ElementsAre(0, 63));
    EXPECT_EQ(listed(~std::uint64_t(0)).size(), 64u);
}

TEST(Bits, OfAMaskThatChangesMeanwhileAreThoseOfTheBeginning) {
    std::uint32_t mask = 0b111;
    int count = 0;
    for (int i : bitsOf(mask)) mask &= ~(1u << i), ++count;
    EXPECT_EQ(count, 3);
}

} // namespace
} // namespace penumbra
