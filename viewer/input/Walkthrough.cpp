#include "viewer/input/Walkthrough.h"

#include "viewer/input/Furnishing.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace penumbra {

namespace {

constexpr double kReach = 1e6;     // of the search for what is under the pointer [m]
constexpr double kClickPixels = 4; // less is no drag

} // namespace

Walkthrough::Walkthrough(ReadyScene ready)
    : loaded_(std::move(ready.loaded)), placed_(std::move(ready.placed)),
      rays_(std::move(ready.rays)),
      rig_(loaded_.scene->upAxis, openingView(placed_, loaded_.scene->upAxis)),
      bookmarks_(bookmarksOf(placed_, rig_.compass())) {
    if (bookmarks_.empty()) rig_.setOrbitCentre(glm::dvec3(placed_.bounds.centre()));
}

SightLine Walkthrough::sightAt(glm::dvec2 position, glm::ivec2 picture) const {
    const View view = rig_.view(picture.x, picture.y);
    const glm::dmat4 toWorld = glm::inverse(view.worldToClip());
    const glm::dvec2 clip = 2.0 * position / glm::dvec2(picture) - 1.0;
    const glm::dvec4 near = toWorld * glm::dvec4(clip.x, -clip.y, -1, 1);
    const glm::dvec4 far = toWorld * glm::dvec4(clip.x, -clip.y, 1, 1);
    const glm::dvec3 from = glm::dvec3(near) / near.w, to = glm::dvec3(far) / far.w;
    return {from, glm::normalize(to - from)};
}

std::optional<Touch> Walkthrough::pointedAt(glm::ivec2 picture) const {
    const SightLine sight = sightAt(controls_.state().position(), picture);
    return rays_->seen(sight.origin, sight.direction, kReach);
}

void Walkthrough::press(const ButtonEvent& button, glm::ivec2 picture) {
    using Gesture = MotionControls::Gesture;
    if (gestureButton_ || held_) return;
    Gesture gesture = Gesture::look;
    if (button.modifiers.alt)
        gesture = button.button == MouseButton::left     ? Gesture::orbit
                  : button.button == MouseButton::middle ? Gesture::pan
                                                         : Gesture::zoom;
    else if (button.button == MouseButton::middle)
        gesture = button.modifiers.shift ? Gesture::pan : Gesture::orbit;
    else if (button.button == MouseButton::left && takeHold(button, picture))
        return;
    if (gesture != Gesture::look) {
        const SightLine sight = sightAt(button.position, picture);
        if (const auto touch = rays_->seen(sight.origin, sight.direction, kReach))
            rig_.setOrbitCentre(touch->position);
    }
    controls_.begin(gesture);
    gestureButton_ = button.button;
    pointerHeld_ = button.button == MouseButton::right && gesture == Gesture::look;
}

/// Whether the camera is in an object, above or below it: a room, its floor, its ceiling.
bool Walkthrough::isAround(ObjectId object) const {
    const Bounds box = rays_->bounds(object);
    const glm::dvec3 up = glm::abs(rig_.compass().up), eye = rig_.pose().eye;
    for (int axis = 0; axis < 3; ++axis)
        if (up[axis] < 0.5 && (eye[axis] < box.lower[axis] || eye[axis] > box.upper[axis]))
            return false;
    return true;
}

/// Selects what is under the pointer. \return whether it is dragged now: what is around the camera
/// only when it was selected before, so that nobody drags the floor away who wants to look around
bool Walkthrough::takeHold(const ButtonEvent& button, glm::ivec2 picture) {
    const SightLine sight = sightAt(button.position, picture);
    const auto touch = rays_->seen(sight.origin, sight.direction, kReach);
    const std::string before = selection_ ? selection_->objectPath : std::string();
    selection_.reset();
    if (!touch) return false;
    selection_ = selectionOf(scene(), placed_, *touch);
    if (!selection_->node) return false;
    if (isAround(touch->object) && selection_->objectPath != before) return false;
    const SupportPlane plane = supportOf(*rays_, touch->object, rig_.compass());
    const glm::dmat4& toWorld = placed_.objects[touch->object.value].toWorld;
    held_ = Held{selection_->node, touch->object, selection_->node->matrix(),
                 Drag(touch->position, toWorld, plane, rig_.compass()), button.position};
    return true;
}

void Walkthrough::dragTo(const MoveEvent& move, glm::ivec2 picture) {
    if (!held_->moving) {
        if (glm::distance(move.position, held_->from) < kClickPixels) return;
        held_->moving = true;
        held_->drag.moved(sightAt(held_->from, picture), Drag::Mode::slide, 0);
    }
    const Modifiers modifiers = controls_.state().modifiers();
    const Drag::Mode mode = modifiers.control ? Drag::Mode::turn
                            : modifiers.shift ? Drag::Mode::lift
                                              : Drag::Mode::slide;
    const glm::dmat4 wanted = held_->drag.moved(sightAt(move.position, picture), mode,
                                                move.moved.x / std::max(1, picture.y));
    const glm::dmat4& now = placed_.objects[held_->object.value].toWorld;
    const glm::dmat4 matrix = matrixFor(*held_->node, now, wanted);
    if (matrix == held_->node->matrix()) return;
    held_->node->setMatrix(matrix);
    changed();
}

/// \param keep false: it goes back to where it was
void Walkthrough::letGo(bool keep) {
    if (!held_) return;
    const MoveEdit move{held_->node, held_->before, held_->node->matrix()};
    held_.reset();
    if (keep)
        history_.note({move});
    else
        takeBack(move);
    changed();
}

void Walkthrough::release(const ButtonEvent& button) {
    if (held_ && button.button == MouseButton::left) letGo(true);
    if (gestureButton_ != button.button) return;
    controls_.end();
    gestureButton_.reset();
    pointerHeld_ = false;
}

void Walkthrough::take(const InputEvent& event, glm::ivec2 picture) {
    controls_.take(event, picture.y);
    if (const auto* button = std::get_if<ButtonEvent>(&event)) {
        if (button->down)
            press(*button, picture);
        else
            release(*button);
    } else if (const auto* move = std::get_if<MoveEvent>(&event)) {
        if (held_) dragTo(*move, picture);
    } else if (const auto* focus = std::get_if<FocusEvent>(&event)) {
        if (focus->focused) return;
        letGo(true);
        gestureButton_.reset();
        pointerHeld_ = false;
    }
}

void Walkthrough::changed() {
    ++revision_;
    placed_ = placeScene(*loaded_.scene);
    rays_->follow(placed_);
    followSelection();
}

/// What is selected may have another number now, or be gone.
void Walkthrough::followSelection() {
    if (!selection_) return;
    const auto& objects = placed_.objects;
    const auto is = [&](const Object& object) { return object.path == selection_->objectPath; };
    ObjectId& object = selection_->object;
    if (object.value < objects.size() && is(objects[object.value])) return;
    const auto found = std::find_if(objects.begin(), objects.end(), is);
    if (found == objects.end())
        selection_.reset();
    else
        object.value = std::uint32_t(found - objects.begin());
}

void Walkthrough::followScene() {
    if (held_) held_.reset();
    changed();
    bookmarks_ = bookmarksOf(placed_, rig_.compass());
}

void Walkthrough::make(const EditHistory::Step& step) {
    if (held_) return; // one hand at a time
    history_.make(step, time_);
    changed();
}

void Walkthrough::place(const Selection& selection, const glm::dmat4& toWorld) {
    const glm::dmat4& now = placed_.objects[selection.object.value].toWorld;
    make({MoveEdit{selection.node, selection.node->matrix(),
                   matrixFor(*selection.node, now, toWorld)}});
}

/// The axis of the scene that comes nearest to what the camera calls right.
glm::dvec3 Walkthrough::besideCamera() const {
    const Compass& compass = rig_.compass();
    const glm::dvec3 right = rig_.pose().right(compass);
    const bool eastward = std::abs(glm::dot(right, compass.east)) > std::sqrt(0.5);
    const glm::dvec3 along = eastward ? compass.east : compass.north;
    return along * std::copysign(1.0, glm::dot(right, along));
}

/// Along the axis of the scene that comes nearest to what the camera calls that direction.
void Walkthrough::nudge(NudgeDirection way, double metres) {
    if (!selection_ || !selection_->node) return;
    const Compass& compass = rig_.compass();
    const glm::dvec3 aside = besideCamera();
    const glm::dvec3 ahead = glm::cross(compass.up, aside);
    const std::array<glm::dvec3, 6> ways{-aside, aside, -ahead, ahead, compass.up, -compass.up};
    const glm::dmat4& now = placed_.objects[selection_->object.value].toWorld;
    place(*selection_, shifted(now, metres * ways[std::size_t(way)]));
}

void Walkthrough::turnSelected(double angle) {
    if (!selection_ || !selection_->node) return;
    const glm::dmat4& now = placed_.objects[selection_->object.value].toWorld;
    place(*selection_, turned(now, glm::dvec3(now[3]), rig_.compass().up, angle));
}

void Walkthrough::brighten(double stops) {
    const float factor = float(std::exp2(stops));
    const bool all = !selection_ || !selection_->emits();
    EditHistory::Step step;
    for (const auto& light : all ? allLights(scene(), placed_) : selection_->lights)
        step.push_back(LightEdit{light, light->luminance(), light->luminance() * factor});
    if (step.empty() && !all) { // a surface that emits
        const Material& material = *selection_->material;
        const PaintEdit::Paint before{material.reflectance(), material.emission()};
        step.push_back(PaintEdit{
            selection_->material, before, {before.reflectance, before.emission * factor}});
    }
    make(step);
}

void Walkthrough::switchLights() {
    if (!selection_) return;
    EditHistory::Step step;
    for (const auto& light : selection_->lights) {
        const Rgb now = light->luminance();
        const bool on = maxChannel(now) > 0;
        if (on) switchedOff_[light.get()] = now;
        step.push_back(LightEdit{light, now, on ? Rgb() : switchedOff_[light.get()]});
    }
    make(step);
}

void Walkthrough::removeSelected(bool hides) {
    if (!selection_ || held_) return;
    if (const auto removal = removalOf(loaded_, *selection_, hides)) make({*removal});
    selection_.reset();
}

void Walkthrough::showHidden() {
    EditHistory::Step step;
    for (PresenceEdit edit : history_.hidden()) {
        std::swap(edit.before, edit.after);
        step.push_back(edit);
    }
    make(step);
}

/// Beside the thing, and selected, so that it can be put where it belongs.
void Walkthrough::duplicateSelected() {
    constexpr double kGap = 0.05; // [m]
    if (!selection_ || held_) return;
    const glm::dvec3 aside = besideCamera();
    const double width =
        glm::dot(glm::abs(aside), glm::dvec3(rays_->bounds(selection_->object).size()));
    const glm::dvec3 shift = (width + kGap) * aside;
    glm::dmat4 place = glm::translate(glm::dmat4(1.0), shift / loaded_.scene->metersPerUnit);
    if (selection_->node) {
        const glm::dmat4& now = placed_.objects[selection_->object.value].toWorld;
        place = matrixFor(*selection_->node, now, shifted(now, shift)) *
                glm::inverse(selection_->node->matrix());
    }
    const auto copy = duplicateOf(loaded_, *selection_, place);
    if (!copy) return;
    make({copy->edit});
    selection_->objectPath = selection_->path = copy->path;
    selection_->node = std::static_pointer_cast<Transform>(copy->edit.node);
    followSelection();
    if (selection_) selection_->lights = lightsOf(scene(), placed_, selection_->object);
}

void Walkthrough::perform(const Command& command) {
    if (!performOnCamera(command)) performOnScene(command);
}

/// \return whether the command is about the camera
bool Walkthrough::performOnCamera(const Command& command) {
    switch (command.action) {
    case Action::nextMode:
        rig_.setMode(CameraMode((int(rig_.mode()) + 1) % int(std::size(kCameraModeNames))));
        return true;
    case Action::gravity:
        rig_.options.gravity = !rig_.options.gravity;
        return true;
    case Action::collision:
        rig_.options.collision = !rig_.options.collision;
        return true;
    case Action::bookmark:
        if (std::size_t(command.number) <= bookmarks_.size())
            rig_.flyTo(bookmarks_[std::size_t(command.number) - 1]);
        return true;
    case Action::home:
        rig_.frame(placed_.bounds);
        return true;
    case Action::frame:
        if (selection_) rig_.frame(rays_->bounds(selection_->object));
        return true;
    default:
        return false;
    }
}

void Walkthrough::performOnScene(const Command& command) {
    constexpr double kStop = 1.0 / 3;
    switch (command.action) {
    case Action::cancel:
        if (held_)
            letGo(false);
        else
            selection_.reset();
        break;
    case Action::undo:
        if (!held_ && history_.undo()) changed();
        break;
    case Action::redo:
        if (!held_ && history_.redo()) changed();
        break;
    case Action::dimmer:
        brighten(-kStop);
        break;
    case Action::brighter:
        brighten(kStop);
        break;
    case Action::showHidden:
        showHidden();
        break;
    default:
        performOnSelection(command);
    }
}

void Walkthrough::performOnSelection(const Command& command) {
    constexpr double kTurnStep = 15 * std::numbers::pi / 180;
    switch (command.action) {
    case Action::nudge:
        nudge(NudgeDirection(command.number), command.more ? 0.1 : 0.01);
        break;
    case Action::turnLeft:
        turnSelected(kTurnStep);
        break;
    case Action::turnRight:
        turnSelected(-kTurnStep);
        break;
    case Action::switchLight:
        switchLights();
        break;
    case Action::remove:
        removeSelected(false);
        break;
    case Action::hide:
        removeSelected(true);
        break;
    case Action::duplicate:
        duplicateSelected();
        break;
    default:
        break;
    }
}

void Walkthrough::goTo(const std::string& cameraPath, const std::string& file) {
    const Bookmark& there = bookmarks_[cameraIndex(placed_, cameraPath, file)];
    rig_.put(there.pose, there.lens);
}

void Walkthrough::advance(double seconds) {
    time_ += seconds;
    rig_.advance(controls_.takeMotion(), seconds, *rays_);
}

bool Walkthrough::moving() const {
    const auto held = [&](const char* letters) {
        return std::any_of(letters, letters + std::char_traits<char>::length(letters),
                           [&](char letter) { return controls_.moves(letter); });
    };
    return rig_.moving() || held("WASDEQ");
}

} // namespace penumbra
