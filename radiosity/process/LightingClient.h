// The node's end of the conversation with its worker.
#pragma once

#include "base/Bounds.h"
#include "radiosity/process/LightingLink.h"
#include "radiosity/process/LightingTask.h"
#include "radiosity/process/MessageQueue.h"
#include "radiosity/process/RadiosityState.h"
#include "radiosity/process/WorkerWatch.h"
#include "radiosity/process/memory/ControlBlock.h"
#include "radiosity/process/snapshot/SceneSnapshot.h"
#include "radiosity/process/store/LightStore.h"
#include "scenegraph/Camera.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace penumbra {

/// Keeps a worker running, sends it what is to be sent, and gives out what it publishes. Nothing
/// here ever waits, except for a worker in a thread to end: what is to be sent is queued
/// (MessageQueue), and a worker that says nothing any more is ended and started anew (WorkerWatch).
class LightingClient {
public:
    /// \param writeTask what a new worker is sent first: the scene with all edits so far
    LightingClient(std::unique_ptr<LightingLink> link, const RadiosityOptions& options,
                   std::function<void(ByteWriter&)> writeTask);
    ~LightingClient();

    void start();
    void stop();

    /// Things have come to the scene.
    void send(const SceneGrowth& growth);
    void send(const GraphEdit& edit);
    void invalidate(const Bounds& box);
    void setCamera(const View& view);
    void send(MessageKind kind, std::uint32_t value);
    void setPreviewLights(const std::vector<std::string>& paths, std::uint32_t serial);
    /// Has the dirty set published as an answer to a question of that number; 0: none any more.
    void watchDirty(std::uint32_t question);

    /// To be called now and then: sends, checks that the worker is alive, and reads its reports.
    void turn();

    /// The newest store, once it is there; the same one until there is another.
    const std::shared_ptr<StoreReader>& store() const { return store_; }
    /// What is read in a store makes no sense: the worker is started anew.
    void distrust(const std::string& why);

    RadiosityState state() const;
    std::vector<std::string> takeMessages();

private:
    ControlBlock& control() { return *reinterpret_cast<ControlBlock*>(control_->bytes().data()); }
    void launch();
    void failed(const std::string& why);
    void say(const std::string& text);
    void sendScene();
    void sendRegion(MessageKind kind, const ByteWriter& content);
    void sendValue(std::uint64_t key, MessageKind kind, std::uint32_t value);
    void watch(double passed);
    void grantStore();
    void openStore();
    void readStatus();
    SolutionState solution() const;

    std::unique_ptr<LightingLink> link_;
    RadiosityOptions options_;
    std::function<void(ByteWriter&)> writeTask_;

    bool running_ = false;  ///< is meant to be
    bool hopeless_ = false; ///< this scene can't be lit here
    bool reportedFailure_ = false;
    RegionPtr control_; ///< null: there is no worker
    std::optional<RingSender> ring_;
    MessageQueue queue_;
    View camera_;
    bool hasCamera_ = false;
    std::vector<std::byte> lights_; ///< the last message about previewed lights
    std::uint32_t question_ = 0;    ///< the last one for the dirty set

    std::uint64_t granted_ = 0, opened_ = 0;
    RegionPtr grantedRegion_;
    std::shared_ptr<StoreReader> store_;
    std::uint64_t storeNumber_ = 0; ///< of store_
    std::uint64_t grantedFor_ = 0;  ///< StoreRequest::store of the last grant

    WorkerStatus status_;
    WorkerWatch watch_;
    double lastTurn_ = 0;   ///< steady clock [s]
    double ungranted_ = 0;  ///< since memory was granted that is not in use yet [s]
    double unlitSince_ = 0; ///< steady clock [s]; 0: all is in the light
    double retryAt_ = 0, retryDelay_ = 0;
    unsigned restarts_ = 0;
    std::string reportedTrouble_;
    std::vector<std::string> toSay_;
};

} // namespace penumbra
