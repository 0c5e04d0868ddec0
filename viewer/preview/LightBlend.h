// From the light that radiosity has published to the light on the screen.
#pragma once

#include "viewer/preview/LightFade.h"
#include "viewer/preview/Preview.h"

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace penumbra {

class RadiosityNode;
struct RadiosityState;

struct BlendOptions {
    double seconds = 0.25; ///< that a vertex takes from one light to the next; 0: it jumps
    int points = 16;       ///< of a light for its shadow maps, at most 16
    std::optional<PreviewMethod> by{}; ///< the preview; none: see PreviewChoice
    bool software = false;             ///< the processor draws
    double inTime = 1.0 / 120;         ///< that rays of a frame may take, see PreviewChoice [s]
    /// That rays of a frame may take before what has had no turn waits for the next [s].
    double slice = std::numeric_limits<double>::infinity();
    std::size_t lights = kMostPreviewed; ///< emitters previewed at most, see PreviewLimits
};

/// Follows the light of a RadiosityNode such that nothing on the screen jumps: when something
/// begins to move the shader takes over for the previewed lights (PreviewLighting), and vertex by
/// vertex gives back when radiosity is ready (LightFade).
///
/// Vertices carry light of the scene state that is *at rest*: the last one of which the light
/// became exact. The shader brings it up to date with the state *now*. When the light of a newer
/// state, the one that was *sent*, becomes exact, that one comes to rest. The share of the old
/// state then falls to 0, in all vertices at once, by one number. Vertices that are not ready
/// keep the old state for themselves (they are *behind*) and follow one by one. Only one state
/// can be left behind at a time; if a third is to come to rest before its vertices have followed,
/// it waits until all are ready.
///
/// Indirect light is not exchanged. It fades to what was published when that is certified; if that
/// takes long, every two seconds.
///
/// It makes no difference who moves things: a hand, arrow keys, undo, an animation. If no lights
/// are previewed, light fades as it is published.
class LightBlend {
public:
    explicit LightBlend(const BlendOptions& options = {}) : options_(options) {}

    /// Which lights are to be previewed; their paths, see lightsThatMatter(), at most
    /// kMostPreviewed. Takes effect when nothing is on its way.
    void want(std::vector<std::string> lights);

    /// Whether they are those that were wanted last.
    bool hasWanted() const { return wanted_ == lights_; }

    /// To be called after each update() of the node. \param time that only grows [s]
    void advance(RadiosityNode& node, double time);

    /// What is shown of a geometry of the node; null: it is not known.
    const ShownLight* shown(const LitGeometry& geometry) const;
    /// The same for a Preview, which takes back what it changes before the next advance().
    ShownLight* shown(const LitGeometry& geometry);
    /// The preview lighting, for the renderer.
    const PreviewLighting& preview() const { return preview_; }
    /// What it would be of if an object began to move now; without anchors. \param object its path,
    /// as LitObject has it; empty: none
    PreviewLighting expecting(const RadiosityNode& node, const std::string& object) const;

    /// Whether the picture changes without new light: fades.
    bool changing() const { return changing_; }
    /// Whether light that was published, or is to come, is not taken yet.
    bool waiting() const { return waiting_; }
    /// Whether direct light is previewed or fades: exposure had better stay.
    bool fading() const { return fading_ || preview_.active(); }

private:
    struct Entry {
        std::string path;
        std::shared_ptr<PublishedGeometry> geometry;
        std::unique_ptr<LightFade> fade;
    };

    bool followObjects(const RadiosityNode& node);
    void followLights(RadiosityNode& node);
    void observe(const RadiosityNode& node);
    void restAnew();
    bool quiet() const;
    bool indirectFadeStarts(const RadiosityState& state, double time);
    LightFade::Frame frameAt(double time, bool fresh) const;
    void comeToRest(double time);
    void advanceFades(const LightFade::Frame& frame);
    float restShare(double time) const;
    void describePreview(const RadiosityNode& node, double time);
    void describeLights(const RadiosityNode& node, PreviewLighting& light) const;

    BlendOptions options_;
    std::vector<std::string> wanted_, lights_;
    std::vector<Entry> entries_;
    std::unordered_map<const LitGeometry*, LightFade*> byGeometry_;
    SceneStatePtr now_, sent_;
    SceneStatePtr rest_, next_; ///< rest_ fades to next_, if there is one
    SceneStatePtr behind_;      ///< what some vertices are left with
    double since_ = 0;          ///< of next_ [s]
    double indirectSince_ = 0;  ///< that indirect light began to fade last [s]
    PreviewLighting preview_;
    bool changing_ = false, fading_ = false, waiting_ = false;
};

} // namespace penumbra
