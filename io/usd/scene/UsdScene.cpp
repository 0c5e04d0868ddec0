#include "io/usd/scene/UsdScene.h"

#include "io/usd/scene/SceneFiles.h"
#include "io/usd/scene/UsdContents.h"
#include "io/usd/scene/UsdSceneBuilder.h"
#include "io/usd/scene/UsdTracks.h"
#include "io/usd/shade/UsdMaterial.h"
#include "io/usd/stage/UsdStage.h"
#include "scenegraph/Objects.h"
#include "scenegraph/Transform.h"

#include <cmath>
#include <set>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

namespace penumbra {

namespace {

std::optional<double> layerNumber(const UsdLayer& layer, std::string_view key) {
    const UsdValue* value = find(layer.metadata, key);
    const auto numbers = value ? value->numbers() : std::vector<double>{};
    if (numbers.size() != 1 || !std::isfinite(numbers[0])) return std::nullopt;
    return numbers[0];
}

// Units, axes and frames of the whole scene.
void readStageMetadata(const UsdLayer& layer, Scene& scene, Diagnostics& warnings) {
    const SourceLocation where{layer.file, 0, 0};
    scene.metersPerUnit = layerNumber(layer, "metersPerUnit").value_or(0.01);
    if (!(scene.metersPerUnit > 0)) {
        warnings.warn(where, "metersPerUnit is not positive: 0.01 is used");
        scene.metersPerUnit = 0.01;
    }
    const UsdValue* axis = find(layer.metadata, "upAxis");
    const std::string up = axis && axis->text() ? *axis->text() : "Y";
    if (up == "Z") scene.upAxis = UpAxis::z;
    if (up != "Y" && up != "Z") warnings.warn(where, "upAxis is neither Y nor Z: Y is used");
    scene.startTimeCode = layerNumber(layer, "startTimeCode").value_or(0);
    scene.endTimeCode = layerNumber(layer, "endTimeCode").value_or(scene.startTimeCode);
    scene.timeCodesPerSecond = timeCodesPerSecond(layer);
}

/// Layers that say another unit or another axis than the root layer: USD rescales and turns
/// nothing.
void warnOfOtherFrames(const UsdStage& stage, const Scene& scene, Diagnostics& warnings) {
    const auto isOther = [&](const UsdLayer& layer) {
        const double unit = layerNumber(layer, "metersPerUnit").value_or(scene.metersPerUnit);
        const UsdValue* axis = find(layer.metadata, "upAxis");
        const std::string up = scene.upAxis == UpAxis::z ? "Z" : "Y";
        return std::abs(unit - scene.metersPerUnit) > 1e-6 * scene.metersPerUnit ||
               (axis && axis->text() && *axis->text() != up);
    };
    std::set<const UsdLayer*> seen;
    std::vector<const UsdLayer*> others;
    for (const UsdPrim& prim : stage.prims())
        for (const UsdOpinion& opinion : prim.opinions)
            if (seen.insert(opinion.layer).second && isOther(*opinion.layer))
                others.push_back(opinion.layer);
    if (others.empty()) return;
    std::string more;
    if (others.size() > 1) more = " (and " + std::to_string(others.size() - 1) + " more)";
    warnings.warn({others.front()->file, 0, 0},
                  "has another metersPerUnit or upAxis than the scene, and is taken as it is" +
                      more);
}

/// A positive number, if the prim says one.
std::optional<double> positive(const UsdPrim& prim, std::string_view name, const char* what,
                               Diagnostics& warnings, double unit = 1) {
    const UsdAttributes attributes(prim, std::nullopt);
    const double number = attributes.number(name, 0);
    if (number > 0 && std::isfinite(number)) return unit * number;
    if (UsdStage::property(prim, name))
        warnings.warn(attributes.location(name), std::string(what) + " ignored: not positive");
    return std::nullopt;
}

/// What one of some words means, if the prim says one of them.
template <class Value>
std::optional<Value> word(const UsdPrim& prim, std::string_view name,
                          std::initializer_list<std::pair<std::string_view, Value>> words,
                          Diagnostics& warnings) {
    const UsdAttributes attributes(prim, std::nullopt);
    const std::string text = attributes.text(name, "");
    std::string known;
    for (const auto& [one, value] : words) {
        if (one == text) return value;
        known += (known.empty() ? "" : ", ") + std::string(one);
    }
    if (UsdStage::property(prim, name))
        warnings.warn(attributes.location(name), "'" + text + "' is none of " + known);
    return std::nullopt;
}

// What the default prim asks of the light; unlike metadata of a layer this reaches the layers above
// it. \param unit [m]
LightRequest askedByDefaultPrim(const UsdStage& stage, double unit, Diagnostics& warnings) {
    const UsdValue* name = find(stage.rootLayer().metadata, "defaultPrim");
    const UsdPrim* prim = name && name->text() ? stage.find("/" + *name->text()) : nullptr;
    if (!prim) return {};
    LightRequest asked;
    asked.patchSize = positive(*prim, "penumbra:patchSize", "patch size", warnings, unit);
    asked.elementSize = positive(*prim, "penumbra:elementSize", "element size", warnings, unit);
    asked.residual = positive(*prim, "penumbra:residual", "residual", warnings);
    asked.trigger = word<Trigger>(*prim, "penumbra:trigger",
                                  {{"implicit", Trigger::implicit},
                                   {"onDemand", Trigger::onDemand},
                                   {"continuous", Trigger::continuous}},
                                  warnings);
    asked.policy = word<PolicyKind>(
        *prim, "penumbra:order",
        {{"importance", PolicyKind::importance}, {"plain", PolicyKind::plain}}, warnings);
    return asked;
}

} // namespace

namespace {

/// The UsdUVTextures of materials that something is bound to.
std::vector<const UsdPrim*> texturesInUse(const UsdStage& stage) {
    Diagnostics ignored;
    std::unordered_set<std::string> bound;
    for (const UsdPrim& prim : stage.prims())
        if (const std::string path = usdMaterialBinding(prim, ignored).path; !path.empty())
            bound.insert(path);
    std::vector<const UsdPrim*> found;
    for (const UsdPrim& prim : stage.prims()) {
        if (prim.typeName != "Shader" || prim.abstract) continue;
        if (UsdAttributes(prim, {}).text("info:id", "") != "UsdUVTexture") continue;
        const UsdPrim* above = &prim;
        while (above->parent != 0 && !bound.contains(above->path))
            above = &stage.prims()[above->parent];
        if (bound.contains(above->path)) found.push_back(&prim);
    }
    return found;
}

} // namespace

LoadedScene loadUsdScene(const std::filesystem::path& file, const LoadOptions& options) {
    UsdComposeLimits limits;
    limits.layer.fileBytes = options.maxFileBytes;
    const SceneFiles files(file, options.allowOutside, options.maxFileBytes);
    const auto stage = std::make_shared<UsdStage>(UsdStage::open(file, limits, files));
    LoadedScene loaded;
    loaded.options = options;
    loaded.scene = std::make_shared<Scene>();
    Scene& scene = *loaded.scene;
    scene.name = file.stem().string();
    readStageMetadata(stage->rootLayer(), scene, stage->diagnostics());
    warnOfOtherFrames(*stage, scene, stage->diagnostics());
    loaded.asked = askedByDefaultPrim(*stage, scene.metersPerUnit, stage->diagnostics());
    if (scene.metersPerUnit != 1) {
        auto toMetres = std::make_shared<Transform>("");
        glm::dmat4 scale(scene.metersPerUnit);
        scale[3][3] = 1;
        toMetres->setMatrix(scale);
        scene.root = toMetres;
    }
    const UsdTime time =
        options.time ? options.time : layerNumber(stage->rootLayer(), "startTimeCode");
    const auto textures = std::make_shared<UsdTextures>(files);
    textures->readAhead(time, texturesInUse(*stage));
    const auto tracks = std::make_shared<UsdTracks>(stage, textures);
    if (const UsdValue* name = find(stage->rootLayer().metadata, "defaultPrim"))
        if (name->text()) loaded.addresses.defaultPrim = *name->text();
    buildUsdScene(*stage, {time, options.maxInstanced, scene.metersPerUnit}, *textures, *tracks,
                  loaded.addresses, scene.root);
    textures->close();
    loaded.files = files.withParts(stage->files());
    if (!tracks->empty()) loaded.animation = tracks;
    const PlacedScene placed = placeScene(scene);
    if (placed.meshes.empty() && placed.lights.empty())
        stage->diagnostics().warn({stage->rootLayer().file, 0, 0},
                                  "nothing in it has a shape that can be shown, or gives light: " +
                                      contentsOf(*stage));
    // Last: thousands of bad samples leave no room for other warnings.
    tracks->warnOfSamples(time, stage->diagnostics());
    loaded.diagnostics = stage->diagnostics().take();
    return loaded;
}

} // namespace penumbra
