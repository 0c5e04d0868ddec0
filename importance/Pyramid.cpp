#include "importance/Pyramid.h"

#include <algorithm>
#include <cassert>

namespace penumbra {

namespace {

constexpr float kKernel[] = {0.05f, 0.25f, 0.4f, 0.25f, 0.05f};

/// Index of a pixel beyond the edge, mirrored at it.
int mirrored(int i, int size) {
    if (i < 0) i = -i - 1;
    if (i >= size) i = 2 * size - 1 - i;
    return std::clamp(i, 0, size - 1); // pictures of one or two pixels
}

/// Smoothed along the rows, and every `step`-th pixel kept; the result lies on its side, so that
/// doing it twice smooths both ways.
Plane smoothedOnItsSide(const Plane& plane, int step) {
    Plane result(plane.height, (plane.width + step - 1) / step);
    for (int y = 0; y < plane.height; ++y)
        for (int x = 0; x < result.height; ++x) {
            float sum = 0;
            for (int k = -2; k <= 2; ++k)
                sum += kKernel[k + 2] * plane.at(mirrored(step * x + k, plane.width), y);
            result.at(y, x) = sum;
        }
    return result;
}

/// Every other pixel is new. Each is the mean of the given ones within the kernel's reach.
Plane expandedOnItsSide(const Plane& plane, int width) {
    Plane result(plane.height, width);
    for (int y = 0; y < plane.height; ++y)
        for (int x = 0; x < width; ++x) {
            float sum = 0;
            for (int k = -2; k <= 2; ++k) {
                if ((x + k) % 2 != 0) continue;
                const int at = std::clamp((x + k) / 2, 0, plane.width - 1);
                sum += 2 * kKernel[k + 2] * plane.at(at, y);
            }
            result.at(y, x) = sum;
        }
    return result;
}

} // namespace

Plane smoothed(const Plane& plane) {
    return smoothedOnItsSide(smoothedOnItsSide(plane, 1), 1);
}

Plane reduced(const Plane& plane) {
    return smoothedOnItsSide(smoothedOnItsSide(plane, 2), 2);
}

Plane expanded(const Plane& plane, int width, int height) {
    assert(plane.width == (width + 1) / 2 && plane.height == (height + 1) / 2);
    return expandedOnItsSide(expandedOnItsSide(plane, width), height);
}

} // namespace penumbra
