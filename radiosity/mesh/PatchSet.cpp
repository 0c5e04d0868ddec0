#include "radiosity/mesh/PatchSet.h"

#include "base/PairHash.h"
#include "base/Parallel.h"
#include "radiosity/rays/Margins.h"

#include <algorithm>
#include <bit>

namespace penumbra {

namespace {

Rgb bounded(Rgb rho) {
    constexpr float kMost = Material::kMaxReflectance;
    return {std::min(rho.r, kMost), std::min(rho.g, kMost), std::min(rho.b, kMost)};
}

/// A corner of a half of a quadrilateral, cut as it is drawn.
constexpr std::array<std::array<std::size_t, 3>, 2> kHalves{{{0, 1, 2}, {0, 2, 3}}};

} // namespace

Rgb elementReflectance(const PatchSet& set, std::uint32_t element) {
    const Rgb rho = set.materials[set.elements[element].material].reflectance;
    return set.textures.elements.empty() ? rho : bounded(rho * set.textures.elements[element]);
}

Rgb patchReflectance(const PatchSet& set, std::uint32_t patch) {
    const Rgb rho = set.materials[set.patches[patch].material].reflectance;
    return set.textures.patches.empty() ? rho : bounded(rho * set.textures.patches[patch]);
}

LitMaterial surfaceAt(const PatchSet& set, std::uint32_t element, glm::vec2 uv) {
    const LitMaterial& material = set.materials[set.elements[element].material];
    LitMaterial there{material.reflectance, material.emission};
    if (const auto& texture = material.textures.reflectance)
        there.reflectance = there.reflectance * texture->at(uv);
    if (const auto& texture = material.textures.emission)
        there.emission = there.emission * texture->at(uv);
    return there;
}

Rgb textureMean(const Texture& texture, const std::array<glm::vec3, 4>& positions,
                const std::array<glm::vec2, 4>& uvs) {
    Rgb sum;
    float area = 0;
    for (const auto& [a, b, c] : kHalves) {
        const float half =
            glm::length(glm::cross(positions[b] - positions[a], positions[c] - positions[a]));
        if (!(half > 0)) continue;
        sum += half * texture.mean(std::array{uvs[a], uvs[b], uvs[c]});
        area += half;
    }
    return area > 0 ? sum * (1 / area) : texture.at(uvs[0]);
}

void findTextureMeans(PatchSet& set) {
    SurfaceTextures& textures = set.textures;
    if (textures.uvs.empty()) return;
    textures.uvs.resize(set.elements.size());
    textures.elements.assign(set.elements.size(), Rgb(1));
    parallelFor(set.elements.size(), 256, [&](std::size_t first, std::size_t last) {
        for (std::size_t e = first; e < last; ++e) {
            const Element& element = set.elements[e];
            const auto& texture = set.materials[element.material].textures.reflectance;
            if (!texture || element.patch == Element::kNone) continue;
            std::array<glm::vec3, 4> positions;
            for (std::size_t k = 0; k < 4; ++k)
                positions[k] = set.vertices[element.vertices[k]].position;
            textures.elements[e] = textureMean(*texture, positions, textures.uvs[e]);
        }
    });
    for (const Patch& patch : set.patches)
        textures.patches.push_back(textureMeanOf(
            set, std::span(set.patchElements).subspan(patch.firstElement, patch.elementCount)));
}

Rgb textureMeanOf(const PatchSet& set, std::span<const std::uint32_t> elements) {
    const LitMaterial& material = set.materials[set.elements[elements[0]].material];
    if (!material.textures.reflectance) return Rgb(1);
    Rgb sum;
    float area = 0;
    for (const std::uint32_t e : elements) {
        const float part = elementArea(set, set.elements[e]);
        sum += part * set.textures.elements[e];
        area += part;
    }
    return area > 0 ? sum * (1 / area) : Rgb(1);
}

Receiver placedReceiver(const Receiver& own, const Pose& pose, float skin) {
    Receiver receiver{pose.point(own.position), pose.direction(own.normal)};
    const float lift = hoverAt(skin, receiver.position) - hoverAt(skin, own.position);
    if (lift > 0) receiver.position += lift * receiver.normal;
    return receiver;
}

Emitter placedEmitter(const Emitter& own, const Pose& pose) {
    Emitter emitter = own;
    emitter.centre = pose.point(own.centre);
    emitter.axis = pose.direction(own.axis);
    for (auto& polygon : emitter.polygons)
        for (glm::vec3& corner : polygon) corner = pose.point(corner);
    return emitter;
}

void placeObject(PatchSet& set, ObjectId object, const Pose& pose) {
    ObjectPart& part = set.objects[object.value];
    const ObjectShape& shape = part.shape;
    part.pose = pose;
    for (std::uint32_t i = 0; i < part.vertices.count; ++i)
        set.vertices[part.vertices.first + i] = {
            pose.point(shape.vertices[i].position),
            placedReceiver(shape.vertices[i].receiver, pose, set.skin)};
    for (std::uint32_t i = 0; i < part.nodes.count; ++i)
        set.nodes[part.nodes.first + i] = set.uncoveredNodes[part.nodes.first + i] =
            placedReceiver(shape.nodes[i], pose, set.skin);
    for (std::uint32_t i = 0; i < part.corners.count; ++i)
        set.corners[part.corners.first + i] = pose.point(shape.corners[i]);
    for (std::uint32_t i = 0; i < part.patches.count; ++i) {
        Patch& patch = set.patches[part.patches.first + i];
        patch.centre = pose.point(shape.patches[i].position);
        patch.normal = pose.direction(shape.patches[i].normal);
    }
    for (std::uint32_t i = 0; i < part.emitters.count; ++i) {
        Emitter& emitter = set.emitters[part.emitters.first + i];
        const Rgb exitance = emitter.exitance;
        emitter = placedEmitter(shape.emitters[i], pose);
        emitter.exitance = exitance; // it may have been dimmed since
    }
    for (std::uint32_t i = 0; i < part.walls.count; ++i) {
        Wall& wall = set.walls[part.walls.first + i];
        wall.normal = pose.direction(shape.walls[i].normal);
        for (std::size_t k = 0; k < wall.outline.size(); ++k)
            wall.outline[k] = pose.point(shape.walls[i].outline[k]);
    }
    RayMesh& rays = set.rayMeshes[object.value];
    for (std::size_t i = 0; i < rays.vertices.size(); ++i)
        rays.vertices[i] = pose.point(shape.rayVertices[i]);
    set.farthest = std::max(set.farthest, magnitude(boundsOf(set, object)));
}

std::size_t PatchSet::patchCount() const {
    std::size_t count = 0;
    for (std::size_t p = 0; p < patches.size(); ++p)
        count += (parts.used.empty() || parts.used[p]) && !objects[patches[p].object.value].removed;
    return count;
}

std::uint32_t addressOf(const ObjectPart& part, const Receiver& inFrame) {
    std::uint64_t hash = part.key;
    for (const glm::vec3 v : {inFrame.position, inFrame.normal})
        for (const float component : {v.x, v.y, v.z}) {
            hash = (hash ^ std::bit_cast<std::uint32_t>(component + 0.0f)) * 0x9e3779b97f4a7c15u;
            hash ^= hash >> 32; // -0 is 0
        }
    return std::uint32_t(hash);
}

std::uint32_t addressOfNode(const PatchSet& set, std::uint32_t node) {
    if (!set.parts.used.empty() && node >= set.parts.firstNode)
        return set.parts.nodeAddress[node - set.parts.firstNode];
    const ObjectPart& part = set.objects[set.nodeBlockObject[node / PatchSet::kBlock].value];
    if (!part.nodes.contains(node)) return 0; // padding
    return addressOf(part, part.shape.nodes[node - part.nodes.first]);
}

std::uint32_t addressOfPatch(const PatchSet& set, std::uint32_t patch) {
    const Patch& it = set.patches[patch];
    const ObjectPart& part = set.objects[it.object.value];
    if (part.patches.contains(patch))
        return addressOf(part, part.shape.patches[patch - part.patches.first]);
    // A part: its first element is no other's.
    const std::uint32_t whole = set.wholeOf(patch);
    if (whole == Element::kNone) return 0;
    const std::uint32_t first = set.patchElements[it.firstElement] - part.elements.first;
    return pairHash(addressOfPatch(set, whole), first);
}

Bounds boundsOf(const PatchSet& set, ObjectId object) {
    Bounds bounds;
    for (glm::vec3 vertex : set.rayMeshes[object.value].vertices) bounds.add(vertex);
    return bounds;
}

Bounds boundsOf(const Emitter& emitter) {
    Bounds bounds;
    for (const auto& polygon : emitter.polygons)
        for (glm::vec3 corner : polygon) bounds.add(corner);
    if (emitter.kind != Emitter::Kind::polygons) {
        bounds.add(emitter.centre - emitter.radius);
        bounds.add(emitter.centre + emitter.radius);
    }
    return bounds;
}

} // namespace penumbra
