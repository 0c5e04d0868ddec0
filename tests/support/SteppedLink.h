// A worker that takes its turns when a test says so, in memory that can be read.
#pragma once

#include "radiosity/process/LightingLink.h"
#include "radiosity/process/LightingWorker.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace penumbra {

/// Remembers what it hands out.
class WatchedRegions : public Regions {
public:
    RegionPtr create(std::size_t bytes) override;
    RegionPtr open(const std::string& name) override { return regions_->open(name); }

    std::vector<std::weak_ptr<Region>> all;

private:
    std::unique_ptr<Regions> regions_ = makeHeapRegions();
};

/// Program and worker in one thread, so that a test is the same each time, and can read or write
/// any byte between any two steps.
class SteppedLink : public LightingLink {
public:
    Regions& regions() override { return watched; }
    bool apart() const override { return false; }
    void start(const RegionPtr& control, const WorkerLimits&) override;
    std::optional<std::string> ended() override { return why_; }
    void end() override { worker_.reset(); }

    /// A turn of about so many seconds.
    void step(double seconds = 0.0005);

    WatchedRegions watched;

private:
    std::unique_ptr<LightingWorker> worker_;
    std::optional<std::string> why_;
};

} // namespace penumbra
