#include "radiosity/process/store/LitPatches.h"

#include "radiosity/process/store/LitMesh.h"
#include "radiosity/rays/Margins.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace penumbra {

namespace {

constexpr std::uint32_t kBlock = PatchSet::kBlock;

void addVertices(const LitMeshObject& object, std::uint32_t index, PatchSet& set) {
    if (object.positions.empty()) return;
    ObjectPart& part = set.objects[index];
    part.vertices = {object.firstBlock * kBlock, std::uint32_t(object.positions.size())};
    set.vertices.resize(part.vertices.end());
    set.vertexBlockObject.resize(part.vertices.end() / kBlock, {index});
    for (std::uint32_t i = 0; i < part.vertices.count; ++i)
        set.vertices[part.vertices.first + i] = {object.positions[i],
                                                 {object.receivers[i], object.normals[i]}};
    const auto first = set.vertices.begin() + part.vertices.first;
    part.shape.vertices.assign(first, first + part.vertices.count);
}

void addBlends(const LitMeshObject& object, std::uint32_t index, PatchSet& set) {
    const Range& own = set.objects[index].vertices;
    set.blockBlends.resize(set.vertices.size() / kBlock, PatchCoordinate::kNone);
    const auto count = std::uint32_t(object.blends.size() / kBlock);
    for (std::uint32_t b = 0; b < count; ++b)
        set.blockBlends[own.end() / kBlock - count + b] =
            std::uint32_t(set.vertexBlends.size()) + b * kBlock;
    for (VertexBlend blend : object.blends) {
        for (std::uint32_t& v : blend.vertices) v += own.first;
        set.vertexBlends.push_back(blend);
    }
}

/// Patches are numbered anew: what an object calls its patches is its own affair.
void addElements(const LitMeshObject& object, std::uint32_t index, PatchSet& set) {
    ObjectPart& part = set.objects[index];
    const auto count = std::uint32_t(object.elements.size());
    part.elements = {std::uint32_t(set.elements.size()), count};
    part.patches.first = std::uint32_t(set.patches.size());
    for (std::uint32_t e = 0; e < count; ++e) {
        Element element{object.elements[e]};
        for (std::uint32_t& v : element.vertices) v += part.vertices.first;
        set.elements.push_back(element);
    }
    std::vector<std::uint32_t> byPatch(count);
    std::iota(byPatch.begin(), byPatch.end(), 0u);
    std::stable_sort(byPatch.begin(), byPatch.end(), [&](std::uint32_t a, std::uint32_t b) {
        return object.elementPatch[a] < object.elementPatch[b];
    });
    std::uint32_t last = Element::kNone;
    for (const std::uint32_t e : byPatch) {
        if (object.elementPatch[e] == Element::kNone) break; // it is greater than any other
        if (std::exchange(last, object.elementPatch[e]) != last || part.patches.count == 0) {
            Patch patch;
            patch.firstElement = std::uint32_t(set.patchElements.size());
            patch.object = {index};
            set.patches.push_back(patch);
            ++part.patches.count;
        }
        set.elements[part.elements.first + e].patch = std::uint32_t(set.patches.size() - 1);
        set.patchElements.push_back(part.elements.first + e);
        ++set.patches.back().elementCount;
    }
    set.elementObject.resize(set.elements.size(), {index});
    part.shape.patches.resize(part.patches.count);
}

void addObject(LitMeshObject object, PatchSet& set) {
    const auto index = std::uint32_t(set.objects.size());
    ObjectPart& part = set.objects.emplace_back();
    part.present = false; // until it is told where it stands
    addVertices(object, index, set);
    addBlends(object, index, set);
    addElements(object, index, set);
    part.path = std::move(object.path);
    part.shape.rayVertices = object.rays.vertices;
    set.rayMeshes.push_back(std::move(object.rays));
}

} // namespace

std::optional<PatchSet> readPatches(std::span<const std::span<const std::byte>> meshes,
                                    std::uint32_t blocks) {
    if (meshes.empty()) return std::nullopt;
    PatchSet set;
    LitMeshReader reader(meshes.front(), blocks);
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        if (m > 0) reader.goOn(meshes[m]);
        if (!reader.ok()) return std::nullopt;
        while (!reader.done()) {
            std::optional<LitMeshObject> object = reader.next();
            if (!object) return std::nullopt;
            addObject(std::move(*object), set);
        }
    }
    const MeshingOptions& sizes = reader.head().sizes;
    set.patchSize = sizes.patchSize;
    set.elementSize = sizes.elementSize;
    set.skin = skinOf(set.patchSize);
    set.uncoveredElements = set.elements;
    set.covered.resize(set.elements.size());
    set.vertexCoordinates.resize(set.vertices.size());
    for (const Element& element : set.elements)
        for (const std::uint32_t v : element.vertices)
            if (set.vertexCoordinates[v].patch == PatchCoordinate::kNone)
                set.vertexCoordinates[v].patch = element.patch;
    set.firstPrivate = std::uint32_t(set.vertices.size());
    return set;
}

} // namespace penumbra
