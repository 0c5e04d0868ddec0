#include "radiosity/schedule/VertexClusters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace penumbra {

namespace {

constexpr std::uint32_t kBlock = PatchSet::kBlock;
constexpr std::size_t kLightSamples = 16, kSightSamples = 8; ///< vertices of a cluster

} // namespace

VertexClusters::VertexClusters(const PatchSet& patches, std::size_t most) : patches_(patches) {
    // Blocks of objects that are hidden now have a cluster as well: they may be shown later.
    std::vector<ReceiverCluster> blocks(patches.vertexBlockObject.size());
    std::vector<std::uint32_t> objects;
    for (std::uint32_t b = 0; b < blocks.size(); ++b) {
        objects.push_back(patches.vertexBlockObject[b].value);
        if (b < patches.firstPrivate / kBlock && // others are of any surface, here and there
            !patches.room.vertices.contains(b * kBlock))
            blocks[b].box.add(patches.vertices[b * kBlock].position);
    }
    clusters_ = clusterBlocks(blocks, objects, most);
    firstBlock_.assign(size(), 0);
    for (auto b = std::uint32_t(blocks.size()); b-- > 0;)
        if (clusters_.clusterOf[b] != ReceiverClusters::kNowhere)
            firstBlock_[clusters_.clusterOf[b]] = b;
    measure();
    for (std::uint32_t cluster = 0; cluster < size(); ++cluster) locate(cluster);
}

/// How large clusters are, and what they reflect. Each corner has its share of an element.
void VertexClusters::measure() {
    for (ReceiverCluster& cluster : clusters_.clusters) cluster.area = cluster.reflectance = 0;
    const auto blockOf = [&](std::uint32_t vertex) {
        std::uint32_t first = vertex;
        patches_.forEachReceiver(vertex, [&](std::uint32_t v, float) { first = v; });
        return first / kBlock;
    };
    area_.assign(patches_.firstPrivate, 0);
    reflectance_.assign(patches_.firstPrivate, 0);
    for (std::uint32_t e = 0; e < patches_.uncoveredElements.size(); ++e) {
        const Element& element = patches_.uncoveredElements[e];
        if (element.patch == Element::kNone) continue;
        const std::uint32_t block = blockOf(element.vertices[0]); // its corners are mostly in one
        if (block >= clusters_.clusterOf.size()) continue;
        ReceiverCluster& cluster = clusters_.clusters[clusters_.clusterOf[block]];
        const float area = elementArea(patches_, element);
        const float reflectance = luminance(elementReflectance(patches_, e));
        const std::size_t corners = element.isTriangle() ? 3 : 4;
        for (std::size_t k = 0; k < corners; ++k)
            patches_.forEachReceiver(element.vertices[k], [&](std::uint32_t v, float weight) {
                area_[v] += weight * area / float(corners);
                reflectance_[v] = reflectance;
            });
        cluster.area += area;
        cluster.reflectance += area * reflectance;
    }
    for (std::uint32_t p = 0; p < size(); ++p) {
        ReceiverCluster& cluster = clusters_.clusters[p];
        if (cluster.area > 0) cluster.reflectance /= cluster.area;
        cluster.area /= float(clusters_.blocks[p]);
    }
}

/// Calls visit(vertex index) for some of a cluster's vertices, spread evenly.
template <class Visit>
void VertexClusters::forSome(std::uint32_t cluster, std::size_t most, Visit visit) const {
    const std::size_t first = std::size_t(firstBlock_[cluster]) * kBlock;
    const std::size_t count = std::size_t(clusters_.blocks[cluster]) * kBlock;
    const std::size_t step = std::max<std::size_t>(1, count / most);
    for (std::size_t v = first; v < first + count; v += step)
        if (!isPadding(patches_.vertices[v].receiver)) visit(v);
}

void VertexClusters::locate(std::uint32_t index) {
    ReceiverCluster& cluster = clusters_.clusters[index];
    cluster.box = {};
    cluster.normal = glm::vec3(0);
    float count = 0;
    forSome(index, std::size_t(clusters_.blocks[index]) * kBlock, [&](std::size_t v) {
        cluster.box.add(patches_.vertices[v].receiver.position);
        cluster.normal += patches_.vertices[v].receiver.normal;
        count += 1;
    });
    if (count > 0) cluster.normal /= count;
}

void VertexClusters::follow(std::span<const ObjectId> objects) {
    for (std::uint32_t cluster = 0; cluster < size(); ++cluster)
        if (std::find(objects.begin(), objects.end(), objectOf(cluster)) != objects.end())
            locate(cluster);
}

Bounds VertexClusters::boundsOf(std::span<const ObjectId> objects) const {
    Bounds box;
    for (std::uint32_t cluster = 0; cluster < size(); ++cluster)
        if (std::find(objects.begin(), objects.end(), objectOf(cluster)) != objects.end())
            box.add(known(cluster).box);
    return box;
}

ReceiverCluster VertexClusters::at(std::uint32_t index, std::span<const Rgb> light) const {
    ReceiverCluster cluster = clusters_.clusters[index];
    float sum = 0, count = 0;
    forSome(index, kLightSamples, [&](std::size_t v) {
        sum += luminance(light[v]);
        count += 1;
    });
    if (count > 0)
        cluster.luminance = cluster.reflectance * sum / count * std::numbers::inv_pi_v<float>;
    return cluster;
}

ReceiverCluster VertexClusters::atVertex(std::size_t v, Rgb light) const {
    const Receiver& receiver = patches_.vertices[v].receiver;
    ReceiverCluster cluster;
    if (isPadding(receiver)) return cluster;
    if (v < patches_.firstPrivate) {
        cluster.area = area_[v];
        cluster.reflectance = reflectance_[v];
    } else {
        const std::uint32_t e = patches_.privateElement[v - patches_.firstPrivate];
        const Element& element = patches_.uncoveredElements[e];
        cluster.area = elementArea(patches_, element) / (element.isTriangle() ? 3 : 4);
        cluster.reflectance = luminance(elementReflectance(patches_, e));
    }
    const glm::vec3 half(0.5f * std::sqrt(cluster.area));
    cluster.box = {receiver.position - half, receiver.position + half};
    cluster.normal = receiver.normal;
    cluster.luminance = cluster.reflectance * luminance(light) * std::numbers::inv_pi_v<float>;
    return cluster;
}

std::vector<std::size_t> VertexClusters::spread(std::uint32_t cluster) const {
    std::vector<std::size_t> vertices;
    forSome(cluster, kSightSamples, [&](std::size_t v) { vertices.push_back(v); });
    return vertices;
}

} // namespace penumbra
