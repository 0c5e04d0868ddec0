#include "io/model/ModelImport.h"

#include "base/Error.h"
#include "io/model/ModelNodes.h"
#include "io/usd/layer/UsdPrimSpecs.h"

#include <assimp/scene.h>

#include <charconv>
#include <cmath>
#include <string_view>

namespace penumbra {

namespace {

/// The unit and the axes of a model.
struct ModelFrame {
    double metersPerUnit = 1;
    UpAxis up = UpAxis::y;
    glm::dmat4 turn{1};   ///< for axes that USD does not have
    double rootScale = 1; ///< that the reader has put on the root node
    bool said = true;     ///< by the file; else a habit of its format
};

template <class T>
std::optional<T> metadataOf(const aiScene& scene, const char* key) {
    T value{};
    if (scene.mMetaData && scene.mMetaData->Get(key, value)) return value;
    return std::nullopt;
}

// A quarter turn that brings X, or a negative axis, to where Y is.
glm::dmat4 turnToY(int axis, bool negative) {
    glm::dmat4 turn(1); // its columns: where X, Y and Z go
    if (axis == 0) {
        turn[0] = {0, negative ? -1 : 1, 0, 0};
        turn[1] = {negative ? 1 : -1, 0, 0, 0};
    } else if (axis == 1 && negative) {
        turn[0] = {-1, 0, 0, 0};
        turn[1] = {0, -1, 0, 0};
    } else if (axis == 2) {
        turn[2] = {0, negative ? -1 : 1, 0, 0};
        turn[1] = {0, 0, negative ? 1 : -1, 0};
    }
    return turn;
}

// FBX: UnitScaleFactor in centimetres; axes 0, 1, 2 with a sign each.
ModelFrame fbxFrame(const aiScene& scene) {
    ModelFrame frame;
    const double centimetres = double(metadataOf<float>(scene, "UnitScaleFactor").value_or(1.0f));
    if (centimetres > 0 && std::isfinite(centimetres)) frame.metersPerUnit = centimetres / 100;
    const int axis = metadataOf<std::int32_t>(scene, "UpAxis").value_or(1);
    const bool negative = metadataOf<std::int32_t>(scene, "UpAxisSign").value_or(1) < 0;
    if (axis == 2 && !negative)
        frame.up = UpAxis::z;
    else
        frame.turn = turnToY(axis, negative);
    return frame;
}

/// What is behind the first `begin`, up to `end` or the end of all; empty if there is no `begin`.
std::string_view between(std::string_view text, std::string_view begin, std::string_view end) {
    const std::size_t at = text.find(begin);
    if (at == std::string_view::npos) return {};
    text.remove_prefix(at + begin.size());
    return text.substr(0, text.find(end));
}

// Collada: `<unit meter="0.01"/>` and `<up_axis>Z_UP</up_axis>` in the first <asset>. Assimp keeps
// the unit as a scale of the root node, which is taken back; it was asked to leave the axes.
ModelFrame colladaFrame(const ModelFile& file) {
    ModelFrame frame;
    const std::string_view asset = between(file.bytes(), "<asset", "</asset>");
    const std::string_view meter = between(between(asset, "<unit", ">"), "meter=", " ");
    double value = 0;
    if (meter.size() > 1) // behind its quote
        std::from_chars(meter.data() + 1, meter.data() + meter.size(), value);
    if (value > 0 && std::isfinite(value)) frame.metersPerUnit = value;
    const std::string_view up = between(asset, "<up_axis>", "</up_axis>");
    if (up.find("Z_UP") != std::string::npos) frame.up = UpAxis::z;
    if (up.find("X_UP") != std::string::npos) frame.turn = turnToY(0, false);
    const double scale = double(file.scene().mRootNode->mTransformation.a1);
    if (std::abs(scale / frame.metersPerUnit - 1) < 1e-5)
        frame.rootScale = scale; // that very float: nothing is left of it
    else
        frame.metersPerUnit = 1; // the file hides it; the scale remains
    return frame;
}

ModelFrame frameOf(const ModelFile& file) {
    ModelFrame frame;
    if (file.format() == ModelFormat::fbx) return fbxFrame(file.scene());
    if (file.format() == ModelFormat::collada) return colladaFrame(file);
    if (file.format() == ModelFormat::stl) frame.up = UpAxis::z; // the habit of what writes it
    frame.said = file.format() == ModelFormat::gltf;
    return frame;
}

void sayWhatWasTaken(const ModelFrame& frame, const ImportOptions& options, const ModelFile& file,
                     Diagnostics& diagnostics) {
    if (frame.said) return;
    std::string taken;
    if (!options.metersPerUnit) taken = "metres";
    if (!options.up)
        taken +=
            std::string(taken.empty() ? "" : ", ") + (frame.up == UpAxis::z ? "Z" : "Y") + " up";
    if (!taken.empty())
        diagnostics.warn({file.path().string()}, std::string(nameOf(file.format())) +
                                                     " does not say its unit or axes: taken as " +
                                                     taken + " (import has --unit and --up)");
}

std::string docOf(const ModelFile& file) {
    std::string doc = "Imported by Penumbra from " + cleanText(file.path().filename().string()) +
                      " (" + nameOf(file.format()) + ").";
    doc += " Point lights are spheres of 0.05 m radius.";
    doc += file.format() == ModelFormat::gltf
               ? " Intensities were candelas, emission is in cd/m2."
               : " Lights and emission had no unit: 1 was taken as 1 candela, and as 1 cd/m2.";
    return doc;
}

void describe(UsdLayer& layer, const ModelFile& file, const std::string& root, double unit,
              UpAxis up) {
    addMetadata(layer.metadata, "defaultPrim", UsdKind::token, root);
    addMetadata(layer.metadata, "doc", UsdKind::string, docOf(file));
    addMetadata(layer.metadata, "metersPerUnit", unit);
    addMetadata(layer.metadata, "upAxis", UsdKind::token, up == UpAxis::z ? "Z" : "Y");
}

void nameWhatIsLeftOut(const ModelFile& file, Diagnostics& diagnostics) {
    if (file.scene().mNumLights > 0) // of glTF, whose unit is known, there are none here
        diagnostics.warn({file.path().string()}, std::string("lights have no unit in ") +
                                                     nameOf(file.format()) +
                                                     ": 1 is taken as 1 candela");
    if (file.animations() > 0)
        diagnostics.warn({file.path().string()}, "animation left out", file.animations());
    for (const std::string& extension : file.gltf().required)
        if (extension != "KHR_lights_punctual" && extension != "KHR_materials_emissive_strength" &&
            extension != "KHR_texture_transform" && extension != "KHR_mesh_quantization" &&
            extension != "KHR_materials_unlit")
            diagnostics.warn({file.path().string()},
                             "needs '" + cleanText(extension) + "', which may be left out");
}

/// Makes the one prim of the layer, and counts what is in it.
void addRoot(ImportedModel& imported, const ModelFile& model, const ModelFrame& frame, double unit,
             const ImportOptions& options, Diagnostics& diagnostics) {
    const std::string stem = model.path().stem().string();
    UsdPrimSpec root = makePrim("Xform", primName(stem, "Model"));
    addMetadata(root.metadata, "kind", UsdKind::token, "group");
    keepDisplayName(root, stem);
    PrimNames names;
    const std::string scope = names.take("Materials", "Materials");
    ImportedImages images(model.scene(), model.path(), options.layer, diagnostics);
    ModelMaterials materials(model, "/" + root.name + "/" + scope, images, diagnostics);
    ModelNodes nodes(model, unit, materials, diagnostics);
    glm::dmat4 rootMatrix = nodeMatrix(*model.scene().mRootNode);
    for (int column = 0; column < 3; ++column) rootMatrix[column] /= frame.rootScale;
    nodes.addTo(root, names, frame.turn * rootMatrix);
    imported.meshes = nodes.counts().meshes;
    imported.faces = nodes.counts().faces;
    imported.lights = nodes.counts().lights;
    imported.cameras = nodes.counts().cameras;
    imported.materials = materials.count();
    if (materials.count() > 0) {
        root.children.push_back(makePrim("Scope", scope));
        root.children.back().children = materials.take();
    }
    imported.layer.prims.push_back(std::move(root));
    imported.images = images.take();
    imported.files = model.files();
    imported.files.insert(imported.files.end(), images.files().begin(), images.files().end());
}

} // namespace

ImportedModel importModel(const std::filesystem::path& file, const ImportOptions& options) {
    const auto format = modelFormatOf(file);
    if (!format)
        throw SceneFileError({file.string()}, "no known model: glTF, OBJ, FBX, PLY, STL and "
                                              "Collada are known by the ending of the name");
    Diagnostics diagnostics;
    const ModelFile model(file, *format, {options.maxFileBytes, options.folders}, diagnostics);
    const ModelFrame frame = frameOf(model);
    sayWhatWasTaken(frame, options, model, diagnostics);
    nameWhatIsLeftOut(model, diagnostics);
    const double unit = options.metersPerUnit.value_or(frame.metersPerUnit);
    ImportedModel imported;
    addRoot(imported, model, frame, unit, options, diagnostics);
    if (imported.meshes + imported.lights + imported.cameras == 0)
        throw SceneFileError({file.string()}, "there is nothing in it to show: no polygons, "
                                              "lights or cameras (export the model again)");
    if (imported.meshes == 0)
        diagnostics.warn({file.string()}, "there are no polygons in it, only lights or cameras");
    imported.layer.file = file.string();
    describe(imported.layer, model, imported.layer.prims.front().name, unit,
             options.up.value_or(frame.up));
    imported.layer.diagnostics = diagnostics.take();
    return imported;
}

} // namespace penumbra
