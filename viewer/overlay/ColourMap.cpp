#include "viewer/overlay/ColourMap.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace penumbra {

glm::vec3 viridis(float value) {
    static constexpr std::array<glm::vec3, 9> kTable{{{68, 1, 84},
                                                      {71, 44, 122},
                                                      {59, 81, 139},
                                                      {44, 113, 142},
                                                      {33, 144, 141},
                                                      {39, 173, 129},
                                                      {92, 200, 99},
                                                      {170, 220, 50},
                                                      {253, 231, 37}}};
    const float at = value > 0 ? std::min(value, 1.0f) * float(kTable.size() - 1) : 0.0f;
    const auto before = std::min(std::size_t(at), kTable.size() - 2);
    return glm::mix(kTable[before], kTable[before + 1], at - float(before)) / 255.0f;
}

glm::vec3 kindColour(std::size_t kind) {
    static constexpr std::array<glm::vec3, kKinds> kTable{{{230, 159, 0},
                                                           {86, 180, 233},
                                                           {0, 158, 115},
                                                           {240, 228, 66},
                                                           {0, 114, 178},
                                                           {213, 94, 0},
                                                           {204, 121, 167}}};
    assert(kind < kKinds);
    return kTable[kind] / 255.0f;
}

} // namespace penumbra
