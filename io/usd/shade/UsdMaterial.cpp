#include "io/usd/shade/UsdMaterial.h"

#include "io/usd/layer/UsdPath.h"
#include "io/usd/shade/UsdConnections.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

namespace {

float finiteOrZero(double v) {
    return std::isfinite(v) ? float(v) : 0.0f;
}

void warnOfNumbers(const UsdAttributes& source, const std::string& attribute,
                   Diagnostics& diagnostics) {
    const std::vector<double> numbers = source.numbers(attribute);
    if (!std::ranges::all_of(numbers, [](double v) { return std::isfinite(v); }))
        diagnostics.warn(source.location(attribute), "a number of a material ignored: not finite");
}

} // namespace

const UsdSurface& UsdMaterials::at(const std::string& path) {
    const auto [entry, isNew] = surfaces_.try_emplace(path);
    if (!isNew) return entry->second;
    const UsdPrim* prim = stage_.find(path);
    if (prim && prim->typeName == "Material")
        entry->second = make(*prim);
    else
        diagnostics_.warn(prim ? prim->location() : SourceLocation{stage_.rootLayer().file, 0, 0},
                          "material binding to <" + path + ">, which is no material");
    return entry->second;
}

const std::shared_ptr<Material>& UsdMaterials::neutral() {
    if (!neutral_) neutral_ = std::make_shared<Material>("neutral");
    return neutral_;
}

UsdSurface UsdMaterials::make(const UsdPrim& prim) {
    UsdSurface surface;
    const UsdPrim* shader = previewSurface(prim);
    if (!shader) return surface;
    const bool specularWorkflow = number(*shader, "inputs:useSpecularWorkflow", 0) != 0;
    const double metallic = std::clamp(number(*shader, "inputs:metallic", 0), 0.0, 1.0);
    const double opacity = std::clamp(number(*shader, "inputs:opacity", 1), 0.0, 1.0);
    const double threshold = number(*shader, "inputs:opacityThreshold", 0);
    constexpr float kMostNits = 1e30f;
    Colour diffuse = colour(*shader, "inputs:diffuseColor", Rgb(0.18f), Rgb(0.5f), 1);
    Colour emissive = colour(*shader, "inputs:emissiveColor", Rgb(), Rgb(), kMostNits);
    const Rgb emission = emissive.factor;
    surface.invisible = opacity == 0 || opacity < threshold;
    if (surface.invisible)
        diagnostics_.warn(prim.location(), "fully transparent surface left out");
    else if (opacity < 1 && threshold == 0)
        diagnostics_.warn(prim.location(), "transparency ignored: the surface blocks light");
    const double cover = (threshold > 0 ? 1 : opacity) * (specularWorkflow ? 1 : 1 - metallic);
    surface.covering = cover == 1;
    surface.reflectance = diffuse.address;
    surface.emission = emissive.address;
    surface.primvar = diffuse.texture ? diffuse.primvar : emissive.primvar;
    if (diffuse.texture && emissive.texture && diffuse.primvar != emissive.primvar)
        diagnostics_.warn(prim.location(), "two sets of texture coordinates: '" + diffuse.primvar +
                                               "' is used for both");
    surface.material = std::make_shared<Material>(
        prim.name, MaterialTextures{std::move(diffuse.texture), std::move(emissive.texture)});
    surface.shader = shader->path;
    surface.material->setReflectance(diffuse.factor * float(cover));
    surface.material->setEmission(
        {std::max(emission.r, 0.0f), std::max(emission.g, 0.0f), std::max(emission.b, 0.0f)});
    return surface;
}

// Follows outputs:surface, through node graphs, to the shader behind it.
const UsdPrim* UsdMaterials::previewSurface(const UsdPrim& material) {
    const UsdPrim* prim = &material;
    std::string output = "outputs:surface";
    for (int i = 0; i < kMostConnections && prim; ++i) {
        if (prim->typeName == "Shader") {
            const std::string id = UsdAttributes(*prim, time_).text("info:id", "");
            if (id == "UsdPreviewSurface") return prim;
            diagnostics_.warn(prim->location(), "shader '" + id + "' not understood");
            return nullptr;
        }
        const auto sources = UsdStage::targets(*prim, output);
        if (sources.empty()) break;
        output = usdPropertyPart(sources.front());
        prim = stage_.find(usdPrimPart(sources.front()));
    }
    diagnostics_.warn(material.location(), "material without a surface that is understood");
    return nullptr;
}

UsdMaterials::Input UsdMaterials::input(const UsdPrim& shader, const std::string& name) {
    const UsdSource source = usdSourceOf(stage_, shader, name);
    switch (source.kind) {
    case UsdSource::Kind::computed:
        return textureFallback(*source.prim, source.attribute, name);
    case UsdSource::Kind::circle:
        diagnostics_.warn(shader.location(), "connections run in a circle");
        return {};
    case UsdSource::Kind::missing:
        diagnostics_.warn(UsdStage::location(*source.prim, source.attribute),
                          "connection to <" + source.target + ">, which is not there");
        break;
    case UsdSource::Kind::value:
        break;
    }
    const UsdAttributes attributes(*source.prim, time_);
    warnOfNumbers(attributes, source.attribute, diagnostics_);
    return {attributes.numbers(source.attribute), false};
}

// Of shaders' outputs only the colours of textures are understood: where these can't be used, their
// authored fallback is, and others are replaced by it.
UsdMaterials::Input UsdMaterials::textureFallback(const UsdPrim& shader, const std::string& output,
                                                  const std::string& name) {
    if (textures_ && name == "inputs:opacity") {
        diagnostics_.warn(shader.location(), "transparency of a texture ignored: drawn opaque");
        return {{1.0}, true};
    }
    const bool isColour = name == "inputs:diffuseColor" || name == "inputs:emissiveColor";
    if (textures_ && isColour && output == "outputs:rgb" &&
        UsdAttributes(shader, time_).text("info:id", "") == "UsdUVTexture") {
        const UsdTexture& read = textures_->at(stage_, shader, time_, diagnostics_);
        if (read.texture) return {{}, true, &read};
    }
    const bool radiometric = name == "inputs:diffuseColor" || name == "inputs:emissiveColor" ||
                             name == "inputs:opacity" || name == "inputs:metallic";
    if (radiometric)
        diagnostics_.warn(shader.location(), "texture or computed colour replaced by a constant");
    auto fallback = UsdAttributes(shader, time_).tuple("inputs:fallback", 4);
    if (fallback.empty()) return {{}, true};
    constexpr std::string_view kChannels = "rgba";
    const std::string channel = output.substr(std::string_view("outputs:").size());
    const std::size_t at = channel.size() == 1 ? kChannels.find(channel) : std::string_view::npos;
    if (at != std::string_view::npos) return {{fallback[at]}, true};
    fallback.resize(3);
    return {std::move(fallback), true};
}

double UsdMaterials::number(const UsdPrim& shader, const std::string& name, double fallback) {
    const Input found = input(shader, name);
    return found.value.size() == 1 && std::isfinite(found.value[0]) ? found.value[0] : fallback;
}

UsdMaterials::Colour UsdMaterials::colour(const UsdPrim& shader, const std::string& name,
                                          Rgb fallback, Rgb ifTexture, float mostFactor) {
    const Input found = input(shader, name);
    if (found.read) return factored(*found.read, mostFactor);
    if (found.value.size() == 3)
        return {{finiteOrZero(found.value[0]), finiteOrZero(found.value[1]),
                 finiteOrZero(found.value[2])}};
    return {found.texture ? ifTexture : fallback};
}

/// A texture's scale is better a factor that can be edited, where it is nothing but one.
UsdMaterials::Colour UsdMaterials::factored(const UsdTexture& read, float most) {
    const Rgb scale = read.texture->scale;
    if (read.texture->bias != Rgb() || minChannel(scale) < 0 || maxChannel(scale) > most)
        return {Rgb(1), read.texture, read.primvar};
    auto texture = std::make_shared<Texture>(*read.texture);
    texture->scale = Rgb(1);
    return {scale, std::move(texture), read.primvar, read.address};
}

std::string UsdMaterials::primvarOf(const Material& material) const {
    if (!material.textures().any()) return {};
    const auto found = std::find_if(surfaces_.begin(), surfaces_.end(), [&](const auto& entry) {
        return entry.second.material.get() == &material;
    });
    return found == surfaces_.end() ? std::string() : found->second.primvar;
}

void checkUsdShader(const UsdStage& stage, const UsdPrim& shader, UsdSampleCheck& check) {
    for (const char* name :
         {"inputs:diffuseColor", "inputs:emissiveColor", "inputs:metallic", "inputs:opacity",
          "inputs:opacityThreshold", "inputs:useSpecularWorkflow"}) {
        const UsdSource source = usdSourceOf(stage, shader, name);
        if (source.kind != UsdSource::Kind::value) continue;
        const std::string_view attribute = source.attribute;
        check.each(*source.prim, {&attribute, 1}, "material",
                   [&](const UsdAttributes& at, Diagnostics& found) {
                       warnOfNumbers(at, source.attribute, found);
                   });
    }
}

UsdBinding usdMaterialBinding(const UsdPrim& prim, Diagnostics& diagnostics) {
    for (const UsdOpinion& opinion : prim.opinions)
        for (const UsdProperty& p : opinion.spec->properties)
            if (p.name.starts_with("material:binding:collection"))
                diagnostics.warn(opinion.layer->location(p.where), "collection binding ignored");
    for (const char* name : {"material:binding:full", "material:binding"}) {
        const auto targets = UsdStage::targets(prim, name);
        if (targets.empty()) continue;
        const UsdValue* strength = UsdStage::metadata(prim, name, "bindMaterialAs");
        const std::string* text = strength ? strength->text() : nullptr;
        return {targets.front(), text && *text == "strongerThanDescendants"};
    }
    return {};
}

} // namespace penumbra
