// The budget of memory: what was asked for, else half of what there is.
#include "base/MachineMemory.h"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>

namespace penumbra {

namespace {

TEST(MachineMemory, OfAProcessIsPartOfTheMachines) {
    EXPECT_GT(residentMemory(), 0u);
    EXPECT_LT(residentMemory(), machineMemory());
}

TEST(MachineMemory, BudgetIsWhatWasAskedForElseHalfOfIt) {
    EXPECT_EQ(memoryBudget(12345), 12345u);
    EXPECT_EQ(memoryBudget(0), machineMemory() / 2);
}

TEST(MachineMemory, RisesWithWhatIsWrittenTo) {
    constexpr std::size_t kBytes = std::size_t(64) << 20;
    const std::size_t before = residentMemory();
    const auto block = std::make_unique_for_overwrite<char[]>(kBytes);
    std::memset(block.get(), 1, kBytes);
    EXPECT_GT(residentMemory(), before + kBytes / 2);
    EXPECT_EQ(block[kBytes - 1], 1);
}

} // namespace

} // namespace penumbra
