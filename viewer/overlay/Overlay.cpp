#include "viewer/overlay/Overlay.h"

#include <iterator>

namespace penumbra {

Overlay after(Overlay overlay, int steps) {
    constexpr int kCount = int(std::size(kOverlayNames));
    return Overlay(((int(overlay) + steps) % kCount + kCount) % kCount);
}

glm::u8vec4 blockColour(glm::vec3 colour) {
    constexpr float kOpacity = 0.88f;
    return glm::u8vec4(glm::round(glm::vec4(colour, kOpacity) * 255.0f));
}

} // namespace penumbra
