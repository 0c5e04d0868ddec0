// Files that are removed when a signal ends the process before they are whole.
#pragma once

#include <string>

namespace penumbra {

/// A new file of a name that was free. It is removed when this is destroyed, unless it was kept,
/// and when a signal ends the process (see removeUnfinishedFilesOnSignals()).
class UnfinishedFile {
public:
    /// Creates it in a folder, open for writing, with the permissions that the user's umask leaves.
    /// If that fails, descriptor() is negative and errno says why.
    explicit UnfinishedFile(const std::string& folder);
    ~UnfinishedFile();
    UnfinishedFile(const UnfinishedFile&) = delete;
    UnfinishedFile& operator=(const UnfinishedFile&) = delete;

    int descriptor() const { return descriptor_; }
    /// False, with errno set, if the system reports late that it could not keep the bytes.
    bool close();
    /// Gives the file its name. False, with errno set, if that fails.
    bool renameTo(const std::string& path);

private:
    std::string path_; ///< empty: there is nothing to remove
    int descriptor_ = -1;
    int slot_ = -1; ///< where the signal handler finds it
};

/// From now on SIGINT, SIGTERM and SIGHUP remove all unfinished files of the process, then end it
/// as they would have: who started it sees which signal it was. What is ignored stays ignored
/// (nohup).
void removeUnfinishedFilesOnSignals();

} // namespace penumbra
