#include "radiosity/Contact.h"

#include "radiosity/Parallel.h"

#include <algorithm>
#include <array>
#include <atomic>

namespace penumbra {

namespace {

/// Receivers keep this share of the way to the middle of their elements away from edges, where a
/// neighbouring wall begins.
constexpr float kPullIn = 0.02f;
/// Something this close above a point, in units of the element's size, covers it.
constexpr float kCover = 0.05f;
/// Steps of the search for the end of the free way from the middle to a corner.
constexpr int kBisections = 6;

class ContactResolver {
public:
    ContactResolver(const RayScene& rays, std::span<const RayMesh> meshes, float skin,
                    const std::vector<Vertex>& vertices)
        : rays_(rays), meshes_(meshes), skin_(skin), vertices_(vertices) {}

    /// What is known of one element: where its corners' light is to be taken.
    struct Result {
        bool free = false;
        std::array<bool, 4> moved{};
        std::array<glm::vec3, 4> position{};
    };

    Result examine(const Element& element) const {
        Result result;
        const int count = element.isTriangle() ? 3 : 4;
        glm::vec3 middle(0), normal(0);
        for (int k = 0; k < count; ++k) {
            middle += vertex(element, k).position / float(count);
            normal += vertex(element, k).receiver.normal;
        }
        normal = glm::normalize(normal);
        float size = 0;
        for (int k = 0; k < count; ++k)
            size = std::max(size, glm::distance(middle, vertex(element, k).position));
        const float cover = coverDistance(size, skin_);

        std::array<glm::vec3, 4> corner;
        std::array<bool, 4> cornerFree{};
        for (int k = 0; k < count; ++k) {
            const auto i = std::size_t(k);
            corner[i] = glm::mix(vertex(element, k).position, middle, kPullIn) + skin_ * normal;
            cornerFree[i] = isFree(corner[i], normal, cover);
        }
        glm::vec3 anchor = middle + skin_ * normal;
        result.free = isFree(anchor, normal, cover);
        for (std::size_t i = 0; !result.free && i < std::size_t(count); ++i)
            if (cornerFree[i]) anchor = corner[i], result.free = true;
        if (!result.free) return result;
        for (std::size_t i = 0; i < std::size_t(count); ++i) {
            if (cornerFree[i] && (corner[i] == anchor || !rays_.occluded(anchor, corner[i]))) continue;
            result.moved[i] = true;
            result.position[i] = endOfWay(anchor, corner[i], normal, cover);
        }
        return result;
    }

private:
    const Vertex& vertex(const Element& element, int k) const {
        return vertices_[element.vertices[std::size_t(k)]];
    }

    bool isFree(glm::vec3 p, glm::vec3 normal, float cover) const {
        return liesFree(rays_, meshes_, p, normal, cover);
    }

    glm::vec3 endOfWay(glm::vec3 from, glm::vec3 to, glm::vec3 normal, float cover) const {
        float free = 0, covered = 1;
        for (int i = 0; i < kBisections; ++i) {
            const float t = 0.5f * (free + covered);
            const glm::vec3 p = glm::mix(from, to, t);
            (!rays_.occluded(from, p) && isFree(p, normal, cover) ? free : covered) = t;
        }
        return glm::mix(from, to, 0.98f * free);
    }

    const RayScene& rays_;
    std::span<const RayMesh> meshes_;
    float skin_;
    const std::vector<Vertex>& vertices_;
};

/// Moves the receivers of shared vertices towards the mean middle of their elements: not at all inside
/// of a surface, a hair inwards at its border.
void pullReceiversIn(float skin, const std::vector<Element>& elements, std::vector<Vertex>& vertices) {
    std::vector<glm::vec3> sum(vertices.size(), glm::vec3(0));
    std::vector<float> weight(vertices.size(), 0.0f);
    for (const Element& element : elements) {
        const std::size_t count = element.isTriangle() ? 3 : 4;
        glm::vec3 middle(0);
        for (std::size_t k = 0; k < count; ++k)
            middle += vertices[element.vertices[k]].position / float(count);
        for (std::size_t k = 0; k < count; ++k) {
            sum[element.vertices[k]] += middle;
            weight[element.vertices[k]] += 1;
        }
    }
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        Vertex& vertex = vertices[i];
        const glm::vec3 middle = weight[i] > 0 ? sum[i] / weight[i] : vertex.position;
        vertex.receiver.position =
            glm::mix(vertex.position, middle, kPullIn) + skin * vertex.receiver.normal;
    }
}

} // namespace

float coverDistance(float elementSize, float skin) { return std::max(kCover * elementSize, 4 * skin); }

bool liesFree(const RayScene& rays, std::span<const RayMesh> meshes, glm::vec3 point, glm::vec3 normal,
              float cover) {
    // Not quite along the normal, so as not to run along edges that stand on the surface.
    const glm::vec3 direction = normal + glm::vec3(0.0123f, 0.0234f, -0.0171f);
    const RayHit hit = rays.nearest(point, direction, 1e30f);
    if (!hit.met()) return true;
    if (hit.distance < cover) return false;
    const bool fromBehind = glm::dot(hit.normal, direction) > 0;
    return !(fromBehind && meshes[hit.object.value].solid[hit.triangle]);
}

std::vector<std::uint8_t> resolveContacts(const RayScene& rays, std::span<const RayMesh> meshes,
                                          float skin, std::vector<Element>& elements,
                                          std::vector<Vertex>& vertices,
                                          std::vector<PatchCoordinate>& coordinates) {
    pullReceiversIn(skin, elements, vertices);
    std::vector<std::uint8_t> free(elements.size());
    struct Moved {
        std::size_t element;
        ContactResolver::Result result;
    };
    constexpr std::size_t kGrain = 4096;
    std::vector<std::vector<Moved>> moved((elements.size() + kGrain - 1) / kGrain);
    const ContactResolver resolver(rays, meshes, skin, vertices);
    parallelFor(elements.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const auto result = resolver.examine(elements[i]);
            free[i] = result.free;
            if (std::any_of(result.moved.begin(), result.moved.end(), [](bool m) { return m; }))
                moved[first / kGrain].push_back({i, result});
        }
    });
    for (const auto& range : moved)
        for (const auto& [index, result] : range) {
            Element& element = elements[index];
            const bool triangle = element.isTriangle();
            for (std::size_t k = 0; k < 4; ++k) {
                if (triangle && k == 3) element.vertices[3] = element.vertices[2];
                if (!result.moved[k]) continue;
                Vertex own = vertices[element.vertices[k]];
                own.receiver.position = result.position[k];
                coordinates.push_back(coordinates[element.vertices[k]]);
                element.vertices[k] = std::uint32_t(vertices.size());
                vertices.push_back(own);
            }
        }
    return free;
}

} // namespace penumbra
