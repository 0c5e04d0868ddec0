#include "viewer/GeometryCache.h"

#include "scenegraph/LitGeometry.h"
#include "viewer/Shaders.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

namespace penumbra {

namespace {

/// Fills a new buffer and feeds it to a vertex attribute of three floats.
template <class T>
GlObject attributeBuffer(LitAttribute attribute, const std::vector<T>& values, GLenum usage) {
    static_assert(sizeof(T) == 3 * sizeof(float));
    GlObject buffer = makeBuffer();
    glBindBuffer(GL_ARRAY_BUFFER, buffer.name());
    glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(values.size() * sizeof(T)), values.data(), usage);
    glVertexAttribPointer(attribute, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    glEnableVertexAttribArray(attribute);
    return buffer;
}

/// Copies values first ... first + count - 1.
void replaceValues(const GlObject& buffer, const std::vector<Rgb>& values, std::size_t first,
                   std::size_t count) {
    glBindBuffer(GL_ARRAY_BUFFER, buffer.name());
    glBufferSubData(GL_ARRAY_BUFFER, GLintptr(first * sizeof(Rgb)), GLsizeiptr(count * sizeof(Rgb)),
                    values.data() + first);
}

/// Indices of all triangles, those of one material after those of another, and where each begins.
std::vector<std::uint32_t> sortByMaterial(const LitMeshData& mesh,
                                          std::vector<MaterialRange>& ranges) {
    std::vector<std::uint32_t> order(mesh.triangleMaterial.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return mesh.triangleMaterial[a] < mesh.triangleMaterial[b];
    });
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

} // namespace

GpuGeometry::GpuGeometry(const LitGeometry& geometry)
    : vertexArray_(makeVertexArray()), revision_(geometry.revision()),
      topologyRevision_(geometry.topologyRevision()), blockRevisions_(geometry.blockRevisions()),
      blockTimes_(blockRevisions_.size(), -1e6f) {
    const LitMeshData& mesh = geometry.data();
    assert(mesh.direct.size() == mesh.positions.size());
    assert(mesh.indirect.size() == mesh.positions.size());
    glBindVertexArray(vertexArray_.name());
    positions_ = attributeBuffer(kPosition, mesh.positions, GL_STATIC_DRAW);
    normals_ = attributeBuffer(kNormal, mesh.normals, GL_STATIC_DRAW);
    direct_ = attributeBuffer(kDirect, mesh.direct, GL_DYNAMIC_DRAW);
    indirect_ = attributeBuffer(kIndirect, mesh.indirect, GL_DYNAMIC_DRAW);

    const std::vector<std::uint32_t> indices = sortByMaterial(mesh, ranges_);
    indices_ = makeBuffer();
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(indices.size() * sizeof(std::uint32_t)),
                 indices.data(), GL_STATIC_DRAW);
    glBindVertexArray(0);
}

std::size_t GpuGeometry::refresh(const LitGeometry& geometry, double now) {
    if (std::exchange(revision_, geometry.revision()) == geometry.revision()) return 0;
    const std::vector<std::uint64_t>& latest = geometry.blockRevisions();
    const std::size_t vertices = geometry.data().direct.size();
    std::size_t bytes = 0;
    for (std::size_t block = 0; block < latest.size(); ++block) {
        const std::size_t begin = block;
        while (block < latest.size() && blockRevisions_[block] != latest[block]) {
            blockTimes_[block] = float(now);
            ++block;
        }
        if (block == begin) continue;
        const std::size_t first = begin * LitGeometry::kBlock;
        const std::size_t count = std::min(block * LitGeometry::kBlock, vertices) - first;
        replaceValues(direct_, geometry.data().direct, first, count);
        replaceValues(indirect_, geometry.data().indirect, first, count);
        bytes += 2 * count * sizeof(Rgb);
    }
    blockRevisions_ = latest;
    return bytes;
}

bool GpuGeometry::sameTopology(const LitGeometry& geometry) const {
    return topologyRevision_ == geometry.topologyRevision();
}

void GpuGeometry::bind() const {
    glBindVertexArray(vertexArray_.name());
}

void GeometryCache::dropDead(double now) {
    now_ = now;
    std::erase_if(entries_, [](const auto& entry) { return entry.second.alive.expired(); });
}

const GpuGeometry& GeometryCache::get(const DrawItem& item) {
    const auto found = entries_.find(item.geometry);
    if (found != entries_.end() && !found->second.gpu.sameTopology(*item.geometry)) {
        entries_.erase(found);
    } else if (found != entries_.end()) {
        const std::size_t bytes = found->second.gpu.refresh(*item.geometry, now_);
        lightUploads_ += bytes > 0;
        lightBytes_ += bytes;
        return found->second.gpu;
    }
    ++uploads_;
    Entry entry{ownerOf(*item.parent, *item.geometry), GpuGeometry(*item.geometry)};
    return entries_.emplace(item.geometry, std::move(entry)).first->second.gpu;
}

} // namespace penumbra
