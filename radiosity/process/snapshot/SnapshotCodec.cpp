// Scene snapshots and edits as bytes, and back again without trusting them.
#include "radiosity/process/snapshot/SceneSnapshot.h"
#include "radiosity/process/snapshot/TextureCodec.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace penumbra {

namespace {

using Kind = NodeSnapshot::Kind;

void writeMesh(ByteWriter& out, const MeshData& mesh) {
    out.list(mesh.points);
    out.list(mesh.faceVertexCounts);
    out.list(mesh.faceVertexIndices);
    out.put(mesh.scheme);
    out.put(std::uint64_t(mesh.creases.size()));
    for (const Crease& crease : mesh.creases) {
        out.list(crease.vertices);
        out.put(crease.sharpness);
    }
    out.list(mesh.corners);
    out.list(mesh.holes);
    out.put(std::uint8_t(mesh.doubleSided));
    out.list(mesh.normals);
    out.list(mesh.faceMaterial);
    out.list(mesh.uvs);
}

MeshData readMesh(ByteReader& in) {
    MeshData mesh;
    mesh.points = in.list<glm::vec3>();
    mesh.faceVertexCounts = in.list<std::int32_t>();
    mesh.faceVertexIndices = in.list<std::int32_t>();
    mesh.scheme = SubdivisionScheme(in.get<std::underlying_type_t<SubdivisionScheme>>());
    mesh.creases.resize(in.count(sizeof(std::uint64_t) + sizeof(float)));
    for (Crease& crease : mesh.creases) {
        crease.vertices = in.list<std::int32_t>();
        crease.sharpness = in.get<float>();
    }
    mesh.corners = in.list<Corner>();
    mesh.holes = in.list<std::int32_t>();
    mesh.doubleSided = in.get<std::uint8_t>() != 0;
    mesh.normals = in.list<glm::vec3>();
    mesh.faceMaterial = in.list<std::uint16_t>();
    mesh.uvs = in.list<glm::vec2>();
    return mesh;
}

/// What a reader of files has seen to, see MeshData.
bool sound(const MeshData& mesh, std::size_t materials) {
    const auto below = [](std::size_t count) {
        return [count](std::int64_t i) { return i >= 0 && std::uint64_t(i) < count; };
    };
    const auto all = [](const auto& list, auto test) {
        return std::all_of(list.begin(), list.end(), test);
    };
    const auto isFinite = [](glm::vec3 p) {
        return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    };
    const auto isPoint = below(mesh.points.size());
    std::uint64_t corners = 0;
    for (std::int32_t count : mesh.faceVertexCounts) {
        if (count < 3) return false;
        corners += std::uint64_t(count);
    }
    return corners == mesh.faceVertexIndices.size() && all(mesh.faceVertexIndices, isPoint) &&
           all(mesh.points, isFinite) && all(mesh.normals, isFinite) &&
           (mesh.normals.empty() || mesh.normals.size() == mesh.faceVertexIndices.size()) &&
           int(mesh.scheme) >= 0 && int(mesh.scheme) <= int(SubdivisionScheme::loop) &&
           all(mesh.creases,
               [&](const Crease& c) {
                   return c.vertices.size() >= 2 && all(c.vertices, isPoint) &&
                          std::isfinite(c.sharpness);
               }) &&
           all(mesh.corners,
               [&](const Corner& c) { return isPoint(c.vertex) && std::isfinite(c.sharpness); }) &&
           all(mesh.holes, below(mesh.faceVertexCounts.size())) && materials > 0 &&
           (mesh.uvs.empty() || mesh.uvs.size() == corners) &&
           all(mesh.uvs, [](glm::vec2 uv) { return std::isfinite(uv.x) && std::isfinite(uv.y); }) &&
           (mesh.faceMaterial.empty() ||
            (mesh.faceMaterial.size() == mesh.faceVertexCounts.size() &&
             all(mesh.faceMaterial, below(materials))));
}

void writeShape(ByteWriter& out, const LightShape& shape) {
    out.put(std::uint8_t(shape.index()));
    std::visit([&](const auto& s) { out.put(s); }, shape);
}

LightShape readShape(ByteReader& in) {
    const auto good = [&](float size) {
        if (!std::isfinite(size) || size < 0) in.fail();
    };
    switch (in.get<std::uint8_t>()) {
    case 0: {
        const auto rect = in.get<RectShape>();
        good(rect.width), good(rect.height);
        return rect;
    }
    case 1: {
        const auto disk = in.get<DiskShape>();
        good(disk.radius);
        return disk;
    }
    case 2: {
        const auto sphere = in.get<SphereShape>();
        good(sphere.radius);
        return sphere;
    }
    default:
        in.fail();
        return {};
    }
}

void writeNode(ByteWriter& out, const NodeSnapshot& node) {
    out.put(node.kind);
    if (node.kind == Kind::none) return;
    out.text(node.name);
    switch (node.kind) {
    case Kind::transform:
        out.put(node.matrix);
        out.put(std::uint8_t(node.beginsObject));
        out.list(node.children);
        break;
    case Kind::choice:
        out.put(std::uint8_t(node.visible));
        [[fallthrough]];
    case Kind::group:
        out.list(node.children);
        break;
    case Kind::light:
        writeShape(out, node.shape);
        out.put(node.luminance);
        break;
    case Kind::mesh:
        out.list(node.materials);
        writeMesh(out, *node.mesh);
        break;
    case Kind::none:
        break;
    }
}

void readMeshNode(ByteReader& in, NodeSnapshot& node) {
    node.materials = in.list<std::uint32_t>();
    MeshData mesh = readMesh(in);
    if (!in.ok() || !sound(mesh, node.materials.size())) return in.fail();
    node.mesh = std::make_shared<const MeshData>(std::move(mesh));
}

NodeSnapshot readNode(ByteReader& in) {
    NodeSnapshot node;
    node.kind = in.get<Kind>();
    if (node.kind == Kind::none) return node;
    node.name = in.text();
    switch (node.kind) {
    case Kind::transform:
        node.matrix = in.get<glm::dmat4>();
        node.beginsObject = in.get<std::uint8_t>() != 0;
        node.children = in.list<std::uint32_t>();
        break;
    case Kind::choice:
        node.visible = in.get<std::uint8_t>() != 0;
        [[fallthrough]];
    case Kind::group:
        node.children = in.list<std::uint32_t>();
        break;
    case Kind::light:
        node.shape = readShape(in);
        node.luminance = in.get<Rgb>();
        break;
    case Kind::mesh:
        readMeshNode(in, node);
        break;
    default:
        in.fail();
    }
    return node;
}

template <class Edit>
Edit readTarget(ByteReader& in) {
    Edit edit{};
    if constexpr (requires { edit.node; })
        edit.node = in.get<std::uint32_t>();
    else
        edit.material = in.get<std::uint32_t>();
    return edit;
}

void writeMaterials(ByteWriter& out, std::span<const MaterialSnapshot> materials) {
    out.put(std::uint64_t(materials.size()));
    std::vector<MaterialTextures> textures;
    for (const MaterialSnapshot& material : materials) {
        out.text(material.name);
        out.put(material.reflectance);
        out.put(material.emission);
        textures.push_back(material.textures);
    }
    writeTextures(out, textures);
}

std::vector<MaterialSnapshot> readMaterials(ByteReader& in) {
    std::vector<MaterialSnapshot> materials(in.count(sizeof(std::uint64_t) + 2 * sizeof(Rgb)));
    for (MaterialSnapshot& material : materials) {
        material.name = in.text();
        material.reflectance = in.get<Rgb>();
        material.emission = in.get<Rgb>();
    }
    const auto textures = readTextures(in, materials.size());
    for (std::size_t m = 0; m < textures.size(); ++m) materials[m].textures = textures[m];
    return materials;
}

void writeNodes(ByteWriter& out, std::span<const NodeSnapshot> nodes) {
    out.put(std::uint64_t(nodes.size()));
    for (const NodeSnapshot& node : nodes) writeNode(out, node);
}

std::vector<NodeSnapshot> readNodes(ByteReader& in) {
    std::vector<NodeSnapshot> nodes;
    const std::size_t count = in.count(sizeof(Kind));
    for (std::size_t n = 0; n < count && in.ok(); ++n) nodes.push_back(readNode(in));
    return nodes;
}

} // namespace

void write(ByteWriter& out, const SceneSnapshot& snapshot) {
    writeMaterials(out, snapshot.materials);
    writeNodes(out, snapshot.nodes);
}

std::optional<SceneSnapshot> readSceneSnapshot(ByteReader& in) {
    SceneSnapshot snapshot;
    snapshot.materials = readMaterials(in);
    snapshot.nodes = readNodes(in);
    if (!in.ok() || !makesSense(snapshot)) return std::nullopt;
    return snapshot;
}

void write(ByteWriter& out, const SceneGrowth& growth) {
    out.put(growth.firstNode);
    out.put(growth.firstMaterial);
    writeMaterials(out, growth.materials);
    writeNodes(out, growth.nodes);
    out.put(std::uint64_t(growth.children.size()));
    for (const SetChildren& edit : growth.children) out.put(edit.node), out.list(edit.children);
    out.list(growth.gone);
}

std::optional<SceneGrowth> readSceneGrowth(ByteReader& in) {
    SceneGrowth growth;
    growth.firstNode = in.get<std::uint32_t>();
    growth.firstMaterial = in.get<std::uint32_t>();
    growth.materials = readMaterials(in);
    growth.nodes = readNodes(in);
    growth.children.resize(in.count(sizeof(std::uint32_t) + sizeof(std::uint64_t)));
    for (SetChildren& edit : growth.children) {
        edit.node = in.get<std::uint32_t>();
        edit.children = in.list<std::uint32_t>();
    }
    growth.gone = in.list<std::uint32_t>();
    if (!in.ok()) return std::nullopt;
    return growth;
}

void write(ByteWriter& out, const GraphEdit& edit) {
    out.put(std::uint8_t(edit.index()));
    struct Fields {
        ByteWriter& out;
        void operator()(const SetMatrix& e) const { out.put(e.node), out.put(e.matrix); }
        void operator()(const SetVisible& e) const {
            out.put(e.node), out.put(std::uint8_t(e.visible));
        }
        void operator()(const SetLuminance& e) const { out.put(e.node), out.put(e.luminance); }
        void operator()(const SetMaterial& e) const {
            out.put(e.material), out.put(e.reflectance), out.put(e.emission);
        }
        void operator()(const SetChildren& e) const { out.put(e.node), out.list(e.children); }
        void operator()(const SetBeginsObject& e) const {
            out.put(e.node), out.put(std::uint8_t(e.beginsObject));
        }
    };
    std::visit(Fields{out}, edit);
}

std::optional<GraphEdit> readGraphEdit(ByteReader& in) {
    GraphEdit edit;
    switch (in.get<std::uint8_t>()) {
    case 0: {
        auto& e = edit.emplace<SetMatrix>(readTarget<SetMatrix>(in));
        e.matrix = in.get<glm::dmat4>();
        break;
    }
    case 1: {
        auto& e = edit.emplace<SetVisible>(readTarget<SetVisible>(in));
        e.visible = in.get<std::uint8_t>() != 0;
        break;
    }
    case 2: {
        auto& e = edit.emplace<SetLuminance>(readTarget<SetLuminance>(in));
        e.luminance = in.get<Rgb>();
        break;
    }
    case 3: {
        auto& e = edit.emplace<SetMaterial>(readTarget<SetMaterial>(in));
        e.reflectance = in.get<Rgb>();
        e.emission = in.get<Rgb>();
        break;
    }
    case 4: {
        auto& e = edit.emplace<SetChildren>(readTarget<SetChildren>(in));
        e.children = in.list<std::uint32_t>();
        break;
    }
    case 5: {
        auto& e = edit.emplace<SetBeginsObject>(readTarget<SetBeginsObject>(in));
        e.beginsObject = in.get<std::uint8_t>() != 0;
        break;
    }
    default:
        in.fail();
    }
    if (!in.ok()) return std::nullopt;
    return edit;
}

} // namespace penumbra
