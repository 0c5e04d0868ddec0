#include "viewer/input/CameraRig.h"

#include "base/Error.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

namespace {

constexpr double kKeyTurn = 1.2;  // of keys in orbit mode [rad/s]
constexpr double kKeyNotches = 8; // of the wheel a second

/// A camera's lens without the scale of its transform: clipping range in metres.
Lens inMetres(Lens lens, const glm::dmat4& toWorld) {
    lens.clippingRange *= float(glm::length(glm::dvec3(toWorld[2])));
    return lens;
}

/// A lens for scenes that bring no camera: 75 degrees wide, as games have it.
Lens plainLens(const Bounds& bounds) {
    Lens lens;
    lens.focalLength = 13.65f;
    lens.horizontalAperture = 20.955f;
    lens.verticalAperture = 11.787f;
    const float size = bounds.empty() ? 1.0f : std::max(bounds.diagonal(), 1e-3f);
    lens.clippingRange = {std::min(0.02f, size * 1e-3f), size * 20};
    return lens;
}

} // namespace

std::vector<Bookmark> bookmarksOf(const PlacedScene& scene, const Compass& compass) {
    std::vector<Bookmark> bookmarks;
    for (const auto& camera : scene.cameras) {
        const glm::dmat4 frame = wholeFrame(camera.toWorld);
        bookmarks.push_back(
            {camera.path, poseOf(frame, compass), inMetres(camera.node->lens(), frame)});
    }
    return bookmarks;
}

std::size_t cameraIndex(const PlacedScene& scene, const std::string& path,
                        const std::string& file) {
    std::string known;
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        const Placed<Camera>& camera = scene.cameras[i];
        if (camera.path == path) return i;
        known += (known.empty() ? "" : ", ") + camera.path;
    }
    throw SceneFileError({file}, "no camera '" + path + "' (" +
                                     (known.empty() ? "the file has none" : "it has " + known) +
                                     ")");
}

Bookmark openingView(const PlacedScene& scene, UpAxis up) {
    const Compass compass(up);
    if (!scene.cameras.empty()) return bookmarksOf(scene, compass).front();
    Bookmark start{"", {}, plainLens(scene.bounds)};
    if (scene.bounds.empty()) return start;
    const View view = frameBox(scene.bounds.lower, scene.bounds.upper, int(up), 16, 9);
    start.pose = poseOf(glm::inverse(view.worldToCamera), compass);
    return start;
}

CameraRig::CameraRig(UpAxis up, const Bookmark& start) : compass_(up), lens_(start.lens) {
    travel_.pose = start.pose;
    centre_ = start.pose.eye + 3.0 * start.pose.forward(compass_);
    landed_ = true;
}

void CameraRig::setMode(CameraMode mode) {
    stop();
    mode_ = mode;
    landed_ = false;
}

void CameraRig::stop() {
    travel_.velocity = glm::dvec3(0);
    travel_.dollyLeft = travel_.fall = zoomLeft_ = 0;
    flying_ = false;
}

void CameraRig::flyTo(const Bookmark& there) {
    stop();
    from_ = travel_.pose;
    to_ = there.pose;
    lens_ = there.lens;
    flown_ = 0;
    flying_ = true;
}

void CameraRig::frame(const Bounds& box) {
    const double tangent = double(lens_.horizontalAperture) / (2 * lens_.focalLength);
    const double radius = std::max(1e-3, 0.5 * double(box.diagonal()));
    centre_ = glm::dvec3(box.centre());
    Bookmark there{"", travel_.pose, lens_};
    // sin: a sphere, not a disk; 9/16: the shorter side of the usual picture
    const double angle = std::atan(tangent * 9 / 16);
    there.pose.eye = centre_ - radius / std::sin(angle) * travel_.pose.forward(compass_);
    flyTo(there);
}

void CameraRig::put(const CameraPose& pose, const Lens& lens) {
    stop();
    travel_.pose = pose;
    lens_ = lens;
    landed_ = true;
}

void CameraRig::advance(const MotionInput& input, double seconds,
                        const Surroundings& surroundings) {
    if (!input.idle()) flying_ = false;
    if (input.move != glm::dvec3(0) || input.dolly != 0) landed_ = false;
    if (flying_) {
        flown_ += seconds;
        const double t = std::clamp(flown_ / kFlightSeconds, 0.0, 1.0);
        travel_.pose = between(from_, to_, t * t * (3 - 2 * t));
        if (t < 1) return;
        flying_ = false;
        landed_ = true;
    }
    const bool around =
        mode_ == CameraMode::orbit || input.orbit != glm::dvec2(0) || input.pan != glm::dvec2(0);
    if (around) {
        circle(input, seconds);
        return;
    }
    TravelOptions how = options;
    how.gravity = how.gravity && !landed_;
    const auto mode = mode_ == CameraMode::fly ? TravelMode::fly : TravelMode::walk;
    travel_ = travelled(travel_, mode, input, seconds, how, compass_, surroundings);
}

void CameraRig::circle(const MotionInput& input, double seconds) {
    const double tangent = double(lens_.horizontalAperture) / (2 * lens_.focalLength);
    MotionInput all = input;
    if (mode_ == CameraMode::orbit) { // keys: sideways and up as hands pull the view, ahead as the
        all.orbit += glm::dvec2(-input.move.x, input.move.z) * (kKeyTurn * seconds); // wheel does
        all.dolly += input.move.y * kKeyNotches * seconds;
    }
    Orbit orbit{travel_.pose, centre_, zoomLeft_};
    orbit = orbited(orbit, all, seconds, tangent, compass_);
    travel_.pose = orbit.pose;
    centre_ = orbit.centre;
    zoomLeft_ = std::abs(orbit.zoomLeft) < 1e-4 ? 0 : orbit.zoomLeft;
    travel_.velocity = glm::dvec3(0);
    landed_ = true; // who circles does not fall; who walks on does
}

bool CameraRig::moving() const {
    return flying_ || zoomLeft_ != 0 ||
           (!landed_ && mode_ != CameraMode::orbit &&
            (glm::length(travel_.velocity) > 1e-3 || std::abs(travel_.dollyLeft) > 1e-3 ||
             travel_.fall != 0));
}

} // namespace penumbra
