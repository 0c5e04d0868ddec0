// Face clusters: the same however a mesh is written down, within their limits, and local.
#include "radiosity/clusters/FaceClusters.h"
#include "tests/radiosity/clusters/ClusterMeshes.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <set>

namespace penumbra {

namespace {

/// A tube along x of quads, open at its ends.
ClusterMesh tube(double radius, double length, int around, int along) {
    ClusterMesh mesh;
    for (int i = 0; i <= along; ++i)
        for (int j = 0; j < around; ++j) {
            const double angle = 2 * std::numbers::pi * j / around;
            mesh.point(
                glm::dvec3(length * i / along, radius * std::cos(angle), radius * std::sin(angle)));
        }
    const auto id = [&](int i, int j) { return std::uint32_t(i * around + j % around); };
    for (int i = 0; i < along; ++i)
        for (int j = 0; j < around; ++j)
            mesh.face({id(i, j), id(i, j + 1), id(i + 1, j + 1), id(i + 1, j)});
    return mesh;
}

void addSquare(ClusterMesh& mesh, glm::vec3 corner, float edge, std::uint32_t material = 0) {
    const std::uint32_t a = mesh.point(corner), b = mesh.point(corner + glm::vec3(edge, 0, 0));
    const std::uint32_t c = mesh.point(corner + glm::vec3(edge, edge, 0));
    const std::uint32_t d = mesh.point(corner + glm::vec3(0, edge, 0));
    mesh.face({a, b, c, d}, material);
}

/// A ball, a tube, slats with gaps and a large square: all stages have something to do.
ClusterMesh furniture() {
    ClusterMesh mesh = bumpyBall(0.5, 40);
    const auto add = [&](const ClusterMesh& other, glm::vec3 offset) {
        const auto base = std::uint32_t(mesh.points.size());
        for (glm::vec3 p : other.points) mesh.point(p + offset);
        for (std::size_t face = 0; face < other.size(); ++face) {
            std::vector<std::uint32_t> corners;
            for (std::uint32_t corner : other.soup().cornersOf(face))
                corners.push_back(base + corner);
            mesh.face(corners, 1);
        }
    };
    add(tube(0.01, 0.6, 12, 30), {0.8f, 0.1f, 0.2f});
    add(tube(0.2, 0.6, 24, 10), {-0.7f, 1.0f, 0.2f});
    for (int i = 0; i < 40; ++i) addSquare(mesh, {0.07f * float(i), 1.5f, -0.0f}, 0.05f, 2);
    addSquare(mesh, {0, 0, 2}, 1, 2);
    return mesh;
}

glm::vec3 normalOf(const ClusterMesh& mesh, std::uint32_t face) {
    const auto corners = mesh.soup().cornersOf(face);
    const auto at = [&](std::size_t i) { return mesh.points[corners[i]]; };
    return glm::normalize(glm::cross(at(1) - at(0), at(2) - at(0)));
}

TEST(FaceClusters, AreTheSameInAnyOrderOfFaces) {
    const ClusterMesh mesh = furniture();
    const FaceClusters clusters = clusterFaces(mesh.soup());
    EXPECT_GT(clusters.clusters.size(), 50u);
    for (unsigned seed = 1; seed <= 8; ++seed) {
        const ClusterMesh other = shuffled(mesh, seed);
        EXPECT_TRUE(same(mesh, clusters, other, clusterFaces(other.soup()))) << seed;
    }
}

TEST(FaceClusters, AreTheSameWithPointsOfTheirOwnForEveryFace) {
    const ClusterMesh mesh = furniture(), torn = shuffled(mesh, 1, true);
    EXPECT_TRUE(same(mesh, clusterFaces(mesh.soup()), torn, clusterFaces(torn.soup())));
}

TEST(FaceClusters, AreTheSameWithNegativeZeros) {
    ClusterMesh mesh = bumpyBall(0.5, 20, {0, 0, 0}, 0), other = mesh;
    for (glm::vec3& p : other.points)
        for (int i = 0; i < 3; ++i)
            if (p[i] == 0) p[i] = -p[i];
    EXPECT_TRUE(same(mesh, clusterFaces(mesh.soup()), other, clusterFaces(other.soup())));
}

TEST(FaceClusters, CoverEveryFaceOnce) {
    const ClusterMesh mesh = furniture();
    const FaceClusters clusters = clusterFaces(mesh.soup());
    std::vector<std::uint32_t> all = clusters.faces;
    all.insert(all.end(), clusters.large.begin(), clusters.large.end());
    all.insert(all.end(), clusters.dropped.begin(), clusters.dropped.end());
    std::sort(all.begin(), all.end());
    std::vector<std::uint32_t> expected(mesh.size());
    std::iota(expected.begin(), expected.end(), 0u);
    EXPECT_EQ(all, expected);
    std::uint32_t next = 0; // clusters and sub-clusters divide the list
    for (const FaceCluster& cluster : clusters.clusters)
        for (const SubCluster& sub : clusters.subClustersOf(cluster)) {
            EXPECT_EQ(sub.firstFace, next);
            EXPECT_GT(sub.faceCount, 0u);
            next += sub.faceCount;
        }
    EXPECT_EQ(next, clusters.faces.size());
}

TEST(FaceClusters, KeepWithinSizeAndCone) {
    const ClusterMesh mesh = furniture();
    for (const float cosine : {0.93969262f, 0.86602540f, 0.70710678f, 0.5f}) { // 20 ... 60 degrees
        const FaceClusters clusters = clusterFaces(mesh.soup(), {.coneCosine = cosine});
        for (const FaceCluster& cluster : clusters.clusters) {
            EXPECT_LE(cluster.extent, cluster.fuzzy ? 0.24f : 0.4f);
            EXPECT_LE(cluster.subCount, 16u);
            if (cluster.fuzzy) continue;
            for (std::uint32_t face : clusters.facesOf(cluster))
                EXPECT_GE(glm::dot(normalOf(mesh, face), cluster.normal), cosine - 1e-5f);
        }
    }
}

TEST(FaceClusters, AreOfOneMaterial) {
    const ClusterMesh mesh = furniture();
    const FaceClusters clusters = clusterFaces(mesh.soup());
    for (const FaceCluster& cluster : clusters.clusters)
        for (std::uint32_t face : clusters.facesOf(cluster))
            EXPECT_EQ(mesh.materials[face], cluster.material);
}

TEST(FaceClusters, HaveNamesOfTheirOwn) {
    const ClusterMesh mesh = furniture();
    std::set<std::uint64_t> names;
    const FaceClusters clusters = clusterFaces(mesh.soup());
    for (const FaceCluster& cluster : clusters.clusters) names.insert(cluster.address);
    EXPECT_EQ(names.size(), clusters.clusters.size());
}

TEST(FaceClusters, AreAsManyForAMillionTrianglesAsForAThousand) {
    // A ball of area 4.5 m^2 has at least 2 A / s^2 = 57 clusters, whatever its triangles.
    std::vector<std::size_t> counts;
    for (int stacks : {16, 50, 160, 501}) // 960, 9,800, 101,760 and 1,002,000 triangles
        counts.push_back(clusterFaces(bumpyBall(0.6, stacks).soup()).clusters.size());
    for (std::size_t count : counts) {
        EXPECT_GT(count, 57u);
        EXPECT_LT(double(count), 1.3 * double(counts[1]));
        EXPECT_GT(double(count), 0.7 * double(counts[1]));
    }
}

TEST(FaceClusters, OneMovedVertexChangesAFewNearby) {
    // Merging is a cascade, but a short one.
    const ClusterMesh mesh = bumpyBall(1.5, 100);
    const auto setsOf = [&](const ClusterMesh& of) {
        std::set<std::vector<std::uint32_t>> sets;
        const FaceClusters clusters = clusterFaces(of.soup());
        for (const FaceCluster& cluster : clusters.clusters) {
            const auto faces = clusters.facesOf(cluster);
            std::vector<std::uint32_t> set(faces.begin(), faces.end());
            std::sort(set.begin(), set.end());
            sets.insert(set);
        }
        return sets;
    };
    const auto before = setsOf(mesh);
    for (std::size_t vertex = 100; vertex < mesh.points.size(); vertex += 2500) {
        ClusterMesh moved = mesh;
        moved.points[vertex] *= 1.001f;
        const auto after = setsOf(moved);
        std::size_t changed = 0;
        float farthest = 0;
        for (const auto& set : before) {
            if (after.contains(set)) continue;
            ++changed;
            for (std::uint32_t face : set)
                for (std::uint32_t corner : mesh.soup().cornersOf(face))
                    farthest =
                        std::max(farthest, glm::distance(mesh.points[corner], mesh.points[vertex]));
        }
        EXPECT_LE(changed, 20u) << "of " << before.size();
        EXPECT_LE(farthest, 1.2f);
    }
}

TEST(FaceClusters, OfAClosedMeshHaveVectorAreasThatSumToZero) {
    const ClusterMesh mesh = bumpyBall(0.5, 60);
    glm::dvec3 sum(0);
    double area = 0;
    for (const FaceCluster& cluster : clusterFaces(mesh.soup()).clusters) {
        sum += glm::dvec3(cluster.vectorArea);
        area += double(cluster.area);
    }
    EXPECT_LT(glm::length(sum), 1e-6 * area);
}

TEST(FaceClusters, AreTheSumOfTheirSubClusters) {
    const ClusterMesh mesh = furniture();
    const FaceClusters clusters = clusterFaces(mesh.soup());
    for (const FaceCluster& cluster : clusters.clusters) {
        double area = 0;
        glm::dvec3 vectorArea(0), first(0);
        for (const SubCluster& sub : clusters.subClustersOf(cluster)) {
            area += double(sub.area);
            vectorArea += glm::dvec3(sub.vectorArea);
            first += double(sub.area) * glm::dvec3(sub.centroid);
        }
        EXPECT_NEAR(area, cluster.area, 1e-6 * area);
        EXPECT_LT(glm::distance(vectorArea, glm::dvec3(cluster.vectorArea)), 1e-6 * area);
        EXPECT_LT(glm::distance(first / area, glm::dvec3(cluster.centroid)), 1e-6);
    }
}

TEST(FaceClusters, LeaveLargeFacesToTheCaller) {
    ClusterMesh mesh;
    addSquare(mesh, {0, 0, 0}, 0.15f); // diagonal .21 m: more than half of .4 m
    addSquare(mesh, {1, 0, 0}, 0.14f); // .198 m
    const FaceClusters clusters = clusterFaces(mesh.soup());
    EXPECT_EQ(clusters.large, std::vector<std::uint32_t>{0});
    EXPECT_EQ(clusters.faces, std::vector<std::uint32_t>{1});
}

TEST(FaceClusters, DropFacesTwiceThereButKeepTheirBacks) {
    ClusterMesh mesh;
    addSquare(mesh, {0, 0, 0}, 0.1f);
    addSquare(mesh, {0, 0, 0}, 0.1f);
    mesh.face({7, 6, 5, 4}); // the back of the second
    EXPECT_EQ(clusterFaces(mesh.soup()).dropped, std::vector<std::uint32_t>{1});
    EXPECT_EQ(clusterFaces(mesh.soup()).faces.size(), 2u);
}

TEST(FaceClusters, DropFacesWithoutAreaOrPlace) {
    ClusterMesh mesh;
    addSquare(mesh, {0, 0, 0}, 0.1f);
    const std::uint32_t nowhere = mesh.point(glm::vec3(std::numeric_limits<float>::quiet_NaN()));
    const std::uint32_t far = mesh.point({std::numeric_limits<float>::infinity(), 0, 0});
    mesh.face({0, 1, nowhere});
    mesh.face({0, 1, far});
    mesh.face({0, 1, 1, 0});
    mesh.face({0, 1});
    const FaceClusters clusters = clusterFaces(mesh.soup());
    EXPECT_EQ(clusters.dropped, (std::vector<std::uint32_t>{1, 2, 3, 4}));
    EXPECT_EQ(clusters.clusters.size(), 1u);
    EXPECT_TRUE(clusterFaces({}).clusters.empty());
}

TEST(FaceClusters, JoinSlatsAcrossGaps) {
    ClusterMesh mesh;
    for (int i = 0; i < 4; ++i) addSquare(mesh, {0.08f * float(i), 0, 0}, 0.05f);
    const FaceClusters near = clusterFaces(mesh.soup());
    EXPECT_EQ(near.clusters.size(), 1u);
    EXPECT_FALSE(near.clusters[0].fuzzy);
    ClusterMesh apart;
    for (int i = 0; i < 4; ++i) addSquare(apart, {0.16f * float(i), 0, 0}, 0.05f); // .11 > .1 m
    EXPECT_EQ(clusterFaces(apart.soup()).clusters.size(), 4u);
}

TEST(FaceClusters, OfAThinTubeAreFuzzy) {
    const ClusterMesh mesh = tube(0.01, 0.2, 12, 10);
    const FaceClusters clusters = clusterFaces(mesh.soup());
    ASSERT_EQ(clusters.clusters.size(), 1u);
    EXPECT_TRUE(clusters.clusters[0].fuzzy);
    EXPECT_GT(clusters.clusters[0].subCount, 3u);
    EXPECT_LT(glm::length(clusters.clusters[0].vectorArea), 1e-6f);
}

} // namespace

} // namespace penumbra
