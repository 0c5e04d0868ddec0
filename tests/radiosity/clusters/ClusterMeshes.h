// Meshes to be clustered, and whether two clusterings are the same.
#pragma once

#include "radiosity/clusters/FaceClusters.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

namespace penumbra {

/// A mesh, and for each face a number that it keeps however faces are ordered.
struct ClusterMesh {
    std::vector<glm::vec3> points;
    std::vector<std::uint32_t> corners, first{0}, materials, ids;

    PolygonSoup soup() const { return {points, corners, first, materials}; }
    std::size_t size() const { return ids.size(); }
    std::uint32_t point(glm::vec3 p) {
        points.push_back(p);
        return std::uint32_t(points.size() - 1);
    }
    void face(std::vector<std::uint32_t> face, std::uint32_t material = 0) {
        corners.insert(corners.end(), face.begin(), face.end());
        first.push_back(std::uint32_t(corners.size()));
        materials.push_back(material);
        ids.push_back(std::uint32_t(ids.size()));
    }
};

/// A bumpy ball around `centre` of 4 stacks (stacks - 1) triangles, closed.
inline ClusterMesh bumpyBall(double radius, int stacks, glm::dvec3 centre = {0.3, -0.2, 0.1},
                             double bump = 0.05) {
    ClusterMesh mesh;
    const int slices = 2 * stacks;
    const auto place = [&](int i, int j) {
        const double t = std::numbers::pi * i / stacks, p = 2 * std::numbers::pi * j / slices;
        const double r = radius * (1 + bump * std::sin(7 * t) * std::sin(5 * p));
        return glm::vec3(centre + r * glm::dvec3(std::sin(t) * std::cos(p), std::cos(t),
                                                 std::sin(t) * std::sin(p)));
    };
    const std::uint32_t top = mesh.point(place(0, 0)), bottom = mesh.point(place(stacks, 0));
    for (int i = 1; i < stacks; ++i)
        for (int j = 0; j < slices; ++j) mesh.point(place(i, j));
    const auto id = [&](int i, int j) {
        return i == 0        ? top
               : i == stacks ? bottom
                             : std::uint32_t(2 + (i - 1) * slices + j % slices);
    };
    for (int i = 0; i < stacks; ++i)
        for (int j = 0; j < slices; ++j) {
            if (i > 0) mesh.face({id(i, j), id(i, j + 1), id(i + 1, j + 1)});
            if (i + 1 < stacks) mesh.face({id(i, j), id(i + 1, j + 1), id(i + 1, j)});
        }
    return mesh;
}

/// The same faces in another order, from other first corners, with their points in another order.
/// \param torn with points of their own, too
inline ClusterMesh shuffled(const ClusterMesh& mesh, unsigned seed, bool torn = false) {
    std::mt19937 random(seed);
    std::vector<std::uint32_t> points(mesh.points.size()), faces(mesh.size());
    std::iota(points.begin(), points.end(), 0u);
    std::iota(faces.begin(), faces.end(), 0u);
    std::shuffle(points.begin(), points.end(), random);
    std::shuffle(faces.begin(), faces.end(), random);
    ClusterMesh other;
    other.points.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) other.points[points[i]] = mesh.points[i];
    for (std::uint32_t face : faces) {
        std::vector<std::uint32_t> corners;
        for (std::uint32_t corner : mesh.soup().cornersOf(face))
            corners.push_back(torn ? other.point(mesh.points[corner]) : points[corner]);
        std::rotate(corners.begin(), corners.begin() + std::ptrdiff_t(random() % corners.size()),
                    corners.end());
        other.face(corners, mesh.materials[face]);
        other.ids.back() = mesh.ids[face];
    }
    return other;
}

/// The faces' lasting numbers, in their order.
inline std::vector<std::uint32_t> idsOf(const ClusterMesh& mesh,
                                        std::span<const std::uint32_t> faces) {
    std::vector<std::uint32_t> ids;
    for (std::uint32_t face : faces) ids.push_back(mesh.ids[face]);
    return ids;
}

inline bool sameBits(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}
inline bool sameBits(glm::vec3 a, glm::vec3 b) {
    return sameBits(a.x, b.x) && sameBits(a.y, b.y) && sameBits(a.z, b.z);
}

/// Whether two clusterings agree bit for bit, but for the numbers of the faces. Faces that coincide
/// may stand for each other: with `coincident` set, only how many faces there are is compared.
inline bool same(const ClusterMesh& meshA, const FaceClusters& a, const ClusterMesh& meshB,
                 const FaceClusters& b, bool coincident = false) {
    const auto sameSums = [](const auto& x, const auto& y) {
        return x.firstFace == y.firstFace && x.faceCount == y.faceCount &&
               sameBits(x.vectorArea, y.vectorArea) && sameBits(x.area, y.area) &&
               sameBits(x.centroid, y.centroid);
    };
    const auto sameCluster = [&](const FaceCluster& x, const FaceCluster& y) {
        return sameSums(x, y) && x.address == y.address && x.material == y.material &&
               x.firstSub == y.firstSub && x.subCount == y.subCount &&
               sameBits(x.extent, y.extent) && sameBits(x.normal, y.normal) && x.fuzzy == y.fuzzy;
    };
    return std::ranges::equal(a.clusters, b.clusters, sameCluster) &&
           std::ranges::equal(a.subClusters, b.subClusters, sameSums) &&
           a.faces.size() == b.faces.size() && a.large.size() == b.large.size() &&
           a.dropped.size() == b.dropped.size() &&
           (coincident || (idsOf(meshA, a.faces) == idsOf(meshB, b.faces) &&
                           idsOf(meshA, a.large) == idsOf(meshB, b.large)));
}

} // namespace penumbra
