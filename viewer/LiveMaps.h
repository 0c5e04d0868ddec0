// The shadow maps of live lamps, arrangement by arrangement.
#pragma once

#include "viewer/GeometryCache.h"
#include "viewer/GlObject.h"
#include "viewer/LiveLight.h"
#include "viewer/LiveShaders.h"
#include "viewer/ShadowMaps.h"
#include "viewer/ShadowView.h"

#include <array>
#include <cstddef>
#include <vector>

namespace penumbra {

/// Keeps the maps of an arrangement as long as it is asked for, so that what does not move is drawn
/// once and what moves once a frame, and the table that the shaders read them by.
class LiveMaps {
public:
    LiveMaps();

    /// Draws what is missing. \return how many maps
    std::size_t prepare(const LiveLight& light, GeometryCache& cache);

    /// Binds table and maps to texture units 0, 1, 2, and says so to the program in use.
    void bind(const ShaderProgram& program) const;

    /// Origin of the frame of the maps [m, world]: near what moves, so that floats suffice.
    glm::dvec3 origin() const { return origin_; }

    /// How light may change of a lamp in an arrangement: on segments from one box that meet the
    /// other [m, frame of the maps].
    struct Reach {
        Bounds lamp, thing;
        bool everywhere = false; ///< the lamp itself moves
        std::size_t index = 0;   ///< of the lamp
    };
    const std::vector<Reach>& reaches() const { return reaches_; }

private:
    using Row = std::array<glm::vec4, kLiveColumns>;
    struct LampMaps {
        Row row{};
        Reach reach;
    };
    struct Group { ///< of layers: the maps of one arrangement
        ArrangementPtr of;
        bool wanted = false;
        std::vector<LampMaps> lamps;
    };

    void startAnew(const LiveLight& light);
    std::size_t groupOf(const ArrangementPtr& arrangement);
    std::size_t draw(const LiveLight& light, GeometryCache& cache, std::size_t group);
    Emitter placedLamp(const Emitter& lamp) const;
    Bounds thingIn(const LiveLight& light, const Arrangement& at) const;
    std::vector<ShadowCaster> casters(const LiveLight& light, const Arrangement& at,
                                      GeometryCache& cache, bool moving, const Reach& reach) const;
    std::size_t drawTight(LampMaps& maps, const Emitter& lamp, int layer,
                          const std::vector<ShadowCaster>& moved,
                          const std::vector<ShadowCaster>& fixed);
    std::size_t drawCube(LampMaps& maps, const Emitter& lamp, int layer,
                         const std::vector<ShadowCaster>& all);
    void writeTable(const LiveLight& light);

    ShadowMaps moved_, fixed_;
    GlObject table_;
    std::array<Group, kLiveSlots> groups_;
    std::vector<Reach> reaches_;
    std::vector<bool> moves_, lampMoves_; ///< what the maps are of; else they are drawn anew
    std::vector<const LitGeometry*> geometries_;
    int points_ = 0;
    glm::dvec3 origin_{0.0};
};

} // namespace penumbra
