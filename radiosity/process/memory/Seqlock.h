// A value that one side writes and any number of others read, none of whom ever waits.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace penumbra {

// A sequence lock after Boehm, "Can seqlocks get along with programming language memory models?",
// MSPC 2012, in the form without fences: every word of the value is an atomic of its own.
//
//     writer: seq = odd (relaxed); words (release); seq = even (release)
//     reader: a = seq (acquire);   words (acquire); b = seq (relaxed);  whole if a = b and even
//
// A reader that sees any word of a write synchronises with it, and so sees the odd number, or a
// later one, in b. On x86-64 all of these are plain moves. Readers don't try again by themselves: a
// writer that died in the middle would hold them for ever.

using SharedWord = std::atomic<std::uint64_t>;
static_assert(SharedWord::is_always_lock_free && sizeof(SharedWord) == 8);
using SharedCount = std::atomic<std::uint32_t>;
static_assert(SharedCount::is_always_lock_free && sizeof(SharedCount) == 4);

/// Begins a write; there is one writer only.
inline void beginWrite(SharedCount& sequence) {
    sequence.store(sequence.load(std::memory_order_relaxed) | 1u, std::memory_order_relaxed);
}
inline void writeWords(SharedWord* to, const void* from, std::size_t words) {
    for (std::size_t i = 0; i < words; ++i) {
        std::uint64_t word;
        std::memcpy(&word, static_cast<const char*>(from) + 8 * i, 8);
        to[i].store(word, std::memory_order_release);
    }
}
inline void endWrite(SharedCount& sequence) {
    sequence.store(sequence.load(std::memory_order_relaxed) + 1, std::memory_order_release);
}
inline void readWords(const SharedWord* from, void* to, std::size_t words) {
    for (std::size_t i = 0; i < words; ++i) {
        const std::uint64_t word = from[i].load(std::memory_order_acquire);
        std::memcpy(static_cast<char*>(to) + 8 * i, &word, 8);
    }
}

/// A value of its own.
template <class T>
class Seqlocked {
public:
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % 8 == 0);

    void write(const T& value) {
        beginWrite(sequence_);
        writeWords(words_.data(), &value, kWords);
        endWrite(sequence_);
    }
    /// \return whether `value` is one that was written; what it is otherwise has no meaning
    bool read(T& value) const {
        const std::uint32_t before = sequence_.load(std::memory_order_acquire);
        if (before % 2 != 0) return false;
        readWords(words_.data(), &value, kWords);
        return sequence_.load(std::memory_order_relaxed) == before;
    }
    /// Even; another one after each write. 0: never written.
    std::uint32_t version() const { return sequence_.load(std::memory_order_acquire) & ~1u; }

private:
    static constexpr std::size_t kWords = sizeof(T) / 8;
    SharedCount sequence_{0};
    std::array<SharedWord, kWords> words_{};
};

} // namespace penumbra
