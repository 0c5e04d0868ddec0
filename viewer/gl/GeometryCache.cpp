#include "viewer/gl/GeometryCache.h"

#include "scenegraph/LitGeometry.h"
#include "viewer/gl/Shaders.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cassert>
#include <numeric>
#include <span>
#include <utility>

namespace penumbra {

namespace {

/// Fills a new buffer with room for so many values, or for those that there are, and feeds it to a
/// vertex attribute of as many floats as T has.
template <class T>
GlObject attributeBuffer(LitAttribute attribute, const std::vector<T>& values, GLenum usage,
                         std::size_t room = 0) {
    GlObject buffer = makeBuffer();
    glBindBuffer(GL_ARRAY_BUFFER, buffer.name());
    constexpr std::size_t kFloat = sizeof(float);
    const auto bytes = GLsizeiptr(values.size() * sizeof(T));
    if (room > values.size()) {
        glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(room * sizeof(T)), nullptr, usage);
        glBufferSubData(GL_ARRAY_BUFFER, 0, bytes, values.data());
    } else {
        glBufferData(GL_ARRAY_BUFFER, bytes, values.data(), usage);
    }
    glVertexAttribPointer(attribute, GLint(sizeof(T) / kFloat), GL_FLOAT, GL_FALSE, 0, nullptr);
    glEnableVertexAttribArray(attribute);
    return buffer;
}

/// Writes values behind the first so many; returns how many bytes.
template <class T>
std::size_t writeValues(const GlObject& buffer, const std::vector<T>& values, std::size_t before) {
    glBindBuffer(GL_ARRAY_BUFFER, buffer.name());
    glBufferSubData(GL_ARRAY_BUFFER, GLintptr(before * sizeof(T)),
                    GLsizeiptr(values.size() * sizeof(T)), values.data());
    return values.size() * sizeof(T);
}

/// Copies values first ... first + count - 1; returns how many bytes.
template <class T>
std::size_t replaceValues(const GlObject& buffer, const std::vector<T>& values, std::size_t first,
                          std::size_t count) {
    glBindBuffer(GL_ARRAY_BUFFER, buffer.name());
    glBufferSubData(GL_ARRAY_BUFFER, GLintptr(first * sizeof(T)), GLsizeiptr(count * sizeof(T)),
                    values.data() + first);
    return count * sizeof(T);
}

/// What the shader wants of the factors.
std::vector<glm::vec4> forMaps(std::span<const LightFactors> factors) {
    std::vector<glm::vec4> first;
    first.reserve(factors.size());
    for (const LightFactors& f : factors) first.emplace_back(f[0], f[1], f[2], f[3]);
    return first;
}

/// The triangles, those of one material after those of another.
std::vector<std::uint32_t> orderByMaterial(const LitMeshData& mesh) {
    std::vector<std::uint32_t> order(mesh.triangleMaterial.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return mesh.triangleMaterial[a] < mesh.triangleMaterial[b];
    });
    return order;
}

/// Indices of all triangles in that order, and where each material begins.
std::vector<std::uint32_t> sortByMaterial(const LitMeshData& mesh,
                                          std::vector<MaterialRange>& ranges) {
    const std::vector<std::uint32_t> order = orderByMaterial(mesh);
    std::vector<std::uint32_t> indices;
    indices.reserve(mesh.indices.size());
    for (std::uint32_t triangle : order) {
        const std::uint32_t material = mesh.triangleMaterial[triangle];
        if (ranges.empty() || ranges.back().material != material)
            ranges.push_back({material, indices.size(), 0});
        for (std::size_t corner = 0; corner < 3; ++corner)
            indices.push_back(mesh.indices[3 * std::size_t(triangle) + corner]);
        ranges.back().indexCount += 3;
    }
    return indices;
}

/// Cuts ranges into runs of so many triangles at most; neighbours in the list are neighbours in
/// space, as patches are.
std::vector<TriangleChunk> cutIntoChunks(const std::vector<std::uint32_t>& indices,
                                         const std::vector<MaterialRange>& ranges,
                                         const std::vector<glm::vec3>& positions) {
    constexpr std::size_t kMost = 3 * 96;
    std::vector<TriangleChunk> chunks;
    for (std::size_t r = 0; r < ranges.size(); ++r)
        for (std::size_t done = 0; done < ranges[r].indexCount; done += kMost) {
            TriangleChunk chunk{
                r, ranges[r].firstIndex + done, std::min(kMost, ranges[r].indexCount - done), {}};
            for (std::size_t i = 0; i < chunk.indexCount; ++i)
                chunk.bounds.add(positions[indices[chunk.firstIndex + i]]);
            chunks.push_back(chunk);
        }
    return chunks;
}

/// Where new light is searched for: in the shown light, or else in the geometry's own.
std::uint64_t revisionOf(const LitGeometry& geometry, const ShownLight* shown) {
    return shown ? shown->revision : geometry.revision();
}
const std::vector<std::uint64_t>& blockRevisionsOf(const LitGeometry& geometry,
                                                   const ShownLight* shown) {
    return shown ? shown->blockRevisions : geometry.blockRevisions();
}

} // namespace

GpuGeometry::GpuGeometry(const LitGeometry& geometry, const ShownLight* shown, bool factors)
    : vertexArray_(makeVertexArray()), shown_(shown), revision_(revisionOf(geometry, shown)),
      topologyRevision_(geometry.topologyRevision()),
      blockRevisions_(blockRevisionsOf(geometry, shown)) {
    const LitMeshData& mesh = geometry.data();
    assert(mesh.direct.size() == mesh.positions.size());
    assert(mesh.indirect.size() == mesh.positions.size());
    makeBuffers(geometry, shown);
    glBindVertexArray(vertexArray_.name());
    const std::vector<std::uint32_t> indices = sortByMaterial(mesh, ranges_);
    indices_ = makeBuffer();
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(indices.size() * sizeof(std::uint32_t)),
                 indices.data(), GL_STATIC_DRAW);
    glBindVertexArray(0);
    chunks_ = cutIntoChunks(indices, ranges_, mesh.positions);
    requireFactors(shown, factors);
    if (shown) splitCorners(geometry, shown->corners);
}

/// Fills buffers of vertices with the geometry and its light, and some room behind that for copies
/// of vertices, if there are any.
void GpuGeometry::makeBuffers(const LitGeometry& geometry, const ShownLight* shown) {
    const LitMeshData& mesh = geometry.data();
    const std::size_t copies = shown ? shown->corners.copies.size() : 0;
    assert(!shown || shown->direct.size() == mesh.positions.size() + copies);
    room_ = mesh.positions.size() + (copies > 0 ? 2 * copies + LitGeometry::kBlock : 0);
    glBindVertexArray(vertexArray_.name());
    positions_ = attributeBuffer(kPosition, mesh.positions, GL_STATIC_DRAW, room_);
    normals_ = attributeBuffer(kNormal, mesh.normals, GL_STATIC_DRAW, room_);
    if (!mesh.uvs.empty()) uvs_ = attributeBuffer(kUv, mesh.uvs, GL_STATIC_DRAW, room_);
    direct_ = attributeBuffer(kDirect, shown ? shown->direct : mesh.direct, GL_DYNAMIC_DRAW, room_);
    indirect_ =
        attributeBuffer(kIndirect, shown ? shown->indirect : mesh.indirect, GL_DYNAMIC_DRAW, room_);
    dropFactors();           // they have no room for copies
    corners_.copies.clear(); // they have no slots yet
    glBindVertexArray(0);
}

/// Notes where triangles lie in the index buffer.
void GpuGeometry::placeEntries(const LitMeshData& mesh) {
    if (!trianglePlaces_.empty()) return;
    const std::vector<std::uint32_t> order = orderByMaterial(mesh);
    trianglePlaces_.resize(order.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) trianglePlaces_[order[i]] = i;
}

std::size_t GpuGeometry::writeEntry(std::uint32_t entry, std::uint32_t vertex) {
    const std::size_t place = 3 * std::size_t(trianglePlaces_[entry / 3]) + entry % 3;
    glBufferSubData(GL_ELEMENT_ARRAY_BUFFER, GLintptr(place * sizeof vertex), sizeof vertex,
                    &vertex);
    return sizeof vertex;
}

/// Draws corners with copies of vertices, as the light wants it, and no others; returns how many
/// bytes are copied.
std::size_t GpuGeometry::splitCorners(const LitGeometry& geometry, const SplitCorners& corners) {
    if (corners == corners_) return 0;
    const LitMeshData& mesh = geometry.data();
    placeEntries(mesh);
    glBindVertexArray(vertexArray_.name()); // has the index buffer
    std::size_t bytes = 0;
    for (const auto& [entry, copy] : corners_.entries)
        bytes += writeEntry(entry, mesh.indices[entry]);
    corners_ = corners;
    const std::size_t first = mesh.positions.size();
    for (const auto& [entry, copy] : corners_.entries)
        bytes += writeEntry(entry, std::uint32_t(first + copy));
    std::vector<glm::vec3> points, normals;
    std::vector<glm::vec2> uvs;
    for (const std::uint32_t v : corners_.copies) {
        points.push_back(mesh.positions[v]);
        normals.push_back(mesh.normals[v]);
        if (!mesh.uvs.empty()) uvs.push_back(mesh.uvs[v]);
    }
    if (!uvs.empty()) bytes += writeValues(uvs_, uvs, first);
    bytes += writeValues(positions_, points, first) + writeValues(normals_, normals, first);
    glBindVertexArray(0);
    return bytes;
}

void GpuGeometry::dropFactors() {
    glDisableVertexAttribArray(kFactors);
    glDisableVertexAttribArray(kBehind);
    factors_ = {};
    behind_ = {};
}

/// Makes room for the factors of previewed lights, or removes it.
void GpuGeometry::requireFactors(const ShownLight* shown, bool wanted) {
    const bool has = factors_.name() != 0, needs = wanted && shown && !shown->factors.empty();
    if (has == needs) return;
    glBindVertexArray(vertexArray_.name());
    if (needs) {
        factors_ = attributeBuffer(kFactors, forMaps(shown->factors), GL_DYNAMIC_DRAW, room_);
        behind_ = attributeBuffer(kBehind, shown->behind, GL_DYNAMIC_DRAW, room_);
    } else {
        dropFactors();
    }
    glBindVertexArray(0);
}

std::size_t GpuGeometry::copyIndirect(const ShownLight* shown, const LitGeometry& geometry,
                                      std::size_t first, std::size_t count) {
    return replaceValues(indirect_, shown ? shown->indirect : geometry.data().indirect, first,
                         count);
}

/// All but the indirect light.
std::size_t GpuGeometry::copyOthers(const ShownLight* shown, const LitGeometry& geometry,
                                    std::size_t first, std::size_t count) {
    std::size_t bytes =
        replaceValues(direct_, shown ? shown->direct : geometry.data().direct, first, count);
    if (factors_.name() != 0)
        bytes +=
            writeValues(factors_, forMaps(std::span(shown->factors).subspan(first, count)), first) +
            replaceValues(behind_, shown->behind, first, count);
    return bytes;
}

std::size_t GpuGeometry::refresh(const LitGeometry& geometry, const ShownLight* shown,
                                 bool factors) {
    requireFactors(shown, factors);
    const std::uint64_t newest = revisionOf(geometry, shown);
    const bool otherLight = std::exchange(shown_, shown) != shown;
    if (std::exchange(revision_, newest) == newest && !otherLight) return 0;
    const std::vector<std::uint64_t>& latest = blockRevisionsOf(geometry, shown);
    if (otherLight) blockRevisions_.clear();
    blockRevisions_.resize(latest.size(), 0);
    const std::size_t vertices = shown ? shown->direct.size() : geometry.data().direct.size();
    std::size_t bytes = 0;
    if (vertices > room_) {
        makeBuffers(geometry, shown);
        blockRevisions_ = latest;
        bytes += vertices * (2 * sizeof(Rgb) + 2 * sizeof(glm::vec3));
    }
    requireFactors(shown, factors);
    bytes += splitCorners(geometry, shown ? shown->corners : SplitCorners());
    const auto copyRuns = [&](auto changed, auto copy) {
        for (std::size_t block = 0; block < latest.size(); ++block) {
            const std::size_t begin = block;
            while (block < latest.size() && changed(block)) ++block;
            if (block == begin) continue;
            const std::size_t first = begin * LitGeometry::kBlock;
            const std::size_t count = std::min(block * LitGeometry::kBlock, vertices) - first;
            bytes += (this->*copy)(shown, geometry, first, count);
        }
    };
    const auto changed = [&](std::size_t b) { return blockRevisions_[b] != latest[b]; };
    copyRuns(changed, &GpuGeometry::copyIndirect);
    copyRuns(
        [&](std::size_t b) {
            return changed(b) && !(shown && shown->onlyIndirectSince(b, blockRevisions_[b]));
        },
        &GpuGeometry::copyOthers);
    blockRevisions_ = latest;
    return bytes;
}

bool GpuGeometry::sameTopology(const LitGeometry& geometry) const {
    return topologyRevision_ == geometry.topologyRevision();
}

void GpuGeometry::bind() const {
    glBindVertexArray(vertexArray_.name());
}

void GeometryCache::dropDead() {
    std::erase_if(entries_, [](const auto& entry) { return entry.second.alive.expired(); });
}

const GpuGeometry& GeometryCache::get(const DrawItem& item) {
    return get(*item.geometry, item.shown, ownerOf(*item.parent, *item.geometry));
}

const GpuGeometry& GeometryCache::peek(const std::shared_ptr<const LitGeometry>& geometry) {
    const auto found = entries_.find(geometry.get());
    if (found != entries_.end() && found->second.gpu.sameTopology(*geometry))
        return found->second.gpu;
    return get(*geometry, nullptr, geometry);
}

const GpuGeometry& GeometryCache::get(const LitGeometry& geometry, const ShownLight* shown,
                                      const std::weak_ptr<const Node>& owner) {
    const auto found = entries_.find(&geometry);
    if (found != entries_.end() && !found->second.gpu.sameTopology(geometry)) {
        entries_.erase(found);
    } else if (found != entries_.end()) {
        const std::size_t bytes = found->second.gpu.refresh(geometry, shown, factors_);
        lightUploads_ += bytes > 0;
        lightBytes_ += bytes;
        return found->second.gpu;
    }
    ++uploads_;
    Entry entry{owner, GpuGeometry(geometry, shown, factors_)};
    return entries_.emplace(&geometry, std::move(entry)).first->second.gpu;
}

} // namespace penumbra
