#include "radiosity/clusters/MicroClusters.h"

#include "radiosity/clusters/SharedEdges.h"
#include "radiosity/surface/UnionFind.h"

#include <algorithm>
#include <numeric>

namespace penumbra {

namespace {

using FacePairs = std::vector<std::array<std::uint32_t, 2>>;

/// Numbers the sets by address and fills ofFace, addresses and materials.
void number(MicroClusters& micro, const AddressedFaces& faces, UnionFind& sets) {
    const std::size_t count = faces.size();
    micro.ofFace.resize(count);
    std::vector<std::uint32_t> roots; // of the faces, the first of each set
    std::vector<std::uint64_t> least;
    for (std::uint32_t face = 0; face < count; ++face) {
        const std::uint32_t root = sets.find(face); // the least member, so met first
        if (root == face) {
            micro.ofFace[face] = std::uint32_t(roots.size());
            roots.push_back(face);
            least.push_back(faces.keys[face].address);
        } else {
            const std::uint32_t set = micro.ofFace[face] = micro.ofFace[root];
            least[set] = std::min(least[set], faces.keys[face].address);
        }
    }
    std::vector<std::uint32_t> order(roots.size()), rank(roots.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return least[a] != least[b] ? least[a] < least[b] : a < b;
    });
    for (std::uint32_t i = 0; i < order.size(); ++i) {
        rank[order[i]] = i;
        micro.addresses.push_back(least[order[i]]);
        micro.materials.push_back(faces.keys[roots[order[i]]].material);
    }
    for (std::uint32_t& set : micro.ofFace) set = rank[set];
}

/// Sums over the faces, in their order, and cones around the mean normals.
void measure(MicroClusters& micro, const AddressedFaces& faces) {
    micro.parts.resize(micro.addresses.size());
    micro.cones.resize(micro.addresses.size());
    std::vector<glm::vec3> normals(faces.size());
    for (std::size_t face = 0; face < faces.size(); ++face) {
        ClusterPart& part = micro.parts[micro.ofFace[face]];
        const FaceMoments moments = momentsOf(faces.points, faces.cornersOf(face));
        normals[face] = glm::vec3(moments.normal());
        part.moments.add(moments);
        for (std::uint32_t corner : faces.cornersOf(face)) part.slabs.add(faces.points[corner]);
    }
    for (std::size_t i = 0; i < micro.size(); ++i)
        micro.cones[i].axis = micro.parts[i].moments.normal();
    for (std::size_t face = 0; face < faces.size(); ++face) {
        NormalCone& cone = micro.cones[micro.ofFace[face]];
        cone.cosine = std::min(cone.cosine, glm::dot(cone.axis, glm::dvec3(normals[face])));
    }
}

} // namespace

MicroClusters clusterByCells(const AddressedFaces& faces) {
    FacePairs pairs = facesAtEdges(faces);
    UnionFind sets(faces.size());
    for (const auto& [a, b] : pairs)
        if (faces.keys[a].sharesCell(faces.keys[b])) sets.join(a, b);

    MicroClusters micro;
    number(micro, faces, sets);
    std::size_t kept = 0;
    for (const auto& [a, b] : pairs) {
        const auto [low, high] = std::minmax(micro.ofFace[a], micro.ofFace[b]);
        if (low != high && micro.materials[low] == micro.materials[high])
            pairs[kept++] = {low, high};
    }
    pairs.resize(kept);
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    pairs.shrink_to_fit();
    micro.touching = std::move(pairs);
    measure(micro, faces);
    return micro;
}

} // namespace penumbra
