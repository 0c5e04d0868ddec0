#include "radiosity/transport/DetailRays.h"

#include "base/Bits.h"
#include "base/Frame.h"
#include "radiosity/mesh/RayElements.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace penumbra {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr int kSlit = DetailRays::kRays / 4;

bool liesAcross(const PatchSet& patches, std::uint32_t index, float distance, glm::vec3 normal) {
    constexpr float kFacing = -0.7f; // cosine between the normals
    const Element& element = patches.elements[index];
    return glm::dot(patches.vertices[element.vertices[0]].receiver.normal, normal) < kFacing &&
           4 * distance * distance < elementArea(patches, element);
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

DetailRays::DetailRays(const PatchSet& patches, const RayScene& rays, float reach)
    : patches_(patches), scene_(rays), rays_(kRays), reach_(reach) {}

int DetailRays::follow(const Receiver& receiver, std::uint64_t which, bool slits,
                       Hits& hits) const {
    constexpr std::size_t kMost = ShadowRays::kMost;
    std::array<glm::vec3, kMost> directions;
    std::array<RayHit, kMost> met;
    std::array<int, kMost> rays;
    std::size_t count = 0;
    const Frame frame(receiver.normal);
    const auto trace = [&] {
        const auto found = std::span(met).first(count);
        scene_.nearest(receiver.position, std::span(directions).first(count), 1e30f,
                       RayScene::Faces::lit, found);
        for (std::size_t k = 0; k < count; ++k)
            note(receiver, directions[k], found[k], rays[k], slits, hits);
        count = 0;
    };
    for (const int i : bitsOf(which)) {
        rays[count] = i;
        directions[count++] = rays_.direction(i, frame);
        if (count == kMost) trace();
    }
    if (count > 0) trace();
    return std::popcount(which);
}

void DetailRays::note(const Receiver& receiver, glm::vec3 direction, const RayHit& hit, int ray,
                      bool slits, Hits& hits) const {
    std::uint32_t& element = hits.elements[std::size_t(ray)];
    element = elementAt(patches_, hit);
    if (slits && hit.met() && hit.distance <= reach_ &&
        liesAcross(patches_, element, hit.distance, receiver.normal))
        element |= kAcross;
    const std::uint64_t bit = std::uint64_t(1) << ray;
    hits.near = hit.met() && hit.distance <= reach_ ? hits.near | bit : hits.near & ~bit;
    if (hit.met()) {
        hits.ways.add(receiver.position);
        hits.ways.add(receiver.position + hit.distance * direction);
    } else {
        addEndless(hits.ways, receiver.position, direction);
    }
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
    const Frame frame(receiver.normal);
    for (const Bounds& box : moved.boxes) {
        if (!inFront(box, receiver) || distanceTo(box, receiver.position) > reach) continue;
        const std::uint64_t towards =
            rays_.towards(box.centre() - receiver.position, 0.5f * box.diagonal(), receiver.normal);
        for (const int i : bitsOf(which & towards & ~affected)) {
            const float at = entry(box, receiver.position, rays_.direction(i, frame));
            const std::uint32_t hit = hits[std::size_t(i)];
            if (at > reach) continue;
            if (hit != Element::kNone && at > farthest(receiver.position, hit & ~kAcross)) continue;
            affected |= std::uint64_t(1) << i;
        }
    }
    return affected;
}

} // namespace penumbra
