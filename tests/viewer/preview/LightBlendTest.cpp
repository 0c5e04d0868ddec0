// From published light to the light on the screen, with the node's real worker.
#include "viewer/preview/LightBlend.h"

#include "tests/viewer/preview/PreviewScenes.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

namespace penumbra {

namespace {

constexpr int kSize = 96;
constexpr double kStep = 1.0 / 60;

/// A room, its light, and the screen.
class Screen {
public:
    explicit Screen(const RadiosityOptions& light = options()) : room(light) {}
    static RadiosityOptions options() {
        RadiosityOptions options = fineRoom();
        options.meshing = {.patchSize = 0.8f, .elementSize = 0.2f};
        options.solving.samples = 16;
        options.trigger = Trigger::implicit;
        options.solving.directOnly = true;
        return options;
    }
    RadiosityNode& node() { return *room.room.node; }

    std::vector<Rgb> frame() {
        time += kStep;
        node().update();
        blend.advance(node(), time);
        const View view = PreviewRoom::viewInside(kSize);
        DrawList list = listVisible(node().lit(), Frustum(view.worldToClip()));
        for (DrawItem& item : list.items) item.shown = blend.shown(*item.geometry);
        maps.update(blend.preview(), nullptr, nullptr);
        renderer.drawScene(list, view, {}, kSize, kSize, &maps);
        return renderer.readLuminances();
    }
    /// What is to be seen in the end: the published light, without fade or previewed lights.
    std::vector<Rgb> published() {
        const View view = PreviewRoom::viewInside(kSize);
        renderer.drawScene(listVisible(node().lit(), Frustum(view.worldToClip())), view, {}, kSize,
                           kSize);
        return renderer.readLuminances();
    }
    bool rest() {
        for (int i = 0; i < 5000; ++i) {
            time += kStep;
            node().update();
            blend.advance(node(), time);
            const RadiosityState& state = node().state();
            if (state.reached(SolutionState::certified) && state.queued == 0 && state.dirtyMarked &&
                !blend.changing() && !blend.waiting() && !blend.preview().active())
                return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        return false;
    }
    bool begin() {
        if (!rest()) return false;
        blend.want({"/lamp/light"});
        return rest();
    }
    void take(double x) {
        room.room.box->setMatrix(glm::translate(glm::dmat4(1.0), glm::dvec3(x, 0.3, 0.3)));
    }

    PreviewRoom room;
    LightBlend blend;
    InteractiveRenderer renderer{{.samples = 1, .precision = HdrTarget::Precision::single}};
    MapPreview maps;
    double time = 0;
};

float largestStep(const std::vector<Rgb>& a, const std::vector<Rgb>& b) {
    float most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i].r - b[i].r));
    return most;
}

class LightBlendTest : public WithContext {};

TEST_F(LightBlendTest, ADraggedThingIsDrawnLiveAndItsLightStaysUntilItIsLetGo) {
    Screen screen;
    ASSERT_TRUE(screen.begin());
    screen.node().grab(*screen.room.room.box);
    const std::vector<Rgb> before = screen.frame();
    EXPECT_LT(largestStep(screen.frame(), before), 1e-5f);
    screen.take(0.4);
    screen.frame();
    EXPECT_TRUE(screen.blend.preview().active()) << "in the frame in which it moves";
    EXPECT_TRUE(screen.blend.fading());
    screen.node().release(*screen.room.room.box);
    ASSERT_TRUE(screen.rest());
    EXPECT_FALSE(screen.blend.preview().active());
}

TEST_F(LightBlendTest, TheHandOverIsAFadeWithoutStepsThatEndsAtTheSolution) {
    Screen screen;
    ASSERT_TRUE(screen.begin());
    screen.node().grab(*screen.room.room.box);
    for (int i = 1; i <= 5; ++i) screen.take(0.1 * i), screen.frame();
    std::vector<std::vector<Rgb>> frames{screen.frame()};
    screen.node().release(*screen.room.room.box);
    for (int i = 0; i < 3000 && (i < 30 || screen.blend.changing() || screen.blend.waiting() ||
                                 screen.blend.preview().active());
         ++i) {
        frames.push_back(screen.frame());
        if (largestStep(frames.back(), frames[frames.size() - 2]) == 0) { // nothing new
            frames.pop_back();
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
    }
    const std::vector<Rgb> exact = screen.published();
    EXPECT_LT(largestStep(screen.frame(), exact), 1e-5f);
    // A pixel goes straight from what was previewed to the solution, as smoothstep goes: 1.5 times
    // the mean speed at most, and no way that it has to go back.
    for (std::size_t p = 0; p < exact.size(); ++p) {
        const float whole = std::abs(exact[p].r - frames[0][p].r);
        float sum = 0;
        for (std::size_t t = 1; t < frames.size(); ++t) {
            const float step = std::abs(frames[t][p].r - frames[t - 1][p].r);
            sum += step;
            ASSERT_LE(step, 2 * whole * float(1.5 * kStep / 0.25) + 0.02f) << "pixel " << p;
        }
        ASSERT_LE(sum - whole, 0.03f) << "pixel " << p;
    }
}

TEST_F(LightBlendTest, IndirectLightStaysUntilItHasSettledAndComesThen) {
    Screen screen(fineRoom()); // takes a while, in which light is published as far as it is
    ASSERT_TRUE(screen.begin());
    std::vector<std::vector<Rgb>> before;
    std::vector<LitObject> objects;
    for (const LitObject& object : screen.node().objects())
        if (object.geometry) objects.push_back(object);
    for (const LitObject& object : objects)
        before.push_back(screen.blend.shown(*object.geometry)->indirect);
    screen.take(0.5);
    const RadiosityState& state = screen.node().state();
    const auto published = [&] { // something else than what is shown
        for (std::size_t o = 0; o < objects.size(); ++o)
            if (objects[o].geometry->data().indirect != before[o]) return true;
        return false;
    };
    bool settled = false, early = false;
    for (int i = 0; i < 5000 && !settled; ++i) {
        screen.node().update();
        if (!std::exchange(early, early || published()) && early) screen.time += 1.8;
        screen.blend.advance(screen.node(), screen.time += 1e-4);
        settled = state.reached(SolutionState::certified) && state.queued == 0;
        for (std::size_t o = 0; o < objects.size() && !settled; ++o)
            for (std::size_t v = 0; v < before[o].size(); ++v)
                ASSERT_EQ(screen.blend.shown(*objects[o].geometry)->indirect[v], before[o][v]);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    float off = 1; // light that is published after it was certified fades in, too
    for (int i = 0; i < 5 && off >= 1e-5f; ++i) {
        ASSERT_TRUE(screen.rest());
        off = largestStep(screen.frame(), screen.published());
    }
    EXPECT_LT(off, 1e-5f);
}

TEST_F(LightBlendTest, WhoTakesItAgainInTheMiddleSeesNoStep) {
    Screen screen;
    ASSERT_TRUE(screen.begin());
    screen.node().grab(*screen.room.room.box);
    screen.take(0.4);
    screen.frame();
    screen.node().release(*screen.room.room.box);
    std::vector<Rgb> last = screen.frame();
    bool onItsWay = false;
    for (int i = 0; i < 3000 && !onItsWay; ++i) { // until it fades
        const std::vector<Rgb> now = screen.frame();
        onItsWay = largestStep(now, last) > 1e-4f;
        last = now;
    }
    ASSERT_TRUE(onItsWay);
    for (int i = 0; i < 5; ++i) last = screen.frame();
    screen.node().grab(*screen.room.room.box);
    screen.take(0.4 + 1e-7); // it moves, but by nothing that can be seen
    const std::vector<Rgb> now = screen.frame();
    EXPECT_TRUE(screen.blend.preview().active());
    EXPECT_LT(largestStep(now, last), 0.12f * 30) << "no more than a frame of the fade";
    screen.node().release(*screen.room.room.box);
    ASSERT_TRUE(screen.rest());
    EXPECT_LT(largestStep(screen.frame(), screen.published()), 1e-5f);
}

} // namespace

} // namespace penumbra
