// Meshes of models as meshes of USD.
#pragma once

#include "io/usd/layer/UsdDiagnostic.h"
#include "io/usd/layer/UsdLayer.h"

#include <optional>
#include <string>

struct aiMesh;

namespace penumbra {

/// What the mesh itself does not say.
struct MeshHabits {
    bool doubleSided = false; ///< as its material is
    bool flat = false;        ///< faces without normals are: glTF 2.0, 3.7.2.1 asks for it
};

/// The polygons of a mesh, as the file has them. Corners of one position share a point, so that
/// faces that touch are one surface; normals, texture coordinates (`primvars:st`, `st1`, ...) and
/// colours are given per point where they agree, else per corner. Points, lines, bones and morph
/// targets are left out, with a warning.
/// \return nothing if no polygon is in it
std::optional<UsdPrimSpec> meshPrim(const aiMesh& mesh, const std::string& name,
                                    const MeshHabits& habits, const SourceLocation& where,
                                    Diagnostics& diagnostics);

/// The primvar of a channel of texture coordinates.
std::string textureCoordinates(unsigned channel);

} // namespace penumbra
