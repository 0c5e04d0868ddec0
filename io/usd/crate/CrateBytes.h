// Bytes of a crate file, none of which is believed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace penumbra {

/// What is wrong with a crate file, and at which of its bytes. Readers of one value let it be
/// caught, leave that value out and go on.
class CrateFault : public std::runtime_error {
public:
    CrateFault(std::uint64_t byte, const std::string& text)
        : std::runtime_error(text + " (at byte " + std::to_string(byte) + ")") {}
};

/// A fault after which nothing else of the file is read: it asks for too much.
class CrateRefused : public CrateFault {
public:
    using CrateFault::CrateFault;
};

/// How many elements may still be made of a file: 64 times its size, and a million. Sharing and
/// compression make much of little, and a hostile file makes as much as it is let. A number is one
/// element; what takes more memory counts as more, so that an element is some 16 bytes at most.
class CrateBudget {
public:
    explicit CrateBudget(std::uint64_t fileBytes) : left_(64 * fileBytes + (1u << 20)) {}
    void spend(std::uint64_t elements, std::uint64_t byte) {
        if (elements > left_)
            throw CrateRefused(byte, "the file unfolds to more than its size allows");
        left_ -= elements;
    }

    static constexpr std::uint64_t kSpec = 16, kReference = 16, kEntry = 8, kSample = 8, kText = 4;

private:
    std::uint64_t left_;
};

/// Reads forward over some bytes of a file, little-endian; each read that would go beyond their end
/// is a fault.
class CrateBytes {
public:
    /// \param origin where `bytes` begin in the file, for what faults say
    explicit CrateBytes(std::span<const std::byte> bytes, std::uint64_t origin = 0)
        : bytes_(bytes), origin_(origin) {}

    std::uint64_t at() const { return origin_ + next_; } ///< [bytes from the start of the file]
    std::uint64_t left() const { return bytes_.size() - next_; }
    [[noreturn]] void fail(const std::string& text) const { throw CrateFault(at(), text); }

    void moveTo(std::uint64_t byte) {
        if (byte < origin_ || byte - origin_ > bytes_.size())
            fail("an offset of " + std::to_string(byte) + " leads out of the file");
        next_ = byte - origin_;
    }
    /// Moves by a distance from `byte` that the file states.
    void moveFrom(std::uint64_t byte, std::int64_t distance) {
        moveTo(byte + static_cast<std::uint64_t>(distance)); // wraps if it is negative, or absurd
    }

    std::span<const std::byte> take(std::uint64_t count) {
        if (count > left())
            fail(std::to_string(count) + " bytes are missing " + std::to_string(left()) +
                 " bytes before the end");
        const auto taken = bytes_.subspan(next_, count);
        next_ += count;
        return taken;
    }
    template <class T>
    T take() {
        static_assert(std::is_trivially_copyable_v<T>);
        T value;
        std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
        return value;
    }
    /// A number of items, each of at least `itemBytes`, that must follow.
    template <class Count = std::uint64_t>
    std::uint64_t takeCount(std::uint64_t itemBytes) {
        const std::uint64_t count = take<Count>();
        if (count > left() / itemBytes)
            fail(std::to_string(count) + " items can't be in " + std::to_string(left()) + " bytes");
        return count;
    }

private:
    std::span<const std::byte> bytes_;
    std::uint64_t origin_;
    std::uint64_t next_ = 0;
};

} // namespace penumbra
