// The shadow maps of previewed lights, one group for each scene state.
#pragma once

#include "viewer/gl/GeometryCache.h"
#include "viewer/gl/GlObject.h"
#include "viewer/preview/PreviewLighting.h"
#include "viewer/shadowmaps/PreviewShaders.h"
#include "viewer/shadowmaps/ShadowMaps.h"
#include "viewer/shadowmaps/ShadowView.h"

#include <array>
#include <cstddef>
#include <vector>

namespace penumbra {

/// Keeps the maps of a scene state as long as it is asked for, so that what does not move is drawn
/// once and what moves once a frame, and the table that the shaders read them by.
class PreviewMaps {
public:
    PreviewMaps();

    /// Draws what is missing. \return how many maps
    std::size_t prepare(const PreviewLighting& light, GeometryCache& cache);

    /// Binds table and maps to texture units 0, 1, 2, and says so to the program in use.
    void bind(const ShaderProgram& program) const;

    /// Origin of the frame of the maps [m, world]: near what moves, so that floats suffice.
    glm::dvec3 origin() const { return origin_; }

    /// How light may change of a light in a scene state: on segments from one box that meet the
    /// other [m, frame of the maps].
    struct Reach {
        Bounds source, thing;
        bool everywhere = false; ///< the light itself moves
        std::size_t index = 0;   ///< of the light
    };
    const std::vector<Reach>& reaches() const { return reaches_; }

private:
    using Row = std::array<glm::vec4, kPreviewColumns>;
    struct LightMaps {
        Row row{};
        Reach reach;
    };
    struct Group { ///< of layers: the maps of one scene state
        SceneStatePtr of;
        bool wanted = false;
        std::vector<LightMaps> lights;
    };

    void startAnew(const PreviewLighting& light);
    std::size_t groupOf(const SceneStatePtr& sceneState);
    std::size_t draw(const PreviewLighting& light, GeometryCache& cache, std::size_t group);
    Emitter placedLight(const Emitter& source) const;
    Bounds thingIn(const PreviewLighting& light, const SceneState& at) const;
    std::vector<ShadowCaster> casters(const PreviewLighting& light, const SceneState& at,
                                      GeometryCache& cache, bool moving, const Reach& reach) const;
    std::size_t drawTight(LightMaps& maps, const Emitter& source, int layer,
                          const std::vector<ShadowCaster>& moved,
                          const std::vector<ShadowCaster>& fixed);
    std::size_t drawCube(LightMaps& maps, const Emitter& source, int layer,
                         const std::vector<ShadowCaster>& all);
    void writeTable(const PreviewLighting& light);

    ShadowMaps moved_, fixed_;
    GlObject table_;
    std::array<Group, kPreviewSlots> groups_;
    std::vector<Reach> reaches_;
    std::vector<bool> moves_, lightMoves_; ///< what the maps are of; else they are drawn anew
    std::vector<const LitGeometry*> geometries_;
    int points_ = 0;
    glm::dvec3 origin_{0.0};
};

} // namespace penumbra
