#include "io/usd/compose/UsdLayerStacks.h"

#include "io/usd/compose/UsdExpression.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <unordered_set>

namespace penumbra {

namespace fs = std::filesystem;

struct UsdLayerStacks::Open {
    UsdLayerStack& stack;
    std::vector<std::string> files; // canonical, from the root down to the one being added
    bool full = false;              // said that there are too many
};

namespace {

// A text that can't be mistaken for the end of another one.
std::string framed(std::string_view text) {
    return std::to_string(text.size()).append(1, ':').append(text);
}

// What tells a value from others. Numbers are told apart bit for bit.
std::string keyOf(const UsdValue& value) {
    std::string key = std::to_string(int(value.type.kind)) + (value.type.array ? "[" : "(");
    if (const auto* strings = value.as<std::string>())
        for (const std::string& s : *strings) key += framed(s);
    else
        for (const double n : value.numbers())
            key += std::to_string(std::bit_cast<std::uint64_t>(n)) + ",";
    return key;
}

// What tells one set of variables from another.
std::string keyOf(const UsdDictionary& variables) {
    std::vector<std::string> entries;
    for (const UsdNamedValue& entry : variables)
        entries.push_back(framed(entry.name) + framed(keyOf(entry.value)));
    std::sort(entries.begin(), entries.end());
    std::string key;
    for (const std::string& entry : entries) key += entry;
    return key;
}

UsdDictionary variablesOf(const UsdLayer& layer, const UsdDictionary& stronger) {
    UsdDictionary variables;
    const UsdValue* own = find(layer.metadata, "expressionVariables");
    if (own && own->dictionary()) variables = *own->dictionary();
    for (const UsdNamedValue& entry : stronger) assign(variables, entry);
    return variables;
}

} // namespace

const std::string& UsdLayerStacks::canonical(const std::string& file) {
    std::string& cached = canonical_[file];
    if (cached.empty()) cached = assets_.canonical(file);
    if (cached.empty()) cached = file;
    return cached;
}

void UsdLayerStacks::read(UsdLoadedLayer& loaded, const std::string& file) {
    loaded.file = file;
    loaded.layer = std::make_shared<UsdLayer>(assets_.layer(file, limits_));
    loaded.file = loaded.layer->file; // of a package: its root layer
    loaded.index = std::make_shared<UsdLayerIndex>(*loaded.layer, paths_);
    errors_.append(loaded.layer->diagnostics);
    read_.push_back(&loaded);
}

const UsdLoadedLayer& UsdLayerStacks::load(const std::string& file) {
    const auto [entry, isNew] = layers_.try_emplace(canonical(file));
    UsdLoadedLayer& loaded = entry->second;
    if (!isNew) return loaded;
    try {
        read(loaded, file);
    } catch (const SceneFileError& error) {
        loaded.problem = error.what();
        std::error_code failed;
        const fs::path onDisk = assets_.fileOf(file);
        if (fs::is_regular_file(onDisk, failed)) unread_.push_back(onDisk);
    }
    return loaded;
}

const UsdLayerStack& UsdLayerStacks::open(const std::string& root) {
    UsdLoadedLayer& loaded = layers_[canonical(root)];
    read(loaded, root);
    return stackOf(root, loaded, variablesOf(*loaded.layer, {}));
}

const UsdLayerStack* UsdLayerStacks::find(const std::string& file, const UsdDictionary& variables,
                                          std::string& problem) {
    const UsdLoadedLayer& root = load(file);
    problem = root.problem;
    if (!root.layer) return nullptr;
    const UsdDictionary all = variablesOf(*root.layer, variables);
    const bool known = stacks_.contains(canonical(file) + "\n" + keyOf(all));
    if (!known && (stacks_.size() >= kMaxStacks || stacked_ >= kMaxStacked)) {
        problem = "the scene has too many layer stacks";
        return nullptr;
    }
    return &stackOf(file, root, all);
}

const UsdLayerStack& UsdLayerStacks::stackOf(const std::string& file, const UsdLoadedLayer& root,
                                             const UsdDictionary& variables) {
    auto& stack = stacks_[canonical(file) + "\n" + keyOf(variables)];
    if (stack) return *stack;
    stack = std::make_unique<UsdLayerStack>();
    stack->assets = &assets_;
    stack->variables = variables;
    stack->timeCodesPerSecond = timeCodesPerSecond(*root.layer);
    Open open{*stack, {}};
    add(open, file, root, {});
    readRelocates(*stack);
    stacked_ += stack->layers.size();
    return *stack;
}

void UsdLayerStacks::add(Open& open, const std::string& file, const UsdLoadedLayer& layer,
                         UsdLayerOffset offset) {
    open.stack.layers.push_back({layer.layer, layer.index, layer.file, offset});
    open.files.push_back(canonical(file));
    for (const UsdSubLayer& sub : layer.layer->subLayers)
        addSubLayer(open, *layer.layer, layer.file, sub, offset);
    open.files.pop_back();
}

void UsdLayerStacks::addSubLayer(Open& open, const UsdLayer& parent, const std::string& parentFile,
                                 const UsdSubLayer& sub, UsdLayerOffset outer) {
    const auto skip = [&](const std::string& why) {
        errors_.report(parent.location(sub.where), "sublayer '" + sub.asset + "' left out: " + why);
    };
    if (open.stack.layers.size() >= kMaxLayers) {
        if (!open.full) skip("there are too many layers");
        open.full = true;
        return;
    }
    const UsdEvaluated asset = evaluateUsdText(sub.asset, open.stack.variables);
    if (!asset.error.empty()) return skip(asset.error);
    if (asset.text.empty()) return isUsdExpression(sub.asset) ? void() : skip("its path is empty");
    if (asset.text.find("://") != std::string::npos) return skip("only files can be read");
    const std::string file = assets_.resolve(parentFile, asset.text);
    if (std::find(open.files.begin(), open.files.end(), canonical(file)) != open.files.end())
        return skip("it contains itself");
    if (open.files.size() >= kMaxDepth) return skip("sublayers are nested too deeply");
    const UsdLoadedLayer& layer = load(file);
    if (!layer.layer) return skip(layer.problem);
    add(open, file, layer, combined(outer, sub, parent, *layer.layer));
}

// t_root = outer(inner(t)); the inner step also turns the layer's time codes into its parent's.
UsdLayerOffset UsdLayerStacks::combined(UsdLayerOffset outer, const UsdSubLayer& sub,
                                        const UsdLayer& parent, const UsdLayer& layer) {
    UsdLayerOffset inner = sub.offset;
    if (!isValid(inner)) {
        errors_.report(parent.location(sub.where), "invalid layer offset ignored");
        inner = {};
    }
    inner.scale *= timeCodesPerSecond(parent) / timeCodesPerSecond(layer);
    return after(outer, inner);
}

// Of all layers; the strongest counts for each source.
void UsdLayerStacks::readRelocates(UsdLayerStack& stack) {
    std::vector<UsdRelocates::Pair> authored;
    std::vector<SourceLocation> where;
    std::vector<const UsdRelocate*> written;
    std::unordered_set<UsdSitePath> sources;
    for (const UsdStackedLayer& stacked : stack.layers)
        for (const UsdRelocate& one : stacked.layer->relocates) {
            UsdSitePath source = paths_.path(one.source);
            if (source && !sources.insert(source).second) continue;
            const UsdSitePath target = paths_.path(one.target);
            if (!one.target.empty() && !target) source = {}; // refused: it is no removal
            authored.push_back({source, target});
            where.push_back(stacked.layer->location(one.where));
            written.push_back(&one);
        }
    if (authored.empty()) return;
    stack.relocates = UsdRelocates(authored, [&](std::size_t i, const std::string& why) {
        errors_.report(where[i], "relocate of <" + written[i]->source + "> to <" +
                                     written[i]->target + "> left out: " + why);
    });
    if (stack.relocates.tracesEnd())
        errors_.report({stack.rootLayer().file, 0, 0},
                       "relocates below each other are too many or too deep: some are not traced "
                       "back to where their sources came from");
}

std::vector<fs::path> UsdLayerStacks::files() const {
    std::vector<fs::path> files;
    for (const UsdLoadedLayer* loaded : read_) files.emplace_back(assets_.fileOf(loaded->file));
    files.insert(files.end(), unread_.begin(), unread_.end());
    return files;
}

} // namespace penumbra
