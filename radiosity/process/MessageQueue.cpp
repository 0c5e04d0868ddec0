#include "radiosity/process/MessageQueue.h"

#include <algorithm>
#include <cstring>

namespace penumbra {

ByteWriter messageOf(MessageKind kind) {
    ByteWriter body;
    body.put(kind);
    body.put(std::uint64_t(0));
    return body;
}

void MessageQueue::put(std::uint64_t key, std::vector<std::byte> body) {
    const auto last =
        std::find_if(queue_.rbegin(), queue_.rend(), [](const Message& m) { return m.region; });
    const auto same = std::find_if(last.base(), queue_.end(),
                                   [&](const Message& m) { return key != kNoKey && m.key == key; });
    if (same != queue_.end())
        *same = {key, std::move(body)};
    else
        queue_.push_back({key, std::move(body)});
}

void MessageQueue::putScene(std::vector<std::byte> body, RegionPtr region) {
    std::erase_if(queue_, [](const Message& m) { return m.key < kCamera || m.region; });
    queue_.push_back({kNoKey, std::move(body), std::move(region)});
}

void MessageQueue::putGrowth(std::vector<std::byte> body, RegionPtr region) {
    queue_.push_back({kNoKey, std::move(body), std::move(region)});
}

bool MessageQueue::send(RingSender& ring) {
    bool sent = false;
    while (!queue_.empty()) {
        Message& message = queue_.front();
        const std::uint64_t serial = serial_ + 1;
        std::memcpy(message.body.data() + sizeof(MessageKind), &serial, sizeof serial);
        if (!ring.send(message.body)) break;
        serial_ = serial;
        if (message.key != kCamera) editSerial_ = serial;
        if (message.region) sent_.emplace_back(serial, std::move(message.region));
        queue_.pop_front();
        sent = true;
    }
    return sent;
}

void MessageQueue::taken(std::uint64_t serial) {
    while (!sent_.empty() && sent_.front().first <= serial) sent_.pop_front();
}

void MessageQueue::clear() {
    *this = {};
}

bool MessageQueue::knowsEdits(std::uint64_t serial) const {
    return serial >= editSerial_ && serial <= serial_ &&
           std::all_of(queue_.begin(), queue_.end(),
                       [](const Message& m) { return m.key == kCamera; });
}

std::size_t MessageQueue::waiting(std::uint64_t serial) const {
    return queue_.size() + std::size_t(serial_ - std::min(serial_, serial));
}

} // namespace penumbra
