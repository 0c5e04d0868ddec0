// The walkthrough's camera: how it moves at the moment, and the views that are kept.
#pragma once

#include "scenegraph/Camera.h"
#include "scenegraph/Objects.h"
#include "viewer/input/CameraMotion.h"

#include <string>
#include <vector>

namespace penumbra {

/// A camera of the file as a viewpoint to go to.
struct Bookmark {
    std::string path;
    CameraPose pose;
    Lens lens; ///< clipping range in metres
};

/// All cameras of a scene, in its order.
std::vector<Bookmark> bookmarksOf(const PlacedScene& scene, const Compass& compass);

/// The index of a camera among the scene's. A camera prim with a transform of its own is two nodes
/// of one name, and either path will do. \param file for the message
/// \throws Error there is none, with those that there are
std::size_t cameraIndex(const PlacedScene& scene, const std::string& path, const std::string& file);

/// The view a scene begins with: its first camera, or the whole scene from a corner above.
Bookmark openingView(const PlacedScene& scene, UpAxis up);

enum class CameraMode { walk, fly, orbit };
inline constexpr const char* kCameraModeNames[] = {"walk", "fly", "orbit"};

/// The camera of the walkthrough.
class CameraRig {
public:
    CameraRig(UpAxis up, const Bookmark& start);

    const Compass& compass() const { return compass_; }
    const CameraPose& pose() const { return travel_.pose; }
    const Lens& lens() const { return lens_; }
    glm::dmat4 toWorld() const { return travel_.pose.toWorld(compass_); }
    View view(int width, int height) const { return makeView(lens_, toWorld(), width, height); }

    CameraMode mode() const { return mode_; }
    void setMode(CameraMode mode);

    /// What walking and flying go by; may be changed at any time.
    TravelOptions options;

    /// The point to orbit around. `MotionInput::orbit` and `pan` work in every mode.
    void setOrbitCentre(glm::dvec3 centre) { centre_ = centre; }
    const glm::dvec3& orbitCentre() const { return centre_; }

    /// Flies there within kFlightSeconds. Any motion of the hands ends the flight where it is.
    void flyTo(const Bookmark& there);
    /// Shows a box as a whole, from the side that the camera is on. \param box [m], not empty
    void frame(const Bounds& box);
    /// Is there at once: played cameras.
    void put(const CameraPose& pose, const Lens& lens);

    /// Lets time pass.
    void advance(const MotionInput& input, double seconds, const Surroundings& surroundings);

    /// Whether it would go on moving without any input.
    bool moving() const;

    static constexpr double kFlightSeconds = 0.6;

private:
    void stop();
    void circle(const MotionInput& input, double seconds);

    Compass compass_;
    Travel travel_;
    Lens lens_;
    CameraMode mode_ = CameraMode::walk;
    glm::dvec3 centre_{0.0};
    double zoomLeft_ = 0;
    bool flying_ = false; ///< to a bookmark
    double flown_ = 0;    ///< [s]
    CameraPose from_, to_;
    bool landed_ = false; ///< a bookmark is kept to until the hands move: no falling meanwhile
};

} // namespace penumbra
