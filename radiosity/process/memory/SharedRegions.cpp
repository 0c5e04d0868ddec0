#include "radiosity/process/memory/SharedRegions.h"

#include "base/Error.h"
#include "base/SystemError.h"

#include <boost/interprocess/file_mapping.hpp>
#include <boost/interprocess/mapped_region.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

namespace penumbra {

namespace ipc = boost::interprocess;

namespace {

constexpr std::string_view kPrefix = "penumbra-";
constexpr const char* kMemory = "/memfd:"; // what Linux calls such a file, before its name

[[noreturn]] void fail(const std::string& what) {
    throw Error("shared memory: " + what);
}

/// 128 random bits.
std::string randomText() {
    std::array<unsigned char, 16> random{};
    if (getrandom(random.data(), random.size(), 0) != ssize_t(random.size()))
        fail("no random numbers for a name");
    std::string text;
    for (unsigned char byte : random) {
        text += "0123456789abcdef"[byte >> 4];
        text += "0123456789abcdef"[byte & 15];
    }
    return text;
}

/// Where to find a file that a process has open.
std::string pathOf(const std::string& process, const std::string& file) {
    return "/proc/" + process + "/fd/" + file;
}

bool isName(std::string_view name) {
    return name.size() <= kMostRegionName && name.starts_with(kPrefix) &&
           std::all_of(name.begin() + kPrefix.size(), name.end(), [](char c) {
               return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') || c == '-';
           });
}

/// What can be had before something else has to go [bytes].
std::size_t availableMemory() {
    std::ifstream facts("/proc/meminfo");
    std::string name;
    for (std::size_t kilobytes = 0; facts >> name >> kilobytes; facts.ignore(80, '\n'))
        if (name == "MemAvailable:") return kilobytes << 10;
    return ~std::size_t(0);
}

/// A file of no more than memory, open in this process.
class MemoryFile {
public:
    explicit MemoryFile(const std::string& name)
        : handle_(memfd_create(name.c_str(), MFD_CLOEXEC | MFD_ALLOW_SEALING)) {
        if (handle_ < 0) fail(reasonOf(errno, FileUse::write));
    }
    ~MemoryFile() { close(handle_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    int handle() const { return handle_; }

private:
    int handle_;
};

class SharedRegion : public Region {
public:
    /// \param file null if it is not ours
    SharedRegion(ipc::file_mapping mapping, std::string name, std::unique_ptr<MemoryFile> file)
        : mapping_(std::move(mapping)), map_(mapping_, ipc::read_write), name_(std::move(name)),
          file_(std::move(file)) {}
    std::span<std::byte> bytes() override {
        return {static_cast<std::byte*>(map_.get_address()), map_.get_size()};
    }
    const std::string& name() const override { return name_; }
    void unlink() override {
        file_.reset();
        ipc::file_mapping().swap(mapping_); // the memory stays
    }
    void reserve() override {
        // What is not there when it is touched kills: a bus error. Linux goes on until nothing is
        // left for anybody, so it is asked before.
        const std::size_t size = map_.get_size();
        const int error =
            size > availableMemory()
                ? ENOMEM
                : posix_fallocate(mapping_.get_mapping_handle().handle, 0, off_t(size));
        if (error != 0)
            fail(std::to_string((size >> 20) + 1) + " MB: " + reasonOf(error, FileUse::write));
    }

private:
    ipc::file_mapping mapping_;
    ipc::mapped_region map_;
    std::string name_;
    std::unique_ptr<MemoryFile> file_;
};

class SharedRegions : public Regions {
public:
    RegionPtr create(std::size_t bytes) override {
        const std::string random = randomText();
        auto file = std::make_unique<MemoryFile>(std::string(kPrefix) + random);
        const int handle = file->handle();
        if (fchmod(handle, 0600) != 0 ||
            ftruncate(handle, off_t(std::max<std::size_t>(bytes, 1))) != 0 ||
            fcntl(handle, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) != 0)
            fail(std::to_string((bytes >> 20) + 1) + " MB: " + reasonOf(errno, FileUse::write));
        const std::string number = std::to_string(handle);
        try {
            ipc::file_mapping mapping(pathOf("self", number).c_str(), ipc::read_write);
            return std::make_shared<SharedRegion>(std::move(mapping),
                                                  std::string(kPrefix) + std::to_string(getpid()) +
                                                      "-" + number + "-" + random,
                                                  std::move(file));
        } catch (const ipc::interprocess_exception& error) {
            fail(std::to_string((bytes >> 20) + 1) +
                 " MB: " + reasonOf(error.get_native_error(), FileUse::write));
        }
    }

    RegionPtr open(const std::string& name) override {
        if (!isName(name)) return nullptr;
        std::istringstream parts(name.substr(kPrefix.size()));
        std::string process, file, random;
        std::getline(std::getline(std::getline(parts, process, '-'), file, '-'), random, '-');
        try {
            ipc::file_mapping mapping(pathOf(process, file).c_str(), ipc::read_write);
            const int handle = mapping.get_mapping_handle().handle;
            std::error_code unknown;
            const auto known =
                std::filesystem::read_symlink(pathOf("self", std::to_string(handle)), unknown);
            struct stat facts {};
            const int seals = fcntl(handle, F_GET_SEALS);
            if (known != kMemory + std::string(kPrefix) + random + " (deleted)" || // another file
                fstat(handle, &facts) != 0 || facts.st_uid != geteuid() ||         // not made by us
                seals < 0 || (seals & F_SEAL_SHRINK) == 0) // could be taken away below our feet
                return nullptr;
            return std::make_shared<SharedRegion>(std::move(mapping), name, nullptr);
        } catch (const ipc::interprocess_exception&) {
            return nullptr;
        }
    }
};

} // namespace

std::unique_ptr<Regions> makeSharedRegions() {
    return std::make_unique<SharedRegions>();
}

} // namespace penumbra
