// The node's end of the conversation with its worker.
#pragma once

#include "base/Bounds.h"
#include "radiosity/process/LightingLink.h"
#include "radiosity/process/LightingTask.h"
#include "radiosity/process/RadiosityState.h"
#include "radiosity/process/memory/ControlBlock.h"
#include "radiosity/process/snapshot/SceneSnapshot.h"
#include "radiosity/process/store/LightStore.h"
#include "scenegraph/Camera.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace penumbra {

/// Keeps a worker running, sends it what is to be sent, and gives out what it publishes. Nothing
/// here ever waits, except for a worker in a thread to end.
///
/// Messages queue up here until there is room for them in the ring; an edit takes the place of an
/// earlier one of the same thing that is still here. So the queue is bounded by the number of
/// things in the scene, and nothing but outdated poses is dropped.
class LightingClient {
public:
    /// \param writeTask what a new worker is to be told: the scene with all that was sent so far
    LightingClient(std::unique_ptr<LightingLink> link, const RadiosityOptions& options,
                   std::function<void(ByteWriter&)> writeTask);
    ~LightingClient();

    void start();
    void stop();

    /// The scene is another one: what was sent before counts no more.
    void sendScene();
    void send(const GraphEdit& edit);
    void invalidate(const Bounds& box);
    void setCamera(const View& view);
    void send(MessageKind kind, std::uint32_t value);
    void setPreviewLights(const std::vector<std::string>& paths, std::uint32_t serial);
    /// Has open work published as an answer to a question of that number; 0: none any more.
    void watchDirty(std::uint32_t question);

    /// To be called now and then: sends, looks after the worker, and at what it has to say.
    void turn();

    /// The newest store, once it is there; the same one until there is another.
    const std::shared_ptr<StoreReader>& store() const { return store_; }
    /// What is read in a store makes no sense: the worker is started anew.
    void distrust(const std::string& why);

    RadiosityState state() const;
    std::vector<std::string> takeMessages();

private:
    struct Message {
        std::uint64_t key = kNoKey; ///< of an edit, see keyOf(); kNoKey: not to be replaced
        std::vector<std::byte> body;
        RegionPtr region; ///< that it names
    };
    static constexpr std::uint64_t kNoKey = ~std::uint64_t(0);

    ControlBlock& control() { return *reinterpret_cast<ControlBlock*>(control_->bytes().data()); }
    void launch();
    void failed(const std::string& why);
    void say(const std::string& text);
    void sendValue(std::uint64_t key, MessageKind kind, std::uint32_t value);
    void queue(std::uint64_t key, ByteWriter body);
    void flush();
    void watch(double passed);
    void grantStore();
    void openStore();
    void readStatus();
    bool knowsEdits(std::uint64_t serial) const;
    SolutionState solution() const;

    std::unique_ptr<LightingLink> link_;
    RadiosityOptions options_;
    std::function<void(ByteWriter&)> writeTask_;

    bool running_ = false;  ///< is meant to be
    bool hopeless_ = false; ///< this scene can't be lit here
    bool reportedFailure_ = false;
    RegionPtr control_; ///< null: there is no worker
    std::optional<RingSender> ring_;
    /// Scenes on their way, with the serial numbers of their messages, in order: each stays until
    /// the worker says that it has taken that message.
    std::deque<std::pair<std::uint64_t, RegionPtr>> sent_;
    std::deque<Message> queue_;
    std::uint64_t serial_ = 0;     ///< of the last message in the ring
    std::uint64_t editSerial_ = 0; ///< of the last one that is no camera
    View camera_;
    bool hasCamera_ = false;
    std::vector<std::byte> lights_; ///< the last message about live lamps
    std::uint32_t question_ = 0;    ///< the last one for open work

    std::uint64_t granted_ = 0, opened_ = 0;
    RegionPtr grantedRegion_;
    std::shared_ptr<StoreReader> store_;

    WorkerStatus status_;
    double lastTurn_ = 0;                 ///< steady clock [s]
    double silence_ = 0, standstill_ = 0; ///< since the last beat, the last turn of the worker [s]
    double ungranted_ = 0;                ///< since memory was granted that is not in use yet [s]
    std::uint64_t beat_ = 0, turns_ = 0;
    double unlitSince_ = 0; ///< steady clock [s]; 0: all is in the light
    double retryAt_ = 0, retryDelay_ = 0;
    unsigned restarts_ = 0;
    std::string reportedTrouble_;
    std::vector<std::string> toSay_;
};

} // namespace penumbra
