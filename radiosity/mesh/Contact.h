// Where surfaces touch: which corners of an element lie free, and where their light is to be taken.
#pragma once

#include "radiosity/mesh/PatchSet.h"
#include "radiosity/rays/RayScene.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// Moves the receiver of every vertex clear of the edges of its surface: not at all inside of a
/// flat one, a hair inwards at its border, where a neighbouring wall begins. Then lifts it by
/// hoverAt(). \param skin how far receivers hover, at least [m]
void pullReceiversIn(float skin, const std::vector<Element>& elements,
                     std::vector<Vertex>& vertices);

/// How a point that hovers over a surface lies.
enum class Lie {
    free,
    covered, ///< by something nearer than the distance that was asked for
    buried   ///< inside of something solid
};
/// \param cover [m], see coverDistance()
Lie lieOf(const RayScene& rays, std::span<const RayMesh> meshes, glm::vec3 point, glm::vec3 normal,
          float cover);

/// The way from a point over a surface on which lieOf() looks first, about as long as the normal.
glm::vec3 leaving(glm::vec3 normal);

/// Something this close above a surface with elements of this size counts as lying on it [m].
/// \param hover how far receivers hover there, see hoverAt() [m]
float coverDistance(float elementSize, float hover);

/// Checks single elements. A corner may be covered by another object (the floor under a cabinet,
/// the wall behind a shelf) or lie beyond one (the floor behind a partition). Its light must not be
/// interpolated over the element's free part. So the element gets a corner of its own: it is drawn
/// at the same point, and its light is computed where the free way from the element's middle to
/// the corner ends.
class ContactResolver {
public:
    /// All must outlive this.
    ContactResolver(const RayScene& rays, const std::vector<RayMesh>& meshes, float skin,
                    const std::vector<Vertex>& vertices)
        : rays_(rays), meshes_(meshes), skin_(skin), vertices_(vertices) {}

    /// Where the corners' light is to be taken.
    struct Result {
        bool free = false;                   ///< whether any of the element is
        std::array<bool, 4> moved{};         ///< corners that can't take it where they lie
        std::array<glm::vec3, 4> position{}; ///< of those [m, world]
        friend bool operator==(const Result&, const Result&) = default;
    };
    Result examine(const Element& element) const;

    /// Where an element is looked at: its middle and its corners, hovering [m, world].
    struct Places {
        std::size_t count = 4; ///< of corners
        glm::vec3 middle{0}, normal{0};
        std::array<glm::vec3, 4> corner{};
        float cover = 0; ///< see coverDistance()
    };
    Places placesOf(const Element& element) const;

    /// Where corner i of an element receives light if it is not shared: a hair inside of the
    /// element [m, world].
    glm::vec3 cornerOf(const Element& element, std::size_t i) const;

private:
    struct Frame {
        std::size_t count = 4;
        glm::vec3 middle{0}, normal{0};
        float size = 0; ///< from the middle to the farthest corner
    };
    Frame frameOf(const Element& element) const;
    glm::vec3 cornerOf(const Frame& frame, const Element& element, std::size_t i) const;
    glm::vec3 pointOf(const Element& element, float s, float t) const;
    glm::vec3 over(glm::vec3 point, glm::vec3 normal) const;
    const Vertex& vertex(const Element& element, std::size_t i) const {
        return vertices_[element.vertices[i]];
    }
    bool isFree(glm::vec3 p, glm::vec3 normal, float cover) const {
        return lieOf(rays_, meshes_, p, normal, cover) == Lie::free;
    }
    glm::vec3 endOfWay(glm::vec3 from, glm::vec3 to, glm::vec3 normal, float cover) const;

    const RayScene& rays_;
    const std::vector<RayMesh>& meshes_;
    float skin_;
    const std::vector<Vertex>& vertices_;
};

/// The corners of elements that meet at each vertex: element * 4 + corner, vertex by vertex.
struct Fans {
    std::vector<std::uint32_t> first, corners;
    std::span<const std::uint32_t> at(std::size_t vertex) const {
        return std::span(corners).subspan(first[vertex], first[vertex + 1] - first[vertex]);
    }
    /// Takes in elements that came to be, of vertices that had none. \pre no vertex behind these
    /// has any
    void add(const std::vector<Element>& elements, Range added, Range vertices);
};
Fans fansOf(const std::vector<Element>& elements, std::size_t vertexCount);

} // namespace penumbra
