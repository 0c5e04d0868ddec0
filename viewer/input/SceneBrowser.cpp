#include "viewer/input/SceneBrowser.h"

#include "io/model/ModelFormat.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <system_error>

namespace penumbra {

bool isSceneFile(const std::filesystem::path& file) {
    constexpr std::array<std::string_view, 4> kUsd{".usda", ".usdc", ".usd", ".usdz"};
    std::string ending = file.extension().string();
    for (char& c : ending) c = char(std::tolower(static_cast<unsigned char>(c)));
    return std::find(kUsd.begin(), kUsd.end(), ending) != kUsd.end() ||
           modelFormatOf(file).has_value();
}

SceneBrowser::SceneBrowser(const std::filesystem::path& folder) : folder_(folder) {
    go(".");
    if (fault_.empty()) return;
    std::error_code failed;
    folder_ = std::filesystem::current_path(failed);
    go(".");
}

void SceneBrowser::go(const std::string& folder) {
    namespace fs = std::filesystem;
    std::error_code failed;
    const fs::path there = fs::weakly_canonical(folder_ / folder, failed);
    fs::directory_iterator entries;
    if (!failed) entries = fs::directory_iterator(there, failed);
    fault_ = failed ? "can't read " + (folder_ / folder).string() + ": " + failed.message() : "";
    if (failed) return;
    folder_ = there;
    folders_.clear();
    files_.clear();
    for (; entries != fs::directory_iterator(); entries.increment(failed)) {
        const std::string name = entries->path().filename().string();
        if (name.starts_with('.')) continue;
        std::error_code unknown; // a link that leads nowhere is neither
        if (entries->is_directory(unknown))
            folders_.push_back(name);
        else if (entries->is_regular_file(unknown) && isSceneFile(entries->path()))
            files_.push_back(name);
        if (failed) break;
    }
    std::sort(folders_.begin(), folders_.end());
    std::sort(files_.begin(), files_.end());
}

} // namespace penumbra
