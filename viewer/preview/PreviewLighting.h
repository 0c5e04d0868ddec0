// Lamps whose light is drawn live, while something in it moves: what the renderer is told.
#pragma once

#include "base/Rgb.h"
#include "radiosity/mesh/PatchSet.h"
#include "scenegraph/LitGeometry.h"
#include "viewer/preview/ShownLight.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <memory>
#include <vector>

namespace penumbra {

constexpr std::size_t kMostPreviewedByMaps = 4; ///< their factors are one attribute of a vertex

/// How lit objects and live lamps stand at one time.
struct SceneState {
    struct ObjectState {
        glm::dmat4 toWorld{1.0}; ///< of the geometry's frame
        bool visible = true;
        friend bool operator==(const ObjectState&, const ObjectState&) = default;
    };
    std::vector<ObjectState> objects; ///< as PreviewLighting::objects
    /// What they send light from, as radiosity does it: a light is one emitter, a mesh one or more
    /// [m, world]. None: hidden.
    std::vector<std::vector<Emitter>> lights;
};
using SceneStatePtr = std::shared_ptr<const SceneState>;

/// Vertices carry light of an earlier time, when things stood otherwise. The shader brings it up to
/// date: with F_u a lamp's form factor in closed form and V the share of it that is seen, by shadow
/// maps, a vertex of which the lamp's factor was f is shown with
///
///     f + sum over anchors a of share_a (F_u(now) V(now) - F_u(a) V(a))
///
/// in place of f; anchors are arrangements of earlier times whose light is in the vertex, by their
/// shares. The sum is kept in [0, F_u(now) + max(0, f - F_u(then))]; the last term is what the
/// triangle, on which f is linear, has too much. It is the sum that is kept there, not each of its
/// terms: f is a mixture as well, and what one term takes another may have to give.
///
/// Where nothing has changed the light is f, exactly: nothing jumps when a thing is taken hold of,
/// and what lies in no shadow keeps its radiosity.
struct PreviewLighting {
    struct Object {
        std::shared_ptr<const LitGeometry> geometry;
        bool moves = false; ///< does not stand alike in all arrangements
    };
    struct PreviewLight {
        Rgb exitance;       ///< pi L, now [lm/m^2]
        bool moves = false; ///< its shadows are looked for everywhere, not behind what moves alone
    };
    struct Anchor {
        SceneStatePtr sceneState;
        float rest = 0, behind = 0; ///< share: mix(rest, behind, ShownLight::behind)
    };

    std::vector<Object> objects;      ///< by LitGeometry::object()
    std::vector<PreviewLight> lights; ///< at most kMostPreviewed; by maps, kMostPreviewedByMaps
    SceneStatePtr now;
    std::vector<Anchor> anchors; ///< at most 3, none of them now
    int points = 16;             ///< of a lamp, from which shadows are drawn; at most 16

    bool active() const { return !lights.empty() && !anchors.empty(); }
};

} // namespace penumbra
