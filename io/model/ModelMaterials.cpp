#include "io/model/ModelMaterials.h"

#include "io/model/ModelMesh.h"
#include "io/usd/layer/UsdPrimSpecs.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>

namespace penumbra {

struct ModelMaterials::Texture {
    std::string file; ///< as the layer names it
    unsigned channel = 0;
    std::string wrapS = "repeat", wrapT = "repeat";
    std::optional<UsdTextureTransform> transform;
};

struct ModelMaterials::Surface {
    std::string name;
    glm::dvec3 diffuse{0.5}, emission{0};
    double metallic = 0, roughness = 0.5, opacity = 1, cutoff = 0;
    bool alphaOfTexture = false, scaled = false;
    std::optional<Texture> diffuseTexture, emissionTexture;
};

namespace {

// The last three arguments are one of Assimp's AI_MATKEY_...
std::string textOf(const aiMaterial& material, const char* key, unsigned type, unsigned index) {
    aiString text;
    return material.Get(key, type, index, text) == aiReturn_SUCCESS ? std::string(text.C_Str())
                                                                    : "";
}

double numberOf(const aiMaterial& material, double fallback, const char* key, unsigned type,
                unsigned index) {
    ai_real number = 0;
    const bool found = material.Get(key, type, index, number) == aiReturn_SUCCESS;
    return found && std::isfinite(number) ? double(number) : fallback;
}

std::optional<glm::dvec3> colourOf(const aiMaterial& material, const char* key, unsigned type,
                                   unsigned index) {
    aiColor4D c;
    if (material.Get(key, type, index, c) != aiReturn_SUCCESS) return std::nullopt;
    if (!std::isfinite(c.r) || !std::isfinite(c.g) || !std::isfinite(c.b)) return std::nullopt;
    return glm::max(glm::dvec3(double(c.r), double(c.g), double(c.b)), glm::dvec3(0));
}

std::string wrapOf(aiTextureMapMode mode) {
    switch (mode) {
    case aiTextureMapMode_Clamp:
        return "clamp";
    case aiTextureMapMode_Mirror:
        return "mirror";
    case aiTextureMapMode_Decal:
        return "black";
    default:
        return "repeat";
    }
}

} // namespace

ModelMaterials::ModelMaterials(const ModelFile& file, std::string scope, ImportedImages& images,
                               Diagnostics& diagnostics)
    : file_(file), scope_(std::move(scope)), images_(images), diagnostics_(diagnostics),
      paths_(file.scene().mNumMaterials) {}

// Assimp gives each mesh a material, also where the file has none: white, or grey, and nameless or
// "DefaultMaterial".
bool ModelMaterials::says(const aiMaterial& material, const aiMesh& mesh) const {
    const std::string name = textOf(material, AI_MATKEY_NAME);
    const bool textured = material.GetTextureCount(aiTextureType_DIFFUSE) > 0 ||
                          material.GetTextureCount(aiTextureType_BASE_COLOR) > 0;
    const auto emission = colourOf(material, AI_MATKEY_COLOR_EMISSIVE).value_or(glm::dvec3(0));
    if (textured || emission != glm::dvec3(0)) return true;
    const bool gltf = file_.format() == ModelFormat::gltf;
    const bool last = mesh.mMaterialIndex + 1 == file_.scene().mNumMaterials;
    if (gltf && name.empty() && last) return false; // Assimp's own, behind those of the file
    if (!gltf && (name.empty() || name == AI_DEFAULT_MATERIAL_NAME)) return false;
    const auto base = colourOf(material, AI_MATKEY_BASE_COLOR);
    const auto colour = base ? base : colourOf(material, AI_MATKEY_COLOR_DIFFUSE);
    return !(mesh.mColors[0] && colour == glm::dvec3(1)); // white times the colours of the mesh
}

std::string ModelMaterials::pathFor(const aiMesh& mesh) {
    const aiMaterial& material = *file_.scene().mMaterials[mesh.mMaterialIndex];
    if (!says(material, mesh)) return {};
    std::optional<std::string>& path = paths_[mesh.mMaterialIndex];
    if (!path) {
        const Surface surface = surfaceOf(material);
        const std::string name = names_.take(surface.name, "Material");
        path = scope_ + "/" + name;
        prims_.push_back(prim(surface, name));
    }
    return *path;
}

bool ModelMaterials::doubleSided(const aiMesh& mesh) const {
    int both = 0;
    const aiMaterial& material = *file_.scene().mMaterials[mesh.mMaterialIndex];
    const bool said = material.Get(AI_MATKEY_TWOSIDED, both) == aiReturn_SUCCESS;
    return said && both != 0 && file_.format() != ModelFormat::ply; // Assimp says so of all PLY
}

ModelMaterials::Surface ModelMaterials::surfaceOf(const aiMaterial& material) {
    Surface made;
    made.name = textOf(material, AI_MATKEY_NAME);
    const auto base = colourOf(material, AI_MATKEY_BASE_COLOR);
    made.diffuse =
        base ? *base : colourOf(material, AI_MATKEY_COLOR_DIFFUSE).value_or(glm::dvec3(0.5));
    const GltfMaterial json = jsonOf(material);
    made.emission = emissionOf(material, json);
    made.roughness = std::clamp(numberOf(material, 0.5, AI_MATKEY_ROUGHNESS_FACTOR), 0.0, 1.0);
    made.opacity = std::clamp(numberOf(material, 1, AI_MATKEY_OPACITY), 0.0, 1.0);
    made.diffuseTexture =
        textureOf(material, {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}, json.baseUse);
    made.emissionTexture = textureOf(
        material, {aiTextureType_EMISSION_COLOR, aiTextureType_EMISSIVE}, json.emissiveUse);
    const std::string alpha = textOf(material, AI_MATKEY_GLTF_ALPHAMODE);
    if (file_.format() == ModelFormat::gltf) {
        if (alpha != "BLEND" && alpha != "MASK") made.opacity = 1;
        if (alpha == "MASK") made.cutoff = numberOf(material, 0.5, AI_MATKEY_GLTF_ALPHACUTOFF);
        made.alphaOfTexture = alpha == "MASK" || alpha == "BLEND";
    } else if (made.opacity == 0) { // more often a slip of an exporter than meant
        made.opacity = 1;
        diagnostics_.warn({file_.path().string()}, "material '" + cleanText(made.name) +
                                                       "' is fully transparent: taken as opaque");
    }
    // Elsewhere a texture replaces the colour.
    made.scaled = file_.format() == ModelFormat::gltf || file_.format() == ModelFormat::obj;
    if (made.diffuseTexture && !made.scaled) made.diffuse = glm::dvec3(1);
    made.metallic = metallicOf(material, made.name);
    nameOtherPictures(material, made.name);
    return made;
}

void ModelMaterials::nameOtherPictures(const aiMaterial& material, const std::string& name) {
    for (const aiTextureType type :
         {aiTextureType_NORMALS, aiTextureType_HEIGHT, aiTextureType_NORMAL_CAMERA,
          aiTextureType_OPACITY, aiTextureType_SPECULAR, aiTextureType_SHININESS,
          aiTextureType_DIFFUSE_ROUGHNESS, aiTextureType_AMBIENT_OCCLUSION, aiTextureType_LIGHTMAP,
          aiTextureType_DISPLACEMENT, aiTextureType_TRANSMISSION})
        if (material.GetTextureCount(type) > 0) {
            diagnostics_.warn({file_.path().string()},
                              "material '" + cleanText(name) +
                                  "': pictures of anything but colour and emission left out");
            return;
        }
}

double ModelMaterials::metallicOf(const aiMaterial& material, const std::string& name) {
    const double metallic = std::clamp(numberOf(material, 0, AI_MATKEY_METALLIC_FACTOR), 0.0, 1.0);
    const auto warn = [&](const char* text) {
        diagnostics_.warn({file_.path().string()}, "material '" + cleanText(name) + "' " + text);
    };
    const bool pictured = material.GetTextureCount(aiTextureType_METALNESS) > 0 ||
                          material.GetTextureCount(aiTextureType_UNKNOWN) > 0; // so glTF's
    if (pictured && metallic > 0) {
        warn("is metal where a picture says so: taken as none");
        return 0;
    }
    if (metallic == 1) warn("is metal: it mirrors, and scatters no light");
    return metallic;
}

glm::dvec3 ModelMaterials::emissionOf(const aiMaterial& material, const GltfMaterial& json) {
    const glm::dvec3 emissive =
        colourOf(material, AI_MATKEY_COLOR_EMISSIVE).value_or(glm::dvec3(0));
    if (emissive == glm::dvec3(0)) return emissive;
    if (file_.format() == ModelFormat::gltf) {
        const bool usable = json.strength >= 0 && std::isfinite(json.strength);
        return emissive * (usable ? json.strength : 1);
    }
    if (!emissionNamed_)
        diagnostics_.warn({file_.path().string()}, std::string("emission has no unit in ") +
                                                       nameOf(file_.format()) +
                                                       ": 1 is taken as 1 cd/m2");
    emissionNamed_ = true;
    return emissive;
}

namespace {

// Assimp hands on scale and rotation as they are in the file, but for the sign.
bool agree(const aiMaterial& material, aiTextureType type, const GltfTextureTransform& transform) {
    aiUVTransform handedOn;
    if (material.Get(AI_MATKEY_UVTRANSFORM(type, 0), handedOn) != aiReturn_SUCCESS) return true;
    const glm::dvec2 scale(double(handedOn.mScaling.x), double(handedOn.mScaling.y));
    const glm::dvec2 off = glm::abs(scale - transform.scale);
    return std::max(off.x, off.y) <= 1e-5 * (1 + glm::length(scale)) &&
           std::abs(double(handedOn.mRotation) + transform.rotation) <= 1e-5;
}

} // namespace

/// What the file says of a material of glTF; of other formats nothing. Assimp's order of materials
/// is not the file's: its own is found by what Assimp hands on of it.
GltfMaterial ModelMaterials::jsonOf(const aiMaterial& material) {
    const std::string name = textOf(material, AI_MATKEY_NAME);
    const auto emissive = colourOf(material, AI_MATKEY_COLOR_EMISSIVE).value_or(glm::dvec3(0));
    const GltfMaterial* found = nullptr;
    bool differ = false;
    for (const GltfMaterial& json : file_.gltf().materials) {
        const glm::dvec3 off = glm::abs(json.emissive - emissive);
        if (json.name != name || std::max({off.r, off.g, off.b}) > 1e-5 ||
            !agree(material, aiTextureType_BASE_COLOR, json.baseUse.transform) ||
            !agree(material, aiTextureType_EMISSIVE, json.emissiveUse.transform))
            continue;
        differ |= found && (found->strength != json.strength || found->baseUse != json.baseUse ||
                            found->emissiveUse != json.emissiveUse);
        if (!found) found = &json;
    }
    if (differ)
        diagnostics_.warn({file_.path().string()},
                          "materials '" + cleanText(name) +
                              "' differ in emissive strength or texture offset alone: one is "
                              "taken for all (give them names)");
    return found ? *found : GltfMaterial();
}

std::optional<ModelMaterials::Texture> ModelMaterials::textureOf(const aiMaterial& material,
                                                                 std::initializer_list<int> types,
                                                                 const GltfTextureUse& use) {
    for (const int type : types) {
        const auto semantic = aiTextureType(type);
        aiString path;
        unsigned channel = 0;
        aiTextureMapMode modes[3] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap,
                                     aiTextureMapMode_Wrap};
        if (material.GetTextureCount(semantic) == 0 ||
            material.GetTexture(semantic, 0, &path, nullptr, &channel, nullptr, nullptr, modes) !=
                aiReturn_SUCCESS)
            continue;
        const auto file = images_.find(path.C_Str());
        if (!file) return std::nullopt;
        if (use.texCoord) channel = unsigned(std::min<std::size_t>(*use.texCoord, 255));
        if (channel >= AI_MAX_NUMBER_OF_TEXTURECOORDS) channel = 0;
        Texture texture{*file, channel, wrapOf(modes[0]), wrapOf(modes[1]), std::nullopt};
        if (use.transform == GltfTextureTransform()) return texture;
        texture.transform = usdTransformOf(use.transform);
        if (!texture.transform)
            diagnostics_.warn({file_.path().string()},
                              "material '" + cleanText(textOf(material, AI_MATKEY_NAME)) +
                                  "': a texture's transform left out, its numbers are too large");
        return texture;
    }
    return std::nullopt;
}

namespace {

std::vector<float> two(glm::dvec2 v) {
    return {float(v.x), float(v.y)};
}
std::vector<float> four(glm::dvec4 c) {
    return {float(c.r), float(c.g), float(c.b), float(c.a)};
}

UsdPrimSpec transformPrim(const UsdTextureTransform& transform, const std::string& name,
                          const std::string& in) {
    UsdPrimSpec prim = makePrim("Shader", name);
    addText(prim, "token", "info:id", "UsdTransform2d").uniform = true;
    addConnection(prim, "float2", "inputs:in", in);
    addAttribute(prim, "float2", "inputs:scale", two(transform.scale));
    addFloat(prim, "inputs:rotation", transform.rotation);
    addAttribute(prim, "float2", "inputs:translation", two(transform.translation));
    declareAttribute(prim, "float2", "outputs:result");
    return prim;
}

} // namespace

/// A texture, what reads its coordinates, and what transforms them, as prims of a material.
/// \param scale, fallback red, green, blue, alpha
void ModelMaterials::addTexture(UsdPrimSpec& material, const std::string& path,
                                const std::string& name, const Texture& used, glm::dvec4 scale,
                                glm::dvec4 fallback) {
    UsdPrimSpec reader = makePrim("Shader", name + "Coordinates");
    addText(reader, "token", "info:id", "UsdPrimvarReader_float2").uniform = true;
    addText(reader, "string", "inputs:varname", textureCoordinates(used.channel));
    declareAttribute(reader, "float2", "outputs:result");
    const std::string result = ".outputs:result";
    const std::string read = path + "/" + reader.name + result;
    const std::string transform = name + "Transform";
    UsdPrimSpec texture = makePrim("Shader", name + "Texture");
    addText(texture, "token", "info:id", "UsdUVTexture").uniform = true;
    addText(texture, "asset", "inputs:file", used.file);
    addConnection(texture, "float2", "inputs:st",
                  used.transform ? path + "/" + transform + result : read);
    addText(texture, "token", "inputs:sourceColorSpace", "sRGB");
    addText(texture, "token", "inputs:wrapS", used.wrapS);
    addText(texture, "token", "inputs:wrapT", used.wrapT);
    addAttribute(texture, "float4", "inputs:scale", four(scale));
    addAttribute(texture, "float4", "inputs:fallback", four(fallback));
    declareAttribute(texture, "float3", "outputs:rgb");
    declareAttribute(texture, "float", "outputs:a");
    material.children.push_back(std::move(texture));
    if (used.transform)
        material.children.push_back(transformPrim(*used.transform, transform, read));
    material.children.push_back(std::move(reader));
}

UsdPrimSpec ModelMaterials::prim(const Surface& surface, const std::string& name) {
    UsdPrimSpec material = makePrim("Material", name);
    const std::string path = scope_ + "/" + name;
    addConnection(material, "token", "outputs:surface", path + "/Surface.outputs:surface");
    UsdPrimSpec shader = makePrim("Shader", "Surface");
    addText(shader, "token", "info:id", "UsdPreviewSurface").uniform = true;
    if (surface.diffuseTexture)
        addConnection(shader, "color3f", "inputs:diffuseColor",
                      path + "/DiffuseTexture.outputs:rgb");
    else
        addColour(shader, "inputs:diffuseColor", surface.diffuse);
    if (surface.emissionTexture)
        addConnection(shader, "color3f", "inputs:emissiveColor",
                      path + "/EmissionTexture.outputs:rgb");
    else if (surface.emission != glm::dvec3(0))
        addColour(shader, "inputs:emissiveColor", surface.emission);
    addFloat(shader, "inputs:metallic", surface.metallic);
    addFloat(shader, "inputs:roughness", surface.roughness);
    const double alpha = surface.alphaOfTexture ? surface.opacity : 1; // times the picture's
    if (surface.diffuseTexture && surface.alphaOfTexture)
        addConnection(shader, "float", "inputs:opacity", path + "/DiffuseTexture.outputs:a");
    else if (surface.opacity != 1)
        addFloat(shader, "inputs:opacity", surface.opacity);
    if (surface.cutoff > 0) addFloat(shader, "inputs:opacityThreshold", surface.cutoff);
    declareAttribute(shader, "token", "outputs:surface");
    material.children.push_back(std::move(shader));
    if (const auto& texture = surface.diffuseTexture)
        addTexture(material, path, "Diffuse", *texture, {surface.diffuse, alpha},
                   {0.5 * surface.diffuse, alpha});
    if (const auto& texture = surface.emissionTexture)
        addTexture(material, path, "Emission", *texture, {surface.emission, 1}, {0, 0, 0, 1});
    keepDisplayName(material, surface.name);
    return material;
}

} // namespace penumbra
