// The width of a set of points.
#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace penumbra {

/// What a set of points covers along 13 fixed directions: the edges, the face diagonals and the
/// space diagonals of a cube. Rounder than a box, and joined as cheaply. Slabs of the same points
/// are the same bit for bit, in whatever order they came.
class Slabs {
public:
    void add(glm::vec3 p) {
        const std::array<float, kCount> along{p.x,
                                              p.y,
                                              p.z,
                                              p.x + p.y,
                                              p.x - p.y,
                                              p.y + p.z,
                                              p.y - p.z,
                                              p.x + p.z,
                                              p.x - p.z,
                                              p.x + p.y + p.z,
                                              p.x + p.y - p.z,
                                              p.x - p.y + p.z,
                                              p.y + p.z - p.x};
        for (std::size_t k = 0; k < kCount; ++k) {
            lower_[k] = std::min(lower_[k], along[k]);
            upper_[k] = std::max(upper_[k], along[k]);
        }
    }
    void add(const Slabs& other) {
        for (std::size_t k = 0; k < kCount; ++k) {
            lower_[k] = std::min(lower_[k], other.lower_[k]);
            upper_[k] = std::max(upper_[k], other.upper_[k]);
        }
    }
    /// The greatest of the widths [m]; -infinity if there are no points. At least .88 of the
    /// distance of any two of the points.
    float extent() const {
        float widest = -std::numeric_limits<float>::infinity();
        for (std::size_t k = 0; k < kCount; ++k)
            widest = std::max(widest, (upper_[k] - lower_[k]) * unit(k));
        return widest;
    }
    glm::vec3 lower() const { return {lower_[0], lower_[1], lower_[2]}; }
    glm::vec3 upper() const { return {upper_[0], upper_[1], upper_[2]}; }

private:
    static constexpr std::size_t kCount = 13;

    /// 1 / length of direction k: 1, or the root of 2 or 3.
    static constexpr float unit(std::size_t k) {
        return k < 3 ? 1.0f : k < 9 ? 0.70710678f : 0.57735027f;
    }
    static constexpr std::array<float, kCount> filled(float value) {
        std::array<float, kCount> all{};
        all.fill(value);
        return all;
    }

    std::array<float, kCount> lower_ = filled(std::numeric_limits<float>::infinity());
    std::array<float, kCount> upper_ = filled(-std::numeric_limits<float>::infinity());
};

} // namespace penumbra
