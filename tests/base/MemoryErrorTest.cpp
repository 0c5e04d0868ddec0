// When memory is short.
#include "base/MemoryError.h"

#include <gmock/gmock.h>

namespace penumbra {

namespace {

TEST(MemoryError, SaysWhatForAndWhatToDo) {
    const std::string text = MemoryError("for ray tracing").what();
    EXPECT_THAT(text, testing::StartsWith("memory is short: for ray tracing ("));
    for (const char* word : {"ulimit -v", "--patch-size", "--element-size"})
        EXPECT_THAT(text, testing::HasSubstr(word));
}

TEST(MemoryError, IsThrownForMoreThanTheAddressSpaceHolds) {
    EXPECT_NO_THROW(requireAddressSpace(std::size_t(1) << 20, "a little"));
    try {
        requireAddressSpace(std::size_t(1) << 50, "a petabyte");
        FAIL();
    } catch (const MemoryError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("a petabyte needs about 1073741825 MB"));
    }
}

} // namespace

} // namespace penumbra
