// All layers and layer stacks of a composition.
#pragma once

#include "io/usd/compose/UsdCompositionErrors.h"
#include "io/usd/compose/UsdLayerStack.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

namespace penumbra {

/// Reads layers, each once, and makes stacks of them, each once. What a stack can't take (a
/// sublayer that is missing, unreadable or contains itself) is reported and left out.
class UsdLayerStacks {
public:
    /// \param assets finds and reads layers. A file outside of the root layer's folder is followed,
    /// as USD does; who wants to forbid that does it there.
    UsdLayerStacks(UsdPathTable& paths, const UsdAssets& assets, const UsdLayerLimits& limits,
                   UsdCompositionErrors& errors)
        : paths_(paths), assets_(assets), limits_(limits), errors_(errors) {}

    UsdPathTable& paths() { return paths_; }
    /// The stack of the scene itself. Throws SceneFileError for faults of its root layer.
    const UsdLayerStack& open(const std::string& root);
    /// The stack of a file that another stack refers to, or null and why.
    const UsdLayerStack* find(const std::string& file, const UsdDictionary& variables,
                              std::string& problem);
    /// The files of all layers in the order of reading; then those that could not be understood. A
    /// package may be there several times.
    std::vector<std::filesystem::path> files() const;

    static constexpr std::size_t kMaxDepth = 64;          ///< sublayers of sublayers
    static constexpr std::size_t kMaxLayers = 4096;       ///< of a stack
    static constexpr std::size_t kMaxStacks = 100'000;    ///< in all
    static constexpr std::size_t kMaxStacked = 1'000'000; ///< layers of all stacks together

private:
    struct Open; // a stack that is being put together

    /// Throws SceneFileError.
    void read(UsdLoadedLayer& loaded, const std::string& file);
    const UsdLoadedLayer& load(const std::string& file);
    const std::string& canonical(const std::string& file);
    const UsdLayerStack& stackOf(const std::string& file, const UsdLoadedLayer& root,
                                 const UsdDictionary& variables);
    void add(Open& open, const std::string& file, const UsdLoadedLayer& layer,
             UsdLayerOffset offset);
    void addSubLayer(Open& open, const UsdLayer& parent, const std::string& parentFile,
                     const UsdSubLayer& sub, UsdLayerOffset outer);
    UsdLayerOffset combined(UsdLayerOffset outer, const UsdSubLayer& sub, const UsdLayer& parent,
                            const UsdLayer& layer);
    void readRelocates(UsdLayerStack& stack);

    UsdPathTable& paths_;
    const UsdAssets& assets_;
    UsdLayerLimits limits_;
    UsdCompositionErrors& errors_;
    std::unordered_map<std::string, std::string> canonical_;
    std::map<std::string, UsdLoadedLayer> layers_; // by canonical name
    std::vector<const UsdLoadedLayer*> read_;
    std::vector<std::filesystem::path> unread_; // there, but could not be understood
    std::map<std::string, std::unique_ptr<UsdLayerStack>> stacks_;
    std::size_t stacked_ = 0;
};

} // namespace penumbra
