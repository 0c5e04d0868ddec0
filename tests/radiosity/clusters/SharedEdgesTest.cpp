// Faces at edges, in a mesh where they can be counted.
#include "radiosity/clusters/SharedEdges.h"
#include "tests/radiosity/clusters/ClusterMeshes.h"

#include <gtest/gtest.h>

#include <set>

namespace penumbra {

namespace {

TEST(SharedEdges, OfAClosedMeshOfTrianglesAreThreeHalvesOfItsFaces) {
    const ClusterMesh mesh = shuffled(bumpyBall(0.5, 20), 1, true); // welded before
    const AddressedFaces faces = addressFaces(mesh.soup(), {});
    const auto pairs = facesAtEdges(faces);
    EXPECT_EQ(pairs.size(), 3 * mesh.size() / 2);
    EXPECT_EQ(std::set(pairs.begin(), pairs.end()).size(), pairs.size());
    for (const auto& [a, b] : pairs) EXPECT_LT(a, b);
}

TEST(SharedEdges, WithThreeFacesLinkEachToTheNext) {
    ClusterMesh mesh;
    const auto a = mesh.point({0, 0, 0}), b = mesh.point({0, 0, 0.1f});
    for (const glm::vec3 p : {glm::vec3(0.1f, 0, 0), glm::vec3(0, 0.1f, 0), glm::vec3(-0.1f, 0, 0)})
        mesh.face({a, b, mesh.point(p)});
    EXPECT_EQ(facesAtEdges(addressFaces(mesh.soup(), {})).size(), 2u);
}

} // namespace

} // namespace penumbra
