// Playing an animation under several scheduling policies, and watching the picture come right.
#pragma once

#include "base/Rgb.h"
#include "comparison/ErrorCurve.h"
#include "importance/Priority.h"
#include "importance/Pyramid.h"
#include "radiosity/mesh/BuildPatches.h"
#include "radiosity/transport/Solver.h"
#include "scenegraph/Camera.h"
#include "scenegraph/Objects.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace penumbra {

/// A picture as its viewer sees it.
struct Picture {
    int width = 0, height = 0;
    std::vector<Rgb> colours;   ///< top row first [nit]
    std::vector<float> metered; ///< by which it is exposed, see base/ViewMeter.h [nit]
};

/// One way of ordering the work.
struct PolicyUnderTest {
    enum class Kind { plain, bound, random, importance, oracle };
    Kind kind = Kind::plain;
    std::string name;
    std::uint32_t seed = 1;    ///< of the random policy
    PriorityFactors factors{}; ///< of importance: which of them count
};
/// The orders that are compared unless others are asked for.
std::vector<PolicyUnderTest> usualPolicies();
/// All there are names for: the usual ones, and importance without each of its factors.
std::vector<PolicyUnderTest> allPolicies();

/// What is worked on after an edit.
enum class DirtySetKind : std::uint8_t {
    shafts, ///< what bounding shafts find, as in the program: much of it turns out not to change
    perfect ///< of direct light only the entries that come out otherwise, as if that were known
};

struct ComparisonOptions {
    MeshingOptions meshing;
    SolverOptions solving;           ///< but for the policy
    int width = 480, height = 270;   ///< of the pictures that are compared [pixels]
    double firstLook = 1000;         ///< work until the first sample of the picture, about [rays]
    double growth = 1.25;            ///< of the work until the next sample; > 1
    std::vector<double> filmSeconds; ///< the film strip's moments, ascending [s]
    int filmFrame = 0;               ///< which of the edits the film strip shows: index of a frame
    DirtySetKind dirty = DirtySetKind::shafts;
    double cutAt = 0.1; ///< share of the work before a cut, see Playback::viewBefore
};

/// What plays: the scene at a frame, and the view of it.
struct Playback {
    std::vector<double> frames; ///< the first is where it starts; each later one is an edit
    std::function<PlacedScene(double frame)> show;
    std::function<View(const PlacedScene&)> view; ///< in which the error is measured
    /// If there is one, what the viewer looks at first, until a share of the work is done: a cut.
    std::function<View(const PlacedScene&)> viewBefore{};
    /// How far the viewer turns to the left while the light is brought up to date, evenly with the
    /// work that this takes unwatched, half of it before and half after the middle of `view`
    /// [degrees]. The error is measured in the view of the moment, and policies that depend
    /// on the view know it.
    double pan = 0;
    glm::dvec3 up{0, 0, 1}; ///< unit vector: about which the viewer turns [world]
};

/// One picture of the film strip: the first that was there at or after its moment.
struct FilmPicture {
    double seconds = 0, work = 0;
    Picture picture;
    Plane jnd; ///< against the settled picture
    DifferenceSummary error;
};

/// How one policy did.
struct PolicyResult {
    std::string name;
    std::vector<std::vector<ErrorSample>> frames; ///< one an edit; the first sample before any work
    std::vector<double> work, seconds;            ///< to the settled light, one an edit
    std::vector<FilmPicture> film;
    double differsFromTruth = 0; ///< when settled, the most of all frames [JND]
};

struct ComparisonResult {
    std::vector<double> frames; ///< that were edits
    std::vector<PolicyResult> policies;
    Picture truth;     ///< settled, of the film strip's frame
    int filmFrame = 0; ///< which of the edits that is: an index
    std::size_t elements = 0, patches = 0, lights = 0;
    double pixelsPerDegree = 0; ///< of the film strip's view
    DirtySetKind dirty = DirtySetKind::shafts;
};

/// Plays under each policy. The truth of each frame is the settled solution of the same mesh, found
/// by a solver that is not watched. Pictures are as drawn.
///
/// One scene plays all of it: for each policy it goes back to the frame before, settles, and takes
/// the edit again, so that each starts from the same light whatever the policy.
/// \param progress called with a phase and the share done in [0, 1]
ComparisonResult comparePolicies(const Playback& playback,
                                 const std::vector<PolicyUnderTest>& policies,
                                 const ComparisonOptions& options, const Progress& progress = {});

} // namespace penumbra
