#include "radiosity/surface/Tessellation.h"

#include "radiosity/surface/EdgeRates.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace penumbra {

namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

class Tessellator {
public:
    Tessellator(const SurfaceMesh& mesh, const LimitSurface& surface, float patchSize,
                float elementSize)
        : mesh_(mesh), surface_(surface), rates_(mesh, surface, patchSize, elementSize),
          patchSize_(patchSize), atPoint_(mesh.points.size(), kNone) {}

    Tessellation run() {
        out_.smooth = mesh_.subdivided() && surface_.understood();
        for (std::uint32_t f = 0; f < mesh_.faces.size(); ++f) {
            auto face = surface_.face(f);
            if (!face) continue;
            const auto corners = rates_.cornersOf(f);
            if (corners.size() != mesh_.faces[f].cornerCount) face = surface_.polygon(f, corners);
            uvs_ = uvsOfCorners(f);
            addFace(f, *face);
        }
        return std::move(out_);
    }

private:
    void addFace(std::uint32_t index, const FaceSurface& face);
    std::vector<int> facetRates(std::uint32_t index) const;
    void addCells(std::uint32_t index, const FaceSurface& face);
    void leaveOutUnsound(std::size_t first);
    bool hasArea(const Facet& facet) const;
    bool hasSide(const Facet& facet) const;
    Facet placeFacet(const FaceSurface& face, const DomainPattern& pattern,
                     const std::array<int, 4>& source,
                     std::span<const std::uint32_t> vertices) const;
    std::uint32_t addVertex(const SurfacePoint& point, glm::vec2 uv);
    std::uint32_t& firstAtEdge(std::uint32_t a, std::uint32_t b, std::uint32_t k,
                               std::uint32_t rate);
    std::uint32_t boundaryVertex(std::uint32_t& first, const SurfacePoint& point, glm::vec2 uv);
    std::vector<glm::vec2> uvsOfCorners(std::uint32_t index) const;
    std::vector<std::uint32_t> addVertices(std::uint32_t index, const FaceSurface& face,
                                           const std::vector<glm::vec2>& coords);

    const SurfaceMesh& mesh_;
    const LimitSurface& surface_;
    const EdgeRates rates_;
    float patchSize_;
    Tessellation out_;

    // Vertices at the same place of a corner or an edge, in lists: the first one of each place, and
    // the next one at each vertex's place.
    std::vector<std::uint32_t> atPoint_, atEdges_, nextThere_;
    std::unordered_map<std::uint64_t, std::size_t> edges_; // first of atEdges_

    std::vector<glm::vec2> uvs_;      // of the corners of the face at hand
    std::vector<glm::vec2> vertexUv_; // of all vertices; both are empty without textures

    // Cells of the face at hand: `cellsU_` x `cellsV_` a quadrilateral domain (or sub-face).
    std::uint32_t firstCell_ = 0;
    int cellsU_ = 1, cellsV_ = 1;
    bool whole_ = false;
};

/// A facet without corners that are the vertex before, as where a strip comes to a point; -1
/// follows the last.
std::array<int, 4> withoutTwins(const std::array<int, 4>& facet,
                                std::span<const std::uint32_t> vertices) {
    const std::size_t count = facet[3] < 0 ? 3 : 4;
    std::array<int, 4> left{-1, -1, -1, -1};
    for (std::size_t k = 0, n = 0; k < count; ++k) {
        const auto next = std::size_t(facet[(k + 1) % count]);
        if (vertices[std::size_t(facet[k])] != vertices[next]) left[n++] = facet[k];
    }
    return left;
}

/// Of a triangle or quadrilateral that is not cut.
DomainPattern wholePattern(const FaceSurface& face) {
    DomainPattern pattern;
    for (int i = 0; i < face.size(); ++i) pattern.coords.push_back(face.vertexCoord(i));
    pattern.facets.push_back({0, 1, 2, face.size() == 4 ? 3 : -1});
    return pattern;
}

/// The boundary as both faces of each edge cut it, the inside as this face wants it.
std::vector<int> Tessellator::facetRates(std::uint32_t index) const {
    const auto corners = rates_.cornersOf(index);
    std::vector<int> rates, inner;
    for (std::size_t e = 0; e < corners.size(); ++e)
        rates.push_back(rates_.along(corners[e], corners[(e + 1) % corners.size()]));
    for (const EdgeRate& edge : rates_.ofFace(index)) inner.push_back(edge.elements);
    if (inner.size() == 4) {
        rates.push_back(std::max(inner[0], inner[2]));
        rates.push_back(std::max(inner[1], inner[3]));
    } else {
        rates.push_back(*std::max_element(inner.begin(), inner.end()));
    }
    return rates;
}

/// Cuts the face's parameter domain into cells and notes their outlines. A small face that is no
/// quadrilateral stays whole.
void Tessellator::addCells(std::uint32_t index, const FaceSurface& face) {
    const std::span<const EdgeRate> edges = rates_.ofFace(index);
    firstCell_ = std::uint32_t(out_.cells.size());
    int most = 1;
    for (const EdgeRate& edge : edges) most = std::max(most, edge.patches);
    const bool quad = !face.hasSubFaces();
    whole_ = !quad && most == 1 && face.extent() <= 1.5f * patchSize_;
    cellsU_ = quad ? std::max(edges[0].patches, edges[2].patches) : (most + 1) / 2;
    cellsV_ = quad ? std::max(edges[1].patches, edges[3].patches) : cellsU_;

    const auto add = [&](std::span<const glm::vec2> corners) {
        Cell cell{index, std::uint32_t(out_.outline.size()), std::uint32_t(corners.size()), whole_};
        for (glm::vec2 uv : corners) {
            out_.outline.push_back(face.at(uv).position);
            if (!uvs_.empty()) out_.outlineUvs.push_back(face.uvAt(uv, uvs_));
        }
        out_.cells.push_back(cell);
    };
    if (whole_) {
        std::vector<glm::vec2> corners;
        for (int i = 0; i < face.size(); ++i) corners.push_back(face.vertexCoord(i));
        return add(corners);
    }
    for (int sub = 0; sub < face.subFaceCount(); ++sub)
        for (int j = 0; j < cellsV_; ++j)
            for (int i = 0; i < cellsU_; ++i) {
                const auto uv = [&](int a, int b) {
                    return face.fromSubFace(
                        sub, {float(i + a) / float(cellsU_), float(j + b) / float(cellsV_)});
                };
                add(std::array{uv(0, 0), uv(1, 0), uv(1, 1), uv(0, 1)});
            }
}

/// Texture coordinates of a face's corners as they are cut; two of these may be the same point.
std::vector<glm::vec2> Tessellator::uvsOfCorners(std::uint32_t index) const {
    if (mesh_.uvs.empty()) return {};
    const SurfaceFace& face = mesh_.faces[index];
    const auto points = mesh_.cornersOf(face);
    const auto uvs = mesh_.uvsOf(face);
    std::vector<glm::vec2> found;
    for (const std::uint32_t corner : rates_.cornersOf(index)) {
        const auto at = std::find(points.begin(), points.end(), corner) - points.begin();
        found.push_back(uvs[std::min(std::size_t(at), uvs.size() - 1)]);
    }
    return found;
}

std::uint32_t Tessellator::addVertex(const SurfacePoint& point, glm::vec2 uv) {
    out_.vertices.push_back(point);
    if (!uvs_.empty()) vertexUv_.push_back(uv);
    return std::uint32_t(out_.vertices.size() - 1);
}

/// A vertex on a corner or an edge: the one already there if its normal and its place in the
/// texture agree.
std::uint32_t Tessellator::boundaryVertex(std::uint32_t& first, const SurfacePoint& point,
                                          glm::vec2 uv) {
    const auto sameUv = [&](std::uint32_t candidate) { // to rounding
        return uvs_.empty() ||
               glm::distance(vertexUv_[candidate], uv) <= 1e-5f * std::max(1.0f, glm::length(uv));
    };
    SurfacePoint added = point;
    if (first != kNone) added.position = out_.vertices[first].position;
    std::uint32_t* last = &first;
    for (; *last != kNone; last = &nextThere_[*last])
        if (glm::dot(out_.vertices[*last].normal, point.normal) > 0.9995f && sameUv(*last))
            return *last;
    const std::uint32_t vertex = addVertex(added, uv);
    *last = vertex; // a list has not moved: this vertex has no place in nextThere_ yet
    nextThere_.resize(out_.vertices.size(), kNone);
    return vertex;
}

/// The first vertex at point k of an edge that is cut into so many parts, from its lower end on.
std::uint32_t& Tessellator::firstAtEdge(std::uint32_t a, std::uint32_t b, std::uint32_t k,
                                        std::uint32_t rate) {
    const auto [edge, fresh] =
        edges_.try_emplace(std::uint64_t(std::min(a, b)) << 32 | std::max(a, b), atEdges_.size());
    if (fresh) atEdges_.resize(atEdges_.size() + rate, kNone);
    return atEdges_[edge->second + (a < b ? k : rate - k)];
}

/// Bfr lists boundary points first, along the edges from vertex 0 on.
std::vector<std::uint32_t> Tessellator::addVertices(std::uint32_t index, const FaceSurface& face,
                                                    const std::vector<glm::vec2>& coords) {
    const auto corners = rates_.cornersOf(index);
    const auto uvOf = [&](glm::vec2 coord) {
        return uvs_.empty() ? glm::vec2(0) : face.uvAt(coord, uvs_);
    };
    std::vector<std::uint32_t> vertices(coords.size());
    std::size_t next = 0;
    for (std::size_t e = 0; e < corners.size(); ++e) {
        const std::uint32_t a = corners[e], b = corners[(e + 1) % corners.size()];
        const auto rate = std::uint32_t(rates_.along(a, b));
        for (std::uint32_t k = 0; k < rate; ++k, ++next) {
            std::uint32_t& first = k == 0 ? atPoint_[a] : firstAtEdge(a, b, k, rate);
            vertices[next] = boundaryVertex(first, face.at(coords[next]), uvOf(coords[next]));
        }
    }
    for (; next < coords.size(); ++next)
        vertices[next] = addVertex(face.at(coords[next]), uvOf(coords[next]));
    return vertices;
}

void Tessellator::addFace(std::uint32_t index, const FaceSurface& face) {
    addCells(index, face);
    const bool simple = face.size() <= 4 && rates_.isWhole(index);
    const DomainPattern pattern = simple ? wholePattern(face) : face.pattern(facetRates(index));
    const std::vector<std::uint32_t> vertices = addVertices(index, face, pattern.coords);
    const std::size_t first = out_.facets.size();
    for (const std::array<int, 4>& facet : pattern.facets) {
        const std::array<int, 4> source = withoutTwins(facet, vertices);
        if (source[2] >= 0) out_.facets.push_back(placeFacet(face, pattern, source, vertices));
    }
    leaveOutUnsound(first);
}

/// Takes out what has no side of the face's facets, or all if the face has no area.
void Tessellator::leaveOutUnsound(std::size_t first) {
    const auto begin = out_.facets.begin() + std::ptrdiff_t(first);
    const bool area =
        std::any_of(begin, out_.facets.end(), [&](const Facet& facet) { return hasArea(facet); });
    const auto end = std::remove_if(begin, out_.facets.end(),
                                    [&](const Facet& facet) { return !area || !hasSide(facet); });
    if (end == out_.facets.end()) return;
    out_.facets.erase(end, out_.facets.end());
    ++out_.leftOut;
}

bool Tessellator::hasArea(const Facet& facet) const {
    const auto at = [&](std::size_t k) { return out_.vertices[facet.vertices[k]].position; };
    return glm::length(glm::cross(at(2) - at(0), at(3) - at(1))) > 0;
}

/// Whether the mean of its corners' normals points anywhere.
bool Tessellator::hasSide(const Facet& facet) const {
    glm::vec3 sum(0);
    for (std::uint32_t v : facet.vertices) sum += out_.vertices[v].normal;
    return glm::length(sum) > 1e-3f;
}

/// Finds the cell that the middle of a facet lies in, and where its corners lie in that cell.
Facet Tessellator::placeFacet(const FaceSurface& face, const DomainPattern& pattern,
                              const std::array<int, 4>& source,
                              std::span<const std::uint32_t> vertices) const {
    Facet facet;
    std::array<glm::vec2, 4> place;
    glm::vec2 middle(0);
    const int count = source[3] < 0 ? 3 : 4;
    for (int k = 0; k < 4; ++k) {
        const auto coord = std::size_t(source[std::size_t(std::min(k, count - 1))]);
        facet.vertices[std::size_t(k)] = vertices[coord];
        facet.uv[std::size_t(k)] =
            uvs_.empty() ? glm::vec2(0) : vertexUv_[facet.vertices[std::size_t(k)]];
        place[std::size_t(k)] = face.layout(pattern.coords[coord]);
        if (k < count) middle += place[std::size_t(k)] / float(count);
    }
    if (whole_) {
        facet.cell = firstCell_;
        facet.st.fill(glm::vec2(0.5f));
        return facet;
    }
    const int sub = face.subFaceOfLayout(middle);
    const glm::vec2 cells(cellsU_, cellsV_);
    const glm::vec2 scaled = face.subFaceCoordinate(sub, middle) * cells;
    const int i = std::clamp(int(scaled.x), 0, cellsU_ - 1);
    const int j = std::clamp(int(scaled.y), 0, cellsV_ - 1);
    facet.cell = firstCell_ + std::uint32_t((sub * cellsV_ + j) * cellsU_ + i);
    for (std::size_t k = 0; k < 4; ++k)
        facet.st[k] =
            glm::clamp(face.subFaceCoordinate(sub, place[k]) * cells - glm::vec2(i, j), 0.0f, 1.0f);
    return facet;
}

} // namespace

Tessellation tessellate(const SurfaceMesh& mesh, float patchSize, float elementSize,
                        bool& understood) {
    const LimitSurface surface(mesh);
    understood = surface.understood();
    return Tessellator(mesh, surface, patchSize, elementSize).run();
}

} // namespace penumbra
