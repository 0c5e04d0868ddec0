// The worker of a RadiosityNode: takes scenes and edits, gives light.
#pragma once

#include "radiosity/process/EditPace.h"
#include "radiosity/process/LightingTask.h"
#include "radiosity/process/ViewerAttention.h"
#include "radiosity/process/memory/ControlBlock.h"
#include "radiosity/process/snapshot/SceneReplica.h"
#include "radiosity/process/store/LightPublisher.h"
#include "radiosity/transport/LitScene.h"
#include "scenegraph/Camera.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace penumbra {

/// What runs in a thread or a process of its own. It knows nothing but two regions of memory, and
/// trusts neither.
class LightingWorker {
public:
    /// \param regions must outlive this
    /// \param memory  instead of what tasks ask for [bytes]; 0: that. See SolverOptions
    /// \throws Error if the control block is not one, or that of another version of the program
    LightingWorker(Regions& regions, RegionPtr control, std::size_t memory = 0);
    ~LightingWorker();

    /// Works until a message says stop. \throws Error if what it reads makes no sense
    void run();

    enum class Turn { worked, idle, stopped };
    /// Takes in what has come, works for about `budget` seconds, publishes some of it.
    Turn turn(double budget);
    /// Waits for something to do, not longer than this [s].
    void wait(double seconds);

    /// The control block of a region. \throws Error as above
    static ControlBlock& controlOf(Region& region);

private:
    void receive();
    void take(MessageKind kind, ByteReader& message);
    RegionPtr opened(const std::string& region);
    void takeScene(const std::string& region);
    void takeGrowth(const std::string& region);
    void takeEdit(ByteReader& message);
    void takePolicy(ByteReader& message);
    void takeLights(ByteReader& message);
    void followScene();
    void build();
    void requestStore();
    void requestAddition();
    void request(std::uint64_t bytes, std::uint64_t store);
    void show(const LitScene::Followed& followed);
    void openStore();
    bool mayFollow() const;
    std::uint64_t followed() const;
    bool work(double budget);
    void solve(double budget);
    void directIsDone();
    void warnOfMemory();
    void stateSolution();
    void showWork();
    void fail(const std::string& why);
    void report();

    Regions& regions_;
    RegionPtr region_;
    ControlBlock& control_;
    RingReceiver messages_;
    std::vector<std::byte> message_;
    std::uint32_t heard_ = 0; ///< the doorbell's count before the messages were read
    double newsAt_ = 0;       ///< when a message was taken last, steady clock [s]

    std::unique_ptr<SceneReplica> graph_;
    std::optional<LightingTask> task_; ///< its scene is in graph_
    std::unique_ptr<LitScene> lit_;
    std::unique_ptr<LightPublisher> publisher_;
    std::vector<Bounds> invalid_;
    ViewerAttention viewer_;
    std::uint32_t question_ = 0; ///< for the dirty set; 0: nobody asks
    double nextWork_ = 0;        ///< when it is published again, steady clock [s]
    std::uint32_t previewSet_ = 0;
    std::vector<std::string> lights_;
    std::size_t memory_;
    bool memoryWarned_ = false; ///< once for all scenes
    bool marked_ = false; ///< stale blocks of previewed lights are known, if not yet published
    bool shown_ = false;  ///< something was published since the last edit
    bool edited_ = false, stopped_ = false;
    EditPace pace_;
    std::uint64_t followed_ = 0; ///< the last message before the scene was followed
    /// What the solver works for; and whether anything is left for it.
    SolutionState aim_ = SolutionState::certified;
    bool workLeft_ = true;
    bool directDone_ = false; ///< of the mesh as it is, once
    double nextScan_ = 0;     ///< at the indirect light, steady clock [s]

    StoreRequest request_;
    StoreShape shape_;
    std::uint64_t store_ = 0;     ///< number of the store that is in use
    std::uint32_t described_ = 0; ///< objects of which the mesh is in it
    std::vector<std::byte> mesh_; ///< until memory for it is granted
    WorkerStatus status_;
};

} // namespace penumbra
