// From the light that radiosity has published to the light on the screen.
#pragma once

#include "viewer/LightFade.h"
#include "viewer/LiveLight.h"

#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

namespace penumbra {

class RadiosityNode;
struct RadiosityState;

/// How it is found out what live lamps reach.
enum class LiveBy {
    maps, ///< by shadow maps, in the vertex shader: LivePass
    rays  ///< by radiosity's rays, vertex by vertex: LiveVertices
};

/// What is best: rays are radiosity's own, so that the fast shadow is the soft one, and maps cost a
/// graphics card next to nothing.
/// \param software the processor draws: then rays are faster, too
/// \param threads  that the processor has: from 8 on it traces a frame's rays in the time of one or
///                 two frames
inline LiveBy bestLiveBy(bool software, unsigned threads) {
    return software || threads >= 8 ? LiveBy::rays : LiveBy::maps;
}

struct BlendOptions {
    double seconds = 0.25; ///< that a vertex takes from one light to the next; 0: it jumps
    int points = 16;       ///< of a lamp for its fast shadows, at most 16
    LiveBy by = LiveBy::maps;
    std::size_t lamps = kMostLampsDrawnLive; ///< emitters drawn live at most, see LampLimits
};

/// Follows the light of a RadiosityNode such that nothing on the screen jumps: when something
/// begins to move the shader takes over for the live lamps (LiveLight), and vertex by vertex gives
/// back when radiosity is ready (LightFade).
///
/// Vertices carry light of the arrangement that is *at rest*: the last one whose light became
/// exact. The shader brings it up to date with how things stand *now*. When the light of a newer
/// arrangement, the one that was *sent*, becomes exact, that one comes to rest: the share of the
/// old one fades to it in all vertices at once, by one number; vertices that are not ready then
/// keep the old one for themselves (they are *behind*) and follow one by one. Only one arrangement
/// can be left behind at a time; if a third comes to rest before its vertices have followed, it
/// waits until all are ready.
///
/// Indirect light is not exchanged. It fades to what was published when that has settled; if that
/// takes long, every two seconds.
///
/// It makes no difference who moves things: a hand, arrow keys, undo, an animation. If nobody has
/// asked for live lamps, light fades as it is published.
class LightBlend {
public:
    explicit LightBlend(const BlendOptions& options = {}) : options_(options) {}

    /// Which lamps are to be drawn live; their paths, see lampsThatMatter(), at most
    /// kMostLampsDrawnLive. Takes effect when nothing is on its way.
    void want(std::vector<std::string> lamps);

    /// To be called after each update() of the node. \param time that only grows [s]
    void advance(RadiosityNode& node, double time);

    /// What is shown of a geometry of the node; null: it is not known.
    const ShownLight* shown(const LitGeometry& geometry) const;
    /// The live part, for the renderer.
    const LiveLight& live() const { return live_; }
    /// What it would be of if an object began to move now; without anchors. \param object its path,
    /// as LitObject has it
    LiveLight expecting(const RadiosityNode& node, const std::string& object) const;

    /// Whether the picture changes without new light: fades.
    bool changing() const { return changing_; }
    /// Whether light that was published, or is to come, is not taken yet.
    bool waiting() const { return waiting_; }
    /// Whether direct light is drawn live or on its way: exposure had better stay.
    bool fading() const { return fading_ || live_.active(); }

private:
    struct Entry {
        std::string path;
        std::shared_ptr<LitGeometry> geometry;
        std::unique_ptr<LightFade> fade;
    };

    bool followObjects(const RadiosityNode& node);
    void followLamps(RadiosityNode& node);
    void lookAround(const RadiosityNode& node);
    void restAnew();
    bool quiet() const;
    bool indirectSetsOut(const RadiosityState& state, double time);
    LightFade::Frame frameAt(double time, bool fresh) const;
    void comeToRest(double time);
    void advanceFades(const LightFade::Frame& frame);
    float restShare(double time) const;
    void describeLive(const RadiosityNode& node, double time);
    void describeLamps(const RadiosityNode& node, LiveLight& light) const;

    BlendOptions options_;
    std::vector<std::string> wanted_, lamps_;
    std::vector<Entry> entries_;
    std::unordered_map<const LitGeometry*, const LightFade*> byGeometry_;
    ArrangementPtr now_, sent_;
    ArrangementPtr rest_, next_; ///< rest_ fades to next_, if there is one
    ArrangementPtr behind_;      ///< what some vertices are left with
    double since_ = 0;           ///< of next_ [s]
    double indirectSince_ = 0;   ///< that indirect light set out last [s]
    LiveLight live_;
    bool changing_ = false, fading_ = false, waiting_ = false;
};

} // namespace penumbra
