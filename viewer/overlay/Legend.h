// What the colours of an overlay mean.
#pragma once

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace penumbra {

/// Numbers > 0 over several powers of ten, on a line from 0 to 1.
struct LogScale {
    double first = 1, last = 10; ///< what lies at 0 and at 1; the first may be the larger one

    /// Where a number lies; those beyond the ends lie there. \pre value >= 0
    float at(double value) const;
};

/// For people: a bar of viridis() with numbers, or kinds of things with their colours.
struct Legend {
    struct Tick {
        float at; ///< on the bar, in [0, 1]
        std::string label;
    };
    struct Kind {
        glm::vec3 colour; ///< sRGB
        std::string label;
    };
    std::string title;              ///< with the unit; empty: there is no legend
    std::vector<std::string> lines; ///< below the title
    std::vector<Tick> ticks;
    std::vector<Kind> kinds;
};

/// A tick at each power of ten of a scale.
std::vector<Legend::Tick> ticksOf(const LogScale& scale);

} // namespace penumbra
