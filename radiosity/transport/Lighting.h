// What vertices receive.
#pragma once

#include "base/Rgb.h"
#include "radiosity/mesh/PatchSet.h"

#include <span>
#include <vector>

namespace penumbra {

/// Illuminance at every vertex of a PatchSet [lux].
struct Lighting {
    std::vector<Rgb> direct;
    std::vector<Rgb> indirect;
};

/// Mean illuminance of an element's corners [lux].
inline Rgb elementMean(const Element& element, std::span<const Rgb> direct,
                       std::span<const Rgb> indirect) {
    const std::size_t count = element.isTriangle() ? 3 : 4;
    Rgb sum;
    for (std::size_t k = 0; k < count; ++k)
        sum += direct[element.vertices[k]] + indirect[element.vertices[k]];
    return (1.0f / float(count)) * sum;
}
inline Rgb elementMean(const Element& element, const Lighting& lighting) {
    return elementMean(element, lighting.direct, lighting.indirect);
}

} // namespace penumbra
