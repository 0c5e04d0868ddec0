#include "radiosity/mesh/PatchAssembly.h"

#include "base/Parallel.h"
#include "radiosity/clusters/DenseReceivers.h"
#include "radiosity/clusters/FaceGroups.h"
#include "radiosity/mesh/Contact.h"
#include "radiosity/mesh/Emitters.h"
#include "radiosity/mesh/NodeBlends.h"
#include "radiosity/mesh/PatchGeometry.h"
#include "radiosity/surface/SurfaceRays.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace penumbra {

namespace {

constexpr std::uint32_t kNone = Element::kNone;

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

void PatchAssembly::add(const SurfaceMesh& mesh, const Tessellation& tessellation, ObjectId object,
                        bool far) {
    Range& elements = out_.objects[object.value].elements;
    if (elements.count == 0) elements.first = std::uint32_t(out_.elements.size());
    const auto before = std::uint32_t(cells_.size());
    addSheet(mesh, tessellation, object, false);
    const auto behind = std::uint32_t(cells_.size());
    addSheet(mesh, tessellation, object, true);
    for (const RaySource& source : addRays(mesh, tessellation, out_.rayMeshes[object.value])) {
        const RaySide front{before + source.firstCell, source.cellCount, source.facet};
        const RaySide back{behind + source.firstCell, source.cellCount, source.facet};
        std::vector<RaySide>& sides = raySides_[object.value];
        sides.push_back(source.turned ? back : front);
        sides.push_back(source.turned ? front : back);
    }
    for (std::size_t c = before; c < cells_.size(); ++c) cells_[c].far = far;
    elements.count = std::uint32_t(out_.elements.size()) - elements.first;
}

void PatchAssembly::addSheet(const SurfaceMesh& mesh, const Tessellation& tessellation,
                             ObjectId object, bool back) {
    const auto firstCell = std::uint32_t(cells_.size());
    for (const Cell& cell : tessellation.cells) {
        SheetCell sheet;
        sheet.back = back;
        sheet.whole = cell.whole;
        sheet.smooth = tessellation.smooth;
        sheet.object = object;
        const SurfaceFace& face = mesh.faces[cell.face];
        if (back ? face.back : face.front) {
            sheet.material = materialIndex(mesh.materialOf(face), !back);
            const auto first = tessellation.outline.begin() + cell.firstCorner;
            sheet.firstCorner = std::uint32_t(outlines_.size());
            sheet.cornerCount = cell.cornerCount;
            outlines_.insert(outlines_.end(), first, first + cell.cornerCount);
            if (back) std::reverse(outlines_.end() - cell.cornerCount + 1, outlines_.end());
        }
        cells_.push_back(sheet);
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
        if (cells_[cell].cornerCount == 0) continue;
        const std::size_t count = facet.vertices[2] == facet.vertices[3] ? 3 : 4;
        Element element;
        std::array<glm::vec2, 4> st, uv;
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
        out_.parts.elementCoordinates.push_back(st);
        if (textured) {
            out_.textures.uvs.resize(out_.elements.size());
            out_.textures.uvs.back() = uv;
        }
    }
}

void PatchAssembly::finish(const Progress& progress) {
    const auto done = [&](double share) {
        if (progress) progress("making patches", share);
    };
    pullReceiversIn(out_.skin, out_.elements, out_.vertices);
    done(0.1);
    const std::vector<Group> order = groupsInOrder();
    done(0.3);
    std::vector<std::vector<std::uint32_t>> elements = elementsOf(order);
    orderElements(order, elements);
    orderVertices(elements, order);
    done(0.6);
    out_.covered.assign(out_.elements.size(), 0);
    out_.vertexCoordinates.assign(out_.vertices.size(), {});
    out_.parts.vertexNode.assign(out_.vertices.size(), kNone);

    for (std::size_t i = 0; i < order.size();) {
        const ObjectId object = cells_[order[i][0]].object;
        ObjectPart& part = out_.objects[object.value];
        part.patches.first = std::uint32_t(out_.patches.size());
        part.nodes.first = std::uint32_t(out_.nodes.size());
        part.corners.first = std::uint32_t(out_.corners.size());
        for (; i < order.size() && cells_[order[i][0]].object == object; ++i)
            if (!elements[i].empty()) makePatch(order[i], elements[i]);
        part.patches.count = std::uint32_t(out_.patches.size()) - part.patches.first;
        part.nodes.count = std::uint32_t(out_.nodes.size()) - part.nodes.first;
        part.corners.count = std::uint32_t(out_.corners.size()) - part.corners.first;
        padBlock(out_.nodes, {});
        out_.nodeBlockObject.resize(out_.nodes.size() / PatchSet::kBlock, object);
    }
    done(0.7);
    out_.uncoveredNodes = out_.nodes;
    out_.uncoveredElements = out_.elements;
    out_.firstPrivate = std::uint32_t(out_.vertices.size());
    blendNodes(out_);
    flat_.resize(out_.vertices.size());
    blendVertices(out_, flat_);
    done(0.9);
    findTextureMeans(out_);
    findRayElements();
    placeObjects();
}

/// Each cell on its own, but for small ones and slivers of one side of an object: which of them are
/// clustered is noted.
std::vector<PatchAssembly::Group> PatchAssembly::groupCells() {
    std::map<std::pair<ObjectId, bool>, std::vector<std::uint32_t>> sides;
    for (std::uint32_t c = 0; c < cells_.size(); ++c)
        if (!cells_[c].smooth && cells_[c].cornerCount > 0)
            sides[{cells_[c].object, cells_[c].back}].push_back(c);
    std::vector<std::vector<std::uint32_t>> ofSide;
    for (auto& [side, cells] : sides) ofSide.push_back(std::move(cells));
    std::vector<std::vector<Group>> found(ofSide.size());
    parallelFor(ofSide.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            std::vector<FacePiece> faces;
            for (const std::uint32_t c : ofSide[i])
                faces.push_back({outlineOf(cells_[c]), cells_[c].material});
            found[i] = groupFaces(faces, out_.patchSize, out_.elementSize);
        }
    });
    std::vector<Group> groups;
    for (std::size_t i = 0; i < found.size(); ++i)
        for (Group& group : found[i]) {
            for (std::uint32_t& c : group) {
                c = ofSide[i][c];
                cells_[c].clustered = true;
            }
            groups.push_back(std::move(group));
        }
    for (std::uint32_t c = 0; c < cells_.size(); ++c)
        if (!cells_[c].clustered && cells_[c].cornerCount > 0) groups.push_back({c});
    return groups;
}

/// Object by object, within one along a space-filling curve: what is near in space shall be near
/// in memory.
std::vector<PatchAssembly::Group> PatchAssembly::groupsInOrder() {
    std::vector<Group> groups = groupCells();
    std::vector<Bounds> bounds(out_.objects.size());
    std::vector<glm::vec3> middle(groups.size());
    for (std::size_t g = 0; g < groups.size(); ++g) {
        for (const std::uint32_t c : groups[g]) {
            glm::vec3 of(0);
            for (glm::vec3 point : outlineOf(cells_[c])) of += point / float(cells_[c].cornerCount);
            middle[g] += of / float(groups[g].size());
        }
        bounds[cells_[groups[g][0]].object.value].add(middle[g]);
    }
    std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::size_t>> keys;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const std::uint32_t object = cells_[groups[g][0]].object.value;
        const Bounds& box = bounds[object];
        keys.emplace_back(
            object, mortonCode((middle[g] - box.lower) / glm::max(box.size(), glm::vec3(1e-20f))),
            groups[g][0], g);
    }
    std::sort(keys.begin(), keys.end());
    std::vector<Group> order;
    for (const auto& key : keys) order.push_back(std::move(groups[std::get<3>(key)]));
    return order;
}

CellElements PatchAssembly::elementsByCell() const {
    CellElements cells{std::vector<std::uint32_t>(cells_.size() + 1),
                       std::vector<std::uint32_t>(elementCell_.size())};
    for (const std::uint32_t c : elementCell_) ++cells.first[c + 1];
    std::partial_sum(cells.first.begin(), cells.first.end(), cells.first.begin());
    std::vector<std::uint32_t> next = cells.first;
    for (std::uint32_t e = 0; e < elementCell_.size(); ++e)
        cells.elements[next[elementCell_[e]]++] = e;
    return cells;
}

std::vector<std::vector<std::uint32_t>>
PatchAssembly::elementsOf(const std::vector<Group>& groups) const {
    const auto [first, ofCell] = elementsByCell();
    std::vector<std::vector<std::uint32_t>> elements(groups.size());
    for (std::size_t g = 0; g < groups.size(); ++g)
        for (const std::uint32_t c : groups[g])
            elements[g].insert(elements[g].end(), ofCell.begin() + first[c],
                               ofCell.begin() + first[c + 1]);
    return elements;
}

void PatchAssembly::findRayElements() {
    const CellElements cells = elementsByCell();
    parallelFor(raySides_.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (auto o = std::uint32_t(begin); o < end; ++o)
            penumbra::findRayElements(out_, {o}, raySides_[o], cells);
    });
}

/// Puts the elements of objects with clusters in the order in which their groups have them: see
/// Patch::cluster. Those of others stay as they are, whatever else there is.
void PatchAssembly::orderElements(const std::vector<Group>& groups,
                                  std::vector<std::vector<std::uint32_t>>& elements) {
    std::vector<std::uint8_t> clustered(out_.objects.size());
    for (const Group& group : groups)
        clustered[cells_[group[0]].object.value] |= std::uint8_t(cells_[group[0]].clustered);
    std::vector<std::uint32_t> order(out_.elements.size()), next;
    std::iota(order.begin(), order.end(), 0u);
    for (const ObjectPart& part : out_.objects) next.push_back(part.elements.first);
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const ObjectId object = cells_[groups[g][0]].object;
        if (!clustered[object.value]) continue;
        for (std::uint32_t& e : elements[g]) {
            const std::uint32_t now = next[object.value]++;
            order[now] = e;
            e = now;
        }
    }
    const auto arrange = [&](auto& items) {
        if (items.empty()) return;
        auto arranged = items;
        for (std::size_t i = 0; i < order.size(); ++i) arranged[i] = items[order[i]];
        items = std::move(arranged);
    };
    arrange(out_.elements);
    arrange(out_.elementObject);
    arrange(elementCell_);
    arrange(out_.parts.elementCoordinates);
    out_.textures.uvs.resize(out_.textures.uvs.empty() ? 0 : out_.elements.size());
    arrange(out_.textures.uvs);
}

/// Notes what vertices are. \param groups of one object
void PatchAssembly::chooseReceivers(std::span<const Group> groups,
                                    std::span<const std::vector<std::uint32_t>> elements,
                                    std::vector<VertexKind>& kinds) const {
    using Role = DenseVertex::Role;
    const auto isClustered = [&](const Group& group) { return cells_[group[0]].clustered; };
    if (std::ranges::none_of(groups, isClustered)) return;
    DenseMesh mesh;
    std::vector<std::uint32_t> vertices;
    for (std::size_t i = 0; i < groups.size(); ++i) {
        const bool clustered = isClustered(groups[i]);
        if (clustered) mesh.firstFace.push_back(std::uint32_t(mesh.faces.size()));
        for (const std::uint32_t e : elements[i]) {
            std::array<std::uint32_t, 4> face = out_.elements[e].vertices;
            for (std::uint32_t& v : face) {
                if (kinds[v].index == kNone) { // it will be this group's, see placeVertices()
                    kinds[v].index = std::uint32_t(vertices.size());
                    const Vertex& vertex = out_.vertices[v];
                    mesh.vertices.push_back({vertex.position, vertex.receiver.normal,
                                             clustered ? Role::open : Role::alone});
                    vertices.push_back(v);
                }
                v = kinds[v].index;
                Role& role = mesh.vertices[v].role;
                if (!clustered && role == Role::open) role = Role::receives;
            }
            if (clustered) mesh.faces.push_back(face);
        }
    }
    mesh.firstFace.push_back(std::uint32_t(mesh.faces.size()));
    penumbra::chooseReceivers(mesh, out_.elementSize);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        kinds[vertices[i]].receives = mesh.vertices[i].role != Role::open;
        kinds[vertices[i]].flat = mesh.vertices[i].flat;
    }
}

/// The groups of each object, which follow one another.
std::vector<PatchAssembly::Run> PatchAssembly::runsOf(const std::vector<Group>& order) const {
    std::vector<Run> runs;
    const auto objectOf = [&](std::size_t i) { return cells_[order[i][0]].object; };
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i == 0 || objectOf(i) != objectOf(i - 1)) runs.push_back({i, i});
        runs.back().last = i + 1;
    }
    return runs;
}

std::vector<PatchAssembly::VertexKind>
PatchAssembly::kindsOf(std::span<const Run> runs, std::span<const Group> order,
                       std::span<const std::vector<std::uint32_t>> elements) const {
    std::vector<VertexKind> kinds(out_.vertices.size());
    parallelFor(runs.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (const auto& [first, last] : runs.subspan(begin, end - begin))
            chooseReceivers(order.subspan(first, last - first),
                            elements.subspan(first, last - first), kinds);
    });
    return kinds;
}

/// Puts the vertices into blocks: object by object, cell by cell; in each object first those that
/// are receivers.
void PatchAssembly::orderVertices(const std::vector<std::vector<std::uint32_t>>& elements,
                                  const std::vector<Group>& order) {
    const std::vector<Run> runs = runsOf(order);
    const std::vector<VertexKind> kinds = kindsOf(runs, order, elements);
    std::vector<std::uint32_t> index(out_.vertices.size(), kNone);
    std::vector<Vertex> ordered;
    ordered.reserve(out_.vertices.size() + 2 * PatchSet::kBlock * out_.objects.size());
    const auto take = [&](std::size_t first, std::size_t last, bool receivers) {
        for (std::size_t i = first; i < last; ++i)
            for (const std::uint32_t e : elements[i])
                for (const std::uint32_t v : out_.elements[e].vertices)
                    if (index[v] == kNone && kinds[v].receives == receivers) {
                        index[v] = std::uint32_t(ordered.size());
                        ordered.push_back(out_.vertices[v]);
                        flat_.resize(ordered.size());
                        flat_.back() = kinds[v].flat;
                    }
    };
    for (const auto& [i, last] : runs) {
        const ObjectId object = cells_[order[i][0]].object;
        Range& range = out_.objects[object.value].vertices;
        range.first = std::uint32_t(ordered.size());
        take(i, last, true);
        range.count = std::uint32_t(ordered.size()) - range.first;
        padBlock(ordered, {});
        out_.blockBlends.resize(ordered.size() / PatchSet::kBlock, kNone);
        const std::size_t blended = ordered.size();
        take(i, last, false);
        if (ordered.size() > blended) { // the object reaches over the padding in between
            for (std::size_t v = range.end(); v < blended; ++v)
                ordered[v].position = ordered[range.first].position;
            range.count = std::uint32_t(ordered.size()) - range.first;
        }
        padBlock(ordered, {});
        for (std::size_t v = blended; v < ordered.size(); v += PatchSet::kBlock) {
            out_.blockBlends.push_back(std::uint32_t(out_.vertexBlends.size()));
            out_.vertexBlends.resize(out_.vertexBlends.size() + PatchSet::kBlock);
        }
        out_.vertexBlockObject.resize(ordered.size() / PatchSet::kBlock, object);
    }
    for (const std::vector<std::uint32_t>& group : elements)
        for (const std::uint32_t e : group)
            for (std::uint32_t& v : out_.elements[e].vertices) v = index[v];
    out_.vertices = std::move(ordered);
}

void PatchAssembly::placeObjects() {
    for (std::uint32_t o = 0; o < out_.objects.size(); ++o) {
        ObjectPart& part = out_.objects[o];
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

/// Cells become a patch, if they have any area. It is as it is when nothing is near: Parting sees
/// to what parts it.
void PatchAssembly::makePatch(const Group& group, const std::vector<std::uint32_t>& elements) {
    const SheetCell& cell = cells_[group[0]];
    Patch patch;
    patch.material = cell.material;
    patch.object = cell.object;
    patch.cluster = cell.clustered;
    patch.divisible = !patch.cluster && !cell.whole && cell.cornerCount == 4;
    patch.smooth = cell.smooth;
    patch.far = cell.far;
    const bool any = measurePatch(out_, elements, patch);
    const auto index = any ? std::uint32_t(out_.patches.size()) : kNone;
    for (std::uint32_t e : elements) out_.elements[e].patch = index;
    if (!any) return;
    out_.area += patch.area;
    patch.firstElement = std::uint32_t(out_.patchElements.size());
    patch.elementCount = std::uint32_t(elements.size());
    out_.patchElements.insert(out_.patchElements.end(), elements.begin(), elements.end());
    patch.firstCorner = std::uint32_t(out_.corners.size());
    if (patch.cluster)
        placeElements(patch, elements);
    else
        std::ranges::copy(outlineOf(cell), std::back_inserter(out_.corners));
    patch.cornerCount = std::uint32_t(out_.corners.size()) - patch.firstCorner;
    placeNodes(patch, cell, elements);
    placeVertices(index, elements);
    out_.patches.push_back(patch);
}

/// Coordinates of a cluster: the middle is where its centre is nearest.
void PatchAssembly::placeElements(const Patch& patch, const std::vector<std::uint32_t>& elements) {
    const auto away = [&](std::uint32_t e, std::size_t k) {
        return glm::distance(out_.vertices[out_.elements[e].vertices[k]].position, patch.centre);
    };
    float farthest = 1e-20f;
    for (const std::uint32_t e : elements)
        for (std::size_t k = 0; k < 4; ++k) farthest = std::max(farthest, away(e, k));
    for (const std::uint32_t e : elements)
        for (std::size_t k = 0; k < 4; ++k)
            out_.parts.elementCoordinates[e][k] = {0.5f + 0.5f * away(e, k) / farthest, 0.5f};
}

/// Tells the vertices of a patch that no other patch has where they lie in it.
void PatchAssembly::placeVertices(std::uint32_t index, const std::vector<std::uint32_t>& elements) {
    for (std::uint32_t e : elements)
        for (std::size_t k = 0; k < 4; ++k) {
            PatchCoordinate& at = out_.vertexCoordinates[out_.elements[e].vertices[k]];
            if (at.patch != kNone) continue;
            const glm::vec2 st = glm::clamp(out_.parts.elementCoordinates[e][k], 0.0f, 1.0f);
            at = {index, st.x, st.y};
        }
}

/// Indirect light is received at a patch's middle and, unless the patch is small, at its corners,
/// which neighbouring patches share.
void PatchAssembly::placeNodes(Patch& patch, const SheetCell& cell,
                               const std::vector<std::uint32_t>& elements) {
    const NodePlaces places = findNodePlaces(out_, patch, elements, {glm::vec2(0), glm::vec2(1)});
    patch.centreNode = std::uint32_t(out_.nodes.size());
    out_.nodes.push_back(places.centre);
    patch.hasCornerNodes = !cell.whole && !places.small && !patch.cluster;
    if (patch.hasCornerNodes)
        for (std::size_t c = 0; c < 4; ++c) patch.cornerNodes[c] = nodeOfVertex(places.vertices[c]);
    out_.parts.cornerNodes.push_back(patch.cornerNodes);
}

std::uint32_t PatchAssembly::nodeOfVertex(std::uint32_t vertex) {
    if (out_.parts.vertexNode[vertex] == kNone) {
        out_.parts.vertexNode[vertex] = std::uint32_t(out_.nodes.size());
        out_.nodes.push_back(out_.vertices[vertex].receiver);
    }
    return out_.parts.vertexNode[vertex];
}

} // namespace penumbra
