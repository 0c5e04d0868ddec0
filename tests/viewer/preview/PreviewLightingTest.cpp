// Previewed lights, by shadow maps (MapPreview, PreviewMaps) and by rays (RayPreview), against
// radiosity.
#include "tests/viewer/preview/PreviewScenes.h"

#include "io/image/PngWriter.h"

#include <cstdlib>

namespace penumbra {

namespace {

constexpr int kSize = 256;

class PreviewLightingTest : public WithContext, public testing::WithParamInterface<PreviewMethod> {
protected:
    InteractiveOptions options() const {
        return {.samples = 1, .precision = HdrTarget::Precision::single};
    }
    /// A picture for people, if they ask for it.
    static void keep(const std::string& name, const std::vector<Rgb>& picture, float white) {
        const char* const folder = std::getenv("PENUMBRA_KEEP_PICTURES");
        if (!folder) return;
        std::vector<Rgb> flipped;
        for (int y = kSize - 1; y >= 0; --y)
            for (int x = 0; x < kSize; ++x)
                flipped.push_back(picture[std::size_t(y * kSize + x)] * (1 / white));
        writePngBytes(std::string(folder) + "/" + name + ".png", kSize, kSize,
                      displayBytes(flipped, kSize));
    }
    /// All light previewed, from a source that was not there before, against the solution: relative
    /// differences of pixels that lie in no shadow.
    std::vector<float> unshadowed(PreviewRoom& room, const std::string& name) {
        room.room.box->setMatrix(lifted());
        EXPECT_TRUE(room.settle());
        const SceneStatePtr now = room.sceneState();
        SceneState dark = *now;
        dark.lights[0].clear();

        InteractiveRenderer interactive(options());
        room.show(ownLight);
        const std::vector<Rgb> exact = room.draw(interactive, {}, kSize);
        room.show([](const LitMeshData&, std::size_t) { return Rgb(); });
        const std::vector<Rgb> fast = room.draw(
            interactive, room.preview(now, std::make_shared<SceneState>(dark)), kSize, GetParam());
        // Where shadows are: any vertex of the triangle sees less than all of the light, or is not
        // in front of it: there the mesh cuts off light more coarsely than the light does.
        room.show([](const LitMeshData&, std::size_t) { return Rgb(); });
        const Rgb exitance = room.room.light->luminance() * 3.14159265f;
        for (const LitObject& object : room.room.node->objects()) {
            if (!object.geometry) continue;
            const LitMeshData& data = object.geometry->data();
            for (std::size_t v = 0; v < data.positions.size(); ++v) {
                const float whole = room.unoccluded(object, now, v);
                const bool shadow = data.direct[v].r <= (whole - 2e-3f * whole) * exitance.r;
                room.shown[object.geometry.get()].direct[v] = Rgb(shadow ? 1.0f : 0.0f);
            }
        }
        const std::vector<Rgb> shadows = room.draw(interactive, {}, kSize);
        keep(name + "exact", exact, 30), keep(name + "live", fast, 30);
        keep(name + "shadows", shadows, 1);

        std::vector<float> differences;
        for (std::size_t i = 0; i < exact.size(); ++i)
            if (shadows[i].r == 0 && exact[i].r > 0)
                differences.push_back(std::abs(fast[i].r - exact[i].r) / exact[i].r);
        EXPECT_GT(differences.size(), exact.size() / 4);
        return differences;
    }
    /// Its light as it is, of which all that is direct is the light's.
    static void showWithFactors(PreviewRoom& room) {
        room.show(ownLight);
        for (auto& [geometry, light] : room.shown)
            for (std::size_t v = 0; v < light.direct.size(); ++v)
                light.factors[v] = LightFactors(light.direct[v].r /
                                                (room.room.light->luminance().r * 3.14159265f));
    }
    static glm::dmat4 lifted() {
        return glm::translate(glm::dmat4(1.0), glm::dvec3(0.3, 0.2, 0.5));
    }
};

TEST_P(PreviewLightingTest, WhatLiesInNoShadowHasTheValueOfItsRadiosity) {
    PreviewRoom room;
    const std::vector<float> differences = unshadowed(room, "rect-");
    EXPECT_LE(mean(differences), 3e-3f);
    EXPECT_LE(percentile(differences, 0.99), 1e-2f);
}

/// Elements of half the size as elsewhere: between vertices light is drawn linear, which a light so
/// near to the walls is not. With 0.1 m that alone is 1.7 % and 1 % at the 99th percentile; it
/// falls with the square of the size.
RadiosityOptions finerRoom() {
    RadiosityOptions finer = fineRoom();
    finer.meshing.elementSize = 0.05f;
    finer.solving.directOnly = true;
    return finer;
}

TEST_P(PreviewLightingTest, WhatADiskLightsHasTheValueOfItsRadiosity) {
    // A side of the box lies in a plane through the middle of the disk: its horizon cuts it there.
    PreviewRoom room(finerRoom(), DiskShape{0.28f}, 1.9);
    const std::vector<float> differences = unshadowed(room, "disk-");
    EXPECT_LE(mean(differences), 3e-3f);
    EXPECT_LE(percentile(differences, 0.99), 1e-2f);
}

TEST_P(PreviewLightingTest, WhatASphereLightsHasTheValueOfItsRadiosity) {
    PreviewRoom room(finerRoom(), SphereShape{0.25f}, 1.9);
    const std::vector<float> differences = unshadowed(room, "sphere-");
    EXPECT_LE(mean(differences), 3e-3f);
    EXPECT_LE(percentile(differences, 0.99), 1e-2f);
}

TEST_P(PreviewLightingTest, TakingHoldOfSomethingChangesNothing) {
    PreviewRoom room;
    ASSERT_TRUE(room.settle());
    const SceneStatePtr now = room.sceneState();
    InteractiveRenderer interactive(options());
    room.show(ownLight);
    const std::vector<Rgb> before = room.draw(interactive, {}, kSize);
    PreviewLighting held = room.preview(now, room.sceneState());
    for (std::size_t o = 0; o < held.objects.size(); ++o)
        held.objects[o].moves = room.room.node->objects()[o].path == "/box";
    const std::vector<Rgb> after = room.draw(interactive, held, kSize, GetParam());
    EXPECT_EQ(interactive.statistics().shadowMaps > 0, GetParam() == PreviewMethod::maps);
    for (std::size_t i = 0; i < before.size(); ++i) {
        ASSERT_NEAR(after[i].r, before[i].r, 1e-6f * before[i].r);
        ASSERT_NEAR(after[i].b, before[i].b, 1e-6f * before[i].b);
    }
}

TEST_P(PreviewLightingTest, AMovedThingTakesItsShadowAlong) {
    PreviewRoom room;
    room.room.box->setMatrix(lifted());
    ASSERT_TRUE(room.settle());
    const SceneStatePtr then = room.sceneState();
    showWithFactors(room);
    const std::map<const LitGeometry*, ShownLight> old = room.shown;
    InteractiveRenderer interactive(options());
    const std::vector<Rgb> before = room.draw(interactive, {}, kSize);

    room.room.box->setMatrix(glm::translate(glm::dmat4(1.0), glm::dvec3(-0.4, 0.6, 0.3)));
    ASSERT_TRUE(room.settle());
    room.show(ownLight);
    const std::vector<Rgb> exact = room.draw(interactive, {}, kSize);
    room.shown = old;
    for (auto& [geometry, light] : room.shown) room.showAnew(light);
    const std::vector<Rgb> fast =
        room.draw(interactive, room.preview(room.sceneState(), then), kSize, GetParam());
    const std::vector<Rgb> stale = room.draw(interactive, {}, kSize);
    keep("moved-before", before, 30), keep("moved-exact", exact, 30), keep("moved-live", fast, 30);

    std::vector<float> errors, staleErrors;
    float whole = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        errors.push_back(std::abs(fast[i].r - exact[i].r));
        staleErrors.push_back(std::abs(stale[i].r - exact[i].r));
        whole += exact[i].r / float(exact.size());
    }
    EXPECT_LT(mean(errors), 0.01f * whole);
    EXPECT_LT(mean(errors), 0.15f * mean(staleErrors));
    EXPECT_LT(percentile(errors, 0.99), 0.2f * whole);
}

TEST_P(PreviewLightingTest, ACopyOfAVertexIsBroughtUpToDateAsThatIs) {
    PreviewRoom room;
    room.room.box->setMatrix(lifted());
    ASSERT_TRUE(room.settle());
    const SceneStatePtr then = room.sceneState();
    room.room.box->setMatrix(glm::translate(glm::dmat4(1.0), glm::dvec3(-0.4, 0.6, 0.3)));
    ASSERT_TRUE(room.settle());
    showWithFactors(room);
    InteractiveRenderer interactive(options());
    const PreviewLighting preview = room.preview(room.sceneState(), then);
    const std::vector<Rgb> with = room.draw(interactive, preview, kSize, GetParam());
    for (auto& [geometry, light] : room.shown) {
        const std::vector<std::uint32_t>& indices = geometry->data().indices;
        for (std::uint32_t i = 0; i < indices.size(); ++i) { // every corner has its own
            light.corners.copies.push_back(indices[i]);
            light.corners.entries.emplace_back(i, i);
            light.direct.push_back(Rgb(light.direct[indices[i]]));
            light.indirect.push_back(Rgb(light.indirect[indices[i]]));
            light.factors.push_back(LightFactors(light.factors[indices[i]]));
            light.behind.push_back(0);
        }
        room.showAnew(light);
    }
    const std::vector<Rgb> copied = room.draw(interactive, preview, kSize, GetParam());
    for (std::size_t i = 0; i < with.size(); ++i)
        ASSERT_NEAR(copied[i].r, with[i].r, 1e-5f * with[i].r + 1e-6f);
}

INSTANTIATE_TEST_SUITE_P(Sampling, PreviewLightingTest,
                         testing::Values(PreviewMethod::maps, PreviewMethod::rays),
                         [](const auto& tried) {
                             return tried.param == PreviewMethod::maps ? "Maps" : "Rays";
                         });

} // namespace

} // namespace penumbra
