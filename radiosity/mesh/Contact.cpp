#include "radiosity/mesh/Contact.h"

#include "base/Parallel.h"
#include "radiosity/rays/Margins.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>

namespace penumbra {

namespace {

/// Receivers keep this share of the way to the middle of their elements away from edges, where a
/// neighbouring wall begins.
constexpr float kPullIn = 0.02f;
/// Something this close above a point, in units of the element's size, covers it.
constexpr float kCover = 0.05f;
/// Steps of the search for the end of the free way from the middle to a corner.
constexpr int kBisections = 6;
/// Points a side that are tried when neither the middle nor a corner of an element is free.
constexpr int kGrid = 5;

} // namespace

ContactResolver::Result ContactResolver::examine(const Element& element) const {
    Result result;
    const Places at = placesOf(element);
    const auto& corner = at.corner;
    std::array<bool, 4> cornerFree{};
    for (std::size_t i = 0; i < at.count; ++i)
        cornerFree[i] = isFree(corner[i], at.normal, at.cover);
    glm::vec3 anchor = at.middle;
    result.free = isFree(anchor, at.normal, at.cover);
    for (std::size_t i = 0; !result.free && i < at.count; ++i)
        if (cornerFree[i]) anchor = corner[i], result.free = true;
    for (int i = 0; !result.free && i < kGrid * kGrid;
         ++i) { // a slit between things that lie on it
        const int column = i % kGrid, row = i / kGrid;
        const glm::vec3 p =
            over(pointOf(element, (float(column) + 0.5f) / kGrid, (float(row) + 0.5f) / kGrid),
                 at.normal);
        if (isFree(p, at.normal, at.cover)) anchor = p, result.free = true;
    }
    if (!result.free) return result;
    for (std::size_t i = 0; i < at.count; ++i) {
        if (cornerFree[i] && (corner[i] == anchor || !rays_.occluded(anchor, corner[i]))) continue;
        result.moved[i] = true;
        result.position[i] = endOfWay(anchor, corner[i], at.normal, at.cover);
    }
    return result;
}

ContactResolver::Places ContactResolver::placesOf(const Element& element) const {
    const Frame frame = frameOf(element);
    Places at{frame.count, over(frame.middle, frame.normal), frame.normal, {}, 0};
    at.cover = coverDistance(frame.size, hoverAt(skin_, frame.middle));
    for (std::size_t i = 0; i < frame.count; ++i) at.corner[i] = cornerOf(frame, element, i);
    return at;
}

glm::vec3 ContactResolver::cornerOf(const Frame& frame, const Element& element,
                                    std::size_t i) const {
    return over(glm::mix(vertex(element, i).position, frame.middle, kPullIn), frame.normal);
}

glm::vec3 ContactResolver::cornerOf(const Element& element, std::size_t i) const {
    return cornerOf(frameOf(element), element, i);
}

glm::vec3 ContactResolver::over(glm::vec3 point, glm::vec3 normal) const {
    return point + hoverAt(skin_, point) * normal;
}

ContactResolver::Frame ContactResolver::frameOf(const Element& element) const {
    Frame frame;
    frame.count = element.isTriangle() ? 3 : 4;
    for (std::size_t i = 0; i < frame.count; ++i) {
        frame.middle += vertex(element, i).position / float(frame.count);
        frame.normal += vertex(element, i).receiver.normal;
    }
    frame.normal = glm::normalize(frame.normal);
    for (std::size_t i = 0; i < frame.count; ++i)
        frame.size = std::max(frame.size, glm::distance(frame.middle, vertex(element, i).position));
    return frame;
}

/// Bilinear; of a triangle, whose last two corners are the same, it is a point of the triangle too.
glm::vec3 ContactResolver::pointOf(const Element& element, float s, float t) const {
    return glm::mix(glm::mix(vertex(element, 0).position, vertex(element, 1).position, s),
                    glm::mix(vertex(element, 3).position, vertex(element, 2).position, s), t);
}

glm::vec3 ContactResolver::endOfWay(glm::vec3 from, glm::vec3 to, glm::vec3 normal,
                                    float cover) const {
    float free = 0, covered = 1;
    for (int i = 0; i < kBisections; ++i) {
        const float t = 0.5f * (free + covered);
        const glm::vec3 p = glm::mix(from, to, t);
        // No surface is at `p` that the segment would have to end before: the wall behind which it
        // lies may be nearer to it than that.
        const bool reached = !rays_.nearest(from, p - from, 1).met();
        (reached && isFree(p, normal, cover) ? free : covered) = t;
    }
    return glm::mix(from, to, 0.98f * free);
}

void Fans::add(const std::vector<Element>& elements, Range added, Range vertices) {
    if (vertices.count == 0) return; // of nothing: it lies nowhere
    const auto forEachCorner = [&](auto visit) {
        for (std::uint32_t e = added.first; e < added.end(); ++e)
            for (std::uint32_t k = 0; k < (elements[e].isTriangle() ? 3u : 4u); ++k)
                visit(elements[e].vertices[k], 4 * e + k);
    };
    const auto from = first.begin() + vertices.first, to = first.begin() + vertices.end() + 1;
    std::vector<std::uint32_t> next(vertices.count);
    forEachCorner([&](std::uint32_t v, std::uint32_t) { ++next[v - vertices.first]; });
    std::inclusive_scan(next.begin(), next.end(), from + 1, std::plus(), *from);
    std::fill(to, first.end(), *(to - 1));
    corners.resize(first.back());
    std::copy(from, to - 1, next.begin());
    forEachCorner([&](std::uint32_t v, std::uint32_t corner) {
        corners[next[v - vertices.first]++] = corner;
    });
}

Fans fansOf(const std::vector<Element>& elements, std::size_t vertexCount) {
    Fans fans;
    fans.first.resize(vertexCount + 1);
    fans.add(elements, {0, std::uint32_t(elements.size())}, {0, std::uint32_t(vertexCount)});
    return fans;
}

float coverDistance(float elementSize, float hover) {
    return std::max(kCover * elementSize, 4 * hover);
}

namespace {

/// Not quite along the normal, so as not to run along edges that stand on the surface.
constexpr std::array<glm::vec3, 5> kAside{{{0.0123f, 0.0234f, -0.0171f},
                                           {-0.0317f, 0.0139f, 0.0223f},
                                           {0.0271f, -0.0353f, 0.0119f},
                                           {0.0149f, 0.0411f, 0.0367f},
                                           {-0.0437f, -0.0187f, -0.0293f}}};

/// Whether a hit lies so well within its triangle that rounding can't have missed another there.
bool isSure(const RayHit& hit) {
    constexpr float kSure = 1e-3f;
    return hit.u > kSure && hit.v > kSure && hit.u + hit.v < 1 - kSure;
}

/// Whether a ray leaves some object more often than it enters it, if its hits say: all of those of
/// objects that it may begin in.
/// \return nothing: it passes by an edge of something solid, and may have met two triangles there
std::optional<bool> leavesSolid(std::span<const RayMesh> meshes, std::span<const RayHit> hits,
                                glm::vec3 direction) {
    std::vector<std::pair<ObjectId, int>> left;
    for (const RayHit& hit : hits) {
        if (!meshes[hit.object.value].solid[hit.triangle]) continue;
        if (!isSure(hit)) return std::nullopt;
        const int side = glm::dot(hit.normal, direction) > 0 ? 1 : -1;
        const auto known = std::find_if(left.begin(), left.end(),
                                        [&](const auto& l) { return l.first == hit.object; });
        if (known == left.end())
            left.emplace_back(hit.object, side);
        else
            known->second += side;
    }
    return std::ranges::any_of(left, [](const auto& l) { return l.second > 0; });
}

} // namespace

glm::vec3 leaving(glm::vec3 normal) {
    return normal + kAside[0];
}

Lie lieOf(const RayScene& rays, std::span<const RayMesh> meshes, glm::vec3 point, glm::vec3 normal,
          float cover) {
    // What is closed around a point is so in any direction: the first counts that passes by no
    // edge.
    Lie lie = Lie::free;
    std::vector<RayHit> hits;
    for (const glm::vec3& aside : kAside) {
        const bool first = &aside == kAside.data();
        const glm::vec3 direction = normal + aside;
        // Beyond that only what is solid and may be around the point matters.
        rays.all(point, direction, std::max(cover, rays.solidsEnd(point, direction)), hits);
        const auto covers = [&](const RayHit& hit) { return hit.distance < cover; };
        if (first && std::ranges::any_of(hits, covers)) lie = Lie::covered;
        const std::optional<bool> buried = leavesSolid(meshes, hits, direction);
        if (buried) return *buried ? Lie::buried : lie;
    }
    return lie;
}

void pullReceiversIn(float skin, const std::vector<Element>& elements,
                     std::vector<Vertex>& vertices) {
    const Fans fans = fansOf(elements, vertices.size());
    parallelFor(vertices.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            glm::vec3 sum(0);
            for (const std::uint32_t corner : fans.at(v)) {
                const Element& element = elements[corner / 4];
                const std::size_t corners = element.isTriangle() ? 3 : 4;
                for (std::size_t k = 0; k < corners; ++k)
                    sum += vertices[element.vertices[k]].position / float(corners);
            }
            Vertex& vertex = vertices[v];
            const auto count = float(fans.at(v).size());
            const glm::vec3 middle = count > 0 ? sum / count : vertex.position;
            const glm::vec3 in = glm::mix(vertex.position, middle, kPullIn);
            const float hover = hoverAt(skin, in);
            // Along a ridge the middle lies below the surface: what is pulled there must not sink
            // into its own object.
            const float sunk = glm::dot(vertex.position - in, vertex.receiver.normal);
            const float lift = sunk > 0.5f * hover ? hover + sunk : hover;
            vertex.receiver.position = in + lift * vertex.receiver.normal;
        }
    });
}

} // namespace penumbra
