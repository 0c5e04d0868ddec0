#include "radiosity/clusters/FaceGroups.h"

#include "radiosity/clusters/FaceClusters.h"

#include <algorithm>
#include <array>

namespace penumbra {

namespace {

struct Shape {
    float extent = 0; ///< [m]
    float width = 0;  ///< [m]
};

Shape shapeOf(const FacePiece& face) {
    Shape shape;
    glm::vec3 twiceArea(0);
    for (std::size_t i = 0; i < face.outline.size(); ++i)
        for (std::size_t j = i + 1; j < face.outline.size(); ++j)
            shape.extent = std::max(shape.extent, glm::distance(face.outline[i], face.outline[j]));
    for (std::size_t i = 2; i < face.outline.size(); ++i)
        twiceArea +=
            glm::cross(face.outline[i - 1] - face.outline[0], face.outline[i] - face.outline[0]);
    shape.width = shape.extent > 0 ? 0.5f * glm::length(twiceArea) / shape.extent : 0;
    return shape;
}

/// Those of `faces` that are listed, in clusters of at most a size.
/// \param thread of this width a face is a cluster on its own [m]
void cluster(std::span<const FacePiece> faces, std::span<const std::uint32_t> listed, float size,
             float thread, std::vector<std::vector<std::uint32_t>>& groups) {
    constexpr std::size_t kLeast = 3; // faces: two triangles are as good as they are
    std::vector<glm::vec3> points;
    std::vector<std::uint32_t> corners, firstCorner{0}, materials;
    for (const std::uint32_t f : listed) {
        for (const glm::vec3 point : faces[f].outline) {
            corners.push_back(std::uint32_t(points.size()));
            points.push_back(point);
        }
        firstCorner.push_back(std::uint32_t(corners.size()));
        materials.push_back(faces[f].material);
    }
    FaceClusterOptions options;
    options.size = size;
    options.largeShare = 1;
    options.fuzzyShare = 0; // what receives at one place has to look one way
    const FaceClusters clusters = clusterFaces({points, corners, firstCorner, materials}, options);
    for (const FaceCluster& cluster : clusters.clusters) {
        const auto own = clusters.facesOf(cluster);
        const auto isThread = [&](std::uint32_t f) {
            return shapeOf(faces[listed[f]]).width < thread;
        };
        if (own.size() < kLeast && !std::all_of(own.begin(), own.end(), isThread)) continue;
        auto& group = groups.emplace_back();
        for (const std::uint32_t f : own) group.push_back(listed[f]);
    }
}

} // namespace

std::vector<std::vector<std::uint32_t>> groupFaces(std::span<const FacePiece> faces,
                                                   float patchSize, float elementSize) {
    const float small = std::min(2 * elementSize, 0.5f * patchSize); // extent of small faces
    const float narrow = std::min(elementSize, 0.125f * patchSize);  // width of slivers
    const float thread = 0.25f * narrow; // of this width one node is enough, whatever is around
    // Faces meet others of about their length only: light is received once a cluster. Of a whole
    // patch or more they would send too little where they are curved.
    constexpr std::array kSizes{0.5f, 1.0f, 2.0f}; // patches
    std::array<std::vector<std::uint32_t>, kSizes.size()> listed;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        const Shape shape = shapeOf(faces[f]);
        if (shape.extent >= small && shape.width >= narrow) continue; // a patch of its own
        const auto size = std::find_if(kSizes.begin(), kSizes.end(), [&](float share) {
            return shape.extent <= share * patchSize;
        });
        if (size != kSizes.end()) listed[std::size_t(size - kSizes.begin())].push_back(f);
    }
    std::vector<std::vector<std::uint32_t>> groups;
    for (std::size_t k = 0; k < kSizes.size(); ++k)
        cluster(faces, listed[k], kSizes[k] * patchSize, thread, groups);
    return groups;
}

} // namespace penumbra
