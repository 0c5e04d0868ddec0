#include "radiosity/mesh/Additions.h"

#include <algorithm>
#include <utility>

namespace penumbra {

namespace {

constexpr std::uint32_t kNone = Element::kNone;
constexpr std::uint32_t kBlock = PatchSet::kBlock;
/// Room for so much at least.
constexpr std::uint32_t kLeastBlocks = 64, kLeastPatches = 512;

void shift(Range& range, std::size_t by) {
    range.first += std::uint32_t(by);
}

template <class T>
void append(std::vector<T>& to, std::vector<T>& from) {
    to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

/// Takes some from the front of what there is room for.
std::uint32_t takeFrom(Range& room, std::size_t count) {
    const std::uint32_t first = room.first;
    room.first += std::uint32_t(count);
    room.count -= std::uint32_t(count);
    return first;
}

/// Numbers of one set as they are in the other.
class Renumbering {
public:
    Renumbering(BuiltPatches& to, const BuiltPatches& from)
        : objects_(std::uint32_t(to.patches.objects.size())),
          vertices_(takeFrom(to.patches.room.vertices, from.patches.vertices.size())),
          nodes_(takeFrom(to.patches.room.nodes, from.patches.nodes.size())),
          patches_(takeFrom(to.patches.room.patches, from.patches.patches.size())),
          elements_(std::uint32_t(to.patches.elements.size())),
          corners_(std::uint32_t(to.patches.corners.size())),
          run_(std::uint32_t(to.patches.patchElements.size())),
          near_(std::uint32_t(to.patches.nearClusters.size())) {
        for (std::uint32_t m = 0; m < from.patches.materials.size(); ++m)
            materials_.push_back(materialIn(to, from, m));
    }

    std::uint32_t firstObject() const { return objects_; }
    ObjectId object(ObjectId old) const { return {old.value + objects_}; }
    std::uint32_t vertex(std::uint32_t old) const { return old + vertices_; }
    std::uint32_t node(std::uint32_t old) const { return old == kNone ? kNone : old + nodes_; }
    std::uint32_t patch(std::uint32_t old) const { return old == kNone ? kNone : old + patches_; }
    std::uint32_t element(std::uint32_t old) const { return old + elements_; }

    Element operator()(Element element) const {
        for (std::uint32_t& v : element.vertices) v = vertex(v);
        element.patch = patch(element.patch);
        element.material = materials_[element.material];
        return element;
    }
    Patch operator()(Patch patch) const {
        patch.firstCorner += corners_;
        patch.firstElement += run_;
        patch.firstNear += near_;
        patch.centreNode = node(patch.centreNode);
        patch.cornerNodes = nodes(patch);
        patch.material = materials_[patch.material];
        patch.object = object(patch.object);
        return patch;
    }
    std::array<std::uint32_t, 4> nodes(const Patch& patch) const {
        std::array<std::uint32_t, 4> nodes = patch.cornerNodes;
        for (std::uint32_t& n : nodes)
            if (patch.hasCornerNodes) n = node(n);
        return nodes;
    }
    /// \pre all of the other set is behind what was there
    void shiftRanges(ObjectPart& part, const PatchSet& to) const {
        shift(part.vertices, vertices_);
        shift(part.nodes, nodes_);
        shift(part.patches, patches_);
        shift(part.elements, elements_);
        shift(part.corners, corners_);
        shift(part.emitters, to.emitters.size());
        shift(part.walls, to.walls.size());
    }

private:
    /// The same material if there is one already: else a new one.
    static std::uint32_t materialIn(BuiltPatches& to, const BuiltPatches& from, std::uint32_t m) {
        const LightSource& source = from.materialSources[m];
        std::vector<LitMaterial>& materials = to.patches.materials;
        for (std::uint32_t i = 0; i < materials.size(); ++i) {
            const LightSource& known = to.materialSources[i];
            if (known.material == source.material && known.light == source.light &&
                to.materialEmits[i] == from.materialEmits[m] &&
                materials[i] == from.patches.materials[m])
                return i;
        }
        materials.push_back(from.patches.materials[m]);
        to.materialSources.push_back(source);
        to.materialEmits.push_back(from.materialEmits[m]);
        return std::uint32_t(materials.size() - 1);
    }

    std::uint32_t objects_, vertices_, nodes_, patches_, elements_, corners_, run_, near_;
    std::vector<std::uint32_t> materials_;
};

void addVertices(PatchSet& to, PatchSet& from, const Renumbering& now) {
    std::ranges::copy(from.vertices, to.vertices.begin() + now.vertex(0));
    for (std::uint32_t v = 0; v < from.vertices.size(); ++v) {
        PatchCoordinate at = from.vertexCoordinates[v];
        at.patch = now.patch(at.patch);
        if (at.blend != kNone) at.blend += std::uint32_t(to.blends.size());
        to.vertexCoordinates[now.vertex(v)] = at;
        to.parts.vertexNode[now.vertex(v)] = now.node(from.parts.vertexNode[v]);
    }
    for (NodeBlend& blend : from.blends)
        for (std::uint32_t& patch : blend.patches) patch = now.patch(patch);
    append(to.blends, from.blends);
    for (std::uint32_t b = 0; b < from.vertexBlockObject.size(); ++b) {
        const std::uint32_t block = now.vertex(0) / kBlock + b;
        to.vertexBlockObject[block] = now.object(from.vertexBlockObject[b]);
        if (from.isBlended(b))
            to.blockBlends[block] = from.blockBlends[b] + std::uint32_t(to.vertexBlends.size());
    }
    for (VertexBlend& blend : from.vertexBlends)
        for (std::uint32_t& v : blend.vertices) v = now.vertex(v);
    append(to.vertexBlends, from.vertexBlends);
}

void addNodes(PatchSet& to, PatchSet& from, const Renumbering& now) {
    std::ranges::copy(from.nodes, to.nodes.begin() + now.node(0));
    std::ranges::copy(from.uncoveredNodes, to.uncoveredNodes.begin() + now.node(0));
    for (std::uint32_t b = 0; b < from.nodeBlockObject.size(); ++b)
        to.nodeBlockObject[now.node(0) / kBlock + b] = now.object(from.nodeBlockObject[b]);
}

/// Textures that only one of the two has leave what the other has as it is.
void addTextures(PatchSet& to, PatchSet& from, const Renumbering& now) {
    if (to.textures.uvs.empty() && from.textures.uvs.empty()) return;
    const std::size_t before = to.elements.size(), all = before + from.elements.size();
    to.textures.uvs.resize(before);
    to.textures.elements.resize(before, Rgb(1));
    to.textures.patches.resize(to.patches.size(), Rgb(1));
    append(to.textures.uvs, from.textures.uvs);
    append(to.textures.elements, from.textures.elements);
    to.textures.uvs.resize(all);
    to.textures.elements.resize(all, Rgb(1));
    for (std::uint32_t p = 0; p < from.patches.size(); ++p)
        to.textures.patches[now.patch(p)] =
            from.textures.patches.empty() ? Rgb(1) : from.textures.patches[p];
}

void addElements(PatchSet& to, PatchSet& from, const Renumbering& now) {
    for (std::size_t e = 0; e < from.elements.size(); ++e) {
        to.elements.push_back(now(from.elements[e]));
        to.uncoveredElements.push_back(now(from.uncoveredElements[e]));
        to.elementObject.push_back(now.object(from.elementObject[e]));
    }
    to.covered.resize(to.elements.size());
    append(to.parts.elementCoordinates, from.parts.elementCoordinates);
}

void addPatches(PatchSet& to, PatchSet& from, const Renumbering& now) {
    for (std::uint32_t p = 0; p < from.patches.size(); ++p) {
        to.patches[now.patch(p)] = now(from.patches[p]);
        to.parts.cornerNodes[now.patch(p)] = now.nodes(from.patches[p]);
    }
    append(to.corners, from.corners);
    for (const std::uint32_t p : from.nearClusters) to.nearClusters.push_back(now.patch(p));
    for (const std::uint32_t e : from.patchElements) to.patchElements.push_back(now.element(e));
}

void addShapes(PatchSet& to, PatchSet& from, const Renumbering& now) {
    for (ObjectPart& part : from.objects) {
        now.shiftRanges(part, to);
        part.present = false;
        part.removed = true; // until it is posed
        for (Emitter& emitter : part.shape.emitters) emitter.object = now.object(emitter.object);
        for (Wall& wall : part.shape.walls) wall.object = now.object(wall.object);
    }
    for (Emitter& emitter : from.emitters) emitter.object = now.object(emitter.object);
    for (Wall& wall : from.walls) wall.object = now.object(wall.object);
    append(to.objects, from.objects);
    append(to.emitters, from.emitters);
    append(to.walls, from.walls);
    append(to.rayMeshes, from.rayMeshes);
    to.bounds.add(from.bounds);
    to.area += from.area;
    to.polygons += from.polygons;
    to.farthest = std::max(to.farthest, from.farthest);
}

} // namespace

void makeRoom(PatchSet& set) {
    PatchRoom& room = set.room;
    room.object = {std::uint32_t(set.objects.size())};
    set.objects.emplace_back();
    set.objects.back().present = false;
    set.objects.back().removed = true;
    set.rayMeshes.emplace_back();
    const auto blocks = [](std::size_t receivers) {
        return std::max(kLeastBlocks, std::uint32_t(receivers / kBlock / 8));
    };
    room.vertices = {std::uint32_t(set.vertices.size()), kBlock * blocks(set.vertices.size())};
    set.vertices.resize(room.vertices.end(), Vertex{});
    set.vertexCoordinates.resize(room.vertices.end());
    set.parts.vertexNode.resize(room.vertices.end(), kNone);
    set.vertexBlockObject.resize(room.vertices.end() / kBlock, room.object);
    set.blockBlends.resize(room.vertices.end() / kBlock, PatchCoordinate::kNone);
    set.firstPrivate = room.vertices.end();

    room.nodes = {std::uint32_t(set.nodes.size()), kBlock * blocks(set.nodes.size())};
    set.nodes.resize(room.nodes.end(), Receiver{});
    set.uncoveredNodes.resize(room.nodes.end(), Receiver{});
    set.nodeBlockObject.resize(room.nodes.end() / kBlock, room.object);

    room.patches = {std::uint32_t(set.patches.size()),
                    std::max(kLeastPatches, std::uint32_t(set.patches.size() / 8))};
    Patch nobodys;
    nobodys.object = room.object;
    set.patches.resize(room.patches.end(), nobodys);
    set.parts.cornerNodes.resize(room.patches.end());
    if (!set.textures.uvs.empty()) set.textures.patches.resize(room.patches.end(), Rgb(1));
}

std::optional<std::vector<ObjectId>> addObjects(BuiltPatches& to, BuiltPatches& from) {
    const PatchRoom& room = to.patches.room;
    if (!room.object.valid() || from.patches.vertices.size() > room.vertices.count ||
        from.patches.nodes.size() > room.nodes.count ||
        from.patches.patches.size() > room.patches.count)
        return std::nullopt;
    const Renumbering now(to, from);
    addVertices(to.patches, from.patches, now);
    addNodes(to.patches, from.patches, now);
    addTextures(to.patches, from.patches, now);
    addElements(to.patches, from.patches, now);
    addPatches(to.patches, from.patches, now);
    std::vector<ObjectId> objects;
    for (std::uint32_t o = 0; o < from.patches.objects.size(); ++o)
        objects.push_back(now.object({o}));
    addShapes(to.patches, from.patches, now);
    append(to.emitterSources, from.emitterSources);
    append(to.warnings, from.warnings);
    to.enclosures.add(from.enclosures, now.firstObject());
    return objects;
}

} // namespace penumbra
