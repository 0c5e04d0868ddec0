#include "radiosity/surface/SurfaceMesh.h"

#include "radiosity/rays/Traceable.h"
#include "radiosity/surface/TrianglePairs.h"
#include "radiosity/surface/Triangulate.h"
#include "radiosity/surface/UnionFind.h"
#include "radiosity/surface/WeldedPoints.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace penumbra {

namespace {

constexpr std::size_t kMostSides = 5000; // of a face: triangulation is quadratic

/// A connected part of a mesh.
struct Component {
    std::vector<std::uint32_t> faces;
    bool closed = true;
    double volume = 0; ///< signed; > 0 if the fronts face outwards
    Bounds bounds;
    std::vector<std::uint32_t> lid; ///< closes its only opening, wound like its faces; may be empty
};

/// How often faces go along an edge, lower point to higher one, more than the other way.
using EdgeCount = std::pair<std::uint64_t, int>;

/// Edges that the faces of a component do not go along as often one way as the other.
std::vector<EdgeCount> openEdges(const SurfaceMesh& mesh, std::span<const std::uint32_t> weld,
                                 const Component& component) {
    std::vector<EdgeCount> edges;
    for (const std::uint32_t f : component.faces) {
        const auto corners = mesh.cornersOf(mesh.faces[f]);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const std::uint32_t a = weld[corners[i]], b = weld[corners[(i + 1) % corners.size()]];
            edges.emplace_back(std::uint64_t(std::min(a, b)) << 32 | std::max(a, b),
                               a < b ? 1 : -1);
        }
    }
    std::sort(edges.begin(), edges.end());
    std::vector<EdgeCount> open;
    for (std::size_t first = 0, last = 0; first < edges.size(); first = last) {
        int count = 0;
        for (; last < edges.size() && edges[last].first == edges[first].first; ++last)
            count += edges[last].second;
        if (count != 0) open.emplace_back(edges[first].first, count);
    }
    return open;
}

/// The boundary of a surface, turned round, if it is a single loop; else nothing.
std::vector<std::uint32_t> boundaryLoop(std::span<const EdgeCount> open) {
    std::unordered_map<std::uint32_t, std::uint32_t> next;
    for (const auto& [edge, count] : open) {
        const auto low = std::uint32_t(edge >> 32), high = std::uint32_t(edge);
        const bool upwards = count > 0; // the lid walks the edge the other way
        if (std::abs(count) != 1 ||
            !next.try_emplace(upwards ? high : low, upwards ? low : high).second)
            return {};
    }
    if (next.size() < 3) return {};
    std::uint32_t start = next.begin()->first;
    for (const auto& [from, to] : next) start = std::min(start, from);
    std::vector<std::uint32_t> loop;
    for (std::uint32_t at = start; loop.empty() || at != start;) {
        const auto found = next.find(at);
        if (found == next.end() || loop.size() == next.size()) return {};
        loop.push_back(at);
        at = found->second;
    }
    return loop.size() == next.size() ? loop : std::vector<std::uint32_t>();
}

/// A plane, and how far off it a point still counts as on it [m].
struct Plane {
    glm::dvec3 origin, normal;
    double tolerance = 0;
    double height(glm::vec3 p) const { return glm::dot(glm::dvec3(p) - origin, normal); }
    bool holds(glm::vec3 p) const { return std::abs(height(p)) <= tolerance; }
};

/// Whether a convex face that lies in `plane` covers all of the outline.
bool covers(const SurfaceMesh& mesh, const SurfaceFace& face, const Plane& plane,
            std::span<const glm::vec3> outline) {
    const auto corners = mesh.cornersOf(face);
    for (std::uint32_t corner : corners)
        if (!plane.holds(mesh.points[corner])) return false;
    const glm::dvec3 normal = glm::normalize(newellNormal(mesh.points, corners));
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = mesh.points[corners[i]];
        const glm::dvec3 along = glm::dvec3(mesh.points[corners[(i + 1) % corners.size()]]) - a;
        const glm::dvec3 inwards = glm::cross(normal, along);
        for (glm::vec3 p : outline)
            if (glm::dot(inwards, glm::dvec3(p) - a) < -plane.tolerance * glm::length(along))
                return false;
    }
    return true;
}

/// Puts a lid on a component that stands with its only opening, a flat one, on a face of its own
/// object: the caps of keys on a keyboard. What another object would close stays open: that may
/// move away.
void close(const SurfaceMesh& mesh, std::span<const SurfaceMesh* const> object,
           std::vector<std::uint32_t> loop, Component& component) {
    if (loop.empty() || mesh.subdivided()) return;
    constexpr double kFlat = 1e-3; // in units of the component's size
    const glm::dvec3 normal = newellNormal(mesh.points, loop);
    if (!(glm::length(normal) > 0)) return;
    const Plane plane{mesh.points[loop[0]], glm::normalize(normal),
                      kFlat * component.bounds.diagonal()};
    std::vector<glm::vec3> outline;
    for (std::uint32_t point : loop) outline.push_back(mesh.points[point]);
    if (!std::all_of(outline.begin(), outline.end(), [&](glm::vec3 p) { return plane.holds(p); }))
        return;
    double lowest = 0, highest = 0;
    for (std::uint32_t f : component.faces)
        for (std::uint32_t corner : mesh.cornersOf(mesh.faces[f])) {
            lowest = std::min(lowest, plane.height(mesh.points[corner]));
            highest = std::max(highest, plane.height(mesh.points[corner]));
        }
    if (-lowest > plane.tolerance && highest > plane.tolerance) return; // on both sides
    if (std::max(-lowest, highest) <= plane.tolerance) return;          // a sheet
    const auto closes = [&](const SurfaceMesh& other) {
        return !other.subdivided() &&
               std::any_of(other.faces.begin(), other.faces.end(), [&](const SurfaceFace& face) {
                   return covers(other, face, plane, outline);
               });
    };
    if (std::none_of(object.begin(), object.end(), [&](const auto* m) { return closes(*m); }))
        return;
    component.closed = true;
    for (std::size_t i = 0; i < loop.size(); ++i)
        component.volume += glm::dot(
            glm::dvec3(outline[0]),
            glm::cross(glm::dvec3(outline[i]), glm::dvec3(outline[(i + 1) % outline.size()])));
    component.lid = std::move(loop);
}

std::vector<Component> connectedComponents(const SurfaceMesh& mesh,
                                           std::span<const SurfaceMesh* const> object) {
    const std::vector<std::uint32_t> weld = weldPoints(mesh.points);
    UnionFind joined(mesh.points.size());
    for (const SurfaceFace& face : mesh.faces)
        for (std::uint32_t corner : mesh.cornersOf(face))
            joined.join(weld[corner], weld[mesh.corners[face.firstCorner]]);

    std::unordered_map<std::uint32_t, std::uint32_t> index;
    std::vector<Component> components;
    std::vector<std::uint64_t> open; // sums over edges: 0 where each is gone along both ways
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        const auto corners = mesh.cornersOf(mesh.faces[f]);
        const std::uint32_t root = joined.find(weld[corners[0]]);
        const auto [found, fresh] = index.try_emplace(root, std::uint32_t(components.size()));
        if (fresh) components.emplace_back(), open.emplace_back();
        Component& component = components[found->second];
        component.faces.push_back(f);
        const glm::dvec3 apex = mesh.points[corners[0]];
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const std::uint32_t a = weld[corners[i]], b = weld[corners[(i + 1) % corners.size()]];
            component.bounds.add(mesh.points[a]);
            const std::uint64_t edge =
                mixHash(std::uint64_t(std::min(a, b)) << 32 | std::max(a, b), 0);
            open[found->second] += a < b ? edge : -edge;
            component.volume +=
                glm::dot(apex, glm::cross(glm::dvec3(mesh.points[a]), glm::dvec3(mesh.points[b])));
        }
    }
    for (std::size_t i = 0; i < components.size(); ++i) {
        components[i].closed = open[i] == 0;
        if (!components[i].closed)
            close(mesh, object, boundaryLoop(openEdges(mesh, weld, components[i])), components[i]);
    }
    return components;
}

/// Adds one face of a plain mesh as it is, or in triangles; those without area, of which nothing
/// can be seen, are not added. \return whether there were any others
bool addPolygon(SurfaceMesh& mesh, std::span<const std::uint32_t> corners,
                std::span<const glm::vec2> uvs, std::uint32_t source) {
    const std::size_t before = mesh.faces.size();
    const auto uvOf = [&](std::uint32_t corner) {
        return uvs[std::size_t(std::find(corners.begin(), corners.end(), corner) -
                               corners.begin())];
    };
    const auto add = [&](std::span<const std::uint32_t> face) {
        SurfaceFace added;
        added.firstCorner = std::uint32_t(mesh.corners.size());
        added.cornerCount = std::uint32_t(face.size());
        added.source = source;
        mesh.corners.insert(mesh.corners.end(), face.begin(), face.end());
        if (!uvs.empty())
            for (std::uint32_t corner : face) mesh.uvs.push_back(uvOf(corner));
        mesh.faces.push_back(added);
    };
    if (mesh.subdivided() || isConvex(mesh.points, corners))
        add(corners);
    else
        for (const auto& triangle : triangulate(mesh.points, corners))
            if (glm::length(newellNormal(mesh.points, triangle)) > 0) add(triangle);
    return mesh.faces.size() > before;
}

bool isFinite(glm::vec3 p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

bool usable(const SurfaceMesh& mesh, std::span<const std::uint32_t> corners) {
    if (corners.size() < 3 || corners.size() > kMostSides) return false;
    for (std::uint32_t corner : corners)
        if (!isFinite(mesh.points[corner])) return false;
    if (mesh.subdivided()) { // a cage must be sound topology; its area may vanish
        std::vector<std::uint32_t> sorted(corners.begin(), corners.end());
        std::sort(sorted.begin(), sorted.end());
        return std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
    }
    double longest = 0;
    for (std::size_t i = 0; i < corners.size(); ++i)
        longest = std::max<double>(
            longest,
            glm::distance(mesh.points[corners[i]], mesh.points[corners[(i + 1) % corners.size()]]));
    return longest > kLeastLength &&
           glm::length(newellNormal(mesh.points, corners)) > 1e-7 * longest * longest;
}

} // namespace

namespace {

ClosedPart closedPart(const SurfaceMesh& mesh, const Component& component) {
    ClosedPart part;
    part.bounds = component.bounds;
    const auto add = [&](std::span<const std::uint32_t> corners) {
        for (std::size_t i = 2; i < corners.size(); ++i)
            part.triangles.push_back(
                {mesh.points[corners[0]], mesh.points[corners[i - 1]], mesh.points[corners[i]]});
    };
    for (std::uint32_t f : component.faces) add(mesh.cornersOf(mesh.faces[f]));
    if (!component.lid.empty()) add(component.lid);
    return part;
}

} // namespace

std::vector<ClosedPart> closedParts(const SurfaceMesh& mesh,
                                    std::span<const SurfaceMesh* const> object) {
    std::vector<ClosedPart> parts;
    for (const Component& component : connectedComponents(mesh, object))
        if (component.closed && component.volume != 0) parts.push_back(closedPart(mesh, component));
    return parts;
}

glm::dvec3 newellNormal(std::span<const glm::vec3> points, std::span<const std::uint32_t> corners) {
    const glm::dvec3 origin = points[corners[0]];
    glm::dvec3 normal(0);
    for (std::size_t i = 0; i < corners.size(); ++i)
        normal += glm::cross(glm::dvec3(points[corners[i]]) - origin,
                             glm::dvec3(points[corners[(i + 1) % corners.size()]]) - origin);
    return normal;
}

namespace {

/// Brings the normals of the mesh's corners to the faces that were made of it.
/// \param weld of its points, empty: each is its own
void placeNormals(SurfaceMesh& mesh, std::span<const std::uint32_t> weld,
                  const glm::dmat4& toWorld) {
    const MeshData& data = *mesh.data;
    if (data.normals.empty() || weld.empty()) return;
    const glm::dmat3 turn = glm::transpose(glm::inverse(glm::dmat3(toWorld)));
    std::vector<std::size_t> first;
    std::size_t next = 0;
    for (const std::int32_t count : data.faceVertexCounts) {
        first.push_back(next);
        next += std::size_t(count);
    }
    for (const SurfaceFace& face : mesh.faces)
        for (const std::uint32_t corner : mesh.cornersOf(face)) {
            std::size_t at = first[face.source];
            while (weld[std::size_t(data.faceVertexIndices[at])] != corner) ++at;
            const glm::dvec3 normal = turn * glm::dvec3(data.normals[at]);
            const double length = glm::length(normal);
            mesh.normals.push_back(length > 0 && std::isfinite(length) ? glm::vec3(normal / length)
                                                                       : glm::vec3(0));
        }
}

} // namespace

SurfaceMesh placeSurface(const MeshData& data, const glm::dmat4& toWorld) {
    SurfaceMesh mesh;
    mesh.data = &data;
    mesh.points.reserve(data.points.size());
    for (glm::vec3 point : data.points)
        mesh.points.emplace_back(glm::vec3(toWorld * glm::dvec4(glm::dvec3(point), 1.0)));
    const bool mirrored = glm::determinant(glm::dmat3(toWorld)) < 0;

    // A cage's topology is its indices; polygons meet where their points are the same.
    const std::vector<std::uint32_t> weld =
        mesh.subdivided() ? std::vector<std::uint32_t>() : weldPoints(mesh.points);
    std::vector<std::uint32_t> corners;
    std::vector<glm::vec2> uvs;
    std::size_t first = 0;
    std::vector<bool> hole(data.faceVertexCounts.size());
    if (mesh.subdivided())
        for (std::int32_t face : data.holes)
            if (std::size_t(face) < hole.size()) hole[std::size_t(face)] = true;
    for (std::uint32_t f = 0; f < data.faceVertexCounts.size(); ++f) {
        const auto count = std::size_t(data.faceVertexCounts[f]);
        corners.assign(data.faceVertexIndices.begin() + std::ptrdiff_t(first),
                       data.faceVertexIndices.begin() + std::ptrdiff_t(first + count));
        if (!data.uvs.empty())
            uvs.assign(data.uvs.begin() + std::ptrdiff_t(first),
                       data.uvs.begin() + std::ptrdiff_t(first + count));
        first += count;
        if (hole[f]) continue;
        if (!weld.empty())
            for (std::uint32_t& corner : corners) corner = weld[corner];
        if (mirrored) {
            std::reverse(corners.begin(), corners.end());
            std::reverse(uvs.begin(), uvs.end());
        }
        if (usable(mesh, corners) && addPolygon(mesh, corners, uvs, f))
            ++mesh.used;
        else
            ++mesh.skipped;
    }
    placeNormals(mesh, weld, toWorld);
    if (!mesh.subdivided()) joinTriangles(mesh);
    return mesh;
}

void chooseSides(SurfaceMesh& mesh, std::span<const glm::vec3> lightPoints,
                 std::span<const SurfaceMesh* const> object) {
    for (const Component& component : connectedComponents(mesh, object)) {
        const ClosedPart part = closedPart(mesh, component);
        const bool solid =
            component.closed && component.volume != 0 && !part.containsAny(lightPoints);
        const bool twoSided = mesh.data->doubleSided;
        for (std::uint32_t f : component.faces) {
            SurfaceFace& face = mesh.faces[f];
            face.solid = solid && (twoSided || component.volume > 0);
            const bool insideOut = face.solid && component.volume < 0;
            face.front = !insideOut;
            const bool turned = solid && !face.solid; // or a room without a light
            face.back = insideOut || turned || (twoSided && !solid);
        }
    }
}

} // namespace penumbra
