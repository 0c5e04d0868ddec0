// A scene that is played under several scheduling policies.
#pragma once

#include "comparison/ComparePolicies.h"
#include "comparison/OraclePolicy.h"
#include "importance/Viewpoint.h"
#include "radiosity/query/DrawnView.h"
#include "radiosity/transport/LitScene.h"

#include <memory>
#include <vector>

namespace penumbra {

/// What is to come out of an edit, by vertex.
struct Truth {
    std::vector<Element> elements; ///< whose corners the vertices are
    Lighting light;
    VertexFactors factors;
};

/// The same by the vertices of a patch set as it is now, after the same edit: which of the private
/// vertices represents which corner depends on what was done before (Coverage.h).
Truth truthBy(const PatchSet& now, const Truth& truth);

/// Keeps a scene lit while its animation is played, and takes pictures of it.
class EditPlayer {
public:
    /// Settles the first frame. Both must outlive this.
    EditPlayer(const Playback& playback, const ComparisonOptions& options);

    /// Goes to a frame, without any work on its light.
    void edit(double frame);
    /// Leaves only that work which changes something.
    void knowWhatChanges(const Truth& truth);
    /// Does what was left out because nothing changes: who blocks an entry may be someone else.
    void catchUp();
    /// With no policy that is watched.
    void settle();
    /// Sets the solver's policy, as a viewer would at each frame.
    /// \param truth for the policy that knows it
    /// \param before the cut, if there is one
    void policy(const PolicyUnderTest& policy, const Truth& truth, bool before);
    /// Takes a picture of the scene as it is. \param turn of the viewer to the left [degrees]
    void aim(double turn = 0);

    LitScene& lit() { return lit_; }
    double pixelsPerDegree() const { return viewpoint(view_).pixelsPerDegree(); }
    /// What the last picture shows, as it is lit now.
    Picture picture() const;
    /// The same in another light [nit].
    Plane luminances(const Lighting& light) const { return drawn_->luminances(light); }

private:
    Viewpoint viewpoint(const View& view) const;
    Attention attention(const PolicyUnderTest& policy, bool before) const;

    const Playback& playback_;
    const ComparisonOptions& options_;
    PlacedScene placed_;
    LitScene lit_;
    SceneChange change_; ///< the last edit
    View view_;
    std::unique_ptr<DrawnView> drawn_;
    double adaptation_ = 100; ///< [nit]
};

} // namespace penumbra
