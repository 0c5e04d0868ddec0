// How the light of one lit surface changes on the screen.
#pragma once

#include "radiosity/process/store/PublishedGeometry.h"
#include "viewer/preview/CornerFade.h"
#include "viewer/preview/ShownLight.h"

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace penumbra {

/// Keeps apart what is shown of a geometry and what it carries. The former follows the latter
/// without a jump, each vertex by a smoothstep in time, in linear light,
///
///     shown = from + (target - from) w,   w = s^2 (3 - 2 s),   s = (t - start) / seconds
///
/// A vertex takes a new target when it is *ready*. Its direct light is ready when the factors of
/// all previewed lights are exact in its block and in the blocks that share a triangle with it, so
/// that no triangle is half ready. Indirect light is ready when a frame says so, at all vertices at
/// once. Until then the vertex goes on to the target that it has, or stays. A target that comes
/// during a fade starts a new fade from what is shown.
///
/// A vertex that comes to represent a corner of a triangle (see Contact.h) begins with the light
/// that was shown there. If it goes on with its own, the corner does not: see CornerFade.
///
/// Only blocks that wait or fade cost anything.
class LightFade {
public:
    /// Shows what the geometry carries.
    explicit LightFade(const PublishedGeometry& geometry);

    struct Frame {
        double time = 0;        ///< [s]
        double seconds = 0.25;  ///< of a fade; 0: at once
        std::size_t lights = 0; ///< previewed ones; with none of them every vertex is always ready
        bool fresh = true;      ///< what is exact is the light of the scene state that is at rest
        /// Share of the state before in vertices that are not behind; it falls to 0.
        float rest = 0;
        /// Vertices that are behind are so with that state, and not with one before it: those
        /// follow only when `rest` has come to 0, for a vertex has but two states.
        bool behindIsRest = true;
        bool indirect = true; ///< indirect light may begin to fade, and does not wait
    };

    /// Begins anew with another number of previewed lights: no factors are known. \pre nothing is
    /// behind
    void setLights(std::size_t lights);

    /// Another scene state comes to rest: vertices that are not ready stay behind with the one
    /// before (see ShownLight::behind). \return whether there are any
    bool leaveBehind(const PublishedGeometry& geometry, const Frame& frame);
    /// What leaveBehind() would return.
    bool anyUnready(const PublishedGeometry& geometry, const Frame& frame) const;

    void advance(const PublishedGeometry& geometry, const Frame& frame);

    /// Goes on from what was shown of another geometry with the same vertices, if it has.
    void takeOver(const LightFade& before);

    const ShownLight& shown() const { return shown_; }
    /// For a Preview, which takes back what it changes before the next advance().
    ShownLight& shown() { return shown_; }
    /// Something is on its way, or waits.
    bool changing() const { return !flights_.empty() || !cornerFade_.empty(); }
    bool fading() const { return fading_; }   ///< direct light is on its way
    bool waiting() const { return waiting_; } ///< some vertices are not ready
    bool anyBehind() const { return behind_ > 0; }

private:
    static constexpr std::size_t kBlock = LitGeometry::kBlock;
    static constexpr double kNever = -1e30;

    struct Direct {
        Rgb light;
        LightFactors factors = {};
        float old = 0; ///< share that the state before, or the one that is behind, has in them
        friend bool operator==(const Direct&, const Direct&) = default;
    };
    template <class T>
    struct Way {
        T from, target;
        double start = kNever; ///< kNever: at rest
    };
    struct Flight {
        std::vector<Way<Direct>> direct;
        std::vector<Way<Rgb>> indirect;
    };

    void followTopology(const PublishedGeometry& geometry);
    void findBorders(const LitMeshData& data);
    bool blockReady(const PublishedGeometry& geometry, std::size_t block, const Frame& frame) const;
    bool ready(const PublishedGeometry& geometry, std::size_t vertex, const Frame& frame) const;
    Direct target(const PublishedGeometry& geometry, std::size_t vertex) const;
    Direct shownDirect(std::size_t vertex, const Frame& frame) const;
    void setShown(std::size_t vertex, const Direct& direct, const Frame& frame);
    void setBehind(std::size_t vertex, float behind);
    /// What is shown somewhere.
    struct Light {
        Rgb direct, indirect;
        LightFactors factors = {};
        float behind = 0;
    };
    void adopt(const PublishedGeometry& geometry);
    Light shownAt(std::uint32_t entry) const;
    void beginWith(std::uint32_t vertex, const Light& light);
    CornerFade::Over beyond(const PublishedGeometry& geometry, std::uint32_t vertex,
                            const Light& light) const;
    Flight& flightOf(std::size_t block);
    void touchIndirect(std::size_t block);
    bool advanceBlock(const PublishedGeometry& geometry, std::size_t block, Flight& flight,
                      const Frame& frame);
    void advanceCorners(const PublishedGeometry& geometry, const Frame& frame);
    void goOn(std::size_t vertex, Way<Direct>& way, const Frame& frame);
    bool advanceDirect(const PublishedGeometry& geometry, std::size_t vertex, Way<Direct>& way,
                       const Frame& frame);
    bool advanceIndirect(const LitMeshData& data, std::size_t vertex, Way<Rgb>& way,
                         const Frame& frame);

    std::size_t vertices_ = 0; ///< of the geometry
    ShownLight shown_;
    CornerFade cornerFade_;
    std::vector<std::uint64_t> seen_; ///< block revisions of the geometry
    std::uint64_t revision_ = 0, topology_ = 0;
    std::vector<std::uint32_t> corners_;              ///< of triangles, as last seen
    std::unordered_map<std::size_t, Flight> flights_; ///< by block
    /// The other blocks that share a triangle with a vertex: of vertex v those from borderFirst_[v]
    /// to borderFirst_[v + 1].
    std::vector<std::uint32_t> borderFirst_, borders_;
    std::size_t behind_ = 0; ///< vertices that are, in part
    bool fading_ = false, waiting_ = false;
    /// Of the block that is being worked on.
    bool directChanged_ = false, indirectChanged_ = false;
};

} // namespace penumbra
