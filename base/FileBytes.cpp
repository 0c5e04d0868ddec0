#include "base/FileBytes.h"

#include "base/Error.h"
#include "base/SystemError.h"

#include <cerrno>
#include <new>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace penumbra {

namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
    throw SceneFileError({path, 0, 0}, why);
}

/// A file that is open for reading.
class OpenFile {
public:
    explicit OpenFile(const std::string& path)
        : number_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
        if (number_ < 0) refuse(path, "can't read: " + reasonOf(errno, FileUse::read));
    }
    ~OpenFile() { ::close(number_); }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;
    int number() const { return number_; }

private:
    int number_;
};

void readAll(int file, const std::string& path, std::span<std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t done = ::read(file, bytes.data(), bytes.size());
        if (done < 0 && errno == EINTR) continue;
        if (done < 0) refuse(path, "can't read: " + reasonOf(errno, FileUse::read));
        if (done == 0) refuse(path, "can't read: it was shortened meanwhile (try again)");
        bytes = bytes.subspan(std::size_t(done));
    }
}

} // namespace

FileBytes::FileBytes(const std::string& path, std::uintmax_t maxBytes, std::uintmax_t mapFrom) {
    const std::string unreadable = whyUnreadable(path);
    if (!unreadable.empty()) refuse(path, "can't read: " + unreadable);
    struct stat status {};
    if (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) // don't wait for a pipe
        refuse(path, "can't read: it is a device or a pipe (name a file)");
    const OpenFile file(path);
    if (::fstat(file.number(), &status) != 0)
        refuse(path, "can't read: " + reasonOf(errno, FileUse::read));
    const auto size = std::uintmax_t(status.st_size);
    if (size > maxBytes)
        refuse(path, "the file is too large: " + std::to_string(size) + " bytes (the limit is " +
                         std::to_string(maxBytes) + ")");
    if (size == 0) return;
    if (size < mapFrom) {
        const std::size_t rounded = (size + kAlignment - 1) / kAlignment * kAlignment;
        copy_.reset(static_cast<std::byte*>(std::aligned_alloc(kAlignment, rounded)));
        if (!copy_) throw std::bad_alloc();
        readAll(file.number(), path, {copy_.get(), size});
        bytes_ = {copy_.get(), size};
        return;
    }
    void* memory = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.number(), 0);
    if (memory == MAP_FAILED) refuse(path, "can't read: " + reasonOf(errno, FileUse::read));
    bytes_ = {static_cast<const std::byte*>(memory), size};
}

FileBytes::~FileBytes() {
    if (!copy_ && !bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

} // namespace penumbra
