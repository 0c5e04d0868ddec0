#include "viewer/app/Viewer.h"

#include "base/Clock.h"
#include "base/Error.h"
#include "io/image/Exposure.h"
#include "io/image/PngWriter.h"
#include "radiosity/process/ProcessLink.h"
#include "radiosity/transport/LitLevel.h"
#include "scenegraph/Objects.h"
#include "viewer/app/EditsFile.h"
#include "viewer/app/FileWatcher.h"
#include "viewer/app/InteractiveRenderer.h"
#include "viewer/app/OverlayChoice.h"
#include "viewer/app/PictureCommands.h"
#include "viewer/app/PicturePace.h"
#include "viewer/app/PictureSaver.h"
#include "viewer/app/Replay.h"
#include "viewer/app/SessionFile.h"
#include "viewer/app/Signals.h"
#include "viewer/app/ViewerSettings.h"
#include "viewer/app/WalkLight.h"
#include "viewer/input/SceneLoader.h"
#include "viewer/input/Walkthrough.h"
#include "viewer/input/Window.h"
#include "viewer/panels/GuiLayer.h"
#include "viewer/panels/PanelState.h"
#include "viewer/panels/Panels.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

namespace penumbra {

namespace {

constexpr double kLongestStep = 0.1;   // after a stall things don't jump further than this [s]
constexpr double kIdlePoll = 1.0 / 60; // how long a picture that does not change is kept [s]
constexpr double kPreviewSlice = 0.08; // of a frame, for rays of what moves [s]

using Clock = std::chrono::steady_clock;

class Viewer {
public:
    explicit Viewer(const ViewerOptions& options);
    ~Viewer();
    Viewer(const Viewer&) = delete;
    Viewer& operator=(const Viewer&) = delete;

    void run();

private:
    void takeEvents();
    void perform(const Command& command);
    void doAsAsked();
    LoadOptions loadOptions(std::optional<double> frame) const {
        return {.time = frame, .allowOutside = options_.allowOutside};
    }
    void takeScene();
    void openScene(ReadyScene ready);
    void lightScene();
    void reload();
    void readAgain();
    void leaveFor(const Departure& next);
    void goTo(const Departure& next);
    bool saveChanges();
    void openFile(const std::string& file);
    void takeOver();
    void advance(double seconds);
    void draw();
    void drawPanelsOver();
    void save(const View& view);
    void showTitle();
    bool changing() const;
    bool due() const;

    const ViewerOptions& options_;
    std::string scene_, name_; ///< path of the scene's file, and its name
    ViewerSettings settings_;
    Signals signals_; // before any thread
    std::optional<SceneLoader> loader_;
    LightRequest fromFile_; ///< settings of the light, where nobody else asks
    Window window_;
    const bool software_;
    PicturePace pace_;
    InteractiveRenderer renderer_;
    Renderer stills_;
    PanelState state_;
    std::optional<Walkthrough> walk_;
    std::optional<WalkLight> light_;
    std::optional<Replay> replay_;
    std::optional<SessionFile> session_;
    FileWatcher watcher_;
    UnlitLighting preview_;
    std::uint64_t previewOf_ = 0; ///< revision of the walkthrough
    Group nothing_{""};
    std::optional<GuiLayer> gui_; // after what it draws over
    std::string title_;
    double highestPriority_ = 0; ///< in the dirty set, since it is shown
    bool shown_ = false; ///< the scene, before it is lit: its light costs some time to ask for
    double drawn_ = 0;   ///< when the last picture was begun, steady clock [s]
    bool quit_ = false;
};

Viewer::Viewer(const ViewerOptions& options)
    : options_(options), scene_(options.scene),
      name_(std::filesystem::path(options.scene).filename().string()), settings_(loadSettings()),
      loader_(std::in_place, options.scene, loadOptions(options.frame)),
      window_({.width = settings_.width,
               .height = settings_.height,
               .title = name_ + " (loading) - Penumbra",
               .vsync = options.vsync}),
      software_(window_.drawnInSoftware()), pace_(software_),
      renderer_({.samples = options.samples > 0 ? options.samples : (software_ ? 1 : 4),
                 .compressed = !software_,
                 .gradual = true}) {
    gui_.emplace(window_);
    state_.sceneName = name_;
    state_.scenePath = scene_;
    state_.recent = settings_.recent;
    state_.renderer = window_.renderer();
    state_.tone = options.tone.value_or(settings_.tone);
    state_.showPanels = settings_.panels;
    state_.trigger = settings_.trigger;
    if (options.exposure)
        state_.exposure.fix(middleGreyAt(*options.exposure));
    else
        state_.exposure.setCompensation(settings_.compensation);
    state_.patchSize = float(options.asked.patchSize.value_or(0));
    state_.elementSize = float(options.asked.elementSize.value_or(0));
}

Viewer::~Viewer() {
    if (!window_.fullScreen() && window_.visible()) {
        settings_.width = int(float(window_.size().x) / window_.contentScale());
        settings_.height = int(float(window_.size().y) / window_.contentScale());
    }
    if (!options_.tone) settings_.tone = state_.tone; // what was asked for once is not remembered
    settings_.panels = state_.showPanels;
    if (state_.trigger != fromFile_.trigger) settings_.trigger = state_.trigger;
    if (!options_.exposure) settings_.compensation = state_.exposure.compensation();
    if (walk_) {
        settings_.walkSpeed = walk_->rig().options.speed;
        settings_.eyeHeight = walk_->rig().options.eyeHeight;
        settings_.gravity = walk_->rig().options.gravity;
        settings_.collision = walk_->rig().options.collision;
        settings_.sensitivity = walk_->controls().sensitivity;
    }
    saveSettings(settings_);
}

/// The scene, when it has been read; a fault in it ends the program only if there is no other.
void Viewer::takeScene() {
    if (!loader_) return;
    try {
        auto ready = loader_->take();
        if (ready && loader_->file() != scene_) takeOver();
        if (ready) openScene(std::move(*ready));
        if (!loader_->busy()) loader_.reset();
    } catch (const Error& error) {
        loader_.reset();
        if (!light_) throw; // nothing to go on with
        state_.notify(error.what(), 20);
    }
}

/// Leaves the scene for another one, which has been read.
void Viewer::takeOver() {
    if (session_) session_->finish();
    session_.reset();
    replay_.reset();
    light_.reset();
    state_.walk = nullptr;
    walk_.reset();
    scene_ = loader_->file();
    name_ = std::filesystem::path(scene_).filename().string();
    state_.sceneName = name_;
    state_.scenePath = scene_;
    state_.light = {};
    state_.certificates = {};
    state_.patchSize = state_.elementSize = 0; // those were of the other scene
}

void Viewer::openScene(ReadyScene ready) {
    const bool again = walk_.has_value();
    const bool first = !again && scene_ == options_.scene;
    std::optional<CameraRig> before;
    if (again) before = walk_->rig();
    light_.reset();
    replay_.reset();
    if (first && options_.opened) options_.opened(ready.loaded.files);
    if (first && options_.reported)
        options_.reported(ready.loaded.diagnostics);
    else if (!again && !ready.loaded.diagnostics.empty())
        state_.notify(summary(ready.loaded.diagnostics), 15);
    addRecent(settings_, scene_);
    state_.recent = settings_.recent;
    watcher_ = FileWatcher(ready.loaded.files);
    fromFile_ = ready.settings;
    walk_.emplace(std::move(ready));
    shown_ = false;
    previewOf_ = 0;
    CameraRig& rig = walk_->rig();
    if (before)
        rig = *before;
    else
        rig.options = {.speed = settings_.walkSpeed,
                       .gravity = settings_.gravity,
                       .collision = settings_.collision,
                       .eyeHeight = settings_.eyeHeight};
    walk_->controls().sensitivity = settings_.sensitivity;
    if (first && !options_.camera.empty()) walk_->goTo(options_.camera, scene_);
    state_.walk = &*walk_;
    if (walk_->loaded().animation) replay_.emplace(*walk_, options_.replay && first);
    state_.hasAnimation = replay_.has_value();
    if (first && !options_.record.empty()) session_.emplace(*walk_, scene_, options_.record);
    state_.recording = session_.has_value();
    if (!again) {
        const RadiosityOptions how = optionsFor(options_.asked.orElse(fromFile_));
        state_.policy = how.solving.policy;
        if (fromFile_.trigger) state_.trigger = *fromFile_.trigger;
    }
    lightScene();
    pace_.changed();
}

void Viewer::lightScene() {
    LightRequest asked{
        .residual = options_.asked.residual, .trigger = state_.trigger, .policy = state_.policy};
    if (state_.patchSize > 0) asked.patchSize = state_.patchSize;
    if (state_.elementSize > 0) asked.elementSize = state_.elementSize;
    const RadiosityOptions how = optionsFor(asked.orElse(fromFile_), options_.light);
    light_.reset();
    light_.emplace(*walk_, how, makeProcessLink({.program = options_.worker, .byHand = {}}),
                   BlendOptions{.software = software_, .slice = kPreviewSlice});
}

void Viewer::reload() {
    if (loader_) return;
    if (session_)
        state_.notify("The file is not read again while a session is being recorded");
    else
        leaveFor({Departure::To::itselfAgain});
}

void Viewer::readAgain() {
    loader_.emplace(scene_, loadOptions(scene_ == options_.scene ? options_.frame : std::nullopt));
    state_.notify("Reading " + name_ + " again");
}

/// Goes there, unless edits would be lost: then people are asked. A recording has them.
void Viewer::leaveFor(const Departure& next) {
    if (loader_ && next.to != Departure::To::nothing) {
        state_.notify("Another scene is still being read");
        return;
    }
    pace_.changed();
    if (state_.leave.ask(next, walk_ && !session_ && walk_->history().edited())) goTo(next);
}

void Viewer::goTo(const Departure& next) {
    if (next.to == Departure::To::another) openFile(next.file);
    if (next.to == Departure::To::itselfAgain) readAgain();
    if (next.to == Departure::To::nothing) quit_ = true;
}

/// \return whether the edits are in a file
bool Viewer::saveChanges() {
    const std::string layer = freeEditsName(std::filesystem::path(name_).stem().string());
    try {
        for (const std::string& name : saveEdits(walk_->loaded(), scene_, walk_->history(), layer))
            state_.notify("What was done to '" + name + "' can't be saved", 15);
        state_.notify("Saved " + layer, 15);
        return true;
    } catch (const Error& error) {
        state_.notify(error.what(), 20);
        return false;
    }
}

/// This scene stays until the other one has been read, or if it can't be.
void Viewer::openFile(const std::string& file) {
    loader_.emplace(file, loadOptions(std::nullopt));
    state_.notify("Reading " + file);
}

void Viewer::perform(const Command& command) {
    if (performOnPicture(command, state_)) return;
    switch (command.action) {
    case Action::quit:
        leaveFor({Departure::To::nothing});
        break;
    case Action::fullScreen:
        window_.setFullScreen(!window_.fullScreen());
        break;
    case Action::update:
        state_.wantsUpdate = true;
        break;
    case Action::save:
        state_.wantsSave = true;
        break;
    case Action::reload:
        state_.wantsReload = true;
        break;
    case Action::open:
        state_.showOpen = !state_.showOpen;
        break;
    case Action::play:
        if (replay_)
            replay_->toggle(*walk_);
        else
            state_.notify("The file has no animation");
        break;
    default:
        if (walk_) walk_->perform(command);
    }
}

/// What panels and keys asked for.
void Viewer::doAsAsked() {
    if (std::exchange(state_.wantsUpdate, false) && light_) light_->requestUpdate();
    if (window_.takeClosing()) leaveFor({Departure::To::nothing});
    if (std::exchange(state_.wantsReload, false)) reload();
    if (const std::string file = std::exchange(state_.wantsOpen, {}); !file.empty())
        leaveFor({Departure::To::another, file});
    if (const auto answer = std::exchange(state_.leaveAnswer, std::nullopt)) {
        if (const auto next = state_.leave.answer(*answer, [&] { return saveChanges(); }))
            goTo(*next);
    }
    if (std::exchange(state_.wantsRestart, false) && walk_) lightScene();
    if (light_) light_->setTrigger(state_.trigger);
    if (light_) light_->setPolicy(state_.policy);
    if (light_) light_->watchDirty(watchesDirty(state_.overlay));
    if (state_.overlay != Overlay::importance) highestPriority_ = 0;
}

void Viewer::takeEvents() {
    for (const InputEvent& event : window_.takeEvents()) {
        pace_.touched(steadySeconds());
        const auto* const stroke = std::get_if<KeyEvent>(&event);
        const auto* const button = std::get_if<ButtonEvent>(&event);
        const bool lets = (stroke && !stroke->down) || (button && !button->down);
        const bool typed = stroke || std::holds_alternative<TextEvent>(event);
        if (!lets && typed && gui_->wantsKeyboard()) continue;
        const bool pointed = button || std::holds_alternative<ScrollEvent>(event);
        if (!lets && pointed && gui_->wantsPointer()) continue;
        if (const auto* const drop = std::get_if<DropEvent>(&event)) {
            state_.wantsOpen = drop->files.front();
            if (drop->files.size() > 1) state_.notify("One scene at a time: the first is opened");
        }
        if (const auto command = commandOf(event)) perform(*command);
        if (walk_) walk_->take(event, window_.pixels());
    }
    const bool held = walk_ && walk_->wantsPointer();
    if (held != window_.pointerCaptured()) window_.capturePointer(held);
}

bool Viewer::changing() const {
    return (walk_ && walk_->moving()) || (replay_ && replay_->playing()) || gui_->busy() ||
           (light_ && overlayChanging(state_.overlay, *walk_, *light_));
}

/// Whether a picture is to be drawn now.
bool Viewer::due() const {
    return changing() || pace_.due(steadySeconds());
}

/// What the window shows, but for the panels, as PNG; with all layers as EXR, once there is light.
void Viewer::save(const View& view) {
    const std::string stem = freeStem(std::filesystem::path(name_).stem().string());
    const float grey = state_.exposure.middleGrey();
    try {
        const DisplayedPicture picture = renderer_.displayed(grey, state_.tone);
        writePngBytes(stem + ".png", picture.width, picture.height, picture.bytes);
        const bool lit = light_ && light_->state().blocksTaken > 0;
        if (lit)
            saveLayers(stem + ".exr", name_, stills_, light_->lit(), view,
                       {picture.width, picture.height});
        const bool whole = lit && light_->state().reached(SolutionState::certified);
        state_.notify("Saved " + stem + (lit ? ".png and .exr" : ".png") +
                      describeExposure(grey, state_.tone) +
                      (whole ? "" : ", while the light is being worked on"));
    } catch (const Error& error) {
        state_.notify(error.what(), 15);
    }
}

void Viewer::advance(double seconds) {
    state_.time += seconds;
    if (!walk_) return;
    if (replay_) replay_->advance(*walk_, seconds);
    state_.playing = replay_ && replay_->playing();
    walk_->advance(seconds);
    if (session_)
        if (const auto why = session_->take(*walk_)) state_.notify(*why + "; tried again", 10);
    const glm::ivec2 size = glm::max(window_.pixels(), glm::ivec2(1));
    if (shown_ && light_->update(*walk_, walk_->rig().view(size.x, size.y))) pace_.news();
    if (light_->fading()) pace_.fades(steadySeconds());
    for (std::string& message : light_->takeMessages()) state_.notify(std::move(message), 15);
    state_.light = light_->state();
    if (std::exchange(previewOf_, walk_->revision()) != walk_->revision()) {
        if (shown_)
            pace_.touched(steadySeconds()); // or undone, or played
        else
            pace_.changed();
        state_.noLights = light_->dark();
        if (state_.noLights || !light_->complete()) preview_ = unlitLighting(walk_->placed());
    }
    if (watcher_.changed(state_.time)) reload();
}

/// The title says what the window is busy with, also to those who have it in the background.
void Viewer::showTitle() {
    using Phase = RadiosityState::Phase;
    const Phase phase = state_.light.phase;
    const bool done = walk_ && state_.light.queued == 0 &&
                      (state_.light.reached(SolutionState::certified) || phase == Phase::off ||
                       phase == Phase::failed);
    const char* const busy = !walk_ ? " (loading)" : done ? "" : " (lighting)";
    if (std::exchange(title_, name_ + busy + " - Penumbra") != name_ + busy + " - Penumbra")
        window_.setTitle(title_);
}

void Viewer::drawPanelsOver() {
    gui_->begin();
    drawSelectionBox(state_);
    drawPanels(state_);
    drawLegend(state_);
    drawStatusLine(state_);
    drawOpen(state_);
    drawLeave(state_);
    drawHelp(state_);
    gui_->end();
}

void Viewer::draw() {
    const double began = steadySeconds();
    const glm::ivec2 size = window_.pixels();
    const View view = walk_ ? walk_->rig().view(size.x, size.y) : View{};
    const Frustum frustum(view.worldToClip());
    const bool saving = std::exchange(state_.wantsSave, false);
    OverlayView overlay;
    if (light_) {
        const bool ranked = state_.policy == PolicyKind::importance;
        overlay = overlayView(state_.overlay, *walk_, *light_, size, ranked, highestPriority_);
    }
    state_.legend = std::move(overlay.legend);
    renderer_.setOverlay(std::move(overlay.picture));
    const DrawList visible = light_ ? light_->listVisible(frustum) : listVisible(nothing_, frustum);
    renderer_.drawScene(visible, view, preview_, size.x, size.y, light_ ? light_->maps() : nullptr);
    if (saving && renderer_.statistics().blurred) {
        renderer_.finishTextures();
        renderer_.drawScene(visible, view, preview_, size.x, size.y,
                            light_ ? light_->maps() : nullptr);
    }
    if (const auto luminances = renderer_.luminances(!state_.exposure.measured() && walk_))
        state_.exposure.measure(*luminances);
    const double passed = std::min(kLongestStep, began - std::exchange(drawn_, began));
    state_.exposure.advance(passed, light_ && light_->fading());
    state_.drawn = renderer_.statistics();
    if (saving) save(view);
    renderer_.show(0, state_.exposure.middleGrey(), state_.tone);
    drawPanelsOver();
    window_.show();
    if (pace_.measures(began)) window_.finish();
    pace_.drawn(steadySeconds(), steadySeconds() - began);
    if (renderer_.statistics().blurred || !state_.exposure.settled()) pace_.news(1);
    shown_ = shown_ || walk_;
}

void Viewer::run() {
    Clock::time_point last = Clock::now();
    double sinceCertificate = 0;
    while (!quit_ && !signals_.endWanted()) {
        const bool blurred = renderer_.statistics().blurred;
        window_.poll(due() || blurred ? 0 : kIdlePoll);
        takeEvents();
        takeScene();
        doAsAsked();
        const Clock::time_point now = Clock::now();
        const double passed = std::chrono::duration<double>(now - last).count();
        last = now;
        advance(std::min(kLongestStep, passed));
        sinceCertificate += passed;
        if (state_.light.litIlluminance > 0 && sinceCertificate > 0.25) {
            const double share =
                certificateOfLit(state_.light.certificate, state_.light.litIlluminance);
            state_.certificates.add(float(std::log10(std::max(share, 1e-6))));
            sinceCertificate = 0;
        }
        showTitle();
        if (blurred && !due()) renderer_.sharpenTextures();
        if (!window_.visible() || !due()) continue;
        state_.frameMilliseconds.add(float(1000 * passed));
        draw();
    }
    if (session_) session_->finish();
}

} // namespace

void runViewer(const ViewerOptions& options) {
    Viewer(options).run();
}

} // namespace penumbra
