// Corners of triangles that come to be drawn with vertices which show another light.
#pragma once

#include "base/Rgb.h"
#include "viewer/preview/ShownLight.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>

namespace penumbra {

/// When a thing no longer touches a corner of an element, the corner is drawn with the shared
/// vertex again (see Contact.h). That vertex keeps its own light. The corner fades to it without a
/// jump: it is drawn with a copy of the vertex that shows
///
///     vertex + over (1 - w),   w as in LightFade
///
/// and begins to fade to the vertex's light with the vertex, each time anew, so that both end
/// together. `over` is what was shown there beyond the vertex, of all but the previewed lights:
/// of these both have the light of now.
class CornerFade {
public:
    struct Over {
        Rgb direct, indirect; ///< [lux]
        friend bool operator==(const Over&, const Over&) = default;
    };

    /// Nothing is drawn with a copy.
    bool empty() const { return corners_.empty(); }
    /// How much an entry of LitMeshData::indices shows over its vertex.
    Over over(std::uint32_t entry) const;

    /// An entry has come to be drawn with this vertex, and showed so much more than that does.
    void put(std::uint32_t entry, std::uint32_t vertex, const Over& over);
    void clear() { corners_.clear(); }

    /// When the last fade of a vertex began; none: it waits for its light.
    using FadeStart = std::function<std::optional<double>(std::uint32_t vertex)>;
    /// \param time see LightFade::Frame
    void advance(double time, double seconds, const FadeStart& fadeStart);

    /// Adds copies, their light and what is drawn with them. \pre there are none
    void show(ShownLight& shown) const;
    /// Removes what show() added.
    static void hide(ShownLight& shown);

private:
    struct Corner {
        std::uint32_t vertex = 0;
        Over first, now; ///< when the fade began; during it
        double start = kWaits;
    };
    static constexpr double kWaits = -1e30;

    std::map<std::uint32_t, Corner> corners_; ///< by entry
};

} // namespace penumbra
