#include "radiosity/process/memory/Seqlock.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <thread>

namespace penumbra {

namespace {

struct Value {
    std::array<std::uint64_t, 100> words{};
};

TEST(Seqlock, WhatIsReadIsWhatWasWritten) {
    const auto lock = std::make_unique<Seqlocked<Value>>();
    EXPECT_EQ(lock->version(), 0u);
    Value written;
    written.words.fill(7);
    lock->write(written);
    Value read;
    ASSERT_TRUE(lock->read(read));
    EXPECT_EQ(read.words, written.words);
    EXPECT_EQ(lock->version(), 2u);
}

TEST(Seqlock, NothingIsReadWhileAWriterIsAtWorkOrHasDiedAtIt) {
    SharedCount sequence{0};
    beginWrite(sequence);
    EXPECT_EQ(sequence.load() % 2, 1u);
    endWrite(sequence);
    EXPECT_EQ(sequence.load(), 2u);
    beginWrite(sequence);
    beginWrite(sequence); // the next writer goes on after a dead one
    endWrite(sequence);
    EXPECT_EQ(sequence.load(), 4u);
}

// The model that ThreadSanitizer checks (preset tsan): one writer, two readers, no lock, no fence.
TEST(Seqlock, NoReaderEverSeesHalfAWriteOrAnOlderOneAfterANewerOne) {
    const auto lock = std::make_unique<Seqlocked<Value>>();
    constexpr std::uint64_t kWrites = 200'000;
    std::atomic<bool> done{false};
    std::atomic<int> torn{0}, older{0};
    const auto readAll = [&] {
        std::uint64_t last = 0;
        while (!done.load()) {
            Value value;
            if (!lock->read(value)) continue;
            for (std::uint64_t word : value.words) torn += word != value.words[0];
            older += value.words[0] < last;
            last = value.words[0];
        }
    };
    std::thread first(readAll), second(readAll);
    Value value;
    for (std::uint64_t i = 1; i <= kWrites; ++i) {
        value.words.fill(i);
        lock->write(value);
    }
    done = true;
    first.join();
    second.join();
    EXPECT_EQ(torn, 0);
    EXPECT_EQ(older, 0);
}

} // namespace

} // namespace penumbra
