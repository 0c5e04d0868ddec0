// Previewed lights, while something in their light moves: what the renderer needs of them.
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

/// Where lit objects and previewed lights are at one time.
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

/// Vertices carry light of an earlier scene state. The shader brings it up to date: with F_u a
/// light's form factor in closed form and V the share of it that is seen, by shadow maps, a vertex
/// of which the light's factor was f is shown with
///
///     f + sum over anchors a of share_a (F_u(now) V(now) - F_u(a) V(a))
///
/// instead of f; anchors are earlier scene states whose light is in the vertex, by their shares.
/// The sum is kept in [0, F_u(now) + max(0, f - F_u(then))]; the last term is what the triangle, on
/// which f is linear, has too much. The bound holds for the sum and not for each of its terms: f is
/// a mixture as well, and terms may cancel.
///
/// Where nothing has changed the light is f, exactly: nothing jumps when a drag begins, and what
/// lies in no shadow keeps its radiosity.
struct PreviewLighting {
    struct Object {
        std::shared_ptr<const LitGeometry> geometry;
        bool moves = false; ///< has not the same pose in all scene states
    };
    struct PreviewLight {
        Rgb exitance;       ///< pi L, now [lm/m^2]
        bool moves = false; ///< else its shadows change only behind what moves
    };
    struct Anchor {
        SceneStatePtr sceneState;
        float rest = 0, behind = 0; ///< share: mix(rest, behind, ShownLight::behind)
    };

    std::vector<Object> objects;      ///< by LitGeometry::object()
    std::vector<PreviewLight> lights; ///< at most kMostPreviewed; by maps, kMostPreviewedByMaps
    SceneStatePtr now;
    std::vector<Anchor> anchors; ///< at most 3, none of them now
    SceneStatePtr awaited;       ///< whose light is on its way: an anchor in a later frame, or null
    int points = 16;             ///< of a light, from which shadows are drawn; at most 16

    bool active() const { return !lights.empty() && !anchors.empty(); }
};

} // namespace penumbra
