#include "radiosity/surface/FaceGroups.h"

#include "radiosity/surface/FaceClusters.h"

#include <algorithm>

namespace penumbra {

std::vector<std::vector<std::uint32_t>> groupFaces(std::span<const WholeFace> faces,
                                                   float patchSize, float elementSize) {
    constexpr float kSize = 0.5f;     // of a patch: light is received once a cluster
    constexpr float kSmall = 2;       // elements: what is larger is a patch of its own
    constexpr std::size_t kLeast = 3; // faces: two triangles are as good as they are
    std::vector<glm::vec3> points;
    std::vector<std::uint32_t> corners, firstCorner{0}, materials;
    for (const WholeFace& face : faces) {
        for (const glm::vec3 point : face.outline) {
            corners.push_back(std::uint32_t(points.size()));
            points.push_back(point);
        }
        firstCorner.push_back(std::uint32_t(corners.size()));
        materials.push_back(face.material);
    }
    FaceClusterOptions options;
    options.size = kSize * patchSize;
    options.largeShare = std::min(1.0f, kSmall * elementSize / options.size);
    options.fuzzyShare = 0; // what receives at one place has to look one way
    const FaceClusters clusters = clusterFaces({points, corners, firstCorner, materials}, options);
    std::vector<std::vector<std::uint32_t>> groups;
    for (const FaceCluster& cluster : clusters.clusters) {
        const auto own = clusters.facesOf(cluster);
        if (own.size() >= kLeast) groups.emplace_back(own.begin(), own.end());
    }
    return groups;
}

} // namespace penumbra
