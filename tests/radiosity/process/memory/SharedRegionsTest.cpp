#include "radiosity/process/memory/SharedRegions.h"

#include "base/Error.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <string>

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

namespace penumbra {

namespace {

/// The file that a name denotes: penumbra-<process>-<file>-<random>.
std::string pathOf(const std::string& name) {
    const std::size_t process = name.find('-') + 1, file = name.find('-', process) + 1;
    return "/proc/" + name.substr(process, file - process - 1) + "/fd/" +
           name.substr(file, name.find('-', file) - file);
}

TEST(SharedRegions, BothSidesSeeTheSameBytes) {
    const auto regions = makeSharedRegions();
    const RegionPtr mine = regions->create(5000);
    mine->reserve();
    ASSERT_EQ(mine->bytes().size(), 5000u);
    mine->bytes()[4999] = std::byte(7);
    const RegionPtr theirs = regions->open(mine->name());
    ASSERT_TRUE(theirs);
    EXPECT_NE(theirs->bytes().data(), mine->bytes().data());
    EXPECT_EQ(theirs->bytes()[4999], std::byte(7));
    theirs->bytes()[0] = std::byte(9);
    EXPECT_EQ(mine->bytes()[0], std::byte(9));
}

TEST(SharedRegions, NobodyOpensThemAfterUnlinkAndTheMemoryStays) {
    const auto regions = makeSharedRegions();
    const RegionPtr region = regions->create(100);
    const std::string name = region->name();
    EXPECT_GE(name.size(), 32u); // 128 bits of chance
    region->unlink();
    EXPECT_FALSE(regions->open(name));
    region->bytes()[99] = std::byte(1);
}

// Else the peer ends by a bus error when it reads next.
TEST(SharedRegions, NobodyCanMakeThemSmaller) {
    const auto regions = makeSharedRegions();
    const RegionPtr region = regions->create(100'000);
    const int file = open(pathOf(region->name()).c_str(), O_RDWR);
    ASSERT_GE(file, 0);
    EXPECT_EQ(ftruncate(file, 10), -1);
    EXPECT_EQ(errno, EPERM);
    EXPECT_EQ(ftruncate(file, 200'000), -1);
    close(file);
    region->bytes()[99'999] = std::byte(1);
}

TEST(SharedRegions, WhatCouldBeMadeSmallerIsNotOpened) {
    const int file = memfd_create("penumbra-0123", MFD_CLOEXEC | MFD_ALLOW_SEALING);
    ASSERT_GE(file, 0);
    ASSERT_EQ(ftruncate(file, 4096), 0);
    const auto regions = makeSharedRegions();
    const std::string name =
        "penumbra-" + std::to_string(getpid()) + "-" + std::to_string(file) + "-0123";
    EXPECT_FALSE(regions->open(name));
    ASSERT_EQ(fcntl(file, F_ADD_SEALS, F_SEAL_SHRINK), 0);
    EXPECT_TRUE(regions->open(name)); // only that was missing
    EXPECT_FALSE(regions->open(name + "4"));
    close(file);
}

TEST(SharedRegions, WhatIsNoNameIsNotOpened) {
    const auto regions = makeSharedRegions();
    for (const char* name : {"", "penumbra-", "penumbra-1-2-3", "penumbra-1", "/etc/passwd",
                             "penumbra-/../../etc/passwd", "penumbra-self-0-0"})
        EXPECT_FALSE(regions->open(name)) << name;
}

TEST(SharedRegions, TheyEndWithTheProcessesThatHaveThem) {
    std::string name(128, '\0');
    int pipes[2];
    ASSERT_EQ(pipe(pipes), 0);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        const auto regions = makeSharedRegions();
        const RegionPtr region = regions->create(4096);
        const bool sent = write(pipes[1], region->name().data(), region->name().size()) > 0;
        pause();
        _exit(sent ? 0 : 1);
    }
    const ssize_t size = read(pipes[0], name.data(), name.size());
    ASSERT_GT(size, 0);
    name.resize(std::size_t(size));
    const auto regions = makeSharedRegions();
    RegionPtr seen = regions->open(name);
    ASSERT_TRUE(seen);
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    EXPECT_EQ(seen->bytes().size(), 4096u); // ours as long as we have it
    seen.reset();
    EXPECT_FALSE(regions->open(name));
    close(pipes[0]), close(pipes[1]);
}

TEST(SharedRegions, MoreThanThereIsIsAnError) {
    const auto regions = makeSharedRegions();
    EXPECT_THROW(regions->create(std::size_t(1) << 45)->reserve(), Error);
}

} // namespace

} // namespace penumbra
