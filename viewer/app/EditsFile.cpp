#include "viewer/app/EditsFile.h"

#include "io/usd/recording/UsdRecording.h"

namespace penumbra {

std::vector<std::string> saveEdits(const LoadedScene& scene, const std::filesystem::path& file,
                                   EditHistory history, const std::filesystem::path& layer) {
    const std::size_t made = history.undoable();
    while (history.undo()) { // what the file says, and then what it does not say
    }
    UsdRecording recording(scene, file);
    while (history.undoable() < made) history.redo();
    std::vector<const Node*> hidden;
    for (const PresenceEdit& edit : history.hidden()) hidden.push_back(edit.node.get());
    recording.takeEdits(hidden);
    recording.write(layer);
    return recording.missed();
}

std::string freeEditsName(const std::string& name) {
    std::string free = name + "-edited.usda";
    std::error_code unknown; // writing will say what is wrong
    for (int number = 2; std::filesystem::exists(free, unknown); ++number)
        free = name + "-edited-" + std::to_string(number) + ".usda";
    return free;
}

} // namespace penumbra
