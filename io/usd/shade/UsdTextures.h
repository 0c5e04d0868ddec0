// UsdUVTexture: pictures, and how they lie on surfaces.
#pragma once

#include "io/usd/layer/UsdAssets.h"
#include "io/usd/layer/UsdDiagnostic.h"
#include "io/usd/shade/UsdTextureAddress.h"
#include "io/usd/stage/UsdAttributes.h"
#include "scenegraph/Mesh.h"
#include "scenegraph/Texture.h"

#include <map>
#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace penumbra {

/// What a UsdUVTexture comes to.
struct UsdTexture {
    std::shared_ptr<const Texture> texture; ///< null: it can't be used
    std::string primvar;                    ///< with its texture coordinates, e.g. `st`
    UsdTextureAddress address = {};
};

/// The textures of a stage. Each picture is read once, whoever asks for it how often; a shader is
/// understood once, at the time at which it is first asked for.
class UsdTextures {
public:
    explicit UsdTextures(const UsdAssets& files) : files_(&files) {}
    /// Reads the pictures of some shaders on all cores. What can't be read is left to at().
    void readAhead(UsdTime time, std::span<const UsdPrim* const> shaders);
    /// From now on nothing more is read; the files may go.
    void close() { files_ = nullptr; }

    /// Understood of a UsdUVTexture: file, st (UsdPrimvarReader_float2, UsdTransform2d), wrapS,
    /// wrapT, scale, bias, sourceColorSpace. What can't be used, a picture in tiles (UDIM) for one,
    /// is warned of. The scale is that at the time asked for.
    const UsdTexture& at(const UsdStage& stage, const UsdPrim& shader, UsdTime time,
                         Diagnostics& diagnostics);

private:
    UsdTexture make(const UsdStage& stage, const UsdAttributes& shader, Diagnostics& diagnostics);
    std::shared_ptr<const TextureImage> image(const UsdAttributes& shader,
                                              Diagnostics& diagnostics);

    const UsdAssets* files_;
    std::unordered_map<std::string, UsdTexture> made_; ///< by the shader's path
    std::map<std::pair<std::string, int>, std::shared_ptr<const TextureImage>> images_;
};

/// How the corners of a mesh lie in the file; to be noted before faces are left out.
struct UsdCorners {
    std::vector<std::size_t> firstCorner; ///< one a face of the file
    std::size_t count = 0;                ///< of all corners
    bool leftHanded = false;
};

/// Texture coordinates of all corners of `mesh`, from `primvars:NAME` of any interpolation; empty,
/// with a warning, if there are none, or too few.
/// \param faceOf the file's number of each face
std::vector<glm::vec2> usdTexCoords(const UsdAttributes& prim, const std::string& name,
                                    const MeshData& mesh, const UsdCorners& corners,
                                    const std::vector<std::size_t>& faceOf,
                                    Diagnostics& diagnostics);

} // namespace penumbra
