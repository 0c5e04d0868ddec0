#include "io/image/AtomicFile.h"

#include "base/SystemError.h"
#include "io/image/UnfinishedFile.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

namespace penumbra {

namespace {

namespace fs = std::filesystem;

constexpr int kMostLinks = 40; ///< followed one after another, as Linux itself does

[[noreturn]] void fail(const std::string& path, int errorNumber) {
    failToUse(path, errorNumber, FileUse::write);
}

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
    const int file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (file < 0) fail(path, errno);
    const int error = writeAll(file, bytes) ? 0 : errno;
    if (::close(file) != 0 || error != 0) fail(path, error ? error : errno);
}

} // namespace

fs::path writtenPlace(const fs::path& path) {
    std::error_code ignored; // of what can't be read; opening it will say why
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
    UnfinishedFile file(folder.string());
    if (file.descriptor() < 0 || !writeAll(file.descriptor(), bytes) || !file.close() ||
        !file.renameTo(target.string()))
        fail(path, errno);
}

void writeFileAtomically(const std::string& path, std::string_view text) {
    writeFileAtomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

} // namespace penumbra
