#include "viewer/overlay/OverlayViews.h"

#include "radiosity/process/RadiosityNode.h"
#include "scenegraph/Objects.h"
#include "viewer/overlay/BlockAges.h"
#include "viewer/overlay/ColourMap.h"
#include "viewer/overlay/OverlayPass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <utility>

namespace penumbra {

namespace {

/// Calls visit(geometry, work) for all blocks of objects of which the work is known.
template <class Visit>
void forEachBlock(std::span<const LitObject> objects, WorkOfObjects work, Visit visit) {
    for (std::size_t o = 0; o < std::min(objects.size(), work.size()); ++o)
        if (objects[o].geometry)
            for (const DirtyStatus& block : work[o]) visit(*objects[o].geometry, block);
}

/// Three digits.
std::string lux(float value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", double(value));
    return text;
}

/// What belongs to no object has the path "/".
std::string nameOf(const std::string& path) {
    return path == "/" ? "what can't be moved" : path;
}

} // namespace

OverlayView meshView() {
    OverlayView view;
    view.picture.mesh = true;
    view.legend.title = "Mesh";
    view.legend.kinds = {
        {kindColour(OverlayPass::kPatchKind), "patches: each passes light on"},
        {kindColour(OverlayPass::kElementKind), "elements: light is computed at their corners"}};
    return view;
}

OverlayView ageView(std::span<const LitObject> objects, const BlockAges& ages, double now) {
    OverlayView view;
    view.legend.title = "Age of the light [s]";
    view.legend.ticks = ticksOf(kAgeScale);
    for (const LitObject& object : objects) {
        if (!object.geometry) continue;
        std::vector<glm::u8vec4>& colours = view.picture.blocks[object.geometry.get()];
        for (const double time : ages.times(*object.geometry))
            colours.push_back(blockColour(viridis(kAgeScale.at(now - time))));
    }
    return view;
}

OverlayView dirtyView(std::span<const LitObject> objects, WorkOfObjects work) {
    struct Shown {
        DirtyStatus::Kind kind;
        std::size_t colour; ///< see kindColour()
        const char* label;
        std::size_t blocks = 0;
    };
    std::array<Shown, 4> kinds{
        {{DirtyStatus::Kind::lights, 0, "direct light"},
         {DirtyStatus::Kind::coming, 3, "computed, about to be shown"},
         {DirtyStatus::Kind::patches, 1, "light that surfaces pass on"},
         {DirtyStatus::Kind::deferred, 6, "deferred: too little to matter yet"}}};
    OverlayView view;
    forEachBlock(objects, work, [&](const LitGeometry& geometry, const DirtyStatus& block) {
        glm::u8vec4 colour(0);
        for (Shown& shown : kinds)
            if (block.kind == shown.kind) {
                colour = blockColour(kindColour(shown.colour));
                ++shown.blocks;
            }
        view.picture.blocks[&geometry].push_back(colour);
    });
    view.legend.title = "Light still to compute [pieces of 64 points]";
    for (const Shown& shown : kinds)
        view.legend.kinds.push_back(
            {kindColour(shown.colour), std::to_string(shown.blocks) + "  " + shown.label});
    return view;
}

OverlayView importanceView(std::span<const LitObject> objects, WorkOfObjects work, double& most) {
    OverlayView view;
    std::size_t open = 0;
    forEachBlock(objects, work, [&](const LitGeometry&, const DirtyStatus& block) {
        open += block.priority > 0;
        most = std::max(most, double(block.priority));
    });
    const double last = most > 0 ? std::pow(10.0, std::ceil(std::log10(most))) : 1;
    const LogScale scale{1e-4 * last, last};
    forEachBlock(objects, work, [&](const LitGeometry& geometry, const DirtyStatus& block) {
        view.picture.blocks[&geometry].push_back(
            block.priority > 0 ? blockColour(viridis(scale.at(double(block.priority))))
                               : glm::u8vec4(0));
    });
    view.legend.title = "What is computed first: " + std::to_string(open) + " pieces wait";
    view.legend.lines = {
        "by what can be seen of it for the work [just visible steps x pixels / ray]"};
    view.legend.ticks = ticksOf(scale);
    return view;
}

OverlayView noImportanceView() {
    OverlayView view;
    view.legend.title = "Only when what I see is computed first (panel Light)";
    return view;
}

std::vector<EmitterAccount> lightsOf(std::vector<EmitterAccount> lights, const std::string& path) {
    const auto isOf = [&](const EmitterAccount& light) {
        return light.path == path || light.path.starts_with(path + "/");
    };
    if (!path.empty() && std::ranges::any_of(lights, isOf))
        std::erase_if(lights, [&](const EmitterAccount& light) { return !isOf(light); });
    return lights;
}

OverlayView blockersView(std::span<const LitObject> objects, const PlacedScene& below,
                         const PlacedScene& scene, std::span<const EmitterAccount> lights,
                         const std::string& of) {
    constexpr std::size_t kMostLights = 4, kMostBlockers = 6;
    constexpr double kLeast = 0.01; // less is not mentioned
    OverlayView view;
    view.legend.title = "Direct light " + of;
    double whole = 0;
    std::map<std::uint32_t, double> taken; // by object [lux]
    for (const EmitterAccount& light : lights) {
        whole += double(luminance(light.unoccluded));
        for (const LightLoss& loss : light.losses)
            taken[loss.object.value] += double(luminance(loss.lux));
        if (luminance(light.unoccluded) > 0 && view.legend.lines.size() < kMostLights)
            view.legend.lines.push_back(lux(luminance(light.arrives)) + " of " +
                                        lux(luminance(light.unoccluded)) + " lux from " +
                                        light.path);
    }
    if (!(whole > 0)) {
        view.legend.lines.push_back("no direct light on this side");
        return view;
    }
    view.legend.lines.push_back("Share of it that an object takes:");
    view.legend.ticks = {{0, "0"}, {0.25f, "25"}, {0.5f, "50"}, {0.75f, "75"}, {1, "100 %"}};
    std::vector<std::pair<double, std::uint32_t>> most;
    for (const auto& [object, loss] : taken) most.emplace_back(loss, object);
    std::sort(most.rbegin(), most.rend());
    for (const auto& [loss, object] : most) {
        if (loss < kLeast * whole || object >= scene.objects.size()) continue;
        const glm::vec3 colour = viridis(float(loss / whole));
        const std::string& path = scene.objects[object].path;
        if (view.legend.kinds.size() < kMostBlockers)
            view.legend.kinds.push_back({colour, lux(float(loss)) + " lux (" +
                                                     lux(float(100 * loss / whole)) +
                                                     " %) taken by " + nameOf(path)});
        if (object >= below.objects.size() || path == "/") continue;
        for (const LitObject& lit : objects)
            if (lit.geometry && lit.path == below.objects[object].path)
                view.picture.blocks[lit.geometry.get()].assign(
                    lit.geometry->blockRevisions().size(), blockColour(colour));
    }
    return view;
}

} // namespace penumbra
