#include "io/model/ModelCheck.h"

#include "base/Error.h"
#include "io/model/PrimNames.h"

#include <assimp/scene.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace penumbra {

namespace {

constexpr std::size_t kMostNodes = 1'000'000;
constexpr std::uint64_t kMostCorners = 200'000'000; // of all meshes in all their nodes
constexpr const char* kAgain = " (export the model again)";

[[noreturn]] void refuse(const std::string& file, const std::string& why) {
    throw SceneFileError({file}, why);
}

bool finite(const aiVector3D& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::string nameOf(const char* what, const aiString& name, std::size_t index) {
    const std::string text = cleanText({name.data, std::min<std::size_t>(name.length, 1023)});
    return std::string(what) + " '" + (text.empty() ? std::to_string(index) : text) + "'";
}

void checkMesh(const aiScene& scene, std::size_t index, const std::string& file) {
    const aiMesh* mesh = scene.mMeshes[index];
    if (!mesh) refuse(file, std::string("a mesh is missing") + kAgain);
    const std::string name = nameOf("mesh", mesh->mName, index);
    if ((mesh->mNumVertices > 0 && !mesh->mVertices) || (mesh->mNumFaces > 0 && !mesh->mFaces))
        refuse(file, name + " has no points or no faces" + kAgain);
    if (mesh->mMaterialIndex >= scene.mNumMaterials)
        refuse(file, name + " has a material that is not there" + kAgain);
    for (unsigned i = 0; i < mesh->mNumVertices; ++i)
        if (!finite(mesh->mVertices[i]))
            refuse(file, name + ": point " + std::to_string(i) + " is not finite" + kAgain);
    for (unsigned f = 0; f < mesh->mNumFaces; ++f) {
        const aiFace& face = mesh->mFaces[f];
        for (unsigned i = 0; i < face.mNumIndices; ++i)
            if (face.mIndices[i] >= mesh->mNumVertices)
                refuse(file, name + ": face " + std::to_string(f) + " has index " +
                                 std::to_string(face.mIndices[i]) + ", beyond its " +
                                 std::to_string(mesh->mNumVertices) + " points" + kAgain);
    }
}

std::uint64_t cornersOf(const aiMesh& mesh) {
    std::uint64_t corners = 0;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) corners += mesh.mFaces[f].mNumIndices;
    return corners;
}

bool finite(const aiMatrix4x4& m) {
    for (unsigned r = 0; r < 4; ++r)
        for (unsigned c = 0; c < 4; ++c)
            if (!std::isfinite(m[r][c])) return false;
    return true;
}

// Depth first, without recursion.
void checkNodes(const aiScene& scene, const std::string& file) {
    struct Open {
        const aiNode* node;
        std::size_t depth;
    };
    std::vector<std::uint64_t> corners;
    for (unsigned i = 0; i < scene.mNumMeshes; ++i) corners.push_back(cornersOf(*scene.mMeshes[i]));
    std::vector<Open> open{{scene.mRootNode, 1}};
    std::size_t nodes = 0;
    std::uint64_t all = 0;
    while (!open.empty()) {
        const auto [node, depth] = open.back();
        open.pop_back();
        if (!node) refuse(file, std::string("a node is missing") + kAgain);
        const std::string name = nameOf("node", node->mName, nodes);
        if (depth > kMostNested) refuse(file, name + " is nested too deeply");
        if (++nodes > kMostNodes) refuse(file, "there are more than a million nodes");
        if (!finite(node->mTransformation))
            refuse(file, name + ": its transform is not finite" + kAgain);
        for (unsigned i = 0; i < node->mNumMeshes; ++i) {
            if (node->mMeshes[i] >= scene.mNumMeshes)
                refuse(file, name + " has a mesh that is not there" + kAgain);
            all += corners[node->mMeshes[i]];
        }
        if (all > kMostCorners)
            refuse(file, "there are more than 200 million corners of faces, with all instances");
        for (unsigned i = 0; i < node->mNumChildren; ++i)
            open.push_back({node->mChildren[i], depth + 1});
    }
}

} // namespace

void checkModel(const aiScene& scene, const std::string& file) {
    if (!scene.mRootNode) refuse(file, std::string("there is no scene in it") + kAgain);
    for (unsigned i = 0; i < scene.mNumMeshes; ++i) checkMesh(scene, i, file);
    checkNodes(scene, file);
}

} // namespace penumbra
