#include "radiosity/process/store/LightStore.h"

#include "base/Error.h"
#include "radiosity/process/memory/SharedRegions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <thread>

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace penumbra {

namespace {

struct Store {
    std::unique_ptr<Regions> regions = makeHeapRegions();
    StoreShape shape{8, 20, 12};
    RegionPtr region = regions->create(shape.bytes());
    std::vector<std::byte> mesh = std::vector<std::byte>(8, std::byte(3));
    StoreWriter writer{region, 5, shape, mesh};
    StoreReader reader{region, 5};

    std::vector<StoreReader::Got> read(std::size_t most = 100) {
        std::vector<StoreReader::Got> got;
        reader.read(most, got);
        return got;
    }
};

/// A block of which everything says `value`.
LightBlock blockOf(std::uint32_t value, bool lights = false) {
    LightBlock block;
    block.object = value;
    block.direct.fill(Rgb(float(value)));
    block.indirect.fill(Rgb(float(value)));
    block.corners.fill(value);
    if (!lights) return block;
    block.previewSet = 1;
    block.lights = kMostPreviewLights;
    for (auto& factors : block.factor) factors.fill(float(value));
    return block;
}

TEST(LightStore, GivesEachBlockOnceAndAgainWhenItSaysSomethingElse) {
    Store store;
    EXPECT_EQ(store.reader.meshes().front().size(), 8u);
    EXPECT_TRUE(store.read().empty());
    store.writer.write(3, blockOf(1));
    store.writer.write(7, blockOf(2));
    const auto got = store.read();
    ASSERT_EQ(got.size(), 2u);
    EXPECT_EQ(got[0].block, 3u);
    EXPECT_EQ(got[1].light.direct, blockOf(2).direct);
    EXPECT_TRUE(store.read().empty());
    EXPECT_TRUE(store.reader.current());
    store.writer.write(3, blockOf(1)); // the same as before
    EXPECT_TRUE(store.read().empty());
    store.writer.write(3, blockOf(4));
    EXPECT_EQ(store.read().size(), 1u);
}

TEST(LightStore, MoreOfTheMeshLiesInAStoreOfItsOwn) {
    Store store;
    const std::vector<std::byte> more(24, std::byte(9));
    const RegionPtr region = store.regions->create(additionShape(more).bytes());
    EXPECT_FALSE(storeReady(*region, 6));
    store.writer.add(region, 6, more);
    ASSERT_TRUE(storeReady(*region, 6));
    EXPECT_EQ(store.reader.meshesReady(), 2u);
    store.reader.add(std::make_shared<StoreReader>(region, 6));
    ASSERT_EQ(store.reader.meshes().size(), 2u);
    EXPECT_TRUE(std::ranges::equal(store.reader.meshes()[1], more));
    store.writer.write(3, blockOf(1));
    EXPECT_EQ(store.read().size(), 1u);
    EXPECT_TRUE(store.read().empty());
    store.reader.again(3);
    EXPECT_EQ(store.read().size(), 1u) << "asked for again";
}

TEST(LightStore, ABoundedReadGoesOnWhereItStopped) {
    Store store;
    for (std::uint32_t b = 0; b < 12; ++b) store.writer.write(b, blockOf(9));
    std::vector<std::uint32_t> blocks;
    for (int i = 0; i < 3; ++i) {
        EXPECT_FALSE(store.reader.current());
        for (const auto& got : store.read(4)) blocks.push_back(got.block);
    }
    EXPECT_EQ(blocks.size(), 12u);
    EXPECT_TRUE(store.read().empty());
    EXPECT_TRUE(store.reader.current());
}

TEST(LightStore, PrivateBlocksAndLightsAreReadWithAllThatTheySay) {
    Store store;
    store.writer.setUsed(15);
    store.writer.write(14, blockOf(6, true));
    const auto got = store.read();
    ASSERT_EQ(got.size(), 1u);
    EXPECT_EQ(got[0].light.corners[63], 6u);
    EXPECT_EQ(got[0].light.factor[kMostPreviewLights - 1][63], 6);
}

TEST(LightStore, DirtySetIsTheAnswerToOneQuestionOnly) {
    Store store;
    std::vector<DirtyStatus> work(15), got{{}};
    work[3] = {DirtyStatus::Kind::lights, 2, 0.5f};
    store.reader.readDirty(7, got);
    EXPECT_TRUE(got.empty()) << "nobody has answered";
    store.writer.writeDirty(7, work);
    store.reader.readDirty(7, got);
    ASSERT_EQ(got.size(), 20u) << "all that there is room for";
    EXPECT_EQ(got[3], work[3]);
    EXPECT_EQ(got[4], DirtyStatus());
    store.reader.readDirty(8, got);
    EXPECT_TRUE(got.empty());
    work.resize(100);
    store.writer.writeDirty(8, work); // more than there is room for
    store.reader.readDirty(8, got);
    EXPECT_EQ(got.size(), 20u);
}

TEST(LightStore, DirtySetThatMakesNoSenseIsNone) {
    const std::uint64_t known = DirtyStatus{DirtyStatus::Kind::coming, 9, 3}.packed();
    EXPECT_EQ(DirtyStatus::unpacked(known), (DirtyStatus{DirtyStatus::Kind::coming, 9, 3}));
    EXPECT_EQ(DirtyStatus::unpacked(known | std::uint64_t(0xff) << 32), DirtyStatus());
    for (const std::uint64_t priority : {0x7f800000u, 0x7fc00000u, 0xbf800000u}) // inf, NaN, -1
        EXPECT_EQ(DirtyStatus::unpacked((known & ~std::uint64_t(0xffffffff)) | priority).priority,
                  0);
}

TEST(LightStore, WhatIsNoStoreIsRefused) {
    const auto regions = makeHeapRegions();
    EXPECT_THROW(StoreReader(regions->create(16), 1), Error);
    EXPECT_THROW(StoreReader(regions->create(4096), 1), Error);
    Store store;
    EXPECT_THROW(StoreReader(store.region, 6), Error);
    auto& header = *reinterpret_cast<StoreHeader*>(store.region->bytes().data());
    header.shape.blocks = 21;
    EXPECT_THROW(StoreReader(store.region, 5), Error);
    header.shape.blocks = 0xffffffffu;
    header.shape.meshBytes = ~std::uint64_t(0) - 100;
    EXPECT_THROW(StoreReader(store.region, 5), Error);
}

// As the node and the worker use it; with the preset tsan, ThreadSanitizer watches.
TEST(LightStore, NoBlockIsEverReadTorn) {
    Store store;
    constexpr unsigned kRounds = 3000;
    std::thread thread([&] {
        store.writer.setUsed(20);
        for (unsigned i = 1; i <= kRounds; ++i)
            for (std::uint32_t b = 0; b < 20; ++b) store.writer.write(b, blockOf(i, true));
    });
    unsigned last = 0, torn = 0;
    while (last < 20 * kRounds) {
        last = 0;
        for (const auto& got : store.read()) {
            const auto value = float(got.light.object);
            for (const Rgb& colour : got.light.direct) torn += colour != Rgb(value);
            for (const float factor : got.light.factor[0]) torn += factor != value;
            if (got.light.object == kRounds) last = 20 * kRounds;
        }
    }
    thread.join();
    store.read();
    EXPECT_EQ(torn, 0u);
}

// Two processes, each with a mapping of its own; the writer is killed in the middle of it.
TEST(LightStore, NoBlockIsReadTornThatAnotherProcessWrites) {
    const auto regions = makeSharedRegions();
    const StoreShape shape = Store().shape;
    const RegionPtr region = regions->create(shape.bytes());
    region->reserve();
    const std::vector<std::byte> mesh(shape.meshBytes);
    const pid_t writer = fork();
    ASSERT_GE(writer, 0);
    if (writer == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        StoreWriter store(makeSharedRegions()->open(region->name()), 5, shape, mesh);
        store.setUsed(shape.blocks);
        for (unsigned i = 1;; ++i)
            for (std::uint32_t b = 0; b < shape.blocks; ++b) store.write(b, blockOf(i, true));
    }
    while (!storeReady(*region, 5)) std::this_thread::yield();
    StoreReader reader(region, 5);
    std::size_t whole = 0, torn = 0;
    const auto look = [&] {
        std::vector<StoreReader::Got> got;
        reader.read(100, got);
        for (const auto& [block, light] : got) {
            const auto value = float(light.object);
            const auto differs = [&](float factor) { return factor != value; };
            const auto isOther = [&](const Rgb& colour) { return colour != Rgb(value); };
            ++whole;
            torn += std::ranges::any_of(light.direct, isOther) ||
                    std::ranges::any_of(light.indirect, isOther) ||
                    std::ranges::any_of(light.factor[kMostPreviewLights - 1], differs);
        }
    };
    while (whole < 20'000) look();
    kill(writer, SIGKILL);
    waitpid(writer, nullptr, 0);
    look();
    EXPECT_EQ(torn, 0u) << "of " << whole;
}

TEST(LightStore, LightOfAnyStrengthIsReadAsItWasWritten) {
    Store store;
    LightBlock block;
    std::mt19937 random(1);
    for (std::size_t v = 0; v < LightBlock::kSize; ++v) {
        const float magnitude =
            std::pow(10.0f, float(v % 16) - 6); // starlight on snow ... a welder
        block.direct[v] = Rgb(std::uniform_real_distribution<float>(magnitude)(random));
        block.indirect[v] = block.direct[v] * 0.3f;
    }
    store.writer.write(3, block);
    const auto got = store.read();
    ASSERT_EQ(got.size(), 1u);
    EXPECT_EQ(got[0].light.direct, block.direct);
    EXPECT_EQ(got[0].light.indirect, block.indirect);
}

TEST(LightStore, NonsenseIsReadAsDarkness) {
    Store store;
    LightBlock block = blockOf(1, true);
    block.exitance.fill(Rgb(2));
    for (const float nonsense : {std::nanf(""), -1.0f, INFINITY, -INFINITY}) {
        block.direct[5].g = block.indirect[63].b = block.factor[7][9] = nonsense;
        block.exitance[1].r = nonsense;
        store.writer.write(3, block);
        const auto got = store.read();
        ASSERT_EQ(got.size(), 1u);
        const LightBlock& light = got[0].light;
        EXPECT_EQ(light.direct[5], Rgb(1, 0, 1)) << nonsense;
        EXPECT_EQ(light.indirect[63], Rgb(1, 1, 0));
        EXPECT_EQ(light.factor[7][9], 0);
        EXPECT_EQ(light.factor[7][10], 1);
        EXPECT_EQ(light.exitance[1], Rgb(0, 2, 2));
    }
}

} // namespace

} // namespace penumbra
