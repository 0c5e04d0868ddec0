#include "radiosity/process/LightingProcess.h"

#include "base/Error.h"
#include "base/Parallel.h"
#include "radiosity/process/LightingWorker.h"
#include "radiosity/process/memory/SharedRegions.h"

#include <algorithm>
#include <cerrno>
#include <thread>

#include <fcntl.h>
#include <poll.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace penumbra {

namespace {

constexpr int kBeat = 50; ///< [ms]

/// Shows that this process is alive, and ends it when the viewer is not: whatever it is doing, a
/// process that nobody listens to is to leave.
class Watch {
public:
    Watch(ControlBlock& control)
        : viewer_(pid_t(control.viewer)), handle_(int(syscall(SYS_pidfd_open, viewer_, 0))) {
        if (handle_ < 0 && errno == ESRCH) leave();
        thread_ = std::jthread([this, &control](const std::stop_token& stop) {
            while (!stop.stop_requested()) {
                control.beat.fetch_add(1, std::memory_order_relaxed);
                pollfd viewer{handle_, POLLIN, 0};
                if (handle_ < 0)
                    poll(nullptr, 0, kBeat);
                else if (poll(&viewer, 1, kBeat) > 0)
                    leave();
            }
        });
    }
    ~Watch() {
        thread_ = {};
        if (handle_ >= 0) close(handle_);
    }
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;

private:
    void leave() const { _exit(0); }
    pid_t viewer_;
    int handle_;
    std::jthread thread_;
};

} // namespace

void runLightingProcess(const std::string& name, const WorkerLimits& limits) {
    const std::unique_ptr<Regions> regions = makeSharedRegions();
    const RegionPtr control = regions->open(name);
    if (!control)
        throw Error("radiosity: no viewer waits at '" + name +
                    "' (it is started by the viewer, or by hand with the name that it gives)");
    control->unlink();
    const Watch watch(LightingWorker::controlOf(*control));
    if (limits.niceness > 0 && nice(limits.niceness) == -1) errno = 0; // then it is not nice
    const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
    const ThreadLimit limit(limits.threads > 0 ? limits.threads : cores);
    LightingWorker(*regions, control, limits.memory).run();
}

} // namespace penumbra
