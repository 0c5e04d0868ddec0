// The light of a lit surface as it is on the screen.
#pragma once

#include "scenegraph/Rgb.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace penumbra {

/// In place of what a LitGeometry carries: the same vertices, in the same blocks.
struct ShownLight {
    std::vector<Rgb> direct, indirect; ///< [lux]
    /// Factors (see LampShare) of up to four live lamps that direct contains; negative: not known.
    /// Empty: there are no live lamps.
    std::vector<glm::vec4> factors;
    /// Share of the light that is of the arrangement which most vertices have left behind, in
    /// [0, 1] (see LiveLight::Anchor). As long as factors.
    std::vector<float> behind;

    std::vector<std::uint64_t> blockRevisions; ///< one a block, rises when any of this changes
    std::uint64_t revision = 1;                ///< rises when any of these does
};

} // namespace penumbra
