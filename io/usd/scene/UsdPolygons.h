// The faces of a UsdGeomMesh, checked one by one.
#pragma once

#include "io/usd/layer/UsdDiagnostic.h"
#include "io/usd/stage/UsdAttributes.h"
#include "scenegraph/Mesh.h"

#include <cstdint>
#include <vector>

namespace penumbra {

/// Faces as the file numbers them. Those that can't be used are marked, not removed, because other
/// attributes speak of faces by their number.
struct UsdPolygons {
    std::vector<glm::vec3> points;
    std::vector<std::int32_t> counts;  ///< corners of each face
    std::vector<std::int32_t> indices; ///< as many as the counts add up to
    std::vector<std::uint8_t> kept;    ///< one a face: 1 if it can be used
    std::vector<glm::vec3> normals;    ///< one an index, see UsdNormals.h; empty: none
    SubdivisionScheme scheme = SubdivisionScheme::none;
    bool leftHanded = false; ///< faces are clockwise seen from their front
    bool doubleSided = false;
};

constexpr std::int32_t kMaxFaceSides = 100'000;

/// Reads the topology of a Mesh. A face is left out, with a warning that counts, if it has fewer
/// than 3 or more than kMaxFaceSides corners, an index out of range, a point that isn't finite, or
/// (without subdivision) no area.
UsdPolygons readUsdPolygons(const UsdAttributes& mesh, Diagnostics& diagnostics);

/// The kept faces as a mesh, counter-clockwise, with the subdivision tags of the prim; without
/// materials. `faceOf` receives the file's number of each face that remains.
MeshData toMeshData(const UsdAttributes& mesh, UsdPolygons polygons,
                    std::vector<std::size_t>& faceOf, Diagnostics& diagnostics);

} // namespace penumbra
