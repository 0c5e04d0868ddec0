#include "radiosity/process/store/LitMesh.h"

#include "radiosity/process/snapshot/SceneReplica.h"
#include "radiosity/transport/LitScene.h"
#include "scenegraph/Light.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

namespace {

constexpr std::uint32_t kBlock = PatchSet::kBlock;

/// Things in a frame without volume are nowhere but at its origin, wherever they would be drawn.
glm::dmat4 inverseOrOne(const glm::dmat4& frame) {
    const glm::dmat4 inverse = glm::inverse(frame);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(inverse[column][row])) return glm::dmat4(1.0);
    return inverse;
}

void writeHead(ByteWriter& out, const LitScene& scene, const SceneReplica& graph) {
    const PatchSet& set = scene.patches();
    out.put(sizesOf(set));
    out.put(std::uint32_t(set.objects.size()));
    std::vector<LitMeshMaterial> materials;
    for (std::size_t m = 0; m < set.materials.size(); ++m) {
        const LightSource& source = scene.built().materialSources[m];
        LitMeshMaterial material;
        if (source.material) material.material = graph.numberOf(source.material);
        if (source.light) material.light = graph.numberOf(static_cast<const Node*>(source.light));
        material.emits = scene.built().materialEmits[m];
        materials.push_back(material);
    }
    out.list(materials);
}

/// In the object's stretched frame, where they never change.
void writeVertices(ByteWriter& out, const ObjectPart& part, std::uint32_t count) {
    std::vector<glm::vec3> positions(count), normals(count), receivers(count);
    for (std::uint32_t i = 0; i < part.vertices.count; ++i) {
        const Vertex& vertex = part.shape.vertices[i];
        positions[i] = vertex.position;
        normals[i] = vertex.receiver.normal;
        receivers[i] = vertex.receiver.position;
    }
    out.list(positions);
    out.list(normals);
    out.list(receivers);
}

void writeBlends(ByteWriter& out, const PatchSet& set, const ObjectPart& part,
                 std::uint32_t count) {
    std::vector<VertexBlend> blends;
    for (std::uint32_t v = part.vertices.first; v < part.vertices.first + count; ++v) {
        if (!set.isBlended(v / kBlock)) continue;
        blends.push_back(set.vertexBlend(v));
        VertexBlend& blend = blends.back();
        for (std::size_t k = 0; k < 4; ++k)
            blend.vertices[k] = blend.weights[k] > 0 ? blend.vertices[k] - part.vertices.first : 0;
    }
    out.list(blends);
}

void writeElements(ByteWriter& out, const PatchSet& set, std::uint32_t object,
                   std::span<const std::uint32_t> elements) {
    std::vector<std::array<std::uint32_t, 4>> corners;
    std::vector<std::uint32_t> materials, patches;
    std::vector<std::array<glm::vec2, 4>> uvs;
    for (std::uint32_t e : elements) {
        std::array<std::uint32_t, 4> local = set.uncoveredElements[e].vertices;
        for (std::uint32_t& v : local) v -= set.objects[object].vertices.first;
        corners.push_back(local);
        materials.push_back(set.elements[e].material);
        patches.push_back(set.uncoveredElements[e].patch);
        if (!set.textures.uvs.empty()) uvs.push_back(set.textures.uvs[e]);
    }
    out.list(corners);
    out.list(materials);
    out.list(patches);
    out.list(uvs);
}

void writeRays(ByteWriter& out, const ObjectPart& part, const RayMesh& rays) {
    out.list(part.shape.rayVertices);
    out.list(rays.triangles);
    out.list(rays.solid);
}

void writeEmitters(ByteWriter& out, const LitScene& scene, const SceneReplica& graph,
                   const ObjectPart& part) {
    std::vector<std::uint32_t> meshes; // the others are lights
    for (std::uint32_t i = 0; i < part.emitters.count; ++i)
        if (scene.built().emitterSources[part.emitters.first + i].material) meshes.push_back(i);
    out.put(std::uint64_t(meshes.size()));
    for (const std::uint32_t i : meshes) {
        const std::uint32_t e = part.emitters.first + i;
        const Emitter& emitter = part.shape.emitters[i];
        out.text(emitter.path);
        out.put(graph.numberOf(scene.built().emitterSources[e].material));
        out.put(emitter.texture);
        out.put(std::uint64_t(emitter.polygons.size()));
        for (const auto& polygon : emitter.polygons) out.list(polygon);
    }
}

std::vector<LitMeshEmitter> readEmitters(ByteReader& in) {
    constexpr std::size_t kLength = sizeof(std::uint64_t); // that of a list, at least
    std::vector<LitMeshEmitter> emitters(in.count(kLength));
    for (LitMeshEmitter& emitter : emitters) {
        emitter.path = in.text();
        emitter.material = in.get<std::uint32_t>();
        emitter.texture = in.get<Rgb>();
        emitter.polygons.resize(in.count(kLength));
        for (auto& polygon : emitter.polygons) polygon = in.list<glm::vec3>();
    }
    return emitters;
}

} // namespace

std::vector<std::byte> describeMesh(const LitScene& scene, const SceneReplica& graph,
                                    std::uint32_t first) {
    const PatchSet& set = scene.patches();
    std::vector<std::vector<std::uint32_t>> elements(set.objects.size());
    for (std::uint32_t e = 0; e < set.elements.size(); ++e)
        if (set.elementObject[e].value >= first) elements[set.elementObject[e].value].push_back(e);
    ByteWriter out;
    writeHead(out, scene, graph);
    for (std::uint32_t o = first; o < set.objects.size(); ++o) {
        static const ObjectPart kNothing; // what has no path is in the scene no more
        const bool isThere = !set.objects[o].path.empty();
        const ObjectPart& part = isThere ? set.objects[o] : kNothing;
        out.text(part.path);
        out.put(inverseOrOne(glm::dmat4(part.stretch)));
        out.put(part.vertices.first / kBlock);
        out.put(std::uint32_t(isThere && part.present));
        const std::uint32_t blocks = (part.vertices.count + kBlock - 1) / kBlock;
        writeVertices(out, part, blocks * kBlock);
        writeBlends(out, set, part, blocks * kBlock);
        writeElements(out, set, o, isThere ? elements[o] : std::vector<std::uint32_t>());
        writeRays(out, part, isThere ? set.rayMeshes[o] : RayMesh());
        writeEmitters(out, scene, graph, part);
    }
    return out.take();
}

void numberElements(const PatchSet& set, std::vector<std::uint32_t>& number) {
    std::vector<std::uint32_t> count(set.objects.size());
    for (std::size_t e = number.size(); e < set.elements.size(); ++e)
        number.push_back(count[set.elementObject[e].value]++);
}

LitMeshReader::LitMeshReader(std::span<const std::byte> bytes, std::uint32_t blocks)
    : reader_(bytes), blocks_(blocks) {
    readHead();
}

void LitMeshReader::goOn(std::span<const std::byte> bytes) {
    reader_ = ByteReader(bytes);
    readHead();
}

void LitMeshReader::readHead() {
    const std::size_t materials = head_.materials.size();
    head_.sizes = reader_.get<MeshingOptions>();
    head_.objects = reader_.get<std::uint32_t>();
    head_.materials = reader_.list<LitMeshMaterial>();
    for (float size : {head_.sizes.patchSize, head_.sizes.elementSize})
        if (!std::isfinite(size) || size < 0) reader_.fail();
    // Objects that were read before have some of these materials.
    if (head_.objects < next_ || head_.materials.size() < materials) reader_.fail();
    if (!reader_.ok()) head_ = {}, next_ = 0;
}

std::optional<LitMeshObject> LitMeshReader::next() {
    LitMeshObject object;
    object.path = reader_.text();
    object.toObject = reader_.get<glm::dmat4>();
    object.firstBlock = reader_.get<std::uint32_t>();
    object.present = reader_.get<std::uint32_t>();
    object.positions = reader_.list<glm::vec3>();
    object.normals = reader_.list<glm::vec3>();
    object.receivers = reader_.list<glm::vec3>();
    object.blends = reader_.list<VertexBlend>();
    object.elements = reader_.list<std::array<std::uint32_t, 4>>();
    object.elementMaterial = reader_.list<std::uint32_t>();
    object.elementPatch = reader_.list<std::uint32_t>();
    object.elementUvs = reader_.list<std::array<glm::vec2, 4>>();
    object.rays.vertices = reader_.list<glm::vec3>();
    object.rays.triangles = reader_.list<std::array<std::uint32_t, 3>>();
    object.rays.solid = reader_.list<std::uint8_t>();
    object.emitters = readEmitters(reader_);
    if (!reader_.ok() || !sound(object)) {
        reader_.fail();
        return std::nullopt;
    }
    if (!object.positions.empty())
        nextBlock_ = object.firstBlock + std::uint32_t(object.positions.size() / kBlock);
    ++next_;
    return object;
}

namespace {

bool sound(const RayMesh& rays) {
    return rays.solid.size() == rays.triangles.size() &&
           std::all_of(rays.vertices.begin(), rays.vertices.end(), canBeTraced) &&
           std::all_of(rays.triangles.begin(), rays.triangles.end(), [&](const auto& triangle) {
               return std::all_of(triangle.begin(), triangle.end(),
                                  [&](std::uint32_t v) { return v < rays.vertices.size(); });
           });
}

/// Blended vertices take light from those before them.
bool sound(std::span<const VertexBlend> blends, std::size_t vertices) {
    if (blends.size() % kBlock != 0 || blends.size() > vertices) return false;
    const auto isSound = [&](const VertexBlend& blend) {
        for (std::size_t k = 0; k < 4; ++k) {
            const bool counts = blend.weights[k] > 0;
            if (blend.vertices[k] >= (counts ? vertices - blends.size() : vertices)) return false;
            if (!(blend.weights[k] >= 0 && blend.weights[k] <= 1)) return false;
        }
        return true;
    };
    return std::ranges::all_of(blends, isSound);
}

bool sound(const LitMeshEmitter& emitter) {
    return std::all_of(emitter.polygons.begin(), emitter.polygons.end(), [](const auto& polygon) {
        return polygon.size() >= 3 && std::all_of(polygon.begin(), polygon.end(), canBeTraced);
    });
}

} // namespace

bool LitMeshReader::sound(const LitMeshObject& object) const {
    const std::size_t vertices = object.positions.size();
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(object.toObject[column][row])) return false;
    // Blocks lie one object after the other, so that no two claim the same one.
    const bool place =
        vertices == 0 || (object.firstBlock >= nextBlock_ && object.firstBlock <= blocks_ &&
                          vertices / kBlock <= blocks_ - object.firstBlock);
    return vertices % kBlock == 0 && place && object.normals.size() == vertices &&
           object.receivers.size() == vertices && penumbra::sound(object.blends, vertices) &&
           penumbra::sound(object.rays) &&
           std::all_of(object.emitters.begin(), object.emitters.end(),
                       [](const LitMeshEmitter& emitter) { return penumbra::sound(emitter); }) &&
           object.elementMaterial.size() == object.elements.size() &&
           object.elementPatch.size() == object.elements.size() &&
           (object.elementUvs.empty() || object.elementUvs.size() == object.elements.size()) &&
           std::all_of(object.positions.begin(), object.positions.end(), canBeTraced) &&
           std::all_of(object.normals.begin(), object.normals.end(), canBeTraced) &&
           std::all_of(object.receivers.begin(), object.receivers.end(), canBeTraced) &&
           std::all_of(object.elements.begin(), object.elements.end(),
                       [&](const std::array<std::uint32_t, 4>& corners) {
                           return std::all_of(corners.begin(), corners.end(),
                                              [&](std::uint32_t v) { return v < vertices; });
                       }) &&
           std::all_of(object.elementMaterial.begin(), object.elementMaterial.end(),
                       [&](std::uint32_t m) { return m < head_.materials.size(); });
}

} // namespace penumbra
