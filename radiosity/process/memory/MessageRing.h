// A bounded queue of messages from one side to the other.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// Where a ring lies in shared memory: these two numbers, and bytes behind them.
struct RingHeader {
    alignas(64) std::atomic<std::uint64_t> written; ///< bytes ever; by the sender
    alignas(64) std::atomic<std::uint64_t> read;    ///< bytes ever; by the receiver
};

/// The sender's end. What was written is remembered here, and never read back.
class RingSender {
public:
    /// \param bytes as many as a power of two; a new ring
    RingSender(RingHeader& header, std::span<std::byte> bytes) : header_(header), bytes_(bytes) {}

    /// \return false: there is no room now
    bool send(std::span<const std::byte> message);
    /// Whether the receiver's count is one that can be.
    bool sound() const;
    /// The longest message that ever finds room [bytes].
    static std::size_t longest(std::size_t ringBytes) { return ringBytes / 2; }

private:
    void copy(std::uint64_t at, std::span<const std::byte> from);
    RingHeader& header_;
    std::span<std::byte> bytes_;
    std::uint64_t written_ = 0;
};

/// The receiver's end.
class RingReceiver {
public:
    RingReceiver(RingHeader& header, std::span<const std::byte> bytes)
        : header_(header), bytes_(bytes) {}

    enum class Got { nothing, message, nonsense };
    Got receive(std::vector<std::byte>& message);

private:
    void copy(std::uint64_t at, std::span<std::byte> to) const;
    RingHeader& header_;
    std::span<const std::byte> bytes_;
    std::uint64_t read_ = 0;
};

} // namespace penumbra
