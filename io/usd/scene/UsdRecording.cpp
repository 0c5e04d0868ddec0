#include "io/usd/scene/UsdRecording.h"

#include "io/image/AtomicFile.h"
#include "io/usd/layer/UsdAssets.h"
#include "io/usd/text/UsdLayerText.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace penumbra {

namespace {

using Samples = std::vector<std::pair<double, std::string>>;

/// The values of one attribute over time.
class Track {
public:
    /// A value from `code` on; before it the last one held until the code before.
    void put(double code, const std::string& value) {
        if (samples_.empty()) {
            samples_.emplace_back(code, value);
            return;
        }
        const auto [last, before] = samples_.back();
        if (before == value) return;
        if (last == code)
            samples_.pop_back(); // the last of several within one time code counts
        else if (last < code - 1)
            samples_.emplace_back(code - 1, before);
        samples_.emplace_back(code, value);
    }
    const Samples& samples() const { return samples_; }
    bool changes() const { return samples_.size() > 1; }

private:
    Samples samples_;
};

/// A transform as it is written: M = translate * orient * scale.
struct Parts {
    glm::dvec3 translate{0.0};
    glm::dquat orient{1, 0, 0, 0};
    glm::dvec3 scale{1.0};
};

/// None: the axes are sheared, mirrored or flat.
std::optional<Parts> partsOf(const glm::dmat4& matrix) {
    Parts parts;
    parts.translate = glm::dvec3(matrix[3]);
    glm::dmat3 axes(matrix);
    for (int i = 0; i < 3; ++i) {
        parts.scale[i] = glm::length(axes[i]);
        if (!(parts.scale[i] > 0)) return std::nullopt;
        axes[i] /= parts.scale[i];
        if (std::abs(parts.scale[i] - 1) < 1e-14) parts.scale[i] = 1; // of rounding alone
    }
    const double skew = std::abs(glm::dot(axes[0], axes[1])) +
                        std::abs(glm::dot(axes[1], axes[2])) + std::abs(glm::dot(axes[2], axes[0]));
    if (skew > 1e-9 || glm::determinant(axes) < 0) return std::nullopt;
    parts.orient = glm::normalize(glm::quat_cast(axes));
    return parts;
}

/// The transform of one prim over time, both ways it may be written.
struct PoseTrack {
    Track translate, orient, scale, matrix;
    bool rigid = true; ///< translate, orient and scale say it all

    void put(double code, const glm::dmat4& value) {
        matrix.put(code, usdText(value));
        const auto parts = partsOf(value);
        rigid = rigid && parts;
        if (!rigid) return;
        translate.put(code, usdText(parts->translate));
        const glm::dquat& q = parts->orient;
        orient.put(code, usdText(glm::dvec4(q.w, q.x, q.y, q.z)));
        scale.put(code, usdText(parts->scale));
    }
    bool changes() const { return matrix.changes(); }

    void write(UsdLayerText& layer, const std::string& prim, bool absolute) const {
        std::string order = absolute ? "\"!resetXformStack!\", " : "";
        if (rigid) {
            layer.add(prim,
                      usdAttribute("double3", "xformOp:translate:session", translate.samples()));
            layer.add(prim, usdAttribute("quatd", "xformOp:orient:session", orient.samples()));
            order += "\"xformOp:translate:session\", \"xformOp:orient:session\"";
            if (scale.changes() || scale.samples().front().second != "(1, 1, 1)") {
                layer.add(prim, usdAttribute("double3", "xformOp:scale:session", scale.samples()));
                order += ", \"xformOp:scale:session\"";
            }
        } else {
            layer.add(prim,
                      usdAttribute("matrix4d", "xformOp:transform:session", matrix.samples()));
            order += "\"xformOp:transform:session\"";
        }
        layer.add(prim, "uniform token[] xformOpOrder = [" + order + "]");
    }
};

/// A luminance as UsdLux has it: a colour whose largest channel is 1, times an intensity.
struct LightTrack {
    Track colour, intensity;
    void put(double code, Rgb nits) {
        const float most = maxChannel(nits);
        if (most > 0)
            colour.put(code, usdText(glm::vec3(nits.r, nits.g, nits.b) / most));
        else if (colour.samples().empty())
            colour.put(code, "(1, 1, 1)");
        intensity.put(code, usdText(most));
    }
    bool changes() const { return colour.changes() || intensity.changes(); }
};

struct PaintTrack {
    Track diffuse, emissive;
    void put(double code, const Material& material) {
        const Rgb rho = material.reflectance(), nits = material.emission();
        diffuse.put(code, usdText(glm::vec3(rho.r, rho.g, rho.b)));
        emissive.put(code, usdText(glm::vec3(nits.r, nits.g, nits.b)));
    }
    bool changes() const { return diffuse.changes() || emissive.changes(); }
};

/// Something of the scene with what became of it.
template <class Address, class Values>
struct Followed {
    Address address;
    Values track;
    std::uint64_t revision = 0;
};

} // namespace

struct UsdRecording::Impl {
    std::filesystem::path file;
    std::shared_ptr<Scene> scene;
    bool animated = false; ///< the file itself plays: what it moves is to hold still
    std::string defaultPrim, camera;
    bool ownCamera = false;
    std::vector<Followed<UsdAddresses::TransformAddress, PoseTrack>> transforms;
    std::vector<Followed<UsdAddresses::LightAddress, LightTrack>> lights;
    std::vector<Followed<UsdAddresses::Paint, PaintTrack>> paints;
    std::vector<UsdAddresses::Choice> choices;
    PoseTrack eye;
    Track focalLength, aperture, clipping;
    double lastCode = 1;

    void sample(double code, bool all);
    void sample(double code, const glm::dmat4& cameraToWorld, const Lens& lens);
    void writePlaces(UsdLayerText& layer) const;
    void writeLights(UsdLayerText& layer) const;
    void writePaints(UsdLayerText& layer) const;
    void writeCamera(UsdLayerText& layer) const;
};

namespace {

Rgb luminanceOf(const UsdAddresses::LightAddress& light) {
    return light.light ? light.light->luminance() : light.tube->emission();
}
std::uint64_t revisionOf(const UsdAddresses::LightAddress& light) {
    return light.light ? light.light->revision() : light.tube->revision();
}

} // namespace

void UsdRecording::Impl::sample(double code, bool all) {
    for (auto& [address, track, revision] : transforms)
        if (all || revision != address.node->revision()) {
            revision = address.node->revision();
            track.put(code, address.node->matrix());
        }
    for (auto& [address, track, revision] : lights)
        if (all || revision != revisionOf(address)) {
            revision = revisionOf(address);
            track.put(code, luminanceOf(address));
        }
    for (auto& [address, track, revision] : paints)
        if (all || revision != address.material->revision()) {
            revision = address.material->revision();
            track.put(code, *address.material);
        }
}

void UsdRecording::Impl::sample(double code, const glm::dmat4& cameraToWorld, const Lens& lens) {
    glm::dmat4 place = cameraToWorld; // [m] to the file's unit
    place[3] = glm::dvec4(glm::dvec3(place[3]) / scene->metersPerUnit, 1);
    eye.put(code, place);
    focalLength.put(code, usdText(lens.focalLength));
    aperture.put(code, usdText(lens.horizontalAperture));
    const float unit = float(scene->metersPerUnit);
    clipping.put(code, usdText(glm::vec2(lens.clippingRange) / unit));
}

UsdRecording::UsdRecording(const LoadedScene& scene, std::filesystem::path file)
    : impl_(std::make_unique<Impl>()) {
    const UsdAddresses& addresses = scene.addresses;
    impl_->file = std::move(file);
    impl_->scene = scene.scene;
    impl_->animated = scene.animation != nullptr;
    impl_->defaultPrim = addresses.defaultPrim;
    impl_->ownCamera = addresses.eyes.empty();
    impl_->camera = impl_->ownCamera ? "/SessionCamera" : addresses.eyes.front().prim;
    for (const auto& place : addresses.transforms)
        if (place.prim != impl_->camera) impl_->transforms.push_back({place, {}, 0});
    for (const auto& light : addresses.lights) impl_->lights.push_back({light, {}, 0});
    for (const auto& paint : addresses.paints) impl_->paints.push_back({paint, {}, 0});
    impl_->choices = addresses.choices;
    impl_->sample(1, true);
}

UsdRecording::~UsdRecording() = default;

void UsdRecording::sample(double seconds, const glm::dmat4& cameraToWorld, const Lens& lens) {
    const double code = std::max(impl_->lastCode, 1 + std::floor(seconds * kRate));
    impl_->lastCode = code;
    impl_->sample(code, false);
    impl_->sample(code, cameraToWorld, lens);
}

void UsdRecording::Impl::writePlaces(UsdLayerText& layer) const {
    for (const auto& [address, track, revision] : transforms) {
        const bool held = animated && address.node->movable();
        if (!track.changes() && !held) continue;
        if (address.node->movable()) layer.add(address.prim, "bool penumbra:movable = 1");
        track.write(layer, address.prim, false);
    }
    for (const auto& [node, prim] : choices)
        layer.add(prim, std::string("token visibility = ") +
                            (node->visible() ? "\"inherited\"" : "\"invisible\""));
}

void UsdRecording::Impl::writeLights(UsdLayerText& layer) const {
    for (const auto& [address, track, revision] : lights) {
        if (!track.changes() && !animated) continue;
        layer.add(address.prim, usdAttribute("color3f", "inputs:color", track.colour.samples()));
        layer.add(address.prim,
                  usdAttribute("float", "inputs:intensity", track.intensity.samples()));
        for (const char* line :
             {"float inputs:exposure = 0", "float inputs:diffuse = 1", "bool inputs:normalize = 0",
              "bool inputs:enableColorTemperature = 0"})
            layer.add(address.prim, line);
    }
}

void UsdRecording::Impl::writePaints(UsdLayerText& layer) const {
    for (const auto& [address, track, revision] : paints) {
        if (!track.changes() && !(animated && !address.shader.empty())) continue;
        std::string shader = address.shader;
        if (shader.empty()) {
            if (address.meshes.empty()) continue; // see missed()
            const std::string material = address.meshes.front() + "/SessionPaint";
            shader = material + "/Surface";
            layer.define(material, "Material");
            layer.define(shader, "Shader");
            layer.add(material, "token outputs:surface.connect = <" + shader + ".outputs:surface>");
            layer.add(shader, "uniform token info:id = \"UsdPreviewSurface\"");
            layer.add(shader, "token outputs:surface");
            for (const std::string& mesh : address.meshes)
                layer.add(mesh, "rel material:binding = <" + material + ">");
        }
        layer.add(shader, usdAttribute("color3f", "inputs:diffuseColor", track.diffuse.samples()));
        layer.add(shader,
                  usdAttribute("color3f", "inputs:emissiveColor", track.emissive.samples()));
        for (const char* input : {"inputs:diffuseColor", "inputs:emissiveColor"})
            layer.add(shader, std::string("color3f ") + input + ".connect = None");
        layer.add(shader, "float inputs:metallic = 0");
        layer.add(shader, "float inputs:opacity = 1");
    }
}

void UsdRecording::Impl::writeCamera(UsdLayerText& layer) const {
    if (eye.matrix.samples().empty()) return;
    if (ownCamera) layer.define(camera, "Camera");
    layer.add(camera, usdAttribute("float", "focalLength", focalLength.samples()));
    layer.add(camera, usdAttribute("float", "horizontalAperture", aperture.samples()));
    layer.add(camera, usdAttribute("float2", "clippingRange", clipping.samples()));
    eye.write(layer, camera, true);
}

std::string UsdRecording::text(const std::filesystem::path& path) const {
    UsdLayerText layer;
    const Scene& scene = *impl_->scene;
    if (!impl_->defaultPrim.empty())
        layer.metadata("defaultPrim = " + usdQuoted(impl_->defaultPrim));
    layer.metadata("doc = \"A recorded session of Penumbra.\"");
    layer.metadata("endTimeCode = " + usdText(impl_->lastCode));
    layer.metadata("metersPerUnit = " + usdText(scene.metersPerUnit));
    layer.metadata("startTimeCode = 1");
    layer.metadata("subLayers = [\n        @" + relativeAsset(impl_->file, path) + "@\n    ]");
    layer.metadata("timeCodesPerSecond = " + usdText(kRate));
    layer.metadata(std::string("upAxis = ") + (scene.upAxis == UpAxis::z ? "\"Z\"" : "\"Y\""));
    impl_->writePlaces(layer);
    impl_->writeLights(layer);
    impl_->writePaints(layer);
    impl_->writeCamera(layer);
    return layer.text();
}

void UsdRecording::write(const std::filesystem::path& layer) const {
    writeFileAtomically(layer.string(), text(layer));
}

std::vector<std::string> UsdRecording::missed() const {
    std::vector<std::string> names;
    for (const auto& [address, track, revision] : impl_->paints)
        if (track.changes() && address.shader.empty() && address.meshes.empty())
            names.push_back(address.material->name());
    return names;
}

} // namespace penumbra
