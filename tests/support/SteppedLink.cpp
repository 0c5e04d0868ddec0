#include "tests/support/SteppedLink.h"

#include <exception>

namespace penumbra {

RegionPtr WatchedRegions::create(std::size_t bytes) {
    RegionPtr region = regions_->create(bytes);
    std::erase_if(all, [](const auto& known) { return known.expired(); });
    all.push_back(region);
    return region;
}

void SteppedLink::start(const RegionPtr& control, const WorkerLimits&) {
    why_.reset();
    worker_ = std::make_unique<LightingWorker>(watched, control);
}

void SteppedLink::step(double seconds) {
    if (!worker_ || why_) return;
    try {
        if (worker_->turn(seconds) == LightingWorker::Turn::stopped) why_ = "it has stopped";
    } catch (const std::exception& error) {
        why_ = error.what();
    }
}

} // namespace penumbra
