#include "radiosity/transport/DetailRays.h"

#include "base/Bits.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace penumbra {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr int kSlit = DetailRays::kRays / 4;

bool liesAcross(const PatchSet& patches, const DrawnHit& hit, glm::vec3 normal) {
    constexpr float kFacing = -0.7f; // cosine between the normals
    return glm::dot(patches.vertices[hit.vertices[0]].receiver.normal, normal) < kFacing &&
           4 * hit.distance * hit.distance < elementArea(patches, patches.elements[hit.element]);
}

/// Adds a ray without end.
void addEndless(Bounds& box, glm::vec3 origin, glm::vec3 direction) {
    box.add(origin);
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] > 0) box.upper[axis] = kInfinity;
        if (direction[axis] < 0) box.lower[axis] = -kInfinity;
    }
}

/// Where a ray gets into a box [in units of its direction]; infinity: it misses it.
float entry(const Bounds& box, glm::vec3 origin, glm::vec3 direction) {
    float first = 0, last = kInfinity;
    for (int axis = 0; axis < 3; ++axis) {
        const float below = box.lower[axis] - origin[axis], above = box.upper[axis] - origin[axis];
        if (direction[axis] == 0) {
            if (below > 0 || above < 0) return kInfinity;
            continue;
        }
        const float a = below / direction[axis], b = above / direction[axis];
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    return first <= last ? first : kInfinity;
}

/// Whether any of a box lies in front of a receiver.
bool inFront(const Bounds& box, const Receiver& receiver) {
    glm::vec3 corner; // the foremost
    for (int axis = 0; axis < 3; ++axis)
        corner[axis] = receiver.normal[axis] > 0 ? box.upper[axis] : box.lower[axis];
    return glm::dot(corner - receiver.position, receiver.normal) >= 0;
}

float distanceTo(const Bounds& box, glm::vec3 p) {
    return glm::distance(p, glm::clamp(p, box.lower, box.upper));
}

} // namespace

bool inSlit(std::span<const std::uint32_t> hits) {
    return std::count_if(hits.begin(), hits.end(), [](auto hit) { return isAcross(hit); }) > kSlit;
}

DetailRays::DetailRays(const PatchSet& patches, const DrawnSurface& surface, float reach)
    : patches_(patches), surface_(surface), rays_(kRays), reach_(reach) {}

int DetailRays::follow(const Receiver& receiver, std::uint64_t which, bool slits,
                       Hits& hits) const {
    for (const int i : bitsOf(which)) {
        const glm::vec3 direction = rays_.direction(i, receiver.normal);
        const DrawnHit hit = surface_.nearest(receiver.position, direction, 1e30f);
        std::uint32_t& element = hits.elements[std::size_t(i)];
        element = hit.met() ? hit.element : Element::kNone;
        if (slits && hit.met() && liesAcross(patches_, hit, receiver.normal)) element |= kAcross;
        const std::uint64_t bit = std::uint64_t(1) << i;
        hits.near = hit.met() && hit.distance <= reach_ ? hits.near | bit : hits.near & ~bit;
        if (hit.met()) {
            hits.ways.add(receiver.position);
            hits.ways.add(receiver.position + hit.distance * direction);
        } else {
            addEndless(hits.ways, receiver.position, direction);
        }
    }
    return std::popcount(which);
}

/// Bound of how far away any point of an element is [m].
float DetailRays::farthest(glm::vec3 from, std::uint32_t element) const {
    float most = 0;
    for (std::uint32_t v : patches_.uncoveredElements[element].vertices)
        most = std::max(most, glm::distance(from, patches_.vertices[v].position));
    return most;
}

std::uint64_t DetailRays::affected(const Receiver& receiver, std::uint64_t which,
                                   std::span<const std::uint32_t> hits, const Moved& moved,
                                   float reach) const {
    std::uint64_t affected = 0;
    for (const Range& elements : moved.elements)
        for (std::size_t i = 0; i < hits.size(); ++i)
            affected |= std::uint64_t(elements.contains(hits[i] & ~kAcross)) << i;
    affected &= which;
    for (const Bounds& box : moved.boxes) {
        if (!inFront(box, receiver) || distanceTo(box, receiver.position) > reach) continue;
        const std::uint64_t towards =
            rays_.towards(box.centre() - receiver.position, 0.5f * box.diagonal(), receiver.normal);
        for (const int i : bitsOf(which & towards & ~affected)) {
            const float at = entry(box, receiver.position, rays_.direction(i, receiver.normal));
            const std::uint32_t hit = hits[std::size_t(i)];
            if (at > reach) continue;
            if (hit != Element::kNone && at > farthest(receiver.position, hit & ~kAcross)) continue;
            affected |= std::uint64_t(1) << i;
        }
    }
    return affected;
}

} // namespace penumbra
