#include "viewer/Walkthrough.h"

#include <algorithm>
#include <cassert>

namespace penumbra {

Walkthrough::Walkthrough(ReadyScene ready)
    : loaded_(std::move(ready.loaded)), placed_(std::move(ready.placed)),
      rays_(std::move(ready.rays)),
      rig_(loaded_.scene->upAxis, openingView(placed_, loaded_.scene->upAxis)),
      bookmarks_(bookmarksOf(placed_, rig_.compass())) {
    if (bookmarks_.empty()) rig_.setOrbitCentre(glm::dvec3(placed_.bounds.centre()));
}

Walkthrough::Ray Walkthrough::rayAt(glm::dvec2 position, glm::ivec2 picture) const {
    const View view = rig_.view(picture.x, picture.y);
    const glm::dmat4 toWorld = glm::inverse(view.worldToClip());
    const glm::dvec2 clip = 2.0 * position / glm::dvec2(picture) - 1.0;
    const glm::dvec4 near = toWorld * glm::dvec4(clip.x, -clip.y, -1, 1);
    const glm::dvec4 far = toWorld * glm::dvec4(clip.x, -clip.y, 1, 1);
    const glm::dvec3 from = glm::dvec3(near) / near.w, to = glm::dvec3(far) / far.w;
    return {from, glm::normalize(to - from)};
}

void Walkthrough::centreOrbitAt(glm::dvec2 position, glm::ivec2 picture) {
    const Ray ray = rayAt(position, picture);
    constexpr double kReach = 1e6;
    if (const auto touch = rays_->touch(ray.origin, ray.direction, kReach))
        rig_.setOrbitCentre(touch->position);
}

void Walkthrough::press(const ButtonEvent& button, glm::ivec2 picture) {
    using Gesture = MotionControls::Gesture;
    if (gestureButton_) return;
    Gesture gesture = Gesture::look;
    if (button.modifiers.alt)
        gesture = button.button == MouseButton::left     ? Gesture::orbit
                  : button.button == MouseButton::middle ? Gesture::pan
                                                         : Gesture::zoom;
    else if (button.button == MouseButton::middle)
        gesture = button.modifiers.shift ? Gesture::pan : Gesture::orbit;
    if (gesture != Gesture::look) centreOrbitAt(button.position, picture);
    controls_.begin(gesture);
    gestureButton_ = button.button;
    pointerHeld_ = button.button == MouseButton::right && gesture == Gesture::look;
}

void Walkthrough::take(const InputEvent& event, glm::ivec2 picture) {
    controls_.take(event, picture.y);
    if (const auto* button = std::get_if<ButtonEvent>(&event)) {
        if (button->down) {
            press(*button, picture);
        } else if (gestureButton_ == button->button) {
            controls_.end();
            gestureButton_.reset();
            pointerHeld_ = false;
        }
    } else if (const auto* focus = std::get_if<FocusEvent>(&event)) {
        if (!focus->focused) gestureButton_.reset(), pointerHeld_ = false;
    }
}

void Walkthrough::perform(const Command& command) {
    switch (command.action) {
    case Action::nextMode:
        rig_.setMode(CameraMode((int(rig_.mode()) + 1) % int(std::size(kCameraModeNames))));
        break;
    case Action::gravity:
        rig_.options.gravity = !rig_.options.gravity;
        break;
    case Action::collision:
        rig_.options.collision = !rig_.options.collision;
        break;
    case Action::bookmark:
        if (std::size_t(command.number) <= bookmarks_.size())
            rig_.flyTo(bookmarks_[std::size_t(command.number) - 1]);
        break;
    case Action::home:
        rig_.frame(placed_.bounds);
        break;
    default:
        break;
    }
}

void Walkthrough::advance(double seconds) {
    rig_.advance(controls_.takeMotion(), seconds, *rays_);
}

bool Walkthrough::moving() const {
    const auto held = [&](const char* letters) {
        return std::any_of(letters, letters + std::char_traits<char>::length(letters),
                           [&](char letter) { return controls_.state().held(key(letter)); });
    };
    return rig_.moving() || held("WASDEQ");
}

} // namespace penumbra
