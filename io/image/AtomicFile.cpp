#include "io/image/AtomicFile.h"

#include "base/SystemError.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <utility>

namespace penumbra {

namespace {

namespace fs = std::filesystem;

constexpr int kMostLinks = 40; ///< followed one after another, as Linux itself does

[[noreturn]] void fail(const std::string& path, int errorNumber) {
    failToUse(path, errorNumber, FileUse::write);
}

/// A file descriptor that closes itself.
class Descriptor {
public:
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() { close(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    int number() const { return number_; }
    /// False, with errno set, if the system reports late that it could not keep the bytes.
    bool close() { return number_ < 0 || ::close(std::exchange(number_, -1)) == 0; }

private:
    int number_;
};

/// Removes a file when the scope is left, unless it was kept.
class TemporaryName {
public:
    explicit TemporaryName(std::string path) : path_(std::move(path)) {}
    ~TemporaryName() {
        if (!path_.empty()) ::unlink(path_.c_str());
    }
    TemporaryName(const TemporaryName&) = delete;
    TemporaryName& operator=(const TemporaryName&) = delete;
    void keep() { path_.clear(); }

private:
    std::string path_;
};

bool writeAll(int descriptor, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return false;
        bytes = bytes.subspan(std::size_t(written));
    }
    return true;
}

void writeStraight(const std::string& path, std::span<const std::byte> bytes) {
    Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    if (file.number() < 0 || !writeAll(file.number(), bytes) || !file.close()) fail(path, errno);
}

/// Creates a file of a name that was free, with the permissions that the user's umask leaves.
std::pair<int, std::string> openTemporary(const fs::path& folder) {
    for (int attempt = 0;; ++attempt) {
        const std::string name =
            ".penumbra-" + std::to_string(::getpid()) + "-" + std::to_string(attempt) + ".tmp";
        const std::string path = (folder / name).string();
        const int number = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (number >= 0 || errno != EEXIST) return {number, path};
    }
}

} // namespace

fs::path writtenPlace(const fs::path& path) {
    std::error_code ignored; // of what can't be looked at; opening it will say why
    fs::path target = path;
    for (int links = 0; links < kMostLinks && fs::is_symlink(target, ignored); ++links)
        target = target.parent_path() / fs::read_symlink(target, ignored);
    return target;
}

void writeFileAtomically(const std::string& path, std::span<const std::byte> bytes) {
    std::error_code failed;
    const fs::path target = writtenPlace(path);
    const fs::file_status status = fs::status(target, failed);
    if (status.type() == fs::file_type::none) fail(path, failed.value());
    if (fs::is_directory(status)) fail(path, EISDIR);
    if (fs::exists(status) && !fs::is_regular_file(status)) return writeStraight(path, bytes);

    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    const auto [number, temporaryPath] = openTemporary(folder);
    if (number < 0) fail(path, errno);
    Descriptor file(number);
    TemporaryName temporary(temporaryPath);
    if (!writeAll(file.number(), bytes) || !file.close()) fail(path, errno);
    if (std::rename(temporaryPath.c_str(), target.c_str()) != 0) fail(path, errno);
    temporary.keep();
}

void writeFileAtomically(const std::string& path, std::string_view text) {
    writeFileAtomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

} // namespace penumbra
