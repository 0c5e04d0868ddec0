// What a radiosity node and its worker share from the start: who says what, and where.
#pragma once

#include "base/SolutionState.h"
#include "radiosity/process/memory/MessageRing.h"
#include "radiosity/process/memory/Region.h"
#include "radiosity/process/memory/Seqlock.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace penumbra {

// Each region of memory, and each field of it, is written by one side only, program or worker.
// Whoever reads it checks it: the writer may have gone mad.

/// Rises with every change of the layout or of the messages.
constexpr std::uint32_t kProtocolVersion = 11;
constexpr std::uint64_t kControlMagic = 0x314c5254434e5550; // "PUNCTRL1"
constexpr std::size_t kRingBytes = std::size_t(1) << 20;

/// A short text in shared memory.
template <std::size_t kLength>
struct SharedText {
    std::array<char, kLength> letters{};

    void set(const std::string& text) {
        letters = {};
        std::copy_n(text.begin(), std::min(text.size(), kLength - 1), letters.begin());
    }
    /// What can't be printed becomes a question mark.
    std::string text() const {
        std::string text(letters.begin(), std::find(letters.begin(), letters.end(), '\0'));
        for (char& c : text)
            if (c < ' ' || c > '~') c = '?';
        return text;
    }
};

/// What the messages begin with; after the serial number [8 bytes] comes what the kind says.
enum class MessageKind : std::uint32_t {
    scene,         ///< name of a region with a LightingTask and a SceneSnapshot
    growth,        ///< name of a region with a SceneGrowth
    edit,          ///< GraphEdit
    invalidate,    ///< Bounds
    camera,        ///< View
    grab,          ///< node number
    release,       ///< node number
    trigger,       ///< Trigger of everything
    update,        ///< a person wants to see the light now
    previewLights, ///< serial of this set, number of paths, paths
    policy,        ///< PolicyKind
    watchDirty,    ///< publish the dirty set: number of the question, 0: not any more
    stop
};

/// How far the worker is.
struct WorkerStatus {
    enum Phase : std::uint32_t { idle, meshing, solving, failed };
    std::uint64_t taken = 0;  ///< serial of the last message that was taken in
    std::uint64_t lit = 0;    ///< `solution` is about the scene after this message
    std::uint64_t marked = 0; ///< what is stale of previewed lights is right for this message
    std::uint32_t phase = idle;
    std::uint32_t dirtyBlocks = 0;
    std::uint32_t solution = 0; ///< SolutionState of the light as it is published
    std::uint32_t stopped = 0;  ///< 1: see Solver::stopped()
    std::uint64_t rough = 0;    ///< 1: a RoughLight is published
    double progress = 0;
    double certificate = 0;    ///< [lm/m^2]
    double litIlluminance = 0; ///< [lux]
    SharedText<32> task;
    SharedText<232> trouble; ///< of phase failed
};

/// The worker asks for memory to publish in, the node grants it.
struct StoreRequest {
    std::uint64_t number = 0, bytes = 0;
    std::uint64_t store =
        0; ///< number of the store that it is to hold more of the mesh of; 0: none
};
struct StoreGrant {
    std::uint64_t number = 0;
    SharedText<kMostRegionName + 1> name;
};

struct ControlBlock {
    // Written by the node.
    std::uint64_t magic;
    std::uint32_t version;
    std::uint32_t bytes;
    std::int64_t viewer;                 ///< process id
    std::atomic<std::uint32_t> doorbell; ///< rises with each message, see Doorbell.h
    std::atomic<std::uint32_t> stop;     ///< 1: end as soon as possible
    Seqlocked<StoreGrant> grant;
    // Written by the worker.
    alignas(64) std::atomic<std::uint64_t> beat; ///< rises as long as the process runs
    std::atomic<std::uint64_t> turns;            ///< rises as long as it gets on
    std::atomic<std::uint64_t> opened;           ///< number of the last store it has opened
    Seqlocked<StoreRequest> request;
    Seqlocked<WorkerStatus> status;
    // From the node to the worker.
    RingHeader ring;
    alignas(64) std::array<std::byte, kRingBytes> ringBytes;
};
static_assert(sizeof(ControlBlock) < (std::size_t(2) << 20));

} // namespace penumbra
