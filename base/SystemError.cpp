#include "base/SystemError.h"

#include "base/Error.h"

#include <cerrno>
#include <filesystem>
#include <system_error>

#include <sys/stat.h>
#include <unistd.h>

namespace penumbra {

namespace {

/// Null: the message depends on the use, or is not known.
const char* commonReason(int errorNumber) {
    switch (errorNumber) {
    case EISDIR:
        return "it is a folder (name a file)";
    case ENOTDIR:
        return "a part of its path is a file, not a folder (look at its spelling)";
    case ENAMETOOLONG:
        return "its name is too long (choose a shorter one)";
    case ELOOP:
        return "its symbolic links lead in a circle (name the file itself)";
    case EMFILE:
    case ENFILE:
        return "too many files are open (allow more: ulimit -n)";
    case ENOMEM:
        return "memory is short (allow more: ulimit -v, or close other programs)";
    case EIO:
        return "the device reports a fault (check the disk)";
    case ESTALE:
        return "its network drive has lost it (try again)";
    default:
        return nullptr;
    }
}

const char* readReason(int errorNumber) {
    switch (errorNumber) {
    case ENOENT:
        return "there is no such file (look at its spelling)";
    case EACCES:
    case EPERM:
        return "no permission (ask for the right to read it)";
    default:
        return nullptr;
    }
}

const char* writeReason(int errorNumber) {
    switch (errorNumber) {
    case ENOENT:
        return "its folder does not exist (create it first)";
    case EACCES:
    case EPERM:
        return "no permission (choose another place, or ask for the right to write there)";
    case EROFS:
        return "the file system can only be read (choose another place)";
    case ENOSPC:
        return "no space left on the device (free some space or choose another place)";
    case EDQUOT:
        return "the quota is used up (free some space or choose another place)";
    case EFBIG:
        return "files may not grow that large (allow more: ulimit -f, or write less)";
    case ETXTBSY:
        return "it is a program that runs (choose another name)";
    case EPIPE:
        return "who was to read it has gone (write to a file instead)";
    default:
        return nullptr;
    }
}

} // namespace

std::string reasonOf(int errorNumber, FileUse use) {
    const char* reason = commonReason(errorNumber);
    if (!reason) reason = use == FileUse::read ? readReason(errorNumber) : writeReason(errorNumber);
    if (reason) return reason;
    return "the system refuses it with error number " + std::to_string(errorNumber) +
           " (try another file or place)";
}

void failToUse(const std::string& path, int errorNumber, FileUse use) {
    std::string reason = reasonOf(errorNumber, use);
    std::error_code unknown;
    if (use == FileUse::write && errorNumber == ENOENT &&
        std::filesystem::is_directory(std::filesystem::absolute(path, unknown).parent_path(),
                                      unknown))
        reason = "its folder takes no files (choose another place)"; // such as /proc
    throw Error(path + ": error: can't " + (use == FileUse::read ? "read" : "write") + ": " +
                reason);
}

std::string whyUnreadable(const std::string& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0 || ::access(path.c_str(), R_OK) != 0)
        return reasonOf(errno, FileUse::read);
    return S_ISDIR(status.st_mode) ? reasonOf(EISDIR, FileUse::read) : std::string();
}

} // namespace penumbra
