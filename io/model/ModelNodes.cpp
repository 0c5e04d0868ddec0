#include "io/model/ModelNodes.h"

#include "io/model/ModelMesh.h"
#include "io/usd/layer/UsdPrimSpecs.h"

#include <assimp/scene.h>

namespace penumbra {

namespace {

// One of the steps of an FBX transform, which Assimp keeps as nodes.
bool isStep(const aiNode& node) {
    return node.mNumMeshes == 0 &&
           std::string_view(node.mName.C_Str()).find("_$AssimpFbx$_") != std::string_view::npos;
}

} // namespace

glm::dmat4 nodeMatrix(const aiNode& node) {
    glm::dmat4 made;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            made[c][r] = double(node.mTransformation[unsigned(r)][unsigned(c)]);
    return made;
}

ModelNodes::ModelNodes(const ModelFile& file, double unit, ModelMaterials& materials,
                       Diagnostics& diagnostics)
    : file_(file), unit_(unit), materials_(materials), diagnostics_(diagnostics) {
    collectNamed();
}

// Assimp's lights and cameras belong to the node of their name.
void ModelNodes::collectNamed() {
    const aiScene& scene = file_.scene();
    for (unsigned i = 0; i < scene.mNumLights; ++i)
        lights_.push_back(modelLightOf(*scene.mLights[i]));
    for (unsigned i = 0; i < scene.mNumCameras; ++i)
        cameras_.push_back(modelCameraOf(*scene.mCameras[i]));
    const auto nodeOf = [&](const std::string& name, const char* what) {
        const aiNode* node = scene.mRootNode->FindNode(name.c_str());
        if (!node)
            diagnostics_.warn(where(), std::string(what) + " '" + cleanText(name) +
                                           "' left out: it is nowhere in the scene");
        return node;
    };
    for (const ModelLight& light : lights_)
        if (const aiNode* node = nodeOf(light.name, "light"))
            byNode_[node].lights.push_back(&light);
    for (const ModelCamera& camera : cameras_)
        if (const aiNode* node = nodeOf(camera.name, "camera"))
            byNode_[node].cameras.push_back(&camera);
}

ModelNodes::Fittings ModelNodes::fittingsOf(const aiNode& node,
                                            std::optional<std::size_t> gltf) const {
    if (!gltf) {
        const auto found = byNode_.find(&node);
        return found == byNode_.end() ? Fittings() : found->second;
    }
    Fittings fittings;
    const GltfNode& json = file_.gltf().nodes[*gltf];
    if (json.light) fittings.lights.push_back(&file_.gltf().lights[*json.light]);
    if (json.camera) fittings.cameras.push_back(&file_.gltf().cameras[*json.camera]);
    return fittings;
}

// Assimp numbers nameless nodes of glTF; the name of what is on them says more.
std::string ModelNodes::nameOf(const aiNode& node, std::optional<std::size_t> gltf) const {
    const bool nameless = !node.mParent && node.mName.length == 0; // the file stands for it
    if (!gltf) return nameless ? file_.path().stem().string() : node.mName.C_Str();
    const GltfNode& json = file_.gltf().nodes[*gltf];
    if (!json.name.empty()) return json.name;
    if (json.light) return file_.gltf().lights[*json.light].name;
    if (json.camera) return file_.gltf().cameras[*json.camera].name;
    if (node.mNumMeshes > 0) return file_.scene().mMeshes[node.mMeshes[0]]->mName.C_Str();
    return {};
}

void ModelNodes::addTo(UsdPrimSpec& root, PrimNames names, const glm::dmat4& rootMatrix) {
    const aiNode& node = *file_.scene().mRootNode;
    const std::vector<std::size_t>& roots = file_.gltf().roots;
    const bool isFile = node.mNumMeshes == 0 && roots.size() != 1 && !byNode_.contains(&node);
    Place place;
    if (!isFile) {
        const auto gltf = roots.size() == 1 ? std::optional(roots.front()) : std::nullopt;
        addNode(root, names, node, gltf, rootMatrix, place);
        return;
    }
    addTransform(root, rootMatrix);
    place.parentToWorld = rootMatrix;
    const bool matched = roots.size() == node.mNumChildren;
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
        const aiNode& child = *node.mChildren[i];
        addNode(root, names, child, matched ? std::optional(roots[i]) : std::nullopt,
                nodeMatrix(child), place);
    }
}

// As deep as the nodes are nested: checkModel() has seen to that.
void ModelNodes::addNode(UsdPrimSpec& parent, PrimNames& siblings, const aiNode& node,
                         std::optional<std::size_t> gltf, const glm::dmat4& own,
                         const Place& place) {
    const glm::dmat4 local = place.before * own;
    const Fittings fittings = fittingsOf(node, gltf);
    if (isStep(node)) {
        Place below = place;
        below.before = local;
        addChildren(parent, siblings, node, gltf, below);
        return;
    }
    const std::string name = nameOf(node, gltf);
    const glm::dmat4 toWorld = place.parentToWorld * local;
    if (addAlone(parent, siblings, node, fittings, local, toWorld, name)) return;
    UsdPrimSpec spec = makePrim("Xform", siblings.take(name, "Node"));
    const bool meshes = node.mNumMeshes > 0;
    if (meshes || (node.mNumChildren > 0 && !place.inComponent))
        addMetadata(spec.metadata, "kind", UsdKind::token,
                    !meshes             ? "group"
                    : place.inComponent ? "subcomponent"
                                        : "component");
    keepDisplayName(spec, name);
    addTransform(spec, local);
    PrimNames names;
    addMeshes(spec, names, node);
    addFittings(spec, names, fittings, toWorld);
    addChildren(spec, names, node, gltf, {glm::dmat4(1), toWorld, place.inComponent || meshes});
    parent.children.push_back(std::move(spec));
}

void ModelNodes::addChildren(UsdPrimSpec& spec, PrimNames& names, const aiNode& node,
                             std::optional<std::size_t> gltf, const Place& place) {
    const std::vector<std::size_t>* numbers = gltf ? &file_.gltf().nodes[*gltf].children : nullptr;
    if (numbers && numbers->size() != node.mNumChildren) {
        diagnostics_.warn(where(), "lights and cameras below node '" +
                                       cleanText(nameOf(node, gltf)) + "' left out");
        numbers = nullptr;
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
        const aiNode& child = *node.mChildren[i];
        addNode(spec, names, child, numbers ? std::optional((*numbers)[i]) : std::nullopt,
                nodeMatrix(child), place);
    }
}

bool ModelNodes::addAlone(UsdPrimSpec& parent, PrimNames& siblings, const aiNode& node,
                          const Fittings& fittings, const glm::dmat4& local,
                          const glm::dmat4& toWorld, const std::string& name) {
    const bool alone = node.mNumMeshes == 0 && node.mNumChildren == 0 &&
                       fittings.lights.size() + fittings.cameras.size() == 1;
    if (!alone) return false;
    if (!fittings.lights.empty()) {
        ModelLight light = *fittings.lights.front();
        light.name = name;
        light.toParent = local;
        auto spec =
            lightPrim(light, siblings.take(name, "Light"), toWorld, unit_, where(), diagnostics_);
        if (!spec) return true;
        parent.children.push_back(std::move(*spec));
        ++counts_.lights;
        return true;
    }
    ModelCamera camera = *fittings.cameras.front();
    camera.name = name;
    camera.toNode = local * camera.toNode;
    parent.children.push_back(cameraPrim(camera, siblings.take(name, "Camera")));
    ++counts_.cameras;
    return true;
}

void ModelNodes::addMeshes(UsdPrimSpec& spec, PrimNames& names, const aiNode& node) {
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
        const aiMesh& mesh = *file_.scene().mMeshes[node.mMeshes[i]];
        const std::string name = names.take(mesh.mName.C_Str(), "Mesh");
        auto made = meshPrim(mesh, name,
                             {materials_.doubleSided(mesh), file_.format() == ModelFormat::gltf},
                             where(), diagnostics_);
        if (!made) continue;
        const std::string material = materials_.pathFor(mesh);
        if (!material.empty()) {
            applySchema(*made, "MaterialBindingAPI");
            addRelationship(*made, "material:binding", material);
        }
        ++counts_.meshes;
        for (unsigned f = 0; f < mesh.mNumFaces; ++f)
            counts_.faces += mesh.mFaces[f].mNumIndices >= 3;
        spec.children.push_back(std::move(*made));
    }
}

void ModelNodes::addFittings(UsdPrimSpec& spec, PrimNames& names, const Fittings& fittings,
                             const glm::dmat4& toWorld) {
    for (const ModelLight* light : fittings.lights) {
        const std::string name = names.take(light->name, "Light");
        auto made = lightPrim(*light, name, toWorld, unit_, where(), diagnostics_);
        if (!made) continue;
        spec.children.push_back(std::move(*made));
        ++counts_.lights;
    }
    for (const ModelCamera* camera : fittings.cameras) {
        spec.children.push_back(cameraPrim(*camera, names.take(camera->name, "Camera")));
        ++counts_.cameras;
    }
}

} // namespace penumbra
