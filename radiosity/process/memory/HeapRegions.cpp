#include "radiosity/process/memory/Region.h"

#include <map>
#include <mutex>
#include <new>
#include <vector>

namespace penumbra {

namespace {

/// What can be opened.
struct Directory {
    std::mutex guard;
    std::size_t count = 0;
    std::map<std::string, std::weak_ptr<Region>> regions;
};

class HeapRegion : public Region {
public:
    HeapRegion(std::shared_ptr<Directory> directory, std::string name, std::size_t size)
        : directory_(std::move(directory)), name_(std::move(name)), lines_((size + 63) / 64),
          size_(size) {}
    ~HeapRegion() override { HeapRegion::unlink(); }
    std::span<std::byte> bytes() override { return {lines_.data()->bytes, size_}; }
    const std::string& name() const override { return name_; }
    void reserve() override {}
    void unlink() override {
        const std::lock_guard lock(directory_->guard);
        directory_->regions.erase(name_);
    }

private:
    struct alignas(64) Line {
        std::byte bytes[64];
    };
    std::shared_ptr<Directory> directory_;
    std::string name_;
    std::vector<Line> lines_;
    std::size_t size_;
};

class HeapRegions : public Regions {
public:
    RegionPtr create(std::size_t bytes) override {
        const std::lock_guard lock(directory_->guard);
        const std::string name = std::to_string(++directory_->count);
        auto region = std::make_shared<HeapRegion>(directory_, name, bytes);
        directory_->regions[name] = region;
        return region;
    }
    RegionPtr open(const std::string& name) override {
        const std::lock_guard lock(directory_->guard);
        const auto found = directory_->regions.find(name);
        return found == directory_->regions.end() ? nullptr : found->second.lock();
    }

private:
    std::shared_ptr<Directory> directory_ = std::make_shared<Directory>();
};

} // namespace

std::unique_ptr<Regions> makeHeapRegions() {
    return std::make_unique<HeapRegions>();
}

} // namespace penumbra
