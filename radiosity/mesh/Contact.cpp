#include "radiosity/mesh/Contact.h"

#include "base/Parallel.h"
#include "radiosity/rays/Margins.h"

#include <algorithm>
#include <array>
#include <limits>
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
    const Frame frame = frameOf(element);
    const float cover = coverDistance(frame.size, hoverAt(skin_, frame.middle));
    std::array<glm::vec3, 4> corner;
    std::array<bool, 4> cornerFree{};
    for (std::size_t i = 0; i < frame.count; ++i) {
        corner[i] = cornerOf(element, i);
        cornerFree[i] = isFree(corner[i], frame.normal, cover);
    }
    glm::vec3 anchor = over(frame.middle, frame.normal);
    result.free = isFree(anchor, frame.normal, cover);
    for (std::size_t i = 0; !result.free && i < frame.count; ++i)
        if (cornerFree[i]) anchor = corner[i], result.free = true;
    for (int i = 0; !result.free && i < kGrid * kGrid;
         ++i) { // a slit between things that lie on it
        const int column = i % kGrid, row = i / kGrid;
        const glm::vec3 p =
            over(pointOf(element, (float(column) + 0.5f) / kGrid, (float(row) + 0.5f) / kGrid),
                 frame.normal);
        if (isFree(p, frame.normal, cover)) anchor = p, result.free = true;
    }
    if (!result.free) return result;
    for (std::size_t i = 0; i < frame.count; ++i) {
        if (cornerFree[i] && (corner[i] == anchor || !rays_.occluded(anchor, corner[i]))) continue;
        result.moved[i] = true;
        result.position[i] = endOfWay(anchor, corner[i], frame.normal, cover);
    }
    return result;
}

glm::vec3 ContactResolver::cornerOf(const Element& element, std::size_t i) const {
    const Frame frame = frameOf(element);
    return over(glm::mix(vertex(element, i).position, frame.middle, kPullIn), frame.normal);
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

Fans fansOf(const std::vector<Element>& elements, std::size_t vertexCount) {
    Fans fans;
    fans.first.resize(vertexCount + 1);
    const auto forEachCorner = [&](auto visit) {
        for (std::uint32_t e = 0; e < elements.size(); ++e)
            for (std::uint32_t k = 0; k < (elements[e].isTriangle() ? 3u : 4u); ++k)
                visit(elements[e].vertices[k], 4 * e + k);
    };
    forEachCorner([&](std::uint32_t v, std::uint32_t) { ++fans.first[v + 1]; });
    for (std::size_t v = 0; v < vertexCount; ++v) fans.first[v + 1] += fans.first[v];
    fans.corners.resize(fans.first.back());
    std::vector<std::uint32_t> next(fans.first.begin(), fans.first.end() - 1);
    forEachCorner([&](std::uint32_t v, std::uint32_t corner) { fans.corners[next[v]++] = corner; });
    return fans;
}

float coverDistance(float elementSize, float hover) {
    return std::max(kCover * elementSize, 4 * hover);
}

Lie lieOf(const RayScene& rays, std::span<const RayMesh> meshes, glm::vec3 point, glm::vec3 normal,
          float cover) {
    // Not quite along the normal, so as not to run along edges that stand on the surface.
    const glm::vec3 direction = normal + glm::vec3(0.0123f, 0.0234f, -0.0171f);
    std::vector<RayHit> hits;
    // Only what is solid matters beyond that.
    rays.all(point, direction, rays.anySolid() ? std::numeric_limits<float>::infinity() : cover,
             hits);
    // Inside of a solid is what is left once more than it is entered.
    std::vector<std::pair<ObjectId, int>> left;
    Lie lie = Lie::free;
    for (const RayHit& hit : hits) {
        if (hit.distance < cover) lie = Lie::covered;
        if (!meshes[hit.object.value].solid[hit.triangle]) continue;
        const int side = glm::dot(hit.normal, direction) > 0 ? 1 : -1;
        const auto known = std::find_if(left.begin(), left.end(),
                                        [&](const auto& l) { return l.first == hit.object; });
        if (known == left.end())
            left.emplace_back(hit.object, side);
        else
            known->second += side;
    }
    for (const auto& [object, times] : left)
        if (times > 0) lie = Lie::buried;
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
