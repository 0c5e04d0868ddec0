#include "radiosity/process/memory/MessageRing.h"

#include <algorithm>
#include <cstring>

namespace penumbra {

// Each message is its length [4 bytes] and its bytes; the ring goes round anywhere.

namespace {
constexpr std::size_t kLength = sizeof(std::uint32_t);
}

bool RingSender::sound() const {
    const std::uint64_t read = header_.read.load(std::memory_order_acquire);
    return read <= written_ && written_ - read <= bytes_.size();
}

bool RingSender::send(std::span<const std::byte> message) {
    const std::uint64_t read = header_.read.load(std::memory_order_acquire);
    if (read > written_ || written_ - read > bytes_.size()) return false; // see sound()
    if (bytes_.size() - (written_ - read) < kLength + message.size()) return false;
    const auto length = std::uint32_t(message.size());
    copy(written_, std::as_bytes(std::span(&length, 1)));
    copy(written_ + kLength, message);
    written_ += kLength + message.size();
    header_.written.store(written_, std::memory_order_release);
    return true;
}

void RingSender::copy(std::uint64_t at, std::span<const std::byte> from) {
    if (from.empty()) return; // memcpy wants an address even for nothing
    const std::size_t start = at & (bytes_.size() - 1);
    const std::size_t first = std::min(from.size(), bytes_.size() - start);
    std::memcpy(bytes_.data() + start, from.data(), first);
    std::memcpy(bytes_.data(), from.data() + first, from.size() - first);
}

RingReceiver::Got RingReceiver::receive(std::vector<std::byte>& message) {
    const std::uint64_t written = header_.written.load(std::memory_order_acquire);
    if (written == read_) return Got::nothing;
    const std::uint64_t there = written - read_;
    if (written < read_ || there > bytes_.size() || there < kLength) return Got::nonsense;
    std::uint32_t length = 0;
    copy(read_, std::as_writable_bytes(std::span(&length, 1)));
    if (length > there - kLength || length > RingSender::longest(bytes_.size()))
        return Got::nonsense;
    message.resize(length);
    copy(read_ + kLength, message);
    read_ += kLength + length;
    header_.read.store(read_, std::memory_order_release);
    return Got::message;
}

void RingReceiver::copy(std::uint64_t at, std::span<std::byte> to) const {
    if (to.empty()) return;
    const std::size_t start = at & (bytes_.size() - 1);
    const std::size_t first = std::min(to.size(), bytes_.size() - start);
    std::memcpy(to.data(), bytes_.data() + start, first);
    std::memcpy(to.data() + first, bytes_.data(), to.size() - first);
}

} // namespace penumbra
