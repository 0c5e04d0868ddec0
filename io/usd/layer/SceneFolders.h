// Which folders the files of a scene may be in.
#pragma once

#include <filesystem>
#include <vector>

namespace penumbra {

/// A scene that somebody sent may name any file of this machine. Only those in the scene's own
/// folder, or below it, are opened, unless the user allows all. Links are followed: what counts is
/// where a file lies.
class SceneFolders {
public:
    /// All folders.
    SceneFolders() = default;
    /// The folder of a file; if the file is a link, also that of what it leads to.
    explicit SceneFolders(const std::filesystem::path& file);

    /// The folder of one more file. Without effect where all are.
    void add(const std::filesystem::path& file);
    /// Whether a file, which need not exist, is in one of the folders or below it.
    bool hold(const std::filesystem::path& file) const;

private:
    bool all_ = true;
    std::vector<std::filesystem::path> folders_; ///< canonical
};

} // namespace penumbra
