// Lit scenes in which something moves, for the tests of preview lighting.
#pragma once

#include "tests/viewer/gl/LitScenes.h"

#include "radiosity/rows/EmitterSender.h"
#include "scenegraph/Light.h"
#include "scenegraph/Mesh.h"
#include "tests/support/LitNode.h"
#include "viewer/app/InteractiveRenderer.h"
#include "viewer/preview/LightBlend.h"
#include "viewer/preview/RayPreview.h"
#include "viewer/preview/SceneStates.h"
#include "viewer/preview/ShownLight.h"
#include "viewer/shadowmaps/MapPreview.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace penumbra {

inline RadiosityOptions fineRoom() {
    RadiosityOptions options;
    options.meshing = {.patchSize = 0.4f, .elementSize = 0.1f};
    options.solving.samples = 64;
    options.trigger = Trigger::continuous;
    return options;
}

/// The room of LitRoom, finely meshed, with its light as the renderer is given it.
class PreviewRoom {
public:
    explicit PreviewRoom(const RadiosityOptions& options = fineRoom(),
                         const LightShape& shape = RectShape{0.5f, 0.5f}, double lightHeight = 2.4)
        : room(makeThreadLink(), options, shape, lightHeight) {}

    bool settle() { return updateUntilSettled(*room.node); }
    SceneStatePtr sceneState() const {
        return std::make_shared<SceneState>(sceneStateOf(*room.node, {&source, 1}));
    }

    /// \param light the light that each vertex carries
    using LightOf = std::function<Rgb(const LitMeshData&, std::size_t vertex)>;
    void show(const LightOf& light) {
        shown.clear();
        for (const LitObject& object : room.node->objects()) {
            if (!object.geometry) continue; // there is nothing of it
            const LitMeshData& data = object.geometry->data();
            ShownLight& to = shown[object.geometry.get()];
            for (std::size_t v = 0; v < data.positions.size(); ++v)
                to.direct.push_back(light(data, v));
            to.indirect.assign(data.positions.size(), Rgb());
            to.factors.assign(data.positions.size(), LightFactors());
            to.behind.assign(data.positions.size(), 0);
            showAnew(to);
        }
    }
    /// Has all of it uploaded: no revision was there before.
    void showAnew(ShownLight& light) {
        light.revision = revision;
        light.blockRevisions.assign((light.direct.size() + 63) / LitGeometry::kBlock, 0);
        for (std::size_t b = 0; b < light.blockRevisions.size(); ++b) light.touch(b);
        revision = light.revision;
    }
    /// What the light gives to a vertex of an object when nothing is in the way, over its exitance.
    float unoccluded(const LitObject& object, const SceneStatePtr& at, std::size_t vertex) const {
        const EmitterSender sender(at->lights[0].front(), 16, 16);
        const LitMeshData& data = object.geometry->data();
        const glm::dmat4 place = object.toNode * object.toObject;
        Receiver receiver;
        receiver.position = glm::vec3(place * glm::dvec4(glm::dvec3(data.positions[vertex]), 1));
        receiver.normal =
            glm::normalize(glm::vec3(glm::dmat3(place) * glm::dvec3(data.normals[vertex])));
        return sender.formFactor(receiver);
    }

    Rgb exitance() const { return exitanceOf(room.node->placed(), source); }
    PreviewLighting preview(SceneStatePtr now, SceneStatePtr then) const {
        PreviewLighting preview;
        for (const LitObject& object : room.node->objects())
            preview.objects.push_back({object.geometry, false});
        for (std::size_t o = 0; o < preview.objects.size(); ++o)
            preview.objects[o].moves = !(now->objects[o] == then->objects[o]);
        preview.lights.push_back({exitance(), !sameLight(now->lights[0], then->lights[0])});
        preview.now = std::move(now);
        preview.anchors.push_back({std::move(then), 1, 0});
        return preview;
    }

    std::vector<Rgb> draw(InteractiveRenderer& renderer, const PreviewLighting& preview, int size,
                          PreviewMethod by = PreviewMethod::maps) {
        const View view = viewInside(size);
        DrawList list = listVisible(room.node->lit(), Frustum(view.worldToClip()));
        for (DrawItem& item : list.items) item.shown = &shown[item.geometry];
        RayPreview rays(fineRoom().solving.samples, [this] { return room.node->patches(); });
        MapPreview maps;
        Preview& way = by == PreviewMethod::rays ? static_cast<Preview&>(rays) : maps;
        if (preview.active())
            way.update(
                preview, [&](const LitGeometry& geometry) { return &shown[&geometry]; }, nullptr);
        renderer.drawScene(list, view, {}, size, size, &maps);
        way.takeBack();
        for (const auto& [geometry, light] : shown) revision = std::max(revision, light.revision);
        return renderer.readLuminances();
    }
    static View viewInside(int size) {
        Lens lens;
        lens.focalLength = 1;
        lens.horizontalAperture = 2;
        lens.clippingRange = {0.01f, 100};
        const glm::dmat4 camera = glm::inverse(glm::lookAt(
            glm::dvec3(-1.8, -1.7, 1.7), glm::dvec3(0.2, 0.1, 0.4), glm::dvec3(0, 0, 1)));
        return makeView(lens, camera, size, size);
    }

    LitRoom room;
    std::string source = "/lamp/light"; ///< that is previewed
    std::map<const LitGeometry*, ShownLight> shown;
    std::uint64_t revision = 1;
};

inline Rgb ownLight(const LitMeshData& data, std::size_t vertex) {
    return data.direct[vertex];
}

inline float percentile(std::vector<float> values, double share) {
    if (values.empty()) return 0;
    const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

inline float mean(const std::vector<float>& values) {
    double sum = 0;
    for (const float v : values) sum += v;
    return values.empty() ? 0 : float(sum / double(values.size()));
}

} // namespace penumbra
