// Fast light while something moves: what its two ways have in common, and which one is taken.
#pragma once

#include "viewer/preview/PreviewLighting.h"

#include <cstddef>
#include <functional>

namespace penumbra {

struct View;

/// How it is found what previewed lights reach.
enum class PreviewMethod {
    maps, ///< by shadow maps, in the vertex shader: MapPreview
    rays  ///< by radiosity's rays, vertex by vertex: RayPreview
};

/// Shows what previewed lights give now, see PreviewLighting, on top of the light that is shown
/// without it (LightBlend). Once a frame takeBack(), then that light goes on, then update() or, if
/// nothing moves, rest().
class Preview {
public:
    virtual ~Preview() = default;
    Preview() = default;
    Preview(const Preview&) = delete;
    Preview& operator=(const Preview&) = delete;

    virtual PreviewMethod method() const = 0;

    /// The light that is shown of a geometry, to be changed; null: not shown.
    using ShownOf = std::function<ShownLight*(const LitGeometry&)>;

    /// Takes back what update() has done to the shown light.
    virtual void takeBack() = 0;
    /// Whether there is more to be shown of the last update() than it had the time for: the next
    /// one goes on.
    virtual bool unfinished() const { return false; }
    /// \param light with PreviewLighting::active() \param view from where it is seen: what can't be
    /// seen may be left out; null: nothing is
    virtual void update(const PreviewLighting& light, const ShownOf& shown, const View* view) = 0;
    /// \param expected see LightBlend::expecting(): may be made ready, so that the first frame of
    /// a move need not; without lights: nothing is expected yet
    virtual void rest(const PreviewLighting& expected, const ShownOf& shown, const View* view) = 0;
};

/// Which way is taken, as measured on this machine in this scene. Rays are radiosity's own, so that
/// the fast shadow is the soft one; they are taken for as long as they come in time. Maps cost a
/// graphics card next to nothing. Where the processor draws, they cost more than rays.
class PreviewChoice {
public:
    /// \param software the processor draws \param inTime a frame's rays may take [s]
    explicit PreviewChoice(bool software, double inTime = 1.0 / 120)
        : software_(software), inTime_(inTime) {}

    /// What rays took in a frame in which something moved [s].
    void note(double seconds) {
        ++frames_;
        late_ += seconds > inTime_;
    }
    PreviewMethod method() const {
        const bool late = frames_ >= kEnough && 2 * late_ > frames_;
        return late && !software_ ? PreviewMethod::maps : PreviewMethod::rays;
    }

private:
    static constexpr std::size_t kEnough = 10; ///< frames, before they count

    bool software_;
    double inTime_; ///< as a default, half of a frame at 60 Hz
    std::size_t frames_ = 0, late_ = 0;
};

} // namespace penumbra
