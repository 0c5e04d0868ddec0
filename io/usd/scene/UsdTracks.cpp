#include "io/usd/scene/UsdTracks.h"

#include "io/usd/scene/UsdCamera.h"
#include "io/usd/scene/UsdLight.h"
#include "io/usd/scene/UsdXform.h"
#include "scenegraph/Mesh.h"

#include <string_view>

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
           materials_.empty();
}

void UsdTracks::addTransform(std::shared_ptr<Transform> node, const UsdPrim& prim,
                             const UsdFrame& parent) {
    transforms_.push_back({std::move(node), &prim, parent});
}

void UsdTracks::addSwitch(std::shared_ptr<Switch> node, const UsdPrim& prim) {
    switches_.push_back({std::move(node), &prim});
}

void UsdTracks::addLight(const NodePtr& node, const UsdPrim& prim, const UsdFrame& frame) {
    if (!changes(prim, "inputs:") && !frame.moves()) return;
    LightTrack track{std::dynamic_pointer_cast<Light>(node), nullptr, &prim, frame};
    if (const auto mesh = std::dynamic_pointer_cast<Mesh>(node)) track.tube = mesh->materialOf(0);
    lights_.push_back(std::move(track));
}

void UsdTracks::addCamera(std::shared_ptr<Camera> node, const UsdPrim& prim) {
    if (changes(prim, "")) cameras_.push_back({std::move(node), &prim});
}

void UsdTracks::addMaterials(const UsdMaterials& materials) {
    for (const auto& [path, surface] : materials.made())
        if (const UsdPrim* prim = stage_->find(path))
            if (surface.material && anythingChangesBelow(*stage_, *prim))
                materials_.push_back({surface.material, path});
}

void UsdTracks::warnOfSamples(UsdTime loaded, Diagnostics& diagnostics) const {
    UsdSampleCheck check(loaded, diagnostics);
    for (const TransformTrack& track : transforms_) checkUsdTransform(*track.prim, check);
    for (const LightTrack& track : lights_) checkUsdLight(*track.prim, check);
    for (const CameraTrack& track : cameras_) checkUsdLens(*track.prim, check);
}

void UsdTracks::setTime(double timeCode) {
    Diagnostics ignored; // all was reported by the load and by warnOfSamples()
    for (const TransformTrack& track : transforms_) {
        const UsdLocalTransform local =
            usdLocalTransform(UsdAttributes(*track.prim, timeCode), ignored);
        const glm::dmat4 matrix =
            local.resetsStack ? relativeToParent(local, track.parent.toWorld()) : local.matrix;
        if (matrix != track.node->matrix()) track.node->setMatrix(matrix);
    }
    for (const SwitchTrack& track : switches_) {
        const bool visible = !usdHidden(UsdAttributes(*track.prim, timeCode));
        if (visible != track.node->visible()) track.node->setVisible(visible);
    }
    for (const LightTrack& track : lights_) {
        const UsdAttributes attributes(*track.prim, timeCode);
        const bool sized = attributes.flag("inputs:normalize", false);
        const double area = sized ? usdLightArea(attributes, track.frame.toWorld()) : 1;
        const Rgb luminance = usdLightLuminance(attributes, area, ignored);
        if (track.light && track.light->luminance() != luminance)
            track.light->setLuminance(luminance);
        if (track.tube && track.tube->emission() != luminance) track.tube->setEmission(luminance);
    }
    for (const CameraTrack& track : cameras_) {
        const Lens lens = usdLens(UsdAttributes(*track.prim, timeCode), ignored);
        if (!equal(lens, track.node->lens())) track.node->setLens(lens);
    }
    if (materials_.empty()) return;
    UsdMaterials now(*stage_, timeCode, ignored, textures_.get());
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
