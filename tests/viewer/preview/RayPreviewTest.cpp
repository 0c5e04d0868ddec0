// Light brought up to date by rays, corner by corner, against radiosity of the scene as it is now.
#include "viewer/preview/RayPreview.h"

#include "tests/support/BallData.h"
#include "tests/viewer/preview/PreviewScenes.h"

#include <glm/gtc/matrix_transform.hpp>

#include <functional>

namespace penumbra {

namespace {

RadiosityOptions directRoom(float elementSize = 0.2f) {
    RadiosityOptions options = fineRoom();
    options.meshing = {.patchSize = 0.8f, .elementSize = elementSize};
    options.solving.samples = 16;
    options.solving.directOnly = true;
    return options;
}

/// The box stands on the floor, askew to its elements.
glm::dmat4 posed(double x, double y, double angle) {
    return glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(x, y, 0)), angle,
                       glm::dvec3(0, 0, 1));
}

/// A room in which the box stands somewhere, settled.
struct PosedRoom : PreviewRoom {
    explicit PosedRoom(const glm::dmat4& place, const RadiosityOptions& options = directRoom())
        : PreviewRoom(options) {
        room.box->setMatrix(place);
        settleAndShow();
    }
    void settleAndShow() {
        EXPECT_TRUE(settle());
        show(ownLight);
        for (const LitObject& object : room.node->objects())
            for (std::size_t v = 0; object.geometry && v < object.geometry->data().positions.size();
                 ++v)
                shown[object.geometry.get()].factors[v] =
                    LightFactors(object.geometry->data().direct[v].r / exitance().r);
    }

protected:
    PosedRoom() : PreviewRoom(directRoom()) {}

public:
    RayPreview vertices{directRoom().solving.samples, [this] { return room.node->patches(); }};
    RayPreview::ShownOf shownOf() {
        return [this](const LitGeometry& geometry) { return &shown[&geometry]; };
    }
};

/// The same with an emissive mesh instead of the light.
struct GlowingRoom : PosedRoom {
    GlowingRoom(const glm::dmat4& place, const glm::dmat4& panels) {
        const auto glow = paint(Rgb(), Rgb(40));
        const auto mesh = std::make_shared<Mesh>("mesh", twoPanels(glow, glow));
        const auto thing = objectOf("panels", {mesh});
        thing->setMatrix(panels);
        room.node->add(thing);
        room.light->setLuminance(Rgb());
        room.box->setMatrix(place);
        source = "/panels/mesh";
        settleAndShow();
        EXPECT_EQ(sceneState()->lights[0].size(), 2u) << "emitters";
    }
};

/// The same with a ball of small triangles, most of whose vertices take the light of others.
struct DenseRoom : PosedRoom {
    DenseRoom(const glm::dmat4& place, const glm::dmat4& ballPlace) {
        const auto mesh = std::make_shared<Mesh>("mesh", ballData(30, 0.4f));
        const auto ball = objectOf("ball", {mesh});
        ball->setMatrix(ballPlace);
        room.node->add(ball);
        room.box->setMatrix(place);
        settleAndShow();
        EXPECT_FALSE(room.node->patches()->vertexBlends.empty());
    }
};

/// The direct light of all corners of triangles as they are drawn.
std::vector<float> drawnLight(const LitGeometry& geometry, const ShownLight* brought) {
    const LitMeshData& data = geometry.data();
    std::vector<std::uint32_t> indices = data.indices;
    if (brought)
        for (const auto& [entry, copy] : brought->corners.entries)
            indices[entry] = std::uint32_t(data.positions.size()) + copy;
    std::vector<float> light;
    for (const std::uint32_t v : indices)
        light.push_back((brought ? brought->direct : data.direct)[v].r);
    return light;
}

/// Corners at which the light that is shown of `before` is not what radiosity has in `after`.
/// \param where those of the room there that matter
std::size_t differing(
    PosedRoom& before, PosedRoom& after,
    const std::function<bool(glm::vec3)>& where = [](glm::vec3) { return true; }) {
    std::size_t wrong = 0;
    const auto objects = before.room.node->objects();
    for (std::size_t o = 0; o < objects.size(); ++o) {
        if (!objects[o].geometry) continue;
        const LitGeometry& geometry = *objects[o].geometry;
        const std::vector<float> is = drawnLight(geometry, &before.shown.at(&geometry));
        const std::vector<float> shouldBe =
            drawnLight(*after.room.node->objects()[o].geometry, nullptr);
        EXPECT_EQ(is.size(), shouldBe.size());
        for (std::size_t i = 0; i < std::min(is.size(), shouldBe.size()); ++i) {
            if (std::abs(is[i] - shouldBe[i]) <= 3e-3f * std::max(is[i], shouldBe[i]) + 1e-3f)
                continue;
            const glm::vec3 at = geometry.data().positions[geometry.data().indices[i]];
            if (objects[o].path == "/room" && !where(at)) continue;
            if (wrong++ > 4) continue;
            ADD_FAILURE() << objects[o].path << " at (" << at.x << ", " << at.y << ", " << at.z
                          << "): " << is[i] << " for " << shouldBe[i];
        }
    }
    return wrong;
}

/// The same once the light of `before` is brought to where the box stands in `after`.
std::size_t broughtAmiss(PosedRoom& before, PosedRoom& after, SceneStatePtr then = nullptr) {
    if (!then) then = before.sceneState();
    before.vertices.update(before.preview(after.sceneState(), then), before.shownOf(), nullptr);
    return differing(before, after);
}

TEST(RayPreview, AThingThatStandsOnTheFloorHasItsContactsWhereverItIsPut) {
    PosedRoom before(posed(0.3, 0.2, 0.3)), after(posed(-0.53, 0.61, 0.8));
    EXPECT_EQ(broughtAmiss(before, after), 0u);
}

TEST(RayPreview, AThingThatIsLiftedUncoversWhatItStoodOn) {
    PosedRoom before(posed(0.3, 0.2, 0.3));
    PosedRoom after(glm::translate(glm::dmat4(1.0), glm::dvec3(0.3, 0.2, 0.7)));
    EXPECT_EQ(broughtAmiss(before, after), 0u);
}

TEST(RayPreview, AThingThatIsPutDownTouchesTheFloor) {
    PosedRoom before(glm::translate(glm::dmat4(1.0), glm::dvec3(0.3, 0.2, 0.7)));
    PosedRoom after(posed(0.3, 0.2, 0.3));
    EXPECT_EQ(broughtAmiss(before, after), 0u);
}

TEST(RayPreview, AThingThatIsDraggedAlongLeavesNoTrace) {
    // Frame by frame, with what was found for the frames before.
    PosedRoom before(posed(0.3, 0.2, 0.3)), after(posed(-0.53, 0.61, 0.8));
    const SceneStatePtr then = before.sceneState();
    for (double way = 0.1; way < 1; way += 0.2) {
        SceneState now = *then;
        for (std::size_t o = 0; o < now.objects.size(); ++o)
            if (before.room.node->objects()[o].path == "/box")
                now.objects[o].toWorld =
                    posed(0.3 - 0.83 * way, 0.2 + 0.41 * way, 0.3 + 0.5 * way) *
                    before.room.node->objects()[o].toObject;
        before.vertices.update(before.preview(std::make_shared<SceneState>(now), then),
                               before.shownOf(), nullptr);
    }
    EXPECT_EQ(broughtAmiss(before, after), 0u);
}

TEST(RayPreview, AThingThatMovesShadesAMeshThatShinesAsRadiosityHasIt) {
    const glm::dmat4 hung = glm::translate(glm::dmat4(1.0), glm::dvec3(0.2, 0.3, 0));
    GlowingRoom before(posed(0.3, 0.2, 0.3), hung), after(posed(-0.53, 0.61, 0.8), hung);
    EXPECT_EQ(broughtAmiss(before, after), 0u);
}

TEST(RayPreview, AMeshThatShinesTakesItsLightAlong) {
    const glm::dmat4 box = posed(0.3, 0.2, 0.3);
    GlowingRoom before(box, glm::translate(glm::dmat4(1.0), glm::dvec3(0.2, 0.3, 0)));
    GlowingRoom after(box, posed(-0.4, -0.3, 0.7));
    EXPECT_EQ(broughtAmiss(before, after), 0u);
}

TEST(RayPreview, AShadowThatFallsOnADenseMeshIsThatOfItsReceivers) {
    const glm::dmat4 ball = glm::translate(glm::dmat4(1.0), glm::dvec3(0.4, 0.1, 0.41));
    const auto over = [](double x) {
        return glm::translate(glm::dmat4(1.0), glm::dvec3(x, 0.1, 1.2));
    };
    DenseRoom before(over(-0.5), ball), after(over(0.3), ball);
    EXPECT_EQ(broughtAmiss(before, after), 0u);
}

TEST(RayPreview, ADenseMeshIsLitWhereItIsPut) {
    const glm::dmat4 box = posed(0.3, 0.2, 0.3);
    const auto put = [](double x, double y) {
        return glm::translate(glm::dmat4(1.0), glm::dvec3(x, y, 0.9));
    };
    DenseRoom before(box, put(0.2, 0.4)), after(box, put(-0.6, -0.3));
    EXPECT_EQ(broughtAmiss(before, after), 0u);
}

TEST(RayPreview, AMoveGoesOnFromWhatWasMadeReadyAtRest) {
    PosedRoom before(posed(0.3, 0.2, 0.3)), after(posed(-0.53, 0.61, 0.8));
    const SceneStatePtr then = before.sceneState();
    PreviewLighting expected = before.preview(then, then);
    expected.anchors.clear();
    for (std::size_t o = 0; o < expected.objects.size(); ++o)
        expected.objects[o].moves = before.room.node->objects()[o].path == "/box";
    before.vertices.rest(expected, before.shownOf(), nullptr);
    EXPECT_EQ(broughtAmiss(before, after, then), 0u);
}

/// Brings it up to date with as little time a frame as there can be. \return frames
int inSlices(PosedRoom& before, const PreviewLighting& light, RayPreview& slices) {
    int frames = 0;
    do {
        slices.update(light, before.shownOf(), nullptr);
    } while (++frames < 1000 && slices.unfinished());
    return frames;
}

RayPreview hurried(PosedRoom& room) {
    return {directRoom().solving.samples, [&room] { return room.room.node->patches(); },
            PreviewRows::Indexing::atOnce, 0};
}

TEST(RayPreview, WhatHasNoTurnInAFrameComesInALaterOne) {
    const RadiosityOptions fine = directRoom(0.05f);
    PosedRoom before(glm::translate(glm::dmat4(1.0), glm::dvec3(0.3, 0.2, 0.7)), fine);
    PosedRoom after(glm::translate(glm::dmat4(1.0), glm::dvec3(-0.53, 0.61, 0.3)), fine);
    RayPreview slices = hurried(before);
    const PreviewLighting light = before.preview(after.sceneState(), before.sceneState());
    EXPECT_GT(inSlices(before, light, slices), 1);
    EXPECT_EQ(differing(before, after), 0u);
}

TEST(RayPreview, ContactsThatTakeTooLongAreLeftToRadiosity) {
    PosedRoom before(posed(0.3, 0.2, 0.3)), after(posed(-0.53, 0.61, 0.8));
    RayPreview slices = hurried(before);
    inSlices(before, before.preview(after.sceneState(), before.sceneState()), slices);
    const auto beside = [](glm::vec3 at) { return glm::distance(at, {-0.53f, 0.61f, 0}) < 0.9f; };
    EXPECT_EQ(differing(before, after, std::not_fn(beside)), 0u) << "what it stood on is uncovered";
}

} // namespace

} // namespace penumbra
