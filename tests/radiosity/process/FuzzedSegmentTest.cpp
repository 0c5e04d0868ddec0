#include "tests/support/LitNode.h"
#include "tests/support/SteppedLink.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

namespace penumbra {

namespace {

class Mutator {
public:
    explicit Mutator(unsigned seed) : random_(seed) {}

    /// Overwrites one to eight bytes: most where the numbers are that others depend on.
    void mutate(WatchedRegions& regions) {
        if (regions.all.empty()) return;
        const auto region = regions.all[below(regions.all.size())].lock();
        if (!region) return;
        const std::span<std::byte> bytes = region->bytes();
        const std::size_t range =
            below(2) == 0 ? bytes.size() : std::min<std::size_t>(bytes.size(), 2048);
        const std::size_t at = below(range);
        for (std::size_t i = at; i < std::min(bytes.size(), at + 1 + below(8)); ++i)
            bytes[i] = std::byte(below(3) == 0 ? 0xff : below(256));
    }
    std::size_t below(std::size_t count) { return random_() % count; }

private:
    std::mt19937_64 random_;
};

/// Until nothing is left to do, or for so many steps.
bool settle(RadiosityNode& node, SteppedLink& link) {
    for (int i = 0; i < 3000; ++i) {
        link.step();
        node.update();
        if (node.state().reached(SolutionState::exact)) return true;
    }
    return false;
}

/// Whether the published dirty status is about the blocks that there are, in numbers that can be.
bool soundWork(const RadiosityNode& node) {
    const auto work = node.dirtyBlocks();
    for (std::size_t o = 0; o < work.size() && o < node.objects().size(); ++o) {
        const auto& geometry = node.objects()[o].geometry;
        if (geometry && !work[o].empty() && work[o].size() != geometry->blockRevisions().size())
            return false;
        for (const DirtyStatus& block : work[o])
            if (!(block.priority >= 0) || !std::isfinite(block.priority) ||
                block.kind > DirtyStatus::Kind::lights)
                return false;
    }
    return true;
}

TEST(FuzzedSegment, NoByteOfItCanCrashOrHangEitherSide) {
    const char* const wanted = std::getenv("PENUMBRA_MUTATIONS");
    const int mutations = wanted ? std::atoi(wanted) : 2000;
    auto owned = std::make_unique<SteppedLink>();
    SteppedLink& link = *owned;
    RadiosityOptions options = LitRoom::smallRoomOptions();
    options.meshing = {.patchSize = 2, .elementSize = 1};
    options.mostMemory = 10 << 20; // what a mad worker asks for is not to be had
    LitRoom room(std::move(owned), options);
    room.node->setPreviewLights({"/lamp/light"});
    room.node->watchDirty(true);
    ASSERT_TRUE(settle(*room.node, link)) << describe(*room.node);
    Mutator mutator(1);
    unsigned restarts = 0;
    int stuck = 0;
    NodePtr shelf;
    for (int done = 0; done < mutations; ++done) {
        mutator.mutate(link.watched);
        if (done % 3 == 0) room.box->setMatrix(moved(0.1 * double(mutator.below(10)), 0, 0));
        if (done % 7 == 0) { // something comes, or goes
            if (shelf) room.node->remove(shelf);
            shelf = shelf ? nullptr : object("shelf", floorData(0, 1, 0, 1, 0.5));
            if (shelf) room.node->add(shelf);
        }
        link.step();
        room.node->update();
        if (done % 100 == 50) room.node->watchDirty(false), room.node->watchDirty(true);
        EXPECT_TRUE(soundWork(*room.node));
        if (room.node->state().restarts == restarts && done % 50 != 0) continue;
        // It was noticed, or it may be that nothing goes on any more: then people start it anew.
        if (!settle(*room.node, link)) {
            ++stuck;
            room.node->stop();
            room.node->start();
        }
        restarts = room.node->state().restarts;
    }
    EXPECT_GT(restarts, 0u);
    room.node->stop();
    room.node->start();
    ASSERT_TRUE(settle(*room.node, link)) << describe(*room.node);
    EXPECT_EQ(room.difference(), "");
    RecordProperty("restarts", int(restarts));
    RecordProperty("stuck", stuck);
}

} // namespace

} // namespace penumbra
