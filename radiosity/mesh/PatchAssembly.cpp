#include "radiosity/mesh/PatchAssembly.h"

#include "radiosity/mesh/Contact.h"
#include "radiosity/mesh/LightShapes.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

namespace penumbra {

namespace {

constexpr std::uint32_t kNone = Element::kNone;

bool planar(const Tessellation& tessellation, const Cell& cell, glm::vec3 normal) {
    const glm::vec3 origin = tessellation.outline[cell.firstCorner];
    float reach = 0, depth = 0;
    for (std::uint32_t i = 1; i < cell.cornerCount; ++i) {
        const glm::vec3 d = tessellation.outline[cell.firstCorner + i] - origin;
        reach = std::max(reach, glm::length(d));
        depth = std::max(depth, std::abs(glm::dot(d, normal)));
    }
    return depth <= 1e-4f * reach;
}

/// Fills up the last block.
template <class T>
void padBlock(std::vector<T>& items, const T& padding) {
    while (items.size() % PatchSet::kBlock != 0) items.push_back(padding);
}

/// Position on a space-filling curve of a point of the unit cube, 30 bits (Morton 1966).
std::uint32_t mortonCode(glm::vec3 p) {
    std::uint32_t code = 0;
    const glm::uvec3 cell(glm::clamp(p, 0.0f, 1.0f) * 1023.0f);
    for (int bit = 9; bit >= 0; --bit)
        for (int axis = 0; axis < 3; ++axis) code = code << 1 | (cell[axis] >> bit & 1);
    return code;
}

std::uint32_t rootOf(std::vector<std::uint32_t>& parent, std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
}

} // namespace

std::uint32_t PatchAssembly::materialIndex(const Material& material, bool emits) {
    const auto [found, fresh] =
        materials_.try_emplace({&material, emits}, std::uint32_t(out_.materials.size()));
    if (fresh) {
        MaterialTextures textures = material.textures();
        if (!emits) textures.emission.reset();
        out_.materials.push_back(
            {material.reflectance(), emits ? material.emission() : Rgb(), std::move(textures)});
        materialSources_.push_back({&material, emits});
    }
    return found->second;
}

void PatchAssembly::add(const SurfaceMesh& mesh, const Tessellation& tessellation,
                        ObjectId object) {
    Range& elements = out_.objects[object.value].elements;
    if (elements.count == 0) elements.first = std::uint32_t(out_.elements.size());
    addRays(mesh, tessellation, object);
    addSheet(mesh, tessellation, object, false);
    addSheet(mesh, tessellation, object, true);
    elements.count = std::uint32_t(out_.elements.size()) - elements.first;
}

/// Flat faces block rays as the triangles of their cells, curved ones as their elements.
void PatchAssembly::addRays(const SurfaceMesh& mesh, const Tessellation& tessellation,
                            ObjectId object) {
    RayMesh& rays = out_.rayMeshes[object.value];
    std::vector<std::uint8_t> flat(tessellation.cells.size());
    const auto add = [&](const SurfaceFace& face, std::array<std::uint32_t, 3> t) {
        if (face.solid && !face.front) std::swap(t[1], t[2]); // inside out: its outside is its back
        rays.triangles.push_back(t);
        rays.solid.push_back(face.solid);
    };
    for (std::size_t c = 0; c < tessellation.cells.size(); ++c) {
        const Cell& cell = tessellation.cells[c];
        const SurfaceFace& face = mesh.faces[cell.face];
        const glm::dvec3 normal = newellNormal(mesh.points, mesh.cornersOf(face));
        flat[c] = !tessellation.smooth && glm::length(normal) > 0 &&
                  planar(tessellation, cell, glm::vec3(glm::normalize(normal)));
        if (!flat[c]) continue;
        const auto base = std::uint32_t(rays.vertices.size());
        for (std::uint32_t i = 0; i < cell.cornerCount; ++i)
            rays.vertices.push_back(tessellation.outline[cell.firstCorner + i]);
        for (std::uint32_t i = 2; i < cell.cornerCount; ++i)
            add(face, {base, base + i - 1, base + i});
    }
    std::unordered_map<std::uint32_t, std::uint32_t> index;
    const auto vertex = [&](std::uint32_t v) {
        const auto [found, fresh] = index.try_emplace(v, std::uint32_t(rays.vertices.size()));
        if (fresh) rays.vertices.push_back(tessellation.vertices[v].position);
        return found->second;
    };
    for (const Facet& facet : tessellation.facets) {
        if (flat[facet.cell]) continue;
        const SurfaceFace& face = mesh.faces[tessellation.cells[facet.cell].face];
        const auto& v = facet.vertices;
        add(face, {vertex(v[0]), vertex(v[1]), vertex(v[2])});
        if (v[2] != v[3]) add(face, {vertex(v[0]), vertex(v[2]), vertex(v[3])});
    }
}

void PatchAssembly::addSheet(const SurfaceMesh& mesh, const Tessellation& tessellation,
                             ObjectId object, bool back) {
    const auto firstCell = std::uint32_t(cells_.size());
    for (const Cell& cell : tessellation.cells) {
        SheetCell sheet;
        sheet.whole = cell.whole;
        sheet.smooth = tessellation.smooth;
        sheet.object = object;
        const SurfaceFace& face = mesh.faces[cell.face];
        sheet.present = back ? face.back : face.front;
        if (sheet.present) {
            sheet.material = materialIndex(mesh.materialOf(face), !back);
            const auto first = tessellation.outline.begin() + cell.firstCorner;
            sheet.outline.assign(first, first + cell.cornerCount);
            if (back) std::reverse(sheet.outline.begin() + 1, sheet.outline.end());
        }
        cells_.push_back(std::move(sheet));
    }
    addElements(tessellation, firstCell, object, back, !mesh.uvs.empty());
}

void PatchAssembly::addElements(const Tessellation& tessellation, std::uint32_t firstCell,
                                ObjectId object, bool back, bool textured) {
    std::vector<std::uint32_t> index(tessellation.vertices.size(), kNone);
    const auto vertex = [&](std::uint32_t v) {
        if (index[v] != kNone) return index[v];
        const SurfacePoint& point = tessellation.vertices[v];
        const glm::vec3 normal = back ? -point.normal : point.normal;
        out_.vertices.push_back({point.position, {point.position, normal}});
        return index[v] = std::uint32_t(out_.vertices.size() - 1);
    };
    for (const Facet& facet : tessellation.facets) {
        const std::uint32_t cell = firstCell + facet.cell;
        if (!cells_[cell].present) continue;
        const std::size_t count = facet.vertices[2] == facet.vertices[3] ? 3 : 4;
        Element element;
        CornerCoordinates st, uv;
        for (std::size_t k = 0; k < 4; ++k) { // the back is wound the other way round, st mirrored
            const std::size_t corner = std::min(k, count - 1);
            const std::size_t from = back ? (count - corner) % count : corner;
            element.vertices[k] = vertex(facet.vertices[from]);
            st[k] = back ? glm::vec2(facet.st[from].y, facet.st[from].x) : facet.st[from];
            uv[k] = facet.uv[from];
        }
        element.material = cells_[cell].material;
        out_.elements.push_back(element);
        out_.elementObject.push_back(object);
        elementCell_.push_back(cell);
        elementSt_.push_back(st);
        if (textured) {
            out_.textures.uvs.resize(out_.elements.size());
            out_.textures.uvs.back() = uv;
        }
    }
}

void PatchAssembly::finish() {
    std::vector<std::uint8_t> free;
    resolveFixedContacts(free);
    const std::vector<std::uint32_t> order = cellsInOrder();
    std::vector<std::vector<std::uint32_t>> cellElements(cells_.size());
    for (std::uint32_t e = 0; e < elementCell_.size(); ++e)
        cellElements[elementCell_[e]].push_back(e);
    orderVertices(cellElements, order);
    out_.covered.assign(out_.elements.size(), 0);
    out_.vertexCoordinates.assign(out_.vertices.size(), {});
    vertexNode_.assign(out_.vertices.size(), kNone);
    vertexPlaced_.assign(out_.vertices.size(), 0);

    for (std::size_t i = 0; i < order.size();) {
        const ObjectId object = cells_[order[i]].object;
        ObjectPart& part = out_.objects[object.value];
        part.patches.first = std::uint32_t(out_.patches.size());
        part.nodes.first = std::uint32_t(out_.nodes.size());
        part.corners.first = std::uint32_t(out_.corners.size());
        for (; i < order.size() && cells_[order[i]].object == object; ++i) {
            std::vector<std::uint32_t>& elements = cellElements[order[i]];
            std::erase_if(elements, [&](std::uint32_t e) { return !free[e]; });
            if (!elements.empty()) makePatches(order[i], elements);
        }
        part.patches.count = std::uint32_t(out_.patches.size()) - part.patches.first;
        part.nodes.count = std::uint32_t(out_.nodes.size()) - part.nodes.first;
        part.corners.count = std::uint32_t(out_.corners.size()) - part.corners.first;
        padBlock(out_.nodes, {});
        out_.nodeBlockObject.resize(out_.nodes.size() / PatchSet::kBlock, object);
    }
    out_.uncoveredNodes = out_.nodes;
    out_.uncoveredElements = out_.elements;
    out_.firstPrivate = std::uint32_t(out_.vertices.size());
    findTextureMeans(out_);
    placeMovables();
}

/// Movable objects are meshed as if nothing touched them.
void PatchAssembly::resolveFixedContacts(std::vector<std::uint8_t>& free) {
    std::vector<RayMesh> meshes(out_.rayMeshes.size());
    std::vector<std::uint8_t> fixed(out_.elements.size());
    for (std::size_t o = 0; o < meshes.size(); ++o)
        if (!out_.objects[o].movable) meshes[o] = out_.rayMeshes[o];
    for (std::size_t e = 0; e < fixed.size(); ++e)
        fixed[e] = !out_.objects[out_.elementObject[e].value].movable;
    free = resolveContacts(RayScene(meshes, out_.skin), meshes, out_.skin, fixed, out_.elements,
                           out_.vertices);
}

/// Object by object, within one along a space-filling curve: what is near in space shall be near
/// in memory.
std::vector<std::uint32_t> PatchAssembly::cellsInOrder() const {
    std::vector<Bounds> bounds(out_.objects.size());
    std::vector<glm::vec3> middle(cells_.size());
    for (std::size_t c = 0; c < cells_.size(); ++c) {
        if (cells_[c].outline.empty()) continue;
        for (glm::vec3 point : cells_[c].outline)
            middle[c] += point / float(cells_[c].outline.size());
        bounds[cells_[c].object.value].add(middle[c]);
    }
    std::vector<std::uint64_t> key(cells_.size());
    for (std::size_t c = 0; c < cells_.size(); ++c) {
        const Bounds& box = bounds[cells_[c].object.value];
        key[c] = std::uint64_t(cells_[c].object.value) << 32 |
                 mortonCode((middle[c] - box.lower) / glm::max(box.size(), glm::vec3(1e-20f)));
    }
    std::vector<std::uint32_t> order;
    for (std::uint32_t c = 0; c < cells_.size(); ++c)
        if (!cells_[c].outline.empty()) order.push_back(c);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return key[a] < key[b]; });
    return order;
}

/// Puts the vertices into blocks: object by object, cell by cell.
void PatchAssembly::orderVertices(const std::vector<std::vector<std::uint32_t>>& cellElements,
                                  const std::vector<std::uint32_t>& order) {
    std::vector<std::uint32_t> index(out_.vertices.size(), kNone);
    std::vector<Vertex> ordered;
    ordered.reserve(out_.vertices.size() + PatchSet::kBlock * out_.objects.size());
    for (std::size_t i = 0; i < order.size();) {
        const ObjectId object = cells_[order[i]].object;
        Range& range = out_.objects[object.value].vertices;
        range.first = std::uint32_t(ordered.size());
        for (; i < order.size() && cells_[order[i]].object == object; ++i)
            for (std::uint32_t e : cellElements[order[i]])
                for (std::uint32_t& v : out_.elements[e].vertices) {
                    if (index[v] == kNone) {
                        index[v] = std::uint32_t(ordered.size());
                        ordered.push_back(out_.vertices[v]);
                    }
                    v = index[v];
                }
        range.count = std::uint32_t(ordered.size()) - range.first;
        padBlock(ordered, {});
        out_.vertexBlockObject.resize(ordered.size() / PatchSet::kBlock, object);
    }
    out_.vertices = std::move(ordered);
}

void PatchAssembly::placeMovables() {
    for (std::uint32_t o = 0; o < out_.objects.size(); ++o) {
        ObjectPart& part = out_.objects[o];
        if (!part.movable) continue;
        ObjectShape& shape = part.shape;
        const auto copy = [](const auto& from, Range range, auto& to) {
            to.assign(from.begin() + range.first, from.begin() + range.end());
        };
        copy(out_.vertices, part.vertices, shape.vertices);
        copy(out_.nodes, part.nodes, shape.nodes);
        copy(out_.corners, part.corners, shape.corners);
        copy(out_.emitters, part.emitters, shape.emitters);
        for (std::uint32_t p = part.patches.first; p < part.patches.end(); ++p)
            shape.patches.push_back({out_.patches[p].centre, out_.patches[p].normal});
        shape.rayVertices = out_.rayMeshes[o].vertices;
        placeObject(out_, {o}, part.pose);
    }
}

/// Elements of a cell that hang together form a patch: one patch a cell, unless a contact (a
/// partition that stands on the floor) parts it.
void PatchAssembly::makePatches(std::uint32_t cell, const std::vector<std::uint32_t>& elements) {
    std::vector<std::uint32_t> parent(elements.size());
    std::iota(parent.begin(), parent.end(), 0u);
    std::unordered_map<std::uint32_t, std::uint32_t> seen;
    for (std::uint32_t i = 0; i < elements.size(); ++i)
        for (std::uint32_t v : out_.elements[elements[i]].vertices) {
            const auto [found, fresh] = seen.try_emplace(v, i);
            if (!fresh) parent[rootOf(parent, i)] = rootOf(parent, found->second);
        }
    std::unordered_map<std::uint32_t, std::size_t> groupOf;
    std::vector<Group> groups;
    for (std::uint32_t i = 0; i < elements.size(); ++i) {
        const auto [found, fresh] = groupOf.try_emplace(rootOf(parent, i), groups.size());
        if (fresh) groups.emplace_back();
        Group& group = groups[found->second];
        group.elements.push_back(elements[i]);
        for (glm::vec2 st : elementSt_[elements[i]]) group.part.add(st);
    }
    if (cells_[cell].whole) { // it has no coordinates to part it by
        for (std::size_t i = 1; i < groups.size(); ++i)
            groups[0].elements.insert(groups[0].elements.end(), groups[i].elements.begin(),
                                      groups[i].elements.end());
        groups.resize(1);
    }
    mergeOverlapping(groups);
    for (const Group& group : groups) makePatch(cells_[cell], group, groups.size() > 1);
}

/// What is sent is sent by the rectangle around a group: rectangles must not overlap.
void PatchAssembly::mergeOverlapping(std::vector<Group>& groups) {
    const auto overlap = [](const Group& a, const Group& b) {
        const glm::vec2 size =
            glm::min(a.part.high, b.part.high) - glm::max(a.part.low, b.part.low);
        return size.x > 1e-3f && size.y > 1e-3f;
    };
    for (std::size_t i = 0; i < groups.size(); ++i)
        for (std::size_t j = 0; j < groups.size(); ++j) {
            if (i == j || !overlap(groups[i], groups[j])) continue;
            Group& into = groups[std::min(i, j)];
            Group& from = groups[std::max(i, j)];
            into.elements.insert(into.elements.end(), from.elements.begin(), from.elements.end());
            into.part.add(from.part.low);
            into.part.add(from.part.high);
            groups.erase(groups.begin() + std::ptrdiff_t(std::max(i, j)));
            i = std::size_t(-1); // it has grown: search again
            break;
        }
}

/// Fills in area, centre and normal of a patch. \return false if it has no area
bool PatchAssembly::measure(Patch& patch, const std::vector<std::uint32_t>& elements) const {
    glm::vec3 areaVector(0), centre(0);
    for (std::uint32_t e : elements) {
        const Element& element = out_.elements[e];
        std::array<glm::vec3, 4> p;
        for (std::size_t k = 0; k < 4; ++k) p[k] = out_.vertices[element.vertices[k]].position;
        const glm::vec3 vector = 0.5f * glm::cross(p[2] - p[0], p[3] - p[1]);
        const float area = glm::length(vector);
        patch.area += area;
        areaVector += vector;
        centre += area * (element.isTriangle() ? (p[0] + p[1] + p[2]) / 3.0f
                                               : 0.25f * (p[0] + p[1] + p[2] + p[3]));
    }
    if (!(patch.area > 0)) return false;
    patch.centre = centre / patch.area;
    patch.normal = glm::length(areaVector) > 0 // not if it folds back on itself
                       ? glm::normalize(areaVector)
                       : out_.vertices[out_.elements[elements[0]].vertices[0]].receiver.normal;
    return true;
}

/// Gives a patch the corners of its cell, or of the part of it that the group spans.
/// \param part the cell has several patches. \return coordinates within the cell that it spans
PatchAssembly::Part PatchAssembly::placeCorners(Patch& patch, const SheetCell& cell,
                                                const Group& group, bool part) {
    const auto& q = cell.outline;
    Part spans{glm::vec2(0), glm::vec2(1)};
    patch.firstCorner = std::uint32_t(out_.corners.size());
    if (part && !cell.whole && q.size() == 4) {
        const glm::vec2 low = group.part.low, high = group.part.high;
        for (glm::vec2 st : {low, glm::vec2(high.x, low.y), high, glm::vec2(low.x, high.y)})
            out_.corners.push_back(
                glm::mix(glm::mix(q[0], q[1], st.x), glm::mix(q[3], q[2], st.x), st.y));
        spans = group.part;
    } else {
        out_.corners.insert(out_.corners.end(), q.begin(), q.end());
    }
    patch.cornerCount = std::uint32_t(out_.corners.size()) - patch.firstCorner;
    return spans;
}

/// Tells the vertices of a patch that no other patch has where they lie in it.
void PatchAssembly::placeVertices(std::uint32_t index, const std::vector<std::uint32_t>& elements,
                                  const Part& part) {
    const glm::vec2 size = glm::max(part.high - part.low, glm::vec2(1e-6f));
    for (std::uint32_t e : elements)
        for (std::size_t k = 0; k < 4; ++k) {
            const std::uint32_t v = out_.elements[e].vertices[k];
            if (vertexPlaced_[v]) continue;
            vertexPlaced_[v] = 1;
            const glm::vec2 st = glm::clamp((elementSt_[e][k] - part.low) / size, 0.0f, 1.0f);
            out_.vertexCoordinates[v] = {index, st.x, st.y};
        }
}

void PatchAssembly::makePatch(const SheetCell& cell, const Group& group, bool part) {
    const std::vector<std::uint32_t>& elements = group.elements;
    Patch patch;
    patch.material = cell.material;
    patch.object = cell.object;
    const bool any = measure(patch, elements);
    const auto index = any ? std::uint32_t(out_.patches.size()) : kNone;
    for (std::uint32_t e : elements) out_.elements[e].patch = index;
    if (!any) return;
    out_.area += patch.area;
    patch.firstElement = std::uint32_t(out_.patchElements.size());
    patch.elementCount = std::uint32_t(elements.size());
    out_.patchElements.insert(out_.patchElements.end(), elements.begin(), elements.end());
    const Part spans = placeCorners(patch, cell, group, part);
    placeNodes(patch, cell, elements, spans);
    placeVertices(index, elements, spans);
    out_.patches.push_back(patch);
}

/// Indirect light is received at a patch's middle and, unless the patch is small, at its corners,
/// which neighbouring patches share.
void PatchAssembly::placeNodes(Patch& patch, const SheetCell& cell,
                               const std::vector<std::uint32_t>& elements, const Part& part) {
    const glm::vec2 low = part.low, high = part.high;
    const glm::vec2 middle = 0.5f * (low + high);
    std::array<glm::vec2, 4> corner{low, glm::vec2(high.x, low.y), high, glm::vec2(low.x, high.y)};
    std::array<float, 4> nearest;
    std::array<std::uint32_t, 4> vertex{};
    nearest.fill(1e30f);
    float nearestMiddle = 1e30f;
    Receiver centre;
    float extent = 0;
    for (std::uint32_t e : elements) {
        const Element& element = out_.elements[e];
        const std::size_t count = element.isTriangle() ? 3 : 4;
        glm::vec2 st(0);
        glm::vec3 position(0), normal(0);
        for (std::size_t k = 0; k < count; ++k) {
            const Receiver& receiver = out_.vertices[element.vertices[k]].receiver;
            extent = std::max(extent, glm::distance(receiver.position, patch.centre));
            st += elementSt_[e][k] / float(count);
            position += receiver.position / float(count);
            normal += receiver.normal;
            for (std::size_t c = 0; c < 4; ++c) {
                const glm::vec2 d = elementSt_[e][k] - corner[c];
                if (glm::dot(d, d) >= nearest[c]) continue;
                nearest[c] = glm::dot(d, d);
                vertex[c] = element.vertices[k];
            }
        }
        const float distance = glm::dot(st - middle, st - middle);
        if (distance < nearestMiddle) {
            nearestMiddle = distance;
            centre = {position, glm::normalize(normal)};
        }
    }
    patch.centreNode = std::uint32_t(out_.nodes.size());
    out_.nodes.push_back(centre);
    const bool small = 2 * extent < 0.6f * out_.patchSize && !cell.smooth;
    patch.hasCornerNodes = !cell.whole && !small;
    if (patch.hasCornerNodes)
        for (std::size_t c = 0; c < 4; ++c) patch.cornerNodes[c] = nodeOfVertex(vertex[c]);
}

std::uint32_t PatchAssembly::nodeOfVertex(std::uint32_t vertex) {
    if (vertexNode_[vertex] == kNone) {
        vertexNode_[vertex] = std::uint32_t(out_.nodes.size());
        out_.nodes.push_back(out_.vertices[vertex].receiver);
    }
    return vertexNode_[vertex];
}

} // namespace penumbra
