// Messages on their way to the worker.
#pragma once

#include "radiosity/process/LightingTask.h"
#include "radiosity/process/memory/ControlBlock.h"
#include "radiosity/process/memory/SharedRegions.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

namespace penumbra {

/// The head of a message; MessageQueue::send() puts in its serial number when it goes out.
ByteWriter messageOf(MessageKind kind);

/// Messages wait here until there is room for them in the ring; a later one replaces an earlier one
/// of the same thing, but not across one that says what things there are. So the queue is bounded
/// by the number of things that were in the scene, and nothing but what is outdated is dropped. A
/// region that a message names lives until the worker has taken the
/// message.
class MessageQueue {
public:
    /// Keys of messages that replace each other; those of edits are smaller, see keyOf().
    static constexpr std::uint64_t kNoKey = ~std::uint64_t(0); ///< replaces nothing
    static constexpr std::uint64_t kCamera = std::uint64_t(1) << 62, kLights = kCamera + 1,
                                   kDirty = kCamera + 2;

    void put(std::uint64_t key, std::vector<std::byte> body);
    /// A whole scene: earlier scenes and edits that are still here count no more.
    void putScene(std::vector<std::byte> body, RegionPtr region);
    /// Things that come: edits before it are about what there was, later ones about what there is.
    void putGrowth(std::vector<std::byte> body, RegionPtr region);
    /// Moves what there is room for into the ring. \return whether anything was
    bool send(RingSender& ring);
    /// The worker has taken all messages up to this serial number.
    void taken(std::uint64_t serial);
    /// For a worker that knows nothing yet.
    void clear();

    /// Whether a worker that knows of all messages up to this one knows of all edits. Cameras come
    /// all the time, and do not count.
    bool knowsEdits(std::uint64_t serial) const;
    /// Messages that the worker has not taken, of which it has taken all up to `serial`.
    std::size_t waiting(std::uint64_t serial) const;

private:
    struct Message {
        std::uint64_t key = kNoKey;
        std::vector<std::byte> body;
        RegionPtr region{}; ///< that it names
    };
    std::deque<Message> queue_;
    /// Scenes on their way, with the serial numbers of their messages, in order.
    std::deque<std::pair<std::uint64_t, RegionPtr>> sent_;
    std::uint64_t serial_ = 0;     ///< of the last message in the ring
    std::uint64_t editSerial_ = 0; ///< of the last one that is no camera
};

} // namespace penumbra
