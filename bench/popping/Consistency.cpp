#include "Consistency.h"

#include "LoadScene.h"

#include "radiosity/process/LightingLink.h"
#include "radiosity/process/RadiosityNode.h"
#include "radiosity/rows/EmitterSender.h"
#include "scenegraph/Frustum.h"
#include "viewer/app/InteractiveRenderer.h"
#include "viewer/gl/OffscreenContext.h"
#include "viewer/input/Walkthrough.h"
#include "viewer/preview/PreviewLightChoice.h"
#include "viewer/preview/PreviewScene.h"
#include "viewer/preview/RayPreview.h"
#include "viewer/preview/SceneStates.h"
#include "viewer/preview/ShownLight.h"
#include "viewer/shadowmaps/MapPreview.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <thread>
#include <vector>

namespace penumbra {

namespace {

constexpr float kSeen = 0.99999f; ///< of a light: nothing is in the way, up to rounding

class Comparison {
public:
    Comparison(const std::string& scene, PreviewMethod by, float elementSize, glm::ivec2 size)
        : walk_(loadScene(scene)), by_(by), size_(size),
          renderer_({.samples = 1, .precision = HdrTarget::Precision::single}) {
        options_ = optionsFor(walk_.loaded().asked);
        options_.meshing.elementSize = elementSize;
        options_.trigger = Trigger::continuous;
        options_.solving.directOnly = true;
        node_ = std::make_shared<RadiosityNode>("lit", options_, makeThreadLink());
        node_->add(walk_.scene().root);
        node_->update();
    }

    Consistency compare() {
        settle(); // emissive meshes are known when they are lit
        for (const PreviewLight& source : previewableLights(*node_, by_))
            lights_.push_back(source.path);
        const std::size_t atOnce = previewLimits(by_).most;
        for (std::size_t first = 0; first < lights_.size(); first += atOnce) {
            const std::size_t end = std::min(first + atOnce, lights_.size());
            group_.assign(lights_.begin() + std::ptrdiff_t(first),
                          lights_.begin() + std::ptrdiff_t(end));
            compareGroup();
        }
        Consistency result{lights_.size(), differences_.size()};
        if (differences_.empty()) return result;
        std::sort(differences_.begin(), differences_.end());
        for (const double difference : differences_)
            result.mean += difference / double(differences_.size());
        result.median = differences_[differences_.size() / 2];
        result.beyond = double(differences_.end() -
                               std::upper_bound(differences_.begin(), differences_.end(), 0.01)) /
                        double(differences_.size());
        result.p99 = differences_[std::size_t(0.99 * double(differences_.size() - 1))];
        result.most = differences_.back();
        return result;
    }

private:
    void settle() {
        for (int still = 0; still < 5;) {
            node_->update();
            const RadiosityState& state = node_->state();
            const bool done =
                state.reached(SolutionState::exact) && state.dirtyMarked && state.queued == 0;
            still = done ? still + 1 : 0;
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
    }
    using LightOf = std::function<Rgb(std::uint32_t object, std::size_t vertex)>;
    void show(const LightOf& light) {
        shown_.clear();
        const auto objects = node_->objects();
        for (std::uint32_t o = 0; o < objects.size(); ++o) {
            if (!objects[o].geometry) continue;
            ShownLight& to = shown_[objects[o].geometry.get()];
            const std::size_t vertices = objects[o].geometry->data().positions.size();
            for (std::size_t v = 0; v < vertices; ++v) to.direct.push_back(light(o, v));
            to.indirect.assign(vertices, Rgb());
            to.factors.assign(vertices, LightFactors());
            to.behind.assign(vertices, 0);
            to.revision = revision_;
            to.blockRevisions.assign(objects[o].geometry->blockRevisions().size(), 0);
            for (std::size_t b = 0; b < to.blockRevisions.size(); ++b) to.touch(b);
            revision_ = to.revision;
        }
    }
    std::vector<Rgb> draw(const PreviewLighting& preview) {
        const View view = walk_.rig().view(size_.x, size_.y);
        DrawList list = listVisible(node_->lit(), Frustum(view.worldToClip()));
        RayPreview rays(options_.solving.samples, [this] { return node_->patches(); });
        MapPreview maps;
        Preview& way = by_ == PreviewMethod::rays ? static_cast<Preview&>(rays) : maps;
        if (preview.active())
            way.update(
                preview, [&](const LitGeometry& geometry) { return &shown_[&geometry]; }, nullptr);
        for (DrawItem& item : list.items) item.shown = &shown_[item.geometry];
        renderer_.drawScene(list, view, {}, size_.x, size_.y, &maps);
        way.takeBack();
        for (const auto& [geometry, light] : shown_)
            revision_ = std::max(revision_, light.revision);
        return renderer_.readLuminances();
    }
    Rgb exitance(std::size_t source) const { return exitanceOf(node_->placed(), group_[source]); }
    /// Nothing is in the way of any of the lights that reach this point at all.
    using Senders = std::vector<std::vector<EmitterSender>>; ///< by light
    bool sees(const PreviewScene& stage, const Senders& senders, std::uint32_t object,
              std::size_t vertex) const {
        if (vertex >= stage.vertices(object)) return false; // something touches it
        const LightShares& shares = node_->objects()[object].geometry->shares();
        const Receiver receiver = stage.receiver(object, vertex);
        for (std::size_t l = 0; l < senders.size(); ++l) {
            float all = 0;
            for (const EmitterSender& sender : senders[l]) all += sender.formFactor(receiver);
            if (shares[l].factor[vertex] < kSeen * all) return false;
        }
        return true;
    }
    /// As if the lights had been dark before, so that all of their light is previewed.
    PreviewLighting preview(const SceneStatePtr& now) const {
        PreviewLighting preview;
        for (const LitObject& object : node_->objects())
            preview.objects.push_back({object.geometry});
        for (std::size_t l = 0; l < group_.size(); ++l)
            preview.lights.push_back({exitance(l), true});
        preview.now = now;
        auto dark = std::make_shared<SceneState>(*now);
        for (auto& source : dark->lights) source.clear();
        preview.anchors.push_back({std::move(dark), 1, 0});
        return preview;
    }
    void compareGroup() {
        node_->setPreviewLights(group_);
        settle();
        const auto now = std::make_shared<const SceneState>(sceneStateOf(*node_, group_));
        PreviewScene stage(*node_->patches());
        stage.pose(*now);
        Senders senders(now->lights.size());
        for (std::size_t l = 0; l < senders.size(); ++l)
            for (const Emitter& emitter : now->lights[l]) senders[l].emplace_back(emitter, 16, 16);
        show([&](std::uint32_t object, std::size_t vertex) {
            const LightShares& shares = node_->objects()[object].geometry->shares();
            Rgb sum;
            for (std::size_t l = 0; l < group_.size(); ++l)
                sum = sum + exitance(l) * shares[l].factor[vertex];
            return sum;
        });
        const std::vector<Rgb> exact = draw({});
        show([](std::uint32_t, std::size_t) { return Rgb(); });
        const std::vector<Rgb> fast = draw(preview(now));
        show([&](std::uint32_t object, std::size_t vertex) {
            return Rgb(sees(stage, senders, object, vertex) ? 0.0f : 1.0f);
        });
        const std::vector<Rgb> shadows = draw({});
        for (std::size_t i = 0; i < exact.size(); ++i)
            if (luminance(shadows[i]) == 0 && luminance(exact[i]) > 0) // what emits is left out too
                differences_.push_back(std::abs(luminance(fast[i]) - luminance(exact[i])) /
                                       luminance(exact[i]));
    }

    OffscreenContext context_;
    Walkthrough walk_;
    PreviewMethod by_;
    glm::ivec2 size_;
    InteractiveRenderer renderer_;
    RadiosityOptions options_;
    std::shared_ptr<RadiosityNode> node_;
    std::vector<std::string> lights_, group_;
    std::map<const LitGeometry*, ShownLight> shown_;
    std::uint64_t revision_ = 0;
    std::vector<double> differences_;
};

} // namespace

Consistency consistency(const std::string& scene, PreviewMethod by, float elementSize,
                        glm::ivec2 size) {
    return Comparison(scene, by, elementSize, size).compare();
}

} // namespace penumbra
