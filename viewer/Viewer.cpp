#include "viewer/Viewer.h"

#include "viewer/AutoExposure.h"
#include "viewer/InteractiveRenderer.h"
#include "viewer/SceneLoader.h"
#include "viewer/Signals.h"
#include "viewer/Walkthrough.h"
#include "viewer/Window.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <optional>

namespace penumbra {

namespace {

constexpr double kLongestStep = 0.1;   // after a stall things don't jump further than this [s]
constexpr double kIdlePoll = 1.0 / 60; // how long a picture that does not change is kept [s]

using Clock = std::chrono::steady_clock;

/// Pictures by the processor: what costs little on a graphics card counts there.
bool drawnInSoftware(const Window& window) {
    const std::string name = window.renderer();
    return name.find("llvmpipe") != name.npos || name.find("softpipe") != name.npos ||
           name.find("SwiftShader") != name.npos;
}

class Viewer {
public:
    explicit Viewer(const ViewerOptions& options)
        : options_(options), name_(std::filesystem::path(options.scene).filename().string()),
          loader_(options.scene),
          window_({.title = name_ + " (loading) - Penumbra", .vsync = options.vsync}),
          renderer_({.samples = options.samples > 0 ? options.samples
                                                    : (drawnInSoftware(window_) ? 1 : 4)}) {}

    void run();

private:
    void takeEvents();
    void perform(const Command& command);
    void openScene(ReadyScene ready);
    void draw(double seconds);
    bool changing() const;

    const ViewerOptions& options_;
    std::string name_;
    Signals signals_; // before any thread
    SceneLoader loader_;
    Window window_;
    InteractiveRenderer renderer_;
    AutoExposure exposure_;
    ToneStyle tone_ = ToneStyle::agx;
    std::optional<Walkthrough> walk_;
    PreviewLighting preview_;
    Group nothing_{""};
    bool quit_ = false;
    int stale_ = 2; ///< frames that are to be drawn whether anything changes or not
};

void Viewer::openScene(ReadyScene ready) {
    preview_ = previewLighting(ready.placed);
    walk_.emplace(std::move(ready));
    window_.setTitle(name_ + " - Penumbra");
    stale_ = 2;
}

void Viewer::perform(const Command& command) {
    constexpr float kStop = 1.0f / 3;
    switch (command.action) {
    case Action::quit:
        quit_ = true;
        break;
    case Action::fullScreen:
        window_.setFullScreen(!window_.fullScreen());
        break;
    case Action::brighterView:
        exposure_.setCompensation(exposure_.compensation() + kStop);
        break;
    case Action::darkerView:
        exposure_.setCompensation(exposure_.compensation() - kStop);
        break;
    case Action::autoExposure:
        exposure_.fix(exposure_.automatic() ? std::optional(exposure_.uncompensated())
                                            : std::nullopt);
        break;
    case Action::nextTone:
        tone_ = ToneStyle((int(tone_) + 1) % int(kToneStyleNames.size()));
        break;
    default:
        if (walk_) walk_->perform(command);
    }
}

void Viewer::takeEvents() {
    for (const InputEvent& event : window_.takeEvents()) {
        stale_ = 2;
        if (const auto command = commandOf(event)) perform(*command);
        if (walk_) walk_->take(event, window_.pixels());
    }
    const bool held = walk_ && walk_->wantsPointer();
    if (held != window_.pointerCaptured()) window_.capturePointer(held);
}

bool Viewer::changing() const {
    return stale_ > 0 || !exposure_.settled() || (walk_ && walk_->moving());
}

void Viewer::draw(double seconds) {
    const glm::ivec2 size = window_.pixels();
    const Group& root = walk_ ? *walk_->scene().root : nothing_;
    const View view = walk_ ? walk_->rig().view(size.x, size.y) : View{};
    renderer_.drawScene(root, view, preview_, size.x, size.y);
    if (const auto luminances = renderer_.luminances(!exposure_.measured() && walk_))
        exposure_.measure(*luminances);
    exposure_.advance(seconds);
    renderer_.show(0, exposure_.middleGrey(), tone_);
    window_.swap();
    stale_ = std::max(0, stale_ - 1);
}

void Viewer::run() {
    Clock::time_point last = Clock::now();
    while (!quit_ && !window_.closing() && !signals_.endWanted()) {
        window_.poll(changing() ? 0 : kIdlePoll);
        takeEvents();
        if (auto ready = loader_.take()) openScene(std::move(*ready));
        const Clock::time_point now = Clock::now();
        const double seconds =
            std::min(kLongestStep, std::chrono::duration<double>(now - last).count());
        last = now;
        if (walk_) walk_->advance(seconds);
        if (window_.visible() && changing()) draw(seconds);
    }
}

} // namespace

void runViewer(const ViewerOptions& options) {
    Viewer(options).run();
}

} // namespace penumbra
