#include "tests/support/LitNode.h"
#include "tests/support/SteppedLink.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <vector>

namespace penumbra {

namespace {

using Known = LightShare::Known;
using Shares = std::map<std::string, std::vector<LightShare>>; ///< of objects

/// A room with two lights, both previewed, and whose worker takes a step a frame.
class LightRoom {
public:
    explicit LightRoom(double residual = 1e-7) : room_(takeLink(), optionsOf(residual)) {
        room_.node->add(other);
        room_.node->setPreviewLights({"/other/light", "/lamp/light"});
    }

    void frame() {
        link_->step(1e-9); // one piece of work
        room_.node->update();
    }
    /// \param look called with each frame
    bool settle(const std::function<void()>& look = [] {}) {
        for (int i = 0; i < 20'000; ++i) {
            frame();
            look();
            if (state().reached(SolutionState::exact)) return true;
        }
        return false;
    }
    const RadiosityState& state() const { return room_.node->state(); }
    LitRoom& room() { return room_; }

    /// The lights' shares of all objects.
    Shares shares() const {
        Shares all;
        for (const LitObject& object : room_.node->objects())
            if (object.geometry) all[object.path] = object.geometry->shares();
        return all;
    }
    std::size_t blocks(Known known) const {
        std::size_t count = 0;
        for (const auto& [path, lights] : shares())
            for (const LightShare& light : lights)
                count += std::size_t(std::ranges::count(light.known, known));
        return count;
    }

    std::shared_ptr<Light> otherLight =
        std::make_shared<Light>("light", SphereShape{0.1f}, Rgb(700));
    std::shared_ptr<Transform> other = objectOf("other", {otherLight});

private:
    std::unique_ptr<LightingLink> takeLink() {
        auto link = std::make_unique<SteppedLink>();
        link_ = link.get();
        return link;
    }
    static RadiosityOptions optionsOf(double residual) {
        RadiosityOptions options = LitRoom::smallRoomOptions();
        options.solving.residual = residual;
        return options;
    }

    SteppedLink* link_ = nullptr;
    LitRoom room_;
};

/// Vertices whose light by an exact factor is not what it is in the end.
std::size_t wrongOnes(const LightShare& then, const LightShare& last) {
    std::size_t wrong = 0;
    for (std::size_t v = 0; v < then.factor.size(); ++v) {
        const std::size_t block = v / LitGeometry::kBlock;
        if (then.known[block] != Known::exact) continue;
        const float was = then.factor[v] * last.exitance[block].g;
        const float is = last.factor[v] * last.exitance[block].g;
        wrong += std::abs(was - is) > 1e-3f * is + 1e-3f;
    }
    return wrong;
}

void expectNoExactLightChanges(LightRoom& lights, const std::function<void()>& edit) {
    std::vector<Shares> seen;
    edit();
    ASSERT_TRUE(lights.settle([&] {
        if (lights.state().dirtyMarked && seen.size() < 200) seen.push_back(lights.shares());
    })) << describe(*lights.room().node);
    const Shares last = lights.shares();
    std::size_t stale = 0;
    for (const Shares& shares : seen)
        for (const char* path : {"/room", "/box"}) // lights themselves reflect nothing
            for (std::size_t l = 0; l < 2; ++l) {
                const LightShare& then = shares.at(path)[l];
                stale += std::size_t(std::ranges::count(then.known, Known::stale));
                ASSERT_EQ(wrongOnes(then, last.at(path)[l]), 0u)
                    << path << ", light " << l << ", frame " << &shares - seen.data();
            }
    EXPECT_GT(stale, 0u);
    EXPECT_EQ(lights.blocks(Known::stale), 0u);
    EXPECT_EQ(lights.blocks(Known::no), 0u);
}

/// There are no other lights, so that what these give is all direct light.
void expectLightsAreAllDirectLight(const LightRoom& lights, const RadiosityNode& node) {
    std::size_t wrong = 0, lit = 0;
    for (const LitObject& object : node.objects()) {
        if (!object.geometry) continue;
        const LitMeshData& data = object.geometry->data();
        for (std::uint32_t v : data.indices) {
            Rgb sum;
            bool known = true;
            for (const LightShare& light : object.geometry->shares()) {
                sum += light.factor[v] * light.exitance[v / LitGeometry::kBlock];
                known &= light.known[v / LitGeometry::kBlock] != Known::no;
            }
            if (!known) continue;
            ++lit;
            wrong += std::abs(data.direct[v].g - sum.g) > 1e-6f * sum.g;
        }
    }
    EXPECT_EQ(wrong, 0u) << "of " << lit << " corners";
    EXPECT_TRUE(lit > 1000 || !lights.state().dirtyMarked);
}

TEST(PreviewLights, EachOnesLightIsGivenAlone) {
    LightRoom lights;
    lights.other->setMatrix(moved(1.5, 1, 2.3));
    ASSERT_TRUE(lights.settle());
    EXPECT_TRUE(lights.state().dirtyMarked);
    EXPECT_EQ(lights.blocks(Known::stale) + lights.blocks(Known::no), 0u);
    expectLightsAreAllDirectLight(lights, *lights.room().node);
    lights.room().node->setPreviewLights({});
    ASSERT_TRUE(lights.settle());
    for (const auto& [path, shares] : lights.shares()) EXPECT_TRUE(shares.empty()) << path;
}

TEST(PreviewLights, LightThatIsCalledExactDoesNotChangeAnyMore) {
    LightRoom lights;
    lights.other->setMatrix(moved(1.5, 1, 2.3));
    ASSERT_TRUE(lights.settle());
    LitRoom& room = lights.room();
    // another object; the light itself; a light that is off; something that comes to touch a wall
    expectNoExactLightChanges(lights, [&] { room.box->setMatrix(moved(0.9, -0.4, 0.1)); });
    expectNoExactLightChanges(lights, [&] { lights.other->setMatrix(moved(-1, 1, 1.8)); });
    lights.otherLight->setLuminance(Rgb(0));
    ASSERT_TRUE(lights.settle());
    expectNoExactLightChanges(lights, [&] { room.box->setMatrix(moved(-0.8, 0.5, 0)); });
    lights.otherLight->setLuminance(Rgb(300));
    expectNoExactLightChanges(lights, [&] { room.box->setMatrix(moved(1.7, 1.7, 0)); });
    expectLightsAreAllDirectLight(lights, *room.node);
}

TEST(PreviewLights, NothingIsExactWhereALightThatIsNotLiveHasYetToCome) {
    // Who goes over to that light, with all that is in it, is to stay there.
    struct Moment {
        std::vector<Rgb> direct;
        std::vector<Known> known;
    };
    LightRoom lights;
    lights.other->setMatrix(moved(1.5, 1, 2.3));
    lights.room().node->setPreviewLights({"/other/light"});
    ASSERT_TRUE(lights.settle());
    const auto floor = [&]() -> Moment {
        for (const LitObject& object : lights.room().node->objects())
            if (object.path == "/room")
                return {object.geometry->data().direct, object.geometry->shares()[0].known};
        return {};
    };
    std::vector<Moment> seen;
    lights.room().box->setMatrix(moved(0.9, -0.4, 0.1));
    ASSERT_TRUE(lights.settle([&] {
        if (lights.state().dirtyMarked && seen.size() < 200) seen.push_back(floor());
    }));
    const Moment last = floor();
    std::size_t exact = 0, changed = 0;
    for (const Moment& then : seen)
        for (std::size_t v = 0; v < last.direct.size(); ++v) {
            if (then.known[v / LitGeometry::kBlock] != Known::exact) continue;
            ++exact;
            changed += std::abs(then.direct[v].g - last.direct[v].g) > 1e-3f * last.direct[v].g;
        }
    EXPECT_GT(exact, 0u);
    EXPECT_EQ(changed, 0u);
}

TEST(PreviewLights, TheirSharesFitTheDirectLightAtEveryMoment) {
    LightRoom lights;
    lights.other->setMatrix(moved(1.5, 1, 2.3));
    ASSERT_TRUE(lights.settle());
    for (int i = 0; i < 60; ++i) {
        if (i % 3 == 0) lights.otherLight->setLuminance(Rgb(float(100 + 10 * i)));
        if (i % 7 == 0) lights.other->setMatrix(moved(1.5 - 0.03 * i, 1, 2.2));
        if (i % 4 == 1) lights.room().box->setMatrix(moved(0.02 * i, -0.01 * i, 0));
        lights.frame();
        expectLightsAreAllDirectLight(lights, *lights.room().node);
    }
}

TEST(PreviewLights, ALightThatIsSwitchedOffKeepsItsFactors) {
    LightRoom lights;
    lights.other->setMatrix(moved(1.5, 1, 2.3));
    ASSERT_TRUE(lights.settle());
    const auto on = lights.shares();
    lights.otherLight->setLuminance(Rgb(0));
    lights.room().node->update();
    EXPECT_FALSE(lights.state().dirtyMarked); // the worker has not compared it yet
    ASSERT_TRUE(lights.settle([&] { EXPECT_EQ(lights.blocks(Known::stale), 0u); }));
    for (const auto& [path, shares] : lights.shares())
        EXPECT_EQ(shares[0].factor, on.at(path)[0].factor) << path;
}

TEST(PreviewLights, WorkThatIsDeferredIsNotCalledStale) {
    LightRoom lights(0.05); // a tolerance that much is below
    ASSERT_TRUE(lights.settle());
    lights.room().box->setMatrix(moved(0.4, 0, 0));
    bool settled = false;
    ASSERT_TRUE(lights.settle([&] {
        settled |= lights.state().reached(SolutionState::certified);
        if (!settled) return;
        EXPECT_TRUE(lights.state().reached(SolutionState::certified)) << "and stays so";
        EXPECT_EQ(lights.blocks(Known::stale), 0u);
    }));
    EXPECT_TRUE(settled);
    EXPECT_EQ(lights.room().difference(), "");
}

} // namespace

} // namespace penumbra
