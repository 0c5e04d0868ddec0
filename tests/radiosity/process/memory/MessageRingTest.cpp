#include "radiosity/process/memory/MessageRing.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <thread>

namespace penumbra {

namespace {

struct Ring {
    RingHeader header{};
    std::vector<std::byte> bytes;
    explicit Ring(std::size_t size) : bytes(size) {}
};

std::vector<std::byte> message(std::size_t length, unsigned value) {
    return std::vector<std::byte>(length, std::byte(value));
}

TEST(MessageRing, GivesMessagesInOrderAndRefusesWhatHasNoRoom) {
    Ring ring(64);
    RingSender sender(ring.header, ring.bytes);
    RingReceiver receiver(ring.header, ring.bytes);
    std::vector<std::byte> got;
    EXPECT_EQ(receiver.receive(got), RingReceiver::Got::nothing);
    unsigned sent = 0, received = 0;
    for (int round = 0; round < 100; ++round) {
        while (sender.send(message(5 + sent % 13, sent))) ++sent;
        EXPECT_TRUE(sender.sound());
        while (receiver.receive(got) == RingReceiver::Got::message) {
            EXPECT_EQ(got, message(5 + received % 13, received));
            ++received;
        }
        EXPECT_EQ(sent, received);
    }
    EXPECT_GT(sent, 300u);
}

TEST(MessageRing, HandsThousandsOfMessagesFromOneThreadToAnother) {
    Ring ring(1024);
    constexpr unsigned kCount = 20'000;
    std::thread thread([&] {
        RingSender sender(ring.header, ring.bytes);
        for (unsigned i = 0; i < kCount;) {
            if (sender.send(message(i % 97, i)))
                ++i;
            else
                std::this_thread::yield();
        }
    });
    RingReceiver receiver(ring.header, ring.bytes);
    std::vector<std::byte> got;
    for (unsigned i = 0; i < kCount;) {
        const RingReceiver::Got what = receiver.receive(got);
        ASSERT_NE(what, RingReceiver::Got::nonsense);
        if (what == RingReceiver::Got::nothing) {
            std::this_thread::yield();
            continue;
        }
        ASSERT_EQ(got, message(i % 97, i));
        ++i;
    }
    thread.join();
}

TEST(MessageRing, NonsenseIsNoticedAndNeverReadBeyondTheRing) {
    std::mt19937_64 random(1);
    int nonsense = 0;
    for (int i = 0; i < 20'000; ++i) {
        Ring ring(256);
        RingSender sender(ring.header, ring.bytes);
        RingReceiver receiver(ring.header, ring.bytes);
        std::vector<std::byte> got;
        for (unsigned k = 0; k < random() % 20; ++k) {
            sender.send(message(random() % 40, k));
            if (random() % 2) receiver.receive(got);
        }
        for (std::byte& byte : ring.bytes) byte = std::byte(random());
        if (random() % 2) ring.header.written = random() >> random() % 64;
        if (random() % 2) ring.header.read = random() >> random() % 64;
        for (int k = 0; k < 20; ++k) {
            const RingReceiver::Got what = receiver.receive(got);
            nonsense += what == RingReceiver::Got::nonsense;
            EXPECT_LE(got.size(), 128u);
            sender.send(message(random() % 40, 0));
            nonsense += !sender.sound();
        }
    }
    EXPECT_GT(nonsense, 1000);
}

} // namespace

} // namespace penumbra
