#include "io/usd/layer/UsdLayerStack.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace penumbra {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxDepth = 64;    // sublayers of sublayers
constexpr std::size_t kMaxLayers = 4096; // in all: a tree that doubles at each level must end

class StackReader {
public:
    StackReader(const UsdAssets& assets, const UsdLayerLimits& limits, Diagnostics& diagnostics,
                std::vector<fs::path>* unread)
        : assets_(assets), limits_(limits), diagnostics_(diagnostics), unread_(unread) {}

    std::vector<UsdStackedLayer> read(const std::string& root) {
        add(root, load(root), {});
        return std::move(stack_);
    }

private:
    std::shared_ptr<const UsdLayer> load(const std::string& file) {
        auto& cached = layers_[assets_.canonical(file)];
        if (cached) return cached;
        cached = std::make_shared<UsdLayer>(assets_.layer(file, limits_));
        diagnostics_.append(cached->diagnostics);
        return cached;
    }

    void add(const std::string& file, const std::shared_ptr<const UsdLayer>& layer,
             UsdLayerOffset offset) {
        stack_.push_back({layer, offset});
        open_.push_back(assets_.canonical(file));
        for (const UsdSubLayer& sub : layer->subLayers) addSubLayer(*layer, sub, offset);
        open_.pop_back();
    }

    void addSubLayer(const UsdLayer& parent, const UsdSubLayer& sub, UsdLayerOffset outer) {
        const SourceLocation where = parent.location(sub.where);
        const auto skip = [&](const std::string& why) {
            diagnostics_.warn(where, "sublayer '" + sub.asset + "' left out: " + why);
        };
        if (sub.asset.empty()) return skip("its path is empty");
        if (sub.asset.front() == '`') return skip("variable expressions are not supported");
        if (sub.asset.find("://") != std::string::npos) return skip("only files can be read");
        const std::string file = assets_.resolve(parent.file, sub.asset);
        const std::string canonical = assets_.canonical(file);
        if (std::find(open_.begin(), open_.end(), canonical) != open_.end())
            return skip("it contains itself");
        if (open_.size() >= kMaxDepth) return skip("sublayers are nested too deeply");
        if (stack_.size() >= kMaxLayers) return skip("there are too many layers");
        std::shared_ptr<const UsdLayer> layer;
        try {
            layer = load(file);
        } catch (const SceneFileError& error) {
            std::error_code ignored;
            const fs::path onDisk = assets_.fileOf(file);
            if (unread_ && fs::is_regular_file(onDisk, ignored)) unread_->push_back(onDisk);
            return skip(error.what());
        }
        add(file, layer, combined(outer, sub, parent, *layer, where));
    }

    // t_root = outer(inner(t)); the inner step also turns the layer's time codes into its parent's.
    UsdLayerOffset combined(UsdLayerOffset outer, const UsdSubLayer& sub, const UsdLayer& parent,
                            const UsdLayer& layer, const SourceLocation& where) {
        UsdLayerOffset inner = sub.offset;
        if (!std::isfinite(inner.offset) || !std::isfinite(inner.scale) || !(inner.scale > 0)) {
            diagnostics_.warn(where, "invalid layer offset ignored");
            inner = {};
        }
        inner.scale *= timeCodesPerSecond(parent) / timeCodesPerSecond(layer);
        return {outer.offset + outer.scale * inner.offset, outer.scale * inner.scale};
    }

    const UsdAssets& assets_;
    UsdLayerLimits limits_;
    Diagnostics& diagnostics_;
    std::vector<fs::path>* unread_;
    std::vector<UsdStackedLayer> stack_;
    std::vector<std::string> open_; // what is open from the root down to the one being added
    std::map<std::string, std::shared_ptr<const UsdLayer>> layers_;
};

double positiveNumber(const UsdLayer& layer, std::string_view key) {
    const UsdValue* value = find(layer.metadata, key);
    const auto numbers = value ? value->numbers() : std::vector<double>{};
    return numbers.size() == 1 && std::isfinite(numbers[0]) && numbers[0] > 0 ? numbers[0] : 0;
}

} // namespace

double timeCodesPerSecond(const UsdLayer& layer) {
    if (const double authored = positiveNumber(layer, "timeCodesPerSecond")) return authored;
    if (const double frames = positiveNumber(layer, "framesPerSecond")) return frames;
    return 24;
}

std::vector<UsdStackedLayer> readUsdLayerStack(const std::filesystem::path& root,
                                               const UsdAssets& assets,
                                               const UsdLayerLimits& limits,
                                               Diagnostics& diagnostics,
                                               std::vector<std::filesystem::path>* unread) {
    return StackReader(assets, limits, diagnostics, unread).read(root.string());
}

} // namespace penumbra
