#include "radiosity/surface/ClosedPart.h"

#include "base/Frame.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

namespace penumbra {

namespace {

/// Skew, so that it meets no edges of what people build.
const glm::dvec3 kAcross(0.3826834323, 0.2705980501, 0.8835345612);

/// Whether the ray from p along kAcross meets the triangle.
bool meets(glm::dvec3 p, const std::array<glm::vec3, 3>& triangle) {
    const glm::dvec3 a = glm::dvec3(triangle[0]) - p;
    const glm::dvec3 ab = glm::dvec3(triangle[1]) - p - a;
    const glm::dvec3 ac = glm::dvec3(triangle[2]) - p - a;
    const glm::dvec3 q = glm::cross(kAcross, ac);
    const double det = glm::dot(ab, q);
    if (det == 0) return false;
    const double u = -glm::dot(a, q) / det;
    const glm::dvec3 r = glm::cross(-a, ab);
    const double v = glm::dot(kAcross, r) / det;
    return u >= 0 && v >= 0 && u + v <= 1 && glm::dot(ac, r) / det > 0;
}

/// Points in the cells of a grid across kAcross, for triangles to find those whose rays they meet.
class PointsAcross {
public:
    explicit PointsAcross(std::vector<glm::vec3> points) : points_(std::move(points)) {
        const Bounds box = across(points_);
        side_ = std::max(1, int(std::sqrt(double(points_.size()))));
        lower_ = box.lower;
        scale_ = float(side_) / glm::max(box.size(), glm::vec3(1e-6f));
        cells_.resize(std::size_t(side_) * std::size_t(side_));
        for (std::uint32_t i = 0; i < points_.size(); ++i) {
            const glm::ivec2 at = cellAt(flat(points_[i]));
            cells_[cell(at.x, at.y)].push_back(i);
        }
    }

    std::span<const glm::vec3> points() const { return points_; }

    /// Calls `visit(i)` for each point i that may lie behind the triangle, seen along kAcross.
    template <class Visit>
    void behind(const std::array<glm::vec3, 3>& triangle, Visit visit) const {
        const Bounds box = across(triangle);
        const glm::ivec2 from = cellAt(box.lower - kRounding * glm::abs(box.lower));
        const glm::ivec2 to = cellAt(box.upper + kRounding * glm::abs(box.upper));
        for (int y = from.y; y <= to.y; ++y)
            for (int x = from.x; x <= to.x; ++x)
                for (const std::uint32_t i : cells_[cell(x, y)]) visit(i);
    }

private:
    static constexpr float kRounding = 1e-5f;

    /// Coordinates across kAcross; the third is 0.
    static glm::vec3 flat(glm::vec3 p) {
        static const Frame frame{glm::vec3(kAcross)};
        return {glm::dot(p, frame.u), glm::dot(p, frame.v), 0};
    }
    static Bounds across(std::span<const glm::vec3> points) {
        Bounds box;
        for (const glm::vec3 point : points) box.add(flat(point));
        return box;
    }
    glm::ivec2 cellAt(glm::vec3 flat) const {
        const glm::vec3 at = glm::clamp((flat - lower_) * scale_, 0.0f, float(side_ - 1));
        return {int(at.x), int(at.y)};
    }
    std::size_t cell(int x, int y) const {
        return std::size_t(y) * std::size_t(side_) + std::size_t(x);
    }

    std::vector<glm::vec3> points_;
    int side_ = 1;
    glm::vec3 lower_{0}, scale_{1};
    std::vector<std::vector<std::uint32_t>> cells_;
};

} // namespace

bool ClosedPart::containsAny(std::span<const glm::vec3> points) const {
    std::vector<glm::vec3> within;
    std::ranges::copy_if(points, std::back_inserter(within),
                         [&](glm::vec3 point) { return bounds.contains(point); });
    if (within.empty()) return false;
    const PointsAcross grid(std::move(within));
    std::vector<bool> odd(grid.points().size());
    for (const auto& triangle : triangles)
        grid.behind(triangle, [&](std::uint32_t i) {
            if (meets(glm::dvec3(grid.points()[i]), triangle)) odd[i] = !odd[i];
        });
    return std::ranges::count(odd, true) > 0;
}

} // namespace penumbra
