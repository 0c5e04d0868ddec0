// Many polygons as one sender: each costs only where it is near.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// Halves of halves of a list of polygons, which neighbours should share. What is far for its size
/// sends as one: by its vector area, which is what the polygons' projected areas add up to while
/// all of them face the receiver (Willmott, Heckbert & Garland, Face cluster radiosity, 1999). So
/// the cost goes by the shape, and not by how many polygons it is made of.
class PolygonTree {
public:
    /// \param polygons convex outlines, counter-clockwise seen from the front; they must outlive
    ///                 the tree
    explicit PolygonTree(std::span<const std::vector<glm::vec3>> polygons);

    /// What polygonFormFactor() of all polygons adds up to, within 0.5 % of it and 1e-5.
    float formFactor(glm::vec3 p, glm::vec3 n) const;

private:
    /// A run of polygons.
    struct Node {
        glm::vec3 centre{0};     ///< area-weighted
        float radius = 0;        ///< of a sphere around all corners
        glm::vec3 vectorArea{0}; ///< [m^2]
        float area = 0;          ///< [m^2]
        glm::vec3 axis{0};       ///< unit mean normal; 0: none
        float spread = 0;        ///< largest distance of a unit normal from it
        std::uint32_t polygon = 0, count = 0;
        std::uint32_t second = 0; ///< the other half; the first one comes next
    };
    std::uint32_t build(std::size_t first, std::size_t count);

    std::span<const std::vector<glm::vec3>> polygons_;
    std::vector<Node> nodes_;
};

} // namespace penumbra
