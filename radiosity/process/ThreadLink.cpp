#include "base/Parallel.h"
#include "radiosity/process/LightingLink.h"
#include "radiosity/process/LightingWorker.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>

namespace penumbra {

namespace {

class ThreadLink : public LightingLink {
public:
    ~ThreadLink() override { ThreadLink::end(); }
    Regions& regions() override { return *regions_; }

    void start(const RegionPtr& control, const WorkerLimits& limits) override {
        end();
        control_ = control;
        thread_ = std::thread([this, control, limits] { work(control, limits.threads); });
    }
    std::optional<std::string> ended() override {
        const std::lock_guard lock(guard_);
        return ended_;
    }
    bool apart() const override { return false; }
    void end() override {
        if (!thread_.joinable()) return;
        ControlBlock& control = LightingWorker::controlOf(*control_);
        control.stop.store(1, std::memory_order_relaxed);
        thread_.join();
        const std::lock_guard lock(guard_);
        ended_.reset();
    }

private:
    void work(const RegionPtr& control, unsigned threads) {
        std::string why = "it was asked to stop";
        try {
            const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
            const ThreadLimit limit(threads > 0 ? threads : std::max(1u, cores - 1));
            LightingWorker(*regions_, control).run();
        } catch (const std::exception& error) {
            why = error.what();
        }
        const std::lock_guard lock(guard_);
        ended_ = why;
    }

    std::unique_ptr<Regions> regions_ = makeHeapRegions();
    RegionPtr control_;
    std::thread thread_;
    std::mutex guard_;
    std::optional<std::string> ended_;
};

} // namespace

std::unique_ptr<LightingLink> makeThreadLink() {
    return std::make_unique<ThreadLink>();
}

} // namespace penumbra
