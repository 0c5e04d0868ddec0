#include "io/usd/scene/UsdTracks.h"

#include "io/usd/scene/UsdCamera.h"
#include "io/usd/scene/UsdLight.h"
#include "io/usd/scene/UsdXform.h"
#include "scenegraph/Mesh.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <string_view>
#include <utility>

namespace penumbra {

namespace {

// Whether some property whose name begins so changes with time.
bool changes(const UsdPrim& prim, std::string_view prefix) {
    for (const UsdOpinion& opinion : prim.opinions)
        for (const UsdProperty& property : opinion.spec->properties)
            if (property.name.starts_with(prefix) && UsdStage::animated(prim, property.name))
                return true;
    return false;
}

bool anythingChangesBelow(const UsdStage& stage, const UsdPrim& root) {
    std::vector<const UsdPrim*> open{&root};
    while (!open.empty()) {
        const UsdPrim& prim = *open.back();
        open.pop_back();
        if (changes(prim, "")) return true;
        for (const std::uint32_t child : prim.children) open.push_back(&stage.prims()[child]);
    }
    return false;
}

bool equal(const Lens& a, const Lens& b) {
    return a.focalLength == b.focalLength && a.horizontalAperture == b.horizontalAperture &&
           a.verticalAperture == b.verticalAperture &&
           a.horizontalApertureOffset == b.horizontalApertureOffset &&
           a.verticalApertureOffset == b.verticalApertureOffset &&
           a.clippingRange == b.clippingRange && a.perspective == b.perspective;
}

} // namespace

bool usdHidden(const UsdAttributes& attributes) {
    return attributes.text("visibility", "inherited") == "invisible";
}

bool UsdTracks::empty() const {
    return transforms_.empty() && switches_.empty() && lights_.empty() && cameras_.empty() &&
           materials_.empty() &&
           std::ranges::none_of(meshLights_, [](const auto& track) { return track.changes; });
}

void UsdTracks::addTransform(std::shared_ptr<Transform> node, const UsdPrim& prim,
                             const UsdFrame& parent, std::optional<glm::dvec3> size) {
    transforms_.push_back({std::move(node), &prim, parent, size});
}

void UsdTracks::addSwitch(std::shared_ptr<Switch> node, const UsdPrim& prim) {
    switches_.push_back({std::move(node), &prim});
}

void UsdTracks::addLight(const NodePtr& node, const UsdAttributes& loaded, const UsdFrame& frame) {
    if (!changes(loaded.prim(), "inputs:") && !frame.moves()) return;
    LightTrack track{std::dynamic_pointer_cast<Light>(node), nullptr, loaded, frame};
    if (const auto mesh = std::dynamic_pointer_cast<Mesh>(node)) track.tube = mesh->materialOf(0);
    lights_.push_back(std::move(track));
}

void UsdTracks::addMeshLight(UsdMeshLight light, const UsdPrim& prim, const UsdFrame& frame,
                             UsdPolygons polygons) {
    meshLights_.push_back(
        {std::move(light), &prim, frame, std::move(polygons), changes(prim, "inputs:")});
}

void UsdTracks::addCamera(std::shared_ptr<Camera> node, const UsdPrim& prim) {
    if (changes(prim, "")) cameras_.push_back({std::move(node), &prim});
}

void UsdTracks::addMaterials(const UsdMaterials& materials) {
    for (const auto& [path, surface] : materials.made())
        if (const UsdPrim* prim = stage_->find(path))
            if (surface.material && anythingChangesBelow(*stage_, *prim))
                materials_.push_back({surface.material, path, surface.shader});
}

void UsdTracks::warnOfSamples(UsdTime loaded, Diagnostics& diagnostics) const {
    UsdSampleCheck check(loaded, diagnostics);
    for (const TransformTrack& track : transforms_) checkUsdTransform(*track.prim, check);
    for (const LightTrack& track : lights_) checkUsdLight(track.loaded.prim(), check);
    for (const MeshLightTrack& track : meshLights_) checkUsdLight(*track.prim, check);
    for (const CameraTrack& track : cameras_) checkUsdLens(*track.prim, check);
    for (const MaterialTrack& track : materials_)
        if (const UsdPrim* shader = stage_->find(track.shader))
            checkUsdShader(*stage_, *shader, check);
}

// All diagnostics below were reported by the load and by warnOfSamples().
void UsdTracks::setTime(double timeCode) {
    Diagnostics reported;
    setTransforms(timeCode);
    for (const SwitchTrack& track : switches_) {
        const bool visible = !usdHidden(UsdAttributes(*track.prim, timeCode));
        if (visible != track.node->visible()) track.node->setVisible(visible);
    }
    for (const CameraTrack& track : cameras_) {
        const Lens lens = usdLens(UsdAttributes(*track.prim, timeCode), reported);
        if (!equal(lens, track.node->lens())) track.node->setLens(lens);
    }
    setMaterials(timeCode);
    setLights(timeCode); // of meshes: once their materials and frames are as they will be
}

void UsdTracks::setTransforms(double timeCode) {
    Diagnostics reported;
    for (const TransformTrack& track : transforms_) {
        const UsdLocalTransform local =
            usdLocalTransform(UsdAttributes(*track.prim, timeCode), reported);
        glm::dmat4 matrix =
            local.resetsStack ? relativeToParent(local, track.parent.toWorld()) : local.matrix;
        if (track.size)
            matrix = glm::scale(matrix, usdLightSize({*track.prim, timeCode}) / *track.size);
        if (matrix != track.node->matrix()) track.node->setMatrix(matrix);
    }
}

void UsdTracks::setLights(double timeCode) {
    Diagnostics reported;
    const auto luminance = [&](const UsdPrim& prim, const auto& area) {
        const UsdAttributes attributes(prim, timeCode);
        const bool sized = attributes.flag("inputs:normalize", false);
        return usdLightLuminance(attributes, sized ? area(attributes) : 1, reported);
    };
    for (const LightTrack& track : lights_) {
        // Where its size changes its frame does.
        const Rgb now = luminance(track.loaded.prim(), [&](const UsdAttributes&) {
            return usdLightArea(track.loaded, track.frame.toWorld());
        });
        if (track.light && track.light->luminance() != now) track.light->setLuminance(now);
        if (track.tube && track.tube->emission() != now) track.tube->setEmission(now);
    }
    for (const MeshLightTrack& track : meshLights_)
        track.light.set(luminance(*track.prim, [&](const UsdAttributes&) {
            return areaOf(track.polygons, glm::dmat3(track.frame.toWorld()));
        }));
}

void UsdTracks::setMaterials(double timeCode) {
    if (materials_.empty()) return;
    Diagnostics reported;
    UsdMaterials now(*stage_, timeCode, reported, textures_.get());
    for (const MaterialTrack& track : materials_) {
        const UsdSurface& surface = now.at(track.path);
        if (!surface.material) continue;
        const Rgb reflectance = surface.material->reflectance();
        const Rgb emission = surface.material->emission();
        if (track.material->reflectance() != reflectance)
            track.material->setReflectance(reflectance);
        if (track.material->emission() != emission) track.material->setEmission(emission);
    }
}

} // namespace penumbra
