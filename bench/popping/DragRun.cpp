#include "DragRun.h"

#include "LoadScene.h"

#include "base/Error.h"
#include "io/image/AutoExposure.h"
#include "io/usd/scene/UsdScene.h"
#include "radiosity/process/LightingLink.h"
#include "scenegraph/Transform.h"
#include "viewer/app/InteractiveRenderer.h"
#include "viewer/app/WalkLight.h"
#include "viewer/gl/OffscreenContext.h"
#include "viewer/input/Walkthrough.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <thread>

namespace penumbra {

namespace {

constexpr double kFrame = 1.0 / 60;
constexpr float kShownGrey = 18; // nits that middle grey has on a display of 100

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

class Run {
public:
    Run(const DragScript& script, const DragOptions& options)
        : script_(script), options_(options), walk_(loadScene(script.scene)),
          renderer_({.samples = 1, .precision = HdrTarget::Precision::single}) {
        if (!script.camera.empty()) walk_.goTo(script.camera, script.scene);
        makeLight();
        for (const auto& place : walk_.loaded().addresses.transforms)
            if (place.prim == script.object) thing_ = place.node;
        if (!thing_) throw Error(script.scene + ": there is no '" + script.object + "' to move");
        start_ = thing_->matrix();
    }

    DragResult play() {
        result_.card = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
        settle();
        for (const auto& object : light_->node().objects())
            if (object.geometry) result_.elements += object.geometry->data().indices.size() / 6;
        measureExposure();
        select();
        settle();
        walk();
        for (int i = 0; i < script_.idle; ++i) frame(&result_.idle);
        result_.grabbed = result_.frames.size();
        light_->node().grab(*thing_);
        for (int i = 0; i < script_.held; ++i) frame();
        result_.moved = result_.frames.size();
        drag();
        result_.released = result_.frames.size();
        light_->node().release(*thing_);
        const Clock::time_point released = Clock::now();
        for (int i = 0; i < script_.after; ++i) {
            frame();
            follow(since(released));
        }
        result_.realSeconds = since(released);
        for (int i = 0; i < 1000 && !settled(); ++i) { // longer than the script
            frame();
            result_.frames.pop_back();
            poses_.pop_back();
            follow(since(released));
        }
        settle();
        exact();
        result_.worstAtStart = nameWorst(result_.moved - 1, result_.moved + 2);
        if (options_.motion) result_.worstInMotion = nameWorst(result_.moved, result_.released);
        result_.worstAtHandOver = nameWorst(result_.released - 1, result_.frames.size());
        compareFromScratch();
        return std::move(result_);
    }

private:
    void makeLight() {
        RadiosityOptions light = optionsFor(walk_.loaded().asked);
        light.meshing.elementSize = options_.elementSize;
        light.trigger = Trigger::implicit;
        light.solving.directOnly = !options_.indirect;
        light_ = std::make_unique<WalkLight>(walk_, light, makeThreadLink(), options_.blend);
    }
    View view() const { return walk_.rig().view(options_.size.x, options_.size.y); }

    bool settled(SolutionState wanted = SolutionState::certified) const {
        const RadiosityState& state = light_->state();
        return state.reached(wanted) && state.queued == 0 && state.held == 0;
    }
    /// Until nothing is deferred any more either: yardsticks are exact.
    void settle() {
        for (int still = 0; still < 5;) {
            walk_.advance(kFrame);
            const bool news = light_->update(walk_, view());
            if (light_->state().phase == RadiosityState::Phase::failed)
                throw Error(script_.scene + ": its light could not be computed");
            still = news || !settled(SolutionState::exact) ? 0 : still + 1;
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
    }
    void draw(const DrawList& list, MapPreview* maps = nullptr) {
        renderer_.drawScene(list, view(), {}, options_.size.x, options_.size.y, maps);
    }
    std::vector<float> drawn() {
        std::vector<float> luminances;
        for (const Rgb& pixel : renderer_.readLuminances()) luminances.push_back(luminance(pixel));
        return luminances;
    }
    std::vector<float> drawnAtRest() {
        draw(listVisible(light_->lit(), Frustum(view().worldToClip())));
        return drawn();
    }
    /// \param matrix where the thing is put; null: it stays
    void frame(FrameTimes* times = nullptr, const glm::dmat4* matrix = nullptr) {
        const Clock::time_point begin = Clock::now();
        const std::clock_t worked = std::clock();
        if (matrix) {
            thing_->setMatrix(*matrix);
            walk_.followScene();
        }
        walk_.advance(kFrame);
        light_->update(walk_, view());
        const Frustum frustum(view().worldToClip());
        draw(light_->listVisible(frustum), light_->maps());
        glFinish();
        if (times) times->add(since(begin), double(std::clock() - worked) / CLOCKS_PER_SEC);
        result_.frames.push_back({drawn(), {}});
        result_.lights = std::max(result_.lights, light_->lightsPreviewed());
        poses_.push_back(thing_->matrix());
        std::this_thread::sleep_until(begin + std::chrono::duration<double>(kFrame));
    }
    void drag() {
        for (int i = 1; i <= script_.drag; ++i) {
            const double s = double(i) / script_.drag;
            glm::dmat4 matrix = start_;
            matrix[3] += glm::dvec4(s * s * (3 - 2 * s) * script_.way, 0);
            frame(&result_.motion, &matrix);
            result_.dragBytes += double(renderer_.statistics().lightBytes) / script_.drag;
        }
    }
    /// Looks aside and back.
    void walk() {
        const CameraPose pose = walk_.rig().pose();
        for (int i = 0; i < script_.walk; ++i) {
            CameraPose turned = pose;
            turned.heading += 0.01 * (i + 1);
            walk_.rig().put(turned, walk_.rig().lens());
            frame(&result_.turning);
        }
        walk_.rig().put(pose, walk_.rig().lens());
        result_.frames.clear();
        poses_.clear();
    }
    /// As the tone curve's linear part shows it, in 8 bits.
    int displayedByte(float nits) const {
        const double shown = std::clamp(double(nits) * result_.toDisplay / 100, 0.0, 1.0);
        return int(std::lround(255 * std::pow(shown, 1 / 2.2)));
    }
    void compareFromScratch() {
        draw(light_->listVisible(Frustum(view().worldToClip())), light_->maps());
        const std::vector<float> after = drawn();
        light_.reset();
        makeLight();
        settle();
        const std::vector<float> anew = drawnAtRest();
        for (std::size_t p = 0; p < after.size(); ++p) {
            const int steps = std::abs(displayedByte(after[p]) - displayedByte(anew[p]));
            result_.fromScratchMost = std::max(result_.fromScratchMost, steps);
            result_.fromScratchBeyond += (steps > 1) / double(after.size());
        }
    }
    /// Notes when there is nothing any more to be waited for, and when all is at rest.
    void follow(double seconds) {
        result_.bytesAfter += double(renderer_.statistics().lightBytes);
        if (light_->waiting()) result_.readySeconds = seconds;
        if (!settled() || light_->fading()) result_.settledSeconds = seconds;
    }
    void select() {
        const PlacedScene& placed = walk_.placed();
        for (std::uint32_t o = 0; o < placed.objects.size(); ++o)
            if (placed.objects[o].path.ends_with(thing_->name()))
                walk_.select(Selection{
                    ObjectId{o}, placed.objects[o].path, {}, {}, {}, thing_, nullptr, {}});
        if (!walk_.selection()) throw Error("nothing is at '" + script_.object + "'");
    }
    void measureExposure() {
        frame();
        result_.frames.clear();
        poses_.clear();
        AutoExposure exposure;
        if (const auto seen = renderer_.luminances(true)) exposure.measure(*seen);
        result_.toDisplay = kShownGrey / exposure.middleGrey();
    }
    /// The settled light of every pose, drawn at rest.
    void exact() {
        std::vector<float> picture;
        glm::dmat4 poseOf(0);
        for (std::size_t i = 0; i < poses_.size(); ++i) {
            const bool between = i > result_.moved + 1 && i + 1 < result_.released;
            if (between && !options_.motion) continue;
            if (picture.empty() || poses_[i] != poseOf) {
                poseOf = poses_[i];
                thing_->setMatrix(poses_[i]);
                walk_.followScene();
                settle();
                picture = drawnAtRest();
            }
            result_.frames[i].exact = picture;
        }
    }

    /// The largest steps of a run of frames, and what is seen there; the camera has not moved.
    std::vector<NamedStep> nameWorst(std::size_t first, std::size_t end) {
        std::vector<NamedStep> named;
        const auto frames = std::span(result_.frames).subspan(first, end - first);
        for (PixelStep step : worstSteps(frames, result_.toDisplay, options_.named)) {
            step.frame += first;
            named.push_back({step, "nothing", {}});
            thing_->setMatrix(poses_[step.frame]);
            walk_.followScene();
            const auto x = int(step.pixel % std::size_t(options_.size.x));
            const auto y = int(step.pixel / std::size_t(options_.size.x));
            const glm::dvec2 at = (glm::dvec2(x, y) + 0.5) / glm::dvec2(options_.size) * 2.0 - 1.0;
            const glm::dmat4 back = glm::inverse(view().worldToClip());
            const glm::dvec4 ahead = back * glm::dvec4(at, 0.5, 1);
            const glm::dvec3 from = walk_.rig().pose().eye;
            const auto touch = walk_.rays().touch(from, glm::dvec3(ahead) / ahead.w - from, 1e9);
            if (!touch) continue;
            named.back().object = touch->path;
            named.back().position = touch->position;
        }
        return named;
    }

    const DragScript& script_;
    const DragOptions& options_;
    OffscreenContext context_;
    Walkthrough walk_;
    InteractiveRenderer renderer_;
    std::unique_ptr<WalkLight> light_;
    std::shared_ptr<Transform> thing_;
    glm::dmat4 start_{1.0};
    std::vector<glm::dmat4> poses_;
    DragResult result_;
};

} // namespace

DragResult runDrag(const DragScript& script, const DragOptions& options) {
    return Run(script, options).play();
}

} // namespace penumbra
