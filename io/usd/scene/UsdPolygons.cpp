#include "io/usd/scene/UsdPolygons.h"

#include "io/usd/scene/UsdNormals.h"
#include "scenegraph/CreaseNormals.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace penumbra {

namespace {

bool finite(glm::vec3 p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

// Newell's normal is zero (Sutherland, Sproull & Schumacker 1974): the polygon encloses nothing.
bool hasArea(const std::vector<glm::vec3>& points, const std::int32_t* face, std::size_t count) {
    glm::dvec3 normal(0);
    const glm::dvec3 origin = points[std::size_t(face[0])];
    for (std::size_t i = 1; i + 1 < count; ++i) {
        const glm::dvec3 a = glm::dvec3(points[std::size_t(face[i])]) - origin;
        const glm::dvec3 b = glm::dvec3(points[std::size_t(face[i + 1])]) - origin;
        normal += glm::cross(a, b);
    }
    return glm::dot(normal, normal) > 0;
}

// Why a face can't be used, or null.
const char* faultOf(const UsdPolygons& p, const std::int32_t* face, std::int32_t count) {
    if (count < 3) return "face with fewer than 3 corners left out";
    if (count > kMaxFaceSides) return "face with more than 100000 corners left out";
    for (std::int32_t i = 0; i < count; ++i) {
        if (face[i] < 0 || std::size_t(face[i]) >= p.points.size())
            return "face with an index out of range left out";
        if (!finite(p.points[std::size_t(face[i])]))
            return "face with a point that is not finite left out";
    }
    if (p.scheme == SubdivisionScheme::none && !hasArea(p.points, face, std::size_t(count)))
        return "face without area left out";
    return nullptr;
}

// Marks what can be used; counts and indices are cut where they no longer fit each other.
void checkFaces(const UsdAttributes& mesh, UsdPolygons& p, Diagnostics& diagnostics) {
    std::map<const char*, std::size_t> faults;
    p.kept.assign(p.counts.size(), 0);
    std::size_t offset = 0;
    for (std::size_t f = 0; f < p.counts.size(); ++f) {
        if (p.counts[f] < 0) p.counts[f] = 0;
        const auto count = std::size_t(p.counts[f]);
        if (count > p.indices.size() - offset) {
            faults["face beyond the end of faceVertexIndices left out"] += p.counts.size() - f;
            p.counts.resize(f);
            break;
        }
        const char* fault = faultOf(p, p.indices.data() + offset, p.counts[f]);
        if (fault)
            ++faults[fault];
        else
            p.kept[f] = 1;
        offset += count;
    }
    p.kept.resize(p.counts.size());
    if (offset < p.indices.size()) {
        diagnostics.warn(mesh.location("faceVertexIndices"),
                         "indices that belong to no face ignored");
        p.indices.resize(offset);
    }
    for (const auto& [text, count] : faults)
        diagnostics.warn(mesh.location("faceVertexIndices"), text, count);
}

SubdivisionScheme readScheme(const UsdAttributes& mesh, const std::vector<std::int32_t>& counts,
                             Diagnostics& diagnostics) {
    const std::string name = mesh.text("subdivisionScheme", "catmullClark");
    const auto warn = [&](const char* text) {
        diagnostics.warn(mesh.location("subdivisionScheme"), text);
        return SubdivisionScheme::none;
    };
    if (name == "none") return SubdivisionScheme::none;
    if (name == "catmullClark") return SubdivisionScheme::catmullClark;
    if (name == "bilinear") return SubdivisionScheme::bilinear;
    if (name != "loop") return warn("unknown subdivision scheme: the mesh is taken as it is");
    const bool triangles =
        std::all_of(counts.begin(), counts.end(), [](std::int32_t c) { return c == 3; });
    if (!triangles) return warn("Loop subdivision needs triangles: the mesh is taken as it is");
    return SubdivisionScheme::loop;
}

} // namespace

UsdPolygons readUsdPolygons(const UsdAttributes& mesh, Diagnostics& diagnostics) {
    UsdPolygons p;
    p.points = mesh.points("points");
    p.counts = mesh.integers("faceVertexCounts");
    p.indices = mesh.integers("faceVertexIndices");
    p.scheme = readScheme(mesh, p.counts, diagnostics);
    p.leftHanded = mesh.text("orientation", "rightHanded") == "leftHanded";
    p.doubleSided = mesh.flag("doubleSided", false);
    checkFaces(mesh, p, diagnostics);
    p.normals = readUsdNormals(mesh, p, diagnostics);
    // Without subdivision a hole is a face that isn't drawn; with it, the face still shapes its
    // neighbours.
    if (p.scheme == SubdivisionScheme::none)
        for (const std::int32_t hole : mesh.integers("holeIndices"))
            if (hole >= 0 && std::size_t(hole) < p.kept.size()) p.kept[std::size_t(hole)] = 0;
    return p;
}

namespace {

bool isPoint(const MeshData& data, std::int32_t index) {
    return index >= 0 && std::size_t(index) < data.points.size();
}

float sharpnessOf(double value) {
    return std::isfinite(value) ? float(std::clamp(value, 0.0, 10.0)) : 10.0f;
}

// creaseSharpnesses has one value a crease, or one an edge: then each edge is a crease of its own.
void readCreases(const UsdAttributes& mesh, MeshData& data, Diagnostics& diagnostics) {
    const auto indices = mesh.integers("creaseIndices");
    const auto lengths = mesh.integers("creaseLengths");
    const auto sharpnesses = mesh.numbers("creaseSharpnesses");
    const bool perCrease = sharpnesses.size() == lengths.size();
    std::size_t at = 0;
    std::size_t edge = 0;
    for (std::size_t c = 0; c < lengths.size(); ++c) {
        const std::size_t length = lengths[c] > 0 ? std::size_t(lengths[c]) : 0;
        const bool usable = length >= 2 && length <= indices.size() - at &&
                            std::all_of(indices.begin() + std::ptrdiff_t(at),
                                        indices.begin() + std::ptrdiff_t(at + length),
                                        [&](std::int32_t i) { return isPoint(data, i); }) &&
                            (perCrease || edge + length - 1 <= sharpnesses.size());
        if (!usable) {
            diagnostics.warn(mesh.location("creaseIndices"), "unusable creases left out",
                             lengths.size() - c);
            return;
        }
        const std::int32_t* chain = indices.data() + at;
        if (perCrease)
            data.creases.push_back({{chain, chain + length}, sharpnessOf(sharpnesses[c])});
        else
            for (std::size_t i = 0; i + 1 < length; ++i)
                data.creases.push_back(
                    {{chain[i], chain[i + 1]}, sharpnessOf(sharpnesses[edge + i])});
        edge += length - 1;
        at += length;
    }
}

void readCorners(const UsdAttributes& mesh, MeshData& data, Diagnostics& diagnostics) {
    const auto indices = mesh.integers("cornerIndices");
    const auto sharpnesses = mesh.numbers("cornerSharpnesses");
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (i < sharpnesses.size() && isPoint(data, indices[i]))
            data.corners.push_back({indices[i], sharpnessOf(sharpnesses[i])});
        else
            diagnostics.warn(mesh.location("cornerIndices"), "unusable corners left out");
    }
}

} // namespace

MeshData toMeshData(const UsdAttributes& mesh, UsdPolygons polygons,
                    std::vector<std::size_t>& faceOf, Diagnostics& diagnostics) {
    MeshData data;
    data.scheme = polygons.scheme;
    data.doubleSided = polygons.doubleSided;
    faceOf.clear();
    std::vector<std::int32_t> newFace(polygons.counts.size(), -1);
    std::size_t offset = 0;
    for (std::size_t f = 0; f < polygons.counts.size(); ++f) {
        const auto count = std::size_t(polygons.counts[f]);
        const std::size_t first = offset;
        const std::int32_t* face = polygons.indices.data() + offset;
        offset += count;
        if (!polygons.kept[f]) continue;
        newFace[f] = std::int32_t(faceOf.size());
        faceOf.push_back(f);
        data.faceVertexCounts.push_back(polygons.counts[f]);
        for (std::size_t i = 0; i < count; ++i) {
            // Clockwise ones are turned, from the same first corner.
            const std::size_t from = polygons.leftHanded && i > 0 ? count - i : i;
            data.faceVertexIndices.push_back(face[from]);
            if (!polygons.normals.empty()) data.normals.push_back(polygons.normals[first + from]);
        }
    }
    data.points = std::move(polygons.points);
    for (glm::vec3& p : data.points)
        if (!finite(p)) p = glm::vec3(0); // no kept face uses it
    if (data.scheme == SubdivisionScheme::none) {
        if (data.normals.empty()) data.normals = creaseNormals(data);
        return data;
    }
    for (const std::int32_t hole : mesh.integers("holeIndices"))
        if (hole >= 0 && std::size_t(hole) < newFace.size() && newFace[std::size_t(hole)] >= 0)
            data.holes.push_back(newFace[std::size_t(hole)]);
    readCreases(mesh, data, diagnostics);
    readCorners(mesh, data, diagnostics);
    return data;
}

} // namespace penumbra
