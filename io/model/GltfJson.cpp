#include "io/model/GltfJson.h"

#include "base/Error.h"
#include "io/model/ModelCheck.h"
#include "io/model/PrimNames.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstring>
#include <numbers>

namespace penumbra {

namespace {

using Json = nlohmann::json;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
    throw SceneFileError({file.string()}, why);
}

std::uint32_t wordAt(std::string_view bytes, std::size_t offset) {
    std::uint32_t word = 0; // little-endian, as this machine is
    std::memcpy(&word, bytes.data() + offset, sizeof word);
    return word;
}

// The JSON itself: of a GLB it is the first chunk (glTF 2.0, section 4.4).
std::string_view jsonOf(const std::filesystem::path& file, std::string_view bytes) {
    if (!bytes.starts_with("glTF")) return bytes;
    constexpr std::size_t kHeader = 20;
    constexpr std::uint32_t kJson = 0x4e4f534a;
    if (bytes.size() < kHeader) refuse(file, "the GLB ends in its header (copy it again)");
    if (wordAt(bytes, 4) != 2) return {};
    const std::size_t length = wordAt(bytes, 12);
    if (wordAt(bytes, 16) != kJson || length > bytes.size() - kHeader)
        refuse(file, "the GLB does not begin with a whole chunk of JSON (copy it again)");
    return bytes.substr(kHeader, length);
}

/// Values of an object, or what is assumed where they are missing or of another type: that is
/// Assimp's to refuse.
const Json& member(const Json& object, const char* name) {
    static const Json kNone;
    const auto found = object.is_object() ? object.find(name) : object.end();
    return found == object.end() ? kNone : *found;
}
double number(const Json& object, const char* name, double fallback) {
    const Json& value = member(object, name);
    return value.is_number() ? value.get<double>() : fallback;
}
std::string text(const Json& object, const char* name) {
    const Json& value = member(object, name);
    return value.is_string() ? value.get<std::string>() : std::string();
}
std::optional<std::size_t> index(const Json& object, const char* name) {
    const Json& value = member(object, name);
    if (!value.is_number_integer() || value.get<std::int64_t>() < 0) return std::nullopt;
    return value.get<std::size_t>();
}
std::vector<std::size_t> indices(const Json& object, const char* name) {
    std::vector<std::size_t> list;
    for (const Json& value : member(object, name))
        if (value.is_number_unsigned()) list.push_back(value.get<std::size_t>());
    return list;
}
glm::dvec3 colour(const Json& object, const char* name, double fallback) {
    const Json& value = member(object, name);
    glm::dvec3 rgb(fallback);
    for (std::size_t i = 0; value.is_array() && i < 3 && i < value.size(); ++i)
        if (value[i].is_number()) rgb[glm::length_t(i)] = value[i].get<double>();
    return rgb;
}

ModelLight lightOf(const Json& json) {
    ModelLight light;
    light.name = text(json, "name");
    const std::string type = text(json, "type");
    light.kind = type == "point"         ? ModelLight::Kind::point
                 : type == "spot"        ? ModelLight::Kind::spot
                 : type == "directional" ? ModelLight::Kind::directional
                                         : ModelLight::Kind::unknown;
    light.intensity = colour(json, "color", 1) * number(json, "intensity", 1);
    light.outerCone = number(member(json, "spot"), "outerConeAngle", std::numbers::pi / 4);
    return light;
}

ModelCamera cameraOf(const Json& json) {
    ModelCamera camera;
    camera.name = text(json, "name");
    const bool flat = text(json, "type") == "orthographic";
    const Json& lens = member(json, flat ? "orthographic" : "perspective");
    camera.nearPlane = number(lens, "znear", 0);
    camera.farPlane = number(lens, "zfar", 0);
    if (flat) {
        camera.orthographicWidth = 2 * number(lens, "xmag", 0);
        camera.aspect =
            number(lens, "ymag", 0) > 0 ? number(lens, "xmag", 0) / number(lens, "ymag", 0) : 0;
    } else {
        const double fov = number(lens, "yfov", 0);
        camera.verticalFov = fov > 0 && fov < std::numbers::pi ? fov : 0;
        camera.aspect = number(lens, "aspectRatio", 0);
    }
    return camera;
}

glm::dvec2 pair(const Json& object, const char* name, double fallback) {
    const Json& value = member(object, name);
    if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number())
        return glm::dvec2(fallback);
    return {value[0].get<double>(), value[1].get<double>()};
}

/// \param info the texture as a material names it
GltfTextureUse textureUseOf(const Json& info) {
    const Json& extension = member(member(info, "extensions"), "KHR_texture_transform");
    return {{pair(extension, "offset", 0), pair(extension, "scale", 1),
             number(extension, "rotation", 0)},
            index(extension, "texCoord")};
}

GltfMaterial materialOf(const Json& json) {
    GltfMaterial material;
    material.name = text(json, "name");
    material.emissive = colour(json, "emissiveFactor", 0);
    const Json& extension = member(member(json, "extensions"), "KHR_materials_emissive_strength");
    material.strength = number(extension, "emissiveStrength", 1);
    const Json& glossy = member(member(json, "extensions"), "KHR_materials_pbrSpecularGlossiness");
    const Json& base = member(member(json, "pbrMetallicRoughness"), "baseColorTexture");
    material.baseUse = textureUseOf(base.is_null() ? member(glossy, "diffuseTexture") : base);
    material.emissiveUse = textureUseOf(member(json, "emissiveTexture"));
    return material;
}

GltfNode nodeOf(const Json& json) {
    GltfNode node;
    node.name = text(json, "name");
    node.children = indices(json, "children");
    node.camera = index(json, "camera");
    node.light = index(member(member(json, "extensions"), "KHR_lights_punctual"), "light");
    return node;
}

template <class Item, class Make>
std::vector<Item> listOf(const Json& array, Make make) {
    std::vector<Item> items;
    if (array.is_array())
        for (const Json& json : array) items.push_back(make(json));
    return items;
}

// Depth first, without recursion; a node that is met twice is in a circle or has two parents.
void checkNodes(const std::filesystem::path& file, const Gltf& gltf) {
    std::vector<bool> seen(gltf.nodes.size(), false);
    std::vector<std::pair<std::size_t, std::size_t>> open; // node, depth
    for (const std::size_t root : gltf.roots) open.emplace_back(root, 1);
    while (!open.empty()) {
        const auto [i, depth] = open.back();
        open.pop_back();
        const std::string name = "node " + std::to_string(i);
        if (i >= gltf.nodes.size()) refuse(file, name + " is not there (export the model again)");
        if (seen[i])
            refuse(file, name + " is below itself or below two nodes (export the model again)");
        if (depth > kMostNested) refuse(file, name + " is nested too deeply");
        seen[i] = true;
        const GltfNode& node = gltf.nodes[i];
        if ((node.light && *node.light >= gltf.lights.size()) ||
            (node.camera && *node.camera >= gltf.cameras.size()))
            refuse(file, name + " has a light or camera that is not there");
        for (const std::size_t child : node.children) open.emplace_back(child, depth + 1);
    }
}

} // namespace

Gltf readGltf(const std::filesystem::path& file, std::string_view bytes) {
    const std::string_view source = jsonOf(file, bytes);
    Gltf gltf;
    if (source.empty()) return gltf;
    Json json;
    try {
        json = Json::parse(source);
    } catch (const Json::exception& error) {
        const std::string why = error.what(); // "[json.exception.parse_error.101] parse error ..."
        const std::size_t begin = why.find("] ");
        refuse(file, "no JSON, hence no glTF: " +
                         cleanText(begin == std::string::npos ? why : why.substr(begin + 2)));
    }
    if (text(member(json, "asset"), "version").starts_with("1")) return gltf;
    gltf.nodes = listOf<GltfNode>(member(json, "nodes"), nodeOf);
    gltf.cameras = listOf<ModelCamera>(member(json, "cameras"), cameraOf);
    gltf.materials = listOf<GltfMaterial>(member(json, "materials"), materialOf);
    const Json& punctual = member(member(json, "extensions"), "KHR_lights_punctual");
    gltf.lights = listOf<ModelLight>(member(punctual, "lights"), lightOf);
    for (const Json& name : member(json, "extensionsRequired"))
        if (name.is_string()) gltf.required.push_back(name.get<std::string>());
    const Json& scenes = member(json, "scenes");
    const std::size_t shown = index(json, "scene").value_or(0);
    if (scenes.is_array() && shown < scenes.size()) gltf.roots = indices(scenes[shown], "nodes");
    checkNodes(file, gltf);
    return gltf;
}

} // namespace penumbra
