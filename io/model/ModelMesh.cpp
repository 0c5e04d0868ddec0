#include "io/model/ModelMesh.h"

#include "io/model/PrimNames.h"
#include "io/usd/layer/UsdPrimSpecs.h"

#include <assimp/mesh.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <unordered_map>

namespace penumbra {

namespace {

/// Polygons whose corners of one position share a point.
struct Polygons {
    std::vector<float> points; // x, y, z each
    std::vector<std::int32_t> counts, indices;
    std::vector<unsigned> vertices; // Assimp's, one a corner
    std::vector<unsigned> vertexOf; // the first one of each point
    std::size_t others = 0;         // points and lines
};

using PositionKey = std::array<std::uint32_t, 3>;
struct PositionHash {
    std::size_t operator()(const PositionKey& key) const {
        std::uint64_t hash = 0; // multiply and rotate: positions on a grid differ in few bits
        for (const std::uint32_t word : key)
            hash = std::rotl((hash ^ word) * 0x9e3779b97f4a7c15u, 29);
        return std::size_t(hash);
    }
};
PositionKey keyOf(const aiVector3D& v) { // -0 is 0
    return {std::bit_cast<std::uint32_t>(v.x + 0.0f), std::bit_cast<std::uint32_t>(v.y + 0.0f),
            std::bit_cast<std::uint32_t>(v.z + 0.0f)};
}

Polygons polygonsOf(const aiMesh& mesh) {
    Polygons made;
    std::unordered_map<PositionKey, std::int32_t, PositionHash> known;
    std::vector<std::int32_t> pointOf(mesh.mNumVertices, -1);
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
        const aiFace& face = mesh.mFaces[f];
        if (face.mNumIndices < 3) {
            ++made.others;
            continue;
        }
        made.counts.push_back(std::int32_t(face.mNumIndices));
        for (unsigned i = 0; i < face.mNumIndices; ++i) {
            const unsigned vertex = face.mIndices[i];
            const aiVector3D& at = mesh.mVertices[vertex];
            if (pointOf[vertex] < 0) {
                const auto [entry, isNew] =
                    known.try_emplace(keyOf(at), std::int32_t(made.vertexOf.size()));
                pointOf[vertex] = entry->second;
                if (isNew) {
                    made.vertexOf.push_back(vertex);
                    made.points.insert(made.points.end(), {at.x, at.y, at.z});
                }
            }
            made.indices.push_back(pointOf[vertex]);
            made.vertices.push_back(vertex);
        }
    }
    return made;
}

/// Writes what vertices have, per point if all corners at each point agree.
/// \param valueOf the components of a vertex, an array of floats
template <class Value>
UsdProperty& addVarying(UsdPrimSpec& spec, const char* type, const std::string& name,
                        const Polygons& polygons, Value valueOf) {
    bool agree = true;
    for (std::size_t i = 0; agree && i < polygons.indices.size(); ++i)
        agree = valueOf(polygons.vertices[i]) ==
                valueOf(polygons.vertexOf[std::size_t(polygons.indices[i])]);
    std::vector<float> values;
    for (const unsigned vertex : agree ? polygons.vertexOf : polygons.vertices)
        for (const float component : valueOf(vertex)) values.push_back(component);
    UsdProperty& property = addAttribute(spec, type, name, std::move(values));
    addMetadata(property.metadata, "interpolation", UsdKind::token,
                agree ? "vertex" : "faceVarying");
    return property;
}

template <class Value>
bool allFinite(const Polygons& polygons, Value valueOf) {
    return std::all_of(polygons.vertices.begin(), polygons.vertices.end(), [&](unsigned vertex) {
        const auto value = valueOf(vertex);
        return std::all_of(value.begin(), value.end(), [](float v) { return std::isfinite(v); });
    });
}

std::array<float, 3> tripleOf(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}

void addNormals(UsdPrimSpec& spec, const aiMesh& mesh, const Polygons& polygons,
                const std::string& what, const SourceLocation& where, Diagnostics& diagnostics) {
    if (!mesh.mNormals) return;
    const auto normal = [&](unsigned vertex) { return tripleOf(mesh.mNormals[vertex]); };
    if (allFinite(polygons, normal))
        addVarying(spec, "normal3f[]", "normals", polygons, normal);
    else
        diagnostics.warn(where, what + ": normals left out, some are not finite");
}

/// One a face; a zero where it has no area.
std::vector<float> faceNormals(const Polygons& polygons) {
    std::vector<float> normals;
    const auto point = [&](std::size_t corner) {
        const float* at = &polygons.points[3 * std::size_t(polygons.indices[corner])];
        return aiVector3t<double>(at[0], at[1], at[2]);
    };
    std::size_t first = 0;
    for (const std::int32_t count : polygons.counts) {
        aiVector3t<double> sum; // of the fan's triangles
        for (std::size_t i = first + 1; i + 1 < first + std::size_t(count); ++i)
            sum += (point(i) - point(first)) ^ (point(i + 1) - point(first));
        sum.NormalizeSafe();
        for (const double component : {sum.x, sum.y, sum.z}) normals.push_back(float(component));
        first += std::size_t(count);
    }
    return normals;
}

void addFlatNormals(UsdPrimSpec& spec, const Polygons& polygons) {
    UsdProperty& property = addAttribute(spec, "normal3f[]", "normals", faceNormals(polygons));
    addMetadata(property.metadata, "interpolation", UsdKind::token, "uniform");
}

void addCoordinates(UsdPrimSpec& spec, const aiMesh& mesh, const Polygons& polygons,
                    const std::string& what, const SourceLocation& where,
                    Diagnostics& diagnostics) {
    for (unsigned channel = 0; channel < AI_MAX_NUMBER_OF_TEXTURECOORDS; ++channel) {
        if (!mesh.mTextureCoords[channel]) continue;
        const auto st = [&](unsigned vertex) {
            const aiVector3D& v = mesh.mTextureCoords[channel][vertex];
            return std::array<float, 2>{v.x, v.y};
        };
        if (allFinite(polygons, st))
            addVarying(spec, "texCoord2f[]", "primvars:" + textureCoordinates(channel), polygons,
                       st);
        else
            diagnostics.warn(where, what + ": texture coordinates left out, some are not finite");
    }
}

void addColours(UsdPrimSpec& spec, const aiMesh& mesh, const Polygons& polygons,
                const std::string& what, const SourceLocation& where, Diagnostics& diagnostics) {
    if (!mesh.mColors[0]) return;
    const auto colour = [&](unsigned vertex) {
        const aiColor4D& c = mesh.mColors[0][vertex];
        return std::array<float, 3>{c.r, c.g, c.b};
    };
    if (allFinite(polygons, colour))
        addVarying(spec, "color3f[]", "primvars:displayColor", polygons, colour);
    else
        diagnostics.warn(where, what + ": colours left out, some are not finite");
}

void addExtent(UsdPrimSpec& spec, const std::vector<float>& points) {
    std::vector<float> extent{points[0], points[1], points[2], points[0], points[1], points[2]};
    for (std::size_t i = 0; i < points.size(); ++i) {
        extent[i % 3] = std::min(extent[i % 3], points[i]);
        extent[3 + i % 3] = std::max(extent[3 + i % 3], points[i]);
    }
    addAttribute(spec, "float3[]", "extent", std::move(extent));
}

} // namespace

std::string textureCoordinates(unsigned channel) {
    return channel == 0 ? "st" : "st" + std::to_string(channel);
}

std::optional<UsdPrimSpec> meshPrim(const aiMesh& mesh, const std::string& name,
                                    const MeshHabits& habits, const SourceLocation& where,
                                    Diagnostics& diagnostics) {
    const std::string what =
        "mesh '" + cleanText(mesh.mName.length ? mesh.mName.C_Str() : name) + "'";
    const Polygons polygons = polygonsOf(mesh);
    if (polygons.others > 0)
        diagnostics.warn(where, what + ": points and lines left out", polygons.others);
    if (polygons.counts.empty()) return std::nullopt;
    if (mesh.mNumBones > 0)
        diagnostics.warn(where, what + ": its skin is left out, it stays as it was bound");
    if (mesh.mNumAnimMeshes > 0) diagnostics.warn(where, what + ": morph targets left out");
    UsdPrimSpec spec = makePrim("Mesh", name);
    addExtent(spec, polygons.points);
    addAttribute(spec, "point3f[]", "points", polygons.points);
    addAttribute(spec, "int[]", "faceVertexCounts", polygons.counts);
    addAttribute(spec, "int[]", "faceVertexIndices", polygons.indices);
    addText(spec, "token", "subdivisionScheme", "none").uniform = true;
    if (habits.doubleSided) addBool(spec, "doubleSided", true).uniform = true;
    addNormals(spec, mesh, polygons, what, where, diagnostics);
    if (!mesh.mNormals && habits.flat) addFlatNormals(spec, polygons);
    addCoordinates(spec, mesh, polygons, what, where, diagnostics);
    addColours(spec, mesh, polygons, what, where, diagnostics);
    keepDisplayName(spec, mesh.mName.C_Str());
    return spec;
}

} // namespace penumbra
