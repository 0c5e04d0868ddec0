#include "radiosity/clusters/FaceClusters.h"

#include "radiosity/clusters/ClusterMerger.h"
#include "radiosity/clusters/MicroClusters.h"
#include "radiosity/clusters/NearPairs.h"

#include <cassert>
#include <cmath>
#include <numeric>

namespace penumbra {

namespace {

/// Bins along either axis of the map of normals. Normals of a bin are up to 35 degrees apart where
/// there are twelve: that is for a cone of 45 degrees, narrower ones have more.
std::uint32_t binsFor(double coneCosine) {
    const double sine = std::sqrt(std::max(1e-4, 1 - coneCosine * coneCosine));
    const auto pairs = std::uint32_t(std::ceil(6 * 0.707 / sine));
    return 2 * std::max(6u, pairs);
}

FaceGrid gridFor(const FaceClusterOptions& options) {
    return {0.25 * options.size, binsFor(options.coneCosine),
            double(options.largeShare) * options.size};
}

/// Merges parts that need not touch, those below `widest` alone.
void mergeAcrossGaps(ClusterMerger& merger, const FaceClusterOptions& options, float widest,
                     const MergeLimits& limits) {
    std::vector<std::uint32_t> parts = merger.parts();
    std::erase_if(parts,
                  [&](std::uint32_t part) { return !(merger.part(part).slabs.extent() < widest); });
    std::vector<Bounds> boxes;
    for (std::uint32_t part : parts)
        boxes.push_back({merger.part(part).slabs.lower(), merger.part(part).slabs.upper()});
    auto pairs = nearPairs(boxes, 0.25f * options.size, options.neighbours,
                           [&](std::uint32_t a, std::uint32_t b) {
                               return merger.mayMerge(parts[a], parts[b], limits);
                           });
    for (auto& [a, b] : pairs) a = parts[a], b = parts[b];
    merger.merge(pairs, limits);
}

void mergeAll(ClusterMerger& merger, const MicroClusters& micro,
              const FaceClusterOptions& options) {
    const float size = options.size;
    merger.merge(micro.touching, {.extent = size});
    mergeAcrossGaps(merger, options, size, {.extent = size});
    const float fuzzy = options.fuzzyShare * size;
    mergeAcrossGaps(merger, options, fuzzy,
                    {.extent = fuzzy, .area = 0.125 * size * size, .coherent = false});
}

/// Puts the clusters together from what was merged.
class Assembly {
public:
    Assembly(const AddressedFaces& faces, const MicroClusters& micro, const ClusterMerger& merger)
        : faces_(faces), micro_(micro), merger_(merger), subOfMicro_(micro.size()) {}

    FaceClusters run(const FaceClusterOptions& options) {
        for (std::uint32_t part : merger_.parts()) addCluster(part, options.subClusters);
        placeFaces();
        sum();
        return std::move(out_);
    }

private:
    void addCluster(std::uint32_t part, std::size_t most) {
        FaceCluster cluster;
        cluster.address = micro_.addresses[part];
        cluster.material = micro_.materials[part];
        cluster.extent = merger_.part(part).slabs.extent();
        cluster.fuzzy = !merger_.withinCone(part);
        cluster.firstSub = std::uint32_t(out_.subClusters.size());
        for (std::uint32_t node : merger_.cut(part, most)) {
            merger_.forEachLeaf(node, [&](std::uint32_t micro) {
                subOfMicro_[micro] = std::uint32_t(out_.subClusters.size());
            });
            out_.subClusters.emplace_back();
            clusterOfSub_.push_back(std::uint32_t(out_.clusters.size()));
        }
        cluster.subCount = std::uint32_t(out_.subClusters.size()) - cluster.firstSub;
        out_.clusters.push_back(cluster);
    }

    /// Lists the faces by sub-cluster, and within it by address.
    void placeFaces() {
        for (std::uint32_t micro : micro_.ofFace) ++out_.subClusters[subOfMicro_[micro]].faceCount;
        std::uint32_t next = 0;
        for (SubCluster& sub : out_.subClusters) {
            sub.firstFace = next;
            next += sub.faceCount;
            sub.faceCount = 0;
        }
        out_.faces.resize(next);
        for (std::size_t face = 0; face < faces_.size(); ++face) {
            SubCluster& sub = out_.subClusters[subOfMicro_[micro_.ofFace[face]]];
            out_.faces[sub.firstFace + sub.faceCount++] = faces_.source[face];
        }
        for (FaceCluster& cluster : out_.clusters) {
            cluster.firstFace = out_.subClusters[cluster.firstSub].firstFace;
            for (const SubCluster& sub : out_.subClustersOf(cluster))
                cluster.faceCount += sub.faceCount;
        }
    }

    /// Sums anew in the order of the faces: a cluster's numbers follow from its faces, and not from
    /// the order in which they were merged.
    void sum() {
        std::vector<FaceMoments> clusters(out_.clusters.size()), subs(out_.subClusters.size());
        for (std::size_t face = 0; face < faces_.size(); ++face) {
            const FaceMoments moments = momentsOf(faces_.points, faces_.cornersOf(face));
            const std::uint32_t sub = subOfMicro_[micro_.ofFace[face]];
            subs[sub].add(moments);
            clusters[clusterOfSub_[sub]].add(moments);
        }
        for (std::size_t i = 0; i < subs.size(); ++i) set(out_.subClusters[i], subs[i]);
        for (std::size_t i = 0; i < clusters.size(); ++i) {
            set(out_.clusters[i], clusters[i]);
            out_.clusters[i].normal = glm::vec3(clusters[i].normal());
        }
    }
    template <class Target>
    static void set(Target& target, const FaceMoments& moments) {
        target.vectorArea = glm::vec3(moments.vectorArea);
        target.area = float(moments.area);
        target.centroid = glm::vec3(moments.centroid());
    }

    const AddressedFaces& faces_;
    const MicroClusters& micro_;
    const ClusterMerger& merger_;
    std::vector<std::uint32_t> subOfMicro_, clusterOfSub_;
    FaceClusters out_;
};

} // namespace

FaceClusters clusterFaces(const PolygonSoup& soup, const FaceClusterOptions& options) {
    assert(options.size > 0 && options.largeShare <= 1 && options.subClusters > 0);
    AddressedFaces faces = addressFaces(soup, gridFor(options));
    const MicroClusters micro = clusterByCells(faces);
    ClusterMerger merger(micro, {options.size, options.coneCosine, options.flatness});
    mergeAll(merger, micro, options);
    FaceClusters clusters = Assembly(faces, micro, merger).run(options);
    clusters.large = std::move(faces.large);
    clusters.dropped = std::move(faces.dropped);
    return clusters;
}

} // namespace penumbra
