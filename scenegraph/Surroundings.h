// What is in the way of somebody who walks through a scene.
#pragma once

#include <glm/glm.hpp>

#include <optional>

namespace penumbra {

/// What is in the way of a walker.
class Surroundings {
public:
    struct Obstacle {
        double distance = 0;    ///< [m]
        glm::dvec3 normal{0.0}; ///< unit, towards where the question came from
    };
    virtual ~Surroundings() = default;
    /// The nearest surface from a point along a unit direction, up to `reach` [m].
    virtual std::optional<Obstacle> ahead(glm::dvec3 from, glm::dvec3 direction,
                                          double reach) const = 0;
};

} // namespace penumbra
