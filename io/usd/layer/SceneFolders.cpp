#include "io/usd/layer/SceneFolders.h"

#include "io/usd/layer/UsdAssets.h"

#include <algorithm>

namespace penumbra {

namespace fs = std::filesystem;

SceneFolders::SceneFolders(const fs::path& file) : all_(false) {
    add(file);
}

void SceneFolders::add(const fs::path& file) {
    if (all_) return;
    std::error_code failed;
    const fs::path folder = canonicalPath(fs::absolute(file, failed).parent_path());
    const fs::path target = canonicalPath(file).parent_path();
    for (const fs::path& path : {folder, target})
        if (!path.empty() && std::find(folders_.begin(), folders_.end(), path) == folders_.end())
            folders_.push_back(path);
}

bool SceneFolders::hold(const fs::path& file) const {
    if (all_) return true;
    const fs::path path = canonicalPath(file);
    if (path.empty()) return true; // links in a circle: opening it says so
    return std::any_of(folders_.begin(), folders_.end(), [&](const fs::path& folder) {
        return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
               folder.end();
    });
}

} // namespace penumbra
