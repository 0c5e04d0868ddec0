// Walking through folders to a file that can be opened.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra {

/// Whether a file's name says that it is a scene: USD text, binary or package, or a model.
bool isSceneFile(const std::filesystem::path& file);

/// What of a folder leads to scenes: its folders and scene files, each sorted by name; hidden ones
/// left out.
class SceneBrowser {
public:
    /// \param folder to begin with; if it can't be read, the present one
    explicit SceneBrowser(const std::filesystem::path& folder);

    const std::filesystem::path& folder() const { return folder_; }
    const std::vector<std::string>& folders() const { return folders_; }
    const std::vector<std::string>& files() const { return files_; }
    /// Why the folder that was gone to last could not be read; empty: it could.
    const std::string& fault() const { return fault_; }

    /// Goes to a folder, relative to the present one ("..": up). Stays if it can't be read.
    void go(const std::string& folder);

private:
    std::filesystem::path folder_;
    std::vector<std::string> folders_, files_;
    std::string fault_;
};

} // namespace penumbra
