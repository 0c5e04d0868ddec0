#include "radiosity/VertexPlaces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace penumbra {

namespace {

constexpr std::uint32_t kBlock = PatchSet::kBlock;
constexpr std::size_t kLightSamples = 16, kSightSamples = 8; ///< vertices of a place

} // namespace

VertexPlaces::VertexPlaces(const PatchSet& patches, std::size_t most) : patches_(patches) {
    // Blocks of objects that are hidden now have a place as well: they may be shown later.
    std::vector<WorkPlace> blocks(patches.vertexBlockObject.size());
    std::vector<std::uint32_t> objects;
    for (std::uint32_t b = 0; b < blocks.size(); ++b) {
        objects.push_back(patches.vertexBlockObject[b].value);
        if (b < patches.firstPrivate / kBlock) // others are of any surface, here and there
            blocks[b].box.add(patches.vertices[b * kBlock].position);
    }
    clusters_ = clusterBlocks(blocks, objects, most);
    firstBlock_.assign(size(), 0);
    for (auto b = std::uint32_t(blocks.size()); b-- > 0;)
        if (clusters_.placeOf[b] != PlaceClusters::kNowhere) firstBlock_[clusters_.placeOf[b]] = b;
    measure();
    for (std::uint32_t place = 0; place < size(); ++place) locate(place);
}

/// How large places are, and what they reflect. Each corner has its share of an element.
void VertexPlaces::measure() {
    for (WorkPlace& place : clusters_.places) place.area = place.reflectance = 0;
    area_.assign(patches_.firstPrivate, 0);
    reflectance_.assign(patches_.firstPrivate, 0);
    for (std::size_t e = 0; e < patches_.uncoveredElements.size(); ++e) {
        const Element& element = patches_.uncoveredElements[e];
        if (element.patch == Element::kNone) continue;
        const std::uint32_t block = element.vertices[0] / kBlock; // its corners are mostly in one
        if (block >= clusters_.placeOf.size()) continue;
        WorkPlace& place = clusters_.places[clusters_.placeOf[block]];
        const float area = elementArea(patches_, element);
        const float reflectance = luminance(patches_.materials[element.material].reflectance);
        const std::size_t corners = element.isTriangle() ? 3 : 4;
        for (std::size_t k = 0; k < corners; ++k) {
            area_[element.vertices[k]] += area / float(corners);
            reflectance_[element.vertices[k]] = reflectance;
        }
        place.area += area;
        place.reflectance += area * reflectance;
    }
    for (std::uint32_t p = 0; p < size(); ++p) {
        WorkPlace& place = clusters_.places[p];
        if (place.area > 0) place.reflectance /= place.area;
        place.area /= float(clusters_.blocks[p]);
    }
}

/// Calls visit(vertex index) for some of a place's vertices, spread evenly.
template <class Visit>
void VertexPlaces::forSome(std::uint32_t place, std::size_t most, Visit visit) const {
    const std::size_t first = std::size_t(firstBlock_[place]) * kBlock;
    const std::size_t count = std::size_t(clusters_.blocks[place]) * kBlock;
    const std::size_t step = std::max<std::size_t>(1, count / most);
    for (std::size_t v = first; v < first + count; v += step)
        if (!isPadding(patches_.vertices[v].receiver)) visit(v);
}

void VertexPlaces::locate(std::uint32_t index) {
    WorkPlace& place = clusters_.places[index];
    place.box = {};
    place.normal = glm::vec3(0);
    float count = 0;
    forSome(index, std::size_t(clusters_.blocks[index]) * kBlock, [&](std::size_t v) {
        place.box.add(patches_.vertices[v].receiver.position);
        place.normal += patches_.vertices[v].receiver.normal;
        count += 1;
    });
    if (count > 0) place.normal /= count;
}

void VertexPlaces::follow(std::span<const ObjectId> objects) {
    for (std::uint32_t place = 0; place < size(); ++place)
        if (std::find(objects.begin(), objects.end(), objectOf(place)) != objects.end())
            locate(place);
}

Bounds VertexPlaces::boundsOf(std::span<const ObjectId> objects) const {
    Bounds box;
    for (std::uint32_t place = 0; place < size(); ++place)
        if (std::find(objects.begin(), objects.end(), objectOf(place)) != objects.end())
            box.add(known(place).box);
    return box;
}

WorkPlace VertexPlaces::at(std::uint32_t index, std::span<const Rgb> light) const {
    WorkPlace place = clusters_.places[index];
    float sum = 0, count = 0;
    forSome(index, kLightSamples, [&](std::size_t v) {
        sum += luminance(light[v]);
        count += 1;
    });
    if (count > 0)
        place.luminance = place.reflectance * sum / count * std::numbers::inv_pi_v<float>;
    return place;
}

WorkPlace VertexPlaces::atVertex(std::size_t v, Rgb light) const {
    const Receiver& receiver = patches_.vertices[v].receiver;
    WorkPlace place;
    if (isPadding(receiver)) return place;
    if (v < patches_.firstPrivate) {
        place.area = area_[v];
        place.reflectance = reflectance_[v];
    } else {
        const Element& element =
            patches_.uncoveredElements[patches_.privateElement[v - patches_.firstPrivate]];
        place.area = elementArea(patches_, element) / (element.isTriangle() ? 3 : 4);
        place.reflectance = luminance(patches_.materials[element.material].reflectance);
    }
    const glm::vec3 half(0.5f * std::sqrt(place.area));
    place.box = {receiver.position - half, receiver.position + half};
    place.normal = receiver.normal;
    place.luminance = place.reflectance * luminance(light) * std::numbers::inv_pi_v<float>;
    return place;
}

std::vector<std::size_t> VertexPlaces::spread(std::uint32_t place) const {
    std::vector<std::size_t> vertices;
    forSome(place, kSightSamples, [&](std::size_t v) { vertices.push_back(v); });
    return vertices;
}

} // namespace penumbra
