#include "tools/OutputFiles.h"

#include "base/Error.h"
#include "base/SystemError.h"
#include "io/image/AtomicFile.h"
#include "tools/SceneSolution.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <map>
#include <utility>

#include <sys/stat.h>
#include <unistd.h>

namespace penumbra {

namespace {

namespace fs = std::filesystem;

/// Files by what they are, and by where they are or will be: either tells that two are one.
class KnownFiles {
public:
    /// Adds a file. \return what it was known for before; null: it is new, or a device or a pipe
    const std::string* add(const fs::path& name, const std::string& as) {
        const fs::path place = writtenPlace(name);
        struct stat status {};
        const bool there = ::stat(place.c_str(), &status) == 0;
        if (there && !S_ISREG(status.st_mode)) return nullptr;
        const auto [byPlace, newPlace] = places_.try_emplace(canonical(place), as);
        if (!newPlace) return &byPlace->second;
        if (!there) return nullptr;
        const auto [byFile, newFile] = files_.try_emplace({status.st_dev, status.st_ino}, as);
        return newFile ? nullptr : &byFile->second;
    }

private:
    std::string canonical(const fs::path& place) {
        const auto [known, isNew] = folders_.try_emplace(place.parent_path().string());
        std::error_code unknown; // what can't be opened is known by its name
        if (isNew) {
            known->second = fs::weakly_canonical(fs::absolute(place, unknown), unknown);
            known->second.remove_filename();
        }
        return (known->second / place.filename()).string();
    }

    std::map<std::string, fs::path> folders_; ///< canonical, by their name
    std::map<std::string, std::string> places_;
    std::map<std::pair<dev_t, ino_t>, std::string> files_;
};

/// Says what is wrong with an output path before anything is computed for it.
void requireAPlaceFor(const std::string& output) {
    struct stat status {};
    const bool there = ::stat(output.c_str(), &status) == 0;
    if (!there && errno != ENOENT) failToUse(output, errno, FileUse::write);
    if (there && S_ISDIR(status.st_mode)) failToUse(output, EISDIR, FileUse::write);
    if (there && !S_ISREG(status.st_mode)) return; // a device or a pipe
    const fs::path parent = writtenPlace(output).parent_path();
    const std::string folder = parent.empty() ? "." : parent.string();
    if (::access(folder.c_str(), W_OK | X_OK) == 0) return;
    if (errno != ENOENT) failToUse(output, errno, FileUse::write);
    throw Error(
        fmt::format("{}: error: can't write: no folder '{}' (create it first)", output, folder));
}

} // namespace

std::vector<std::string> everyName(const std::string& pattern, FrameRange frames) {
    if (pattern.empty()) return {};
    if (pattern.find('#') == std::string::npos) return {pattern};
    std::vector<std::string> names;
    for (int frame = frames.first; frame <= frames.last; ++frame)
        names.push_back(numberedPath(pattern, frame));
    return names;
}

void finishStandardOutput() {
    errno = 0;
    if (std::fflush(stdout) != 0 || std::ferror(stdout))
        failToUse("standard output", errno ? errno : EIO, FileUse::write);
}

void checkOutputs(const std::vector<fs::path>& read, const std::vector<std::string>& outputs) {
    KnownFiles known;
    for (const fs::path& file : read)
        if (!file.empty()) known.add(file, fmt::format("'{}', which is read", file.string()));
    for (const std::string& output : outputs) {
        if (output.empty() || output == "-") continue;
        requireAPlaceFor(output);
        if (const std::string* owner = known.add(output, "another result"))
            throw CLI::ValidationError(
                output, fmt::format("would overwrite {} (give it another name)", *owner));
    }
}

} // namespace penumbra
