#include "radiosity/mesh/RayElements.h"

#include "radiosity/mesh/PatchSet.h"
#include "radiosity/rays/NearestHit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

namespace penumbra {

namespace {

using Grid = RayElements::Grid;
using Plane = RayElements::Plane;
using Outline = std::array<glm::vec2, 4>; ///< of an element, in cells of a grid

constexpr std::uint32_t kNone = RayElements::kNone;
constexpr std::uint32_t kMany = RayElements::kMany;

glm::vec2 onPlane(const Plane& plane, glm::vec3 p) {
    return {glm::dot(p - plane.origin, plane.across), glm::dot(p - plane.origin, plane.along)};
}

/// The column or line in which a coordinate lies.
std::uint32_t binOf(float at, std::uint32_t count) {
    return std::uint32_t(glm::clamp(at, 0.0f, float(count - 1)));
}

float cross(glm::vec2 a, glm::vec2 b) {
    return a.x * b.y - a.y * b.x;
}

/// How far inside of an outline a point lies: the distance from the nearest line through an edge,
/// negative if it is outside.
float depth(const Outline& outline, glm::vec2 p) {
    const float turn = cross(outline[2] - outline[0], outline[3] - outline[1]) < 0 ? -1.0f : 1.0f;
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t k = 0; k < 4; ++k) {
        const glm::vec2 edge = outline[(k + 1) % 4] - outline[k];
        const float length = glm::length(edge);
        if (length > 0) least = std::min(least, turn * cross(edge, p - outline[k]) / length);
    }
    return least;
}

/// Finds the elements of an object.
class Finder {
public:
    Finder(const PatchSet& set, ObjectId object)
        : set_(set), rays_(set.rayMeshes[object.value]),
          first_(set.objects[object.value].elements.first) {}

    RayElements found;

    /// What stands for a side of a triangle in RayElements::sides.
    /// \param firstCell names the elements \param elements at least one
    std::uint32_t add(std::size_t triangle, std::uint32_t firstCell,
                      std::span<const std::uint32_t> elements) {
        if (elements.size() == 1) return elements[0] - first_;
        const auto [known, fresh] = known_.try_emplace(firstCell);
        if (fresh) known->second = divided(elements);
        Grid grid = known->second;
        const auto& [a, b, c] = rays_.triangles[triangle];
        const Plane& plane = found.planes[grid.plane];
        grid.first = onPlane(plane, rays_.vertices[a]);
        grid.u = onPlane(plane, rays_.vertices[b]) - grid.first;
        grid.v = onPlane(plane, rays_.vertices[c]) - grid.first;
        found.grids.push_back(grid);
        return std::uint32_t(found.grids.size() - 1) | kMany;
    }

private:
    glm::vec3 corner(std::uint32_t element, std::size_t k) const {
        return set_.vertices[set_.elements[element].vertices[k]].position;
    }

    /// About as many cells as there are elements, along an edge of the first of them.
    Grid divided(std::span<const std::uint32_t> elements) {
        Grid grid;
        grid.plane = std::uint32_t(found.planes.size());
        Plane& plane = found.planes.emplace_back();
        plane.origin = corner(elements[0], 0);
        const glm::vec3 edge = corner(elements[0], 1) - plane.origin;
        const glm::vec3 normal = glm::cross(corner(elements[0], 2) - plane.origin,
                                            corner(elements[0], 3) - corner(elements[0], 1));
        if (glm::length(normal) > 0 && glm::length(edge) > 0) {
            plane.across = glm::normalize(edge);
            plane.along = glm::normalize(glm::cross(normal, edge));
            glm::vec2 lower(0), upper(0);
            for (const std::uint32_t e : elements)
                for (std::size_t k = 0; k < 4; ++k) {
                    lower = glm::min(lower, onPlane(plane, corner(e, k)));
                    upper = glm::max(upper, onPlane(plane, corner(e, k)));
                }
            plane.origin += lower.x * plane.across + lower.y * plane.along;
            const glm::vec2 size = glm::max(upper - lower, glm::vec2(1e-30f));
            const auto count = float(elements.size());
            const auto rounded = [&](float x) {
                return std::uint32_t(std::round(glm::clamp(x, 1.0f, count)));
            };
            grid.columns = rounded(std::sqrt(count * size.x / size.y));
            grid.lines = rounded(count / float(grid.columns));
            plane.across *= float(grid.columns) / size.x;
            plane.along *= float(grid.lines) / size.y;
        }
        fill(grid, plane, elements);
        return grid;
    }

    void fill(Grid& grid, const Plane& plane, std::span<const std::uint32_t> elements) {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> meets; // cell, element
        for (const std::uint32_t e : elements) {
            glm::vec2 lower = onPlane(plane, corner(e, 0)), upper = lower;
            for (std::size_t k = 1; k < 4; ++k) {
                lower = glm::min(lower, onPlane(plane, corner(e, k)));
                upper = glm::max(upper, onPlane(plane, corner(e, k)));
            }
            // What only touches a cell, up to rounding, is left out: most have one element alone.
            constexpr float kHair = 1e-3f; // of a cell
            const std::uint32_t right = binOf(upper.x - kHair, grid.columns);
            const std::uint32_t top = binOf(upper.y - kHair, grid.lines);
            for (std::uint32_t j = binOf(lower.y + kHair, grid.lines); j <= top; ++j)
                for (std::uint32_t i = binOf(lower.x + kHair, grid.columns); i <= right; ++i)
                    meets.emplace_back(j * grid.columns + i, e - first_);
        }
        std::ranges::sort(meets);
        grid.bin = std::uint32_t(found.bins.size());
        found.bins.resize(found.bins.size() + grid.columns * grid.lines, kNone);
        for (std::size_t i = 0, end = 0; i < meets.size(); i = end) {
            while (end < meets.size() && meets[end].first == meets[i].first) ++end;
            std::uint32_t& bin = found.bins[grid.bin + meets[i].first];
            bin = meets[i].second;
            if (end == i + 1) continue;
            bin = std::uint32_t(found.lists.size()) | kMany;
            found.lists.push_back(std::uint32_t(end - i));
            for (std::size_t k = i; k < end; ++k) found.lists.push_back(meets[k].second);
        }
    }

    const PatchSet& set_;
    const RayMesh& rays_;
    std::uint32_t first_;
    std::unordered_map<std::uint32_t, Grid> known_; ///< by first cell
};

/// Finds the element of an object in which a point lies deepest.
class Deepest {
public:
    Deepest(const PatchSet& set, const ObjectPart& part, const Plane& plane, glm::vec2 at)
        : set_(set), part_(part), plane_(plane), at_(at) {}

    /// \param what of a grid's bins
    void search(std::uint32_t what) {
        if (what == kNone) return;
        if (!(what & kMany)) return consider(what);
        const std::vector<std::uint32_t>& lists = part_.shape.rayElements.lists;
        const std::uint32_t list = what & ~kMany;
        for (std::uint32_t i = 1; i <= lists[list]; ++i) consider(lists[list + i]);
    }

    std::uint32_t element = kNone; ///< of the object's

private:
    void consider(std::uint32_t e) {
        Outline outline;
        const Element& corners = set_.uncoveredElements[part_.elements.first + e];
        for (std::size_t k = 0; k < 4; ++k)
            outline[k] = onPlane(
                plane_, part_.shape.vertices[corners.vertices[k] - part_.vertices.first].position);
        const float deep = depth(outline, at_);
        if (deep > most_) most_ = deep, element = e;
    }

    const PatchSet& set_;
    const ObjectPart& part_;
    const Plane& plane_;
    glm::vec2 at_;
    float most_ = -std::numeric_limits<float>::infinity();
};

} // namespace

void findRayElements(PatchSet& set, ObjectId object, std::span<const RaySide> sides,
                     const CellElements& cells) {
    Finder finder(set, object);
    std::vector<std::uint8_t>& lit = set.rayMeshes[object.value].lit;
    lit.assign(sides.size() / 2, kNoSide);
    finder.found.sides.reserve(sides.size());
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const RaySide& side = sides[i];
        const std::uint32_t first = cells.first[side.firstCell];
        const std::uint32_t end = cells.first[side.firstCell + side.cellCount];
        auto elements = std::span(cells.elements).subspan(first, end - first);
        if (elements.empty()) {
            finder.found.sides.push_back(kNone);
            continue;
        }
        if (side.which != RaySide::kAll) elements = elements.subspan(side.which, 1);
        finder.found.sides.push_back(finder.add(i / 2, side.firstCell, elements));
        lit[i / 2] |= i % 2 == 0 ? kFront : kBack;
    }
    set.objects[object.value].shape.rayElements = std::move(finder.found);
}

std::uint32_t elementAt(const PatchSet& set, const RayHit& hit) {
    if (!hit.met()) return kNone;
    const ObjectPart& part = set.objects[hit.object.value];
    const RayElements& known = part.shape.rayElements;
    const std::uint32_t side = known.sides[2 * hit.triangle + (hit.back ? 1 : 0)];
    if (side == kNone) return side;
    if (!(side & kMany)) return part.elements.first + side;

    const Grid& grid = known.grids[side & ~kMany];
    const glm::vec2 at = grid.first + hit.u * grid.u + hit.v * grid.v;
    const std::uint32_t bin =
        known.bins[grid.bin + binOf(at.y, grid.lines) * grid.columns + binOf(at.x, grid.columns)];
    if (!(bin & kMany)) return part.elements.first + bin;
    Deepest deepest(set, part, known.planes[grid.plane], at);
    deepest.search(bin);
    if (bin == kNone) // beside all of them, by what faces without area leave
        for (std::uint32_t i = 0; i < grid.columns * grid.lines; ++i)
            deepest.search(known.bins[grid.bin + i]);
    return part.elements.first + deepest.element;
}

} // namespace penumbra
