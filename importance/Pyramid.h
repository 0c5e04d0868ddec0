// A picture as a stack of ever coarser ones.
#pragma once

#include <cstddef>
#include <vector>

namespace penumbra {

/// One value a pixel, top row first.
struct Plane {
    int width = 0, height = 0;
    std::vector<float> values;

    Plane() = default;
    Plane(int planeWidth, int planeHeight, float value = 0)
        : width(planeWidth), height(planeHeight),
          values(std::size_t(planeWidth) * std::size_t(planeHeight), value) {}

    float& at(int x, int y) { return values[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
    float at(int x, int y) const {
        return values[std::size_t(y) * std::size_t(width) + std::size_t(x)];
    }
};

/// The picture smoothed by the kernel (1 5 8 5 1) / 20 in both directions; it goes on beyond its
/// edges as its mirror image. (The kernel of Burt & Adelson, "The Laplacian pyramid as a compact
/// image code", IEEE Transactions on Communications 31(4), 1983, for a = 0.4.)
Plane smoothed(const Plane& plane);
/// Smoothed, and every other pixel left out: half as wide and as high, rounded up.
Plane reduced(const Plane& plane);
/// A picture of the given size, twice as fine: what reduced() has taken away is filled in smoothly.
Plane expanded(const Plane& plane, int width, int height);

} // namespace penumbra
