#include "radiosity/process/SharedRegions.h"

#include "scenegraph/Error.h"

#include <boost/interprocess/mapped_region.hpp>
#include <boost/interprocess/shared_memory_object.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <signal.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

namespace penumbra {

namespace ipc = boost::interprocess;

namespace {

constexpr std::string_view kPrefix = "penumbra-";
constexpr const char* kFolder = "/dev/shm"; // where Linux keeps POSIX shared memory

[[noreturn]] void fail(const std::string& what) {
    throw Error("shared memory: " + what);
}

/// penumbra-<process>-<128 random bits>
std::string newName() {
    std::array<unsigned char, 16> random{};
    if (getrandom(random.data(), random.size(), 0) != ssize_t(random.size()))
        fail("no random numbers for a name");
    std::string name = std::string(kPrefix) + std::to_string(getpid()) + "-";
    for (unsigned char byte : random) {
        name += "0123456789abcdef"[byte >> 4];
        name += "0123456789abcdef"[byte & 15];
    }
    return name;
}

bool isName(std::string_view name) {
    return name.size() <= kMostRegionName && name.starts_with(kPrefix) &&
           std::all_of(name.begin() + kPrefix.size(), name.end(), [](char c) {
               return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') || c == '-';
           });
}

class SharedRegion : public Region {
public:
    SharedRegion(ipc::shared_memory_object object, std::string name, bool mine)
        : object_(std::move(object)), map_(object_, ipc::read_write), name_(std::move(name)),
          mine_(mine) {}
    ~SharedRegion() override {
        if (mine_) SharedRegion::unlink();
    }
    std::span<std::byte> bytes() override {
        return {static_cast<std::byte*>(map_.get_address()), map_.get_size()};
    }
    const std::string& name() const override { return name_; }
    void unlink() override {
        if (!std::exchange(unlinked_, true)) ipc::shared_memory_object::remove(name_.c_str());
    }
    void reserve() override {
        // What is not there when it is touched kills: a bus error.
        const int error =
            posix_fallocate(object_.get_mapping_handle().handle, 0, off_t(map_.get_size()));
        if (error != 0)
            fail(std::to_string((map_.get_size() >> 20) + 1) + " MB: " + std::strerror(error));
    }

private:
    ipc::shared_memory_object object_;
    ipc::mapped_region map_;
    std::string name_;
    bool mine_, unlinked_ = false;
};

class SharedRegions : public Regions {
public:
    RegionPtr create(std::size_t bytes) override {
        const std::string name = newName();
        try {
            ipc::shared_memory_object object(ipc::create_only, name.c_str(), ipc::read_write,
                                             ipc::permissions(0600));
            try {
                object.truncate(ipc::offset_t(std::max<std::size_t>(bytes, 1)));
                return std::make_shared<SharedRegion>(std::move(object), name, true);
            } catch (...) {
                ipc::shared_memory_object::remove(name.c_str());
                throw;
            }
        } catch (const ipc::interprocess_exception& error) {
            fail(std::to_string((bytes >> 20) + 1) + " MB: " + error.what());
        }
    }

    RegionPtr open(const std::string& name) override {
        if (!isName(name)) return nullptr;
        try {
            ipc::shared_memory_object object(ipc::open_only, name.c_str(), ipc::read_write);
            struct stat facts {};
            if (fstat(object.get_mapping_handle().handle, &facts) != 0 ||
                facts.st_uid != geteuid() || (facts.st_mode & 077) != 0)
                return nullptr; // not made by us
            return std::make_shared<SharedRegion>(std::move(object), name, false);
        } catch (const ipc::interprocess_exception&) {
            return nullptr;
        }
    }
};

template <class Which>
void removeRegions(Which which) {
    std::error_code ignored;
    for (const auto& file : std::filesystem::directory_iterator(kFolder, ignored)) {
        const std::string name = file.path().filename().string();
        if (!isName(name)) continue;
        int process = 0;
        const char* const digits = name.data() + kPrefix.size();
        if (std::from_chars(digits, name.data() + name.size(), process).ec != std::errc()) continue;
        struct stat facts {};
        if (stat(file.path().c_str(), &facts) == 0 && facts.st_uid == geteuid() && which(process))
            ipc::shared_memory_object::remove(name.c_str());
    }
}

} // namespace

std::unique_ptr<Regions> makeSharedRegions() {
    return std::make_unique<SharedRegions>();
}

void removeRegionsOf(int process) {
    removeRegions([process](int maker) { return maker == process; });
}

void removeOrphanedRegions() {
    removeRegions([](int maker) { return kill(maker, 0) != 0 && errno == ESRCH; });
}

} // namespace penumbra
