#include "io/usd/recording/UsdRecording.h"

#include "io/image/AtomicFile.h"
#include "io/usd/layer/UsdAssets.h"
#include "io/usd/layer/UsdPath.h"
#include "io/usd/layer/UsdPrimSpecs.h"
#include "io/usd/recording/UsdTrack.h"
#include "io/usd/text/UsdLayerWriter.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace penumbra {

namespace {

const UsdListEdits<std::string>& noConnection() {
    static const UsdListEdits<std::string> kNone{{UsdListOp::explicitly, {}}};
    return kNone;
}

/// A colour of a material: a constant, or the factor of a texture.
struct ColourTrack {
    UsdTrack constant{"color3f"}, scale{"float4"};

    void put(double code, Rgb factor, const Texture* texture, const UsdTextureAddress& address) {
        constant.put(code, listOf(texture ? factor * texture->mean() : factor));
        if (texture && !address.shader.empty())
            scale.put(code, std::vector{factor.r, factor.g, factor.b, address.alpha});
    }
    bool changes() const { return constant.changes() || scale.changes(); }

    void write(UsdLayer& layer, const std::string& surface, const char* input,
               const UsdTextureAddress& address) const {
        const bool textured = !scale.empty();
        UsdPrimSpec& spec = overAt(layer, textured ? address.shader : surface);
        (textured ? scale : constant).write(spec, textured ? "inputs:scale" : input);
        spec.properties.back().targets = noConnection();
    }
};

struct PaintTrack {
    ColourTrack diffuse, emissive;
    void put(double code, const UsdAddresses::Paint& paint) {
        const Material& material = *paint.material;
        const MaterialTextures& textures = material.textures();
        diffuse.put(code, material.reflectance(), textures.reflectance.get(), paint.reflectance);
        emissive.put(code, material.emission(), textures.emission.get(), paint.emission);
    }
    bool changes() const { return diffuse.changes() || emissive.changes(); }
};

const char* visibilityOf(bool visible) {
    return visible ? "inherited" : "invisible";
}

/// Whether something is there.
struct PresenceTrack {
    UsdTrack visibility{"token"};
    bool now = true;
    void put(double code, bool isThere) {
        now = isThere;
        visibility.put(code, std::vector<std::string>{visibilityOf(now)});
    }
};

/// Where something that is part of a thing is in a copy of it.
std::string counterpart(const std::string& prim, const UsdAddresses::Presence& copy) {
    return movedUsdPath(prim, copy.source, copy.prim);
}

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
    bool timeless = false; ///< edits alone
    std::string defaultPrim, camera;
    bool ownCamera = false;
    std::vector<Followed<UsdAddresses::TransformAddress, UsdPoseTrack>> transforms;
    std::vector<Followed<UsdAddresses::LightAddress, UsdLightTrack>> lights;
    std::vector<Followed<UsdAddresses::Paint, PaintTrack>> paints;
    std::vector<UsdAddresses::Choice> choices;
    using FollowedPresence = Followed<UsdAddresses::Presence, PresenceTrack>;
    std::vector<FollowedPresence> presences;
    /// How many of each are followed.
    struct {
        std::size_t transforms = 0, lights = 0, presences = 0;
    } known;
    std::vector<const Node*> hidden; ///< of what is not there
    UsdPoseTrack eye;
    UsdTrack focalLength{"float"}, aperture{"float"}, clipping{"float2"};
    double lastCode = 1;

    void follow(const UsdAddresses& addresses);
    void sample(double code, bool all);
    void sample(double code, const glm::dmat4& cameraToWorld, const Lens& lens);
    bool isOfCopy(const std::string& prim) const;
    bool leftOut(const std::string& prim) const;
    std::vector<const FollowedPresence*> copies(const std::set<std::string>& prims) const;
    std::set<std::string> followedPrims() const;
    void writeCopy(UsdLayer& layer, const FollowedPresence& copy) const;
    void matchCopy(UsdLayer& layer, const UsdAddresses::Presence& copy,
                   const std::set<std::string>& prims) const;
    void writePresences(UsdLayer& layer) const;
    void writePlaces(UsdLayer& layer) const;
    void writeObjects(UsdLayer& layer) const;
    void writeLights(UsdLayer& layer) const;
    void writePaints(UsdLayer& layer) const;
    void writeCamera(UsdLayer& layer) const;
};

namespace {

Rgb luminanceOf(const UsdAddresses::LightAddress& light) {
    return light.light ? light.light->luminance() : light.tube->emission();
}
std::uint64_t revisionOf(const UsdAddresses::LightAddress& light) {
    return light.light ? light.light->revision() : light.tube->revision();
}

} // namespace

/// What comes later has been as it is now from the beginning, but for what was not there.
void UsdRecording::Impl::follow(const UsdAddresses& addresses) {
    for (; known.transforms < addresses.transforms.size(); ++known.transforms) {
        const auto& place = addresses.transforms[known.transforms];
        if (place.prim == camera) continue;
        transforms.push_back({place, {}, 0});
        transforms.back().track.put(1, place.node->matrix());
    }
    for (; known.lights < addresses.lights.size(); ++known.lights) {
        lights.push_back({addresses.lights[known.lights], {}, 0});
        lights.back().track.put(1, luminanceOf(lights.back().address));
    }
    for (; known.presences < addresses.presences.size(); ++known.presences) {
        presences.push_back({addresses.presences[known.presences], {}, 0});
        presences.back().track.put(1, presences.back().address.source.empty());
    }
}

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
            track.put(code, address);
        }
    for (auto& [address, track, revision] : presences)
        if (all || revision != address.parent->revision()) {
            revision = address.parent->revision();
            track.put(code, address.parent->has(address.node));
        }
}

void UsdRecording::Impl::sample(double code, const glm::dmat4& cameraToWorld, const Lens& lens) {
    glm::dmat4 place = cameraToWorld; // [m] to the file's unit
    place[3] = glm::dvec4(glm::dvec3(place[3]) / scene->metersPerUnit, 1);
    eye.put(code, place);
    focalLength.put(code, std::vector{lens.focalLength});
    aperture.put(code, std::vector{lens.horizontalAperture});
    const float unit = float(scene->metersPerUnit);
    clipping.put(code, std::vector{lens.clippingRange.x / unit, lens.clippingRange.y / unit});
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
    for (const auto& paint : addresses.paints) impl_->paints.push_back({paint, {}, 0});
    impl_->choices = addresses.choices;
    impl_->follow(addresses);
    impl_->sample(1, true);
}

UsdRecording::~UsdRecording() = default;

void UsdRecording::sample(double seconds, const glm::dmat4& cameraToWorld, const Lens& lens) {
    const double code = std::max(impl_->lastCode, 1 + std::floor(seconds * kRate));
    impl_->lastCode = code;
    impl_->sample(code, false);
    impl_->sample(code, cameraToWorld, lens);
}

void UsdRecording::follow(const UsdAddresses& addresses) {
    impl_->follow(addresses);
}

void UsdRecording::takeEdits(std::span<const Node* const> hidden) {
    impl_->hidden.assign(hidden.begin(), hidden.end());
    impl_->sample(1, false);
    impl_->timeless = true;
    impl_->animated = false; // what it moves goes on
}

bool UsdRecording::Impl::isOfCopy(const std::string& prim) const {
    return std::any_of(presences.begin(), presences.end(), [&](const auto& copy) {
        return !copy.address.source.empty() && isUsdPathWithin(prim, copy.address.prim);
    });
}

/// Whether a layer of edits has nothing of a prim: of a copy that is not there.
bool UsdRecording::Impl::leftOut(const std::string& prim) const {
    return timeless && std::any_of(presences.begin(), presences.end(), [&](const auto& copy) {
               return !copy.address.source.empty() && !copy.track.now &&
                      isUsdPathWithin(prim, copy.address.prim);
           });
}

/// The copies that are written: those that are there, and what they are copies of.
/// \param prims followedPrims()
std::vector<const UsdRecording::Impl::FollowedPresence*>
UsdRecording::Impl::copies(const std::set<std::string>& prims) const {
    std::vector<const FollowedPresence*> written;
    for (std::size_t i = presences.size(); i-- > 0;) {
        const FollowedPresence& one = presences[i];
        const auto& [prim, source] = std::tie(one.address.prim, one.address.source);
        if (source.empty()) continue;
        const auto needs = [&, &p = prim](const FollowedPresence* later) {
            return isUsdPathWithin(later->address.source, p) ||
                   (isUsdPathWithin(p, later->address.source) &&
                    prims.contains(counterpart(p, later->address)));
        };
        if (!timeless || one.track.now || std::any_of(written.begin(), written.end(), needs))
            written.push_back(&one);
    }
    return written;
}

std::set<std::string> UsdRecording::Impl::followedPrims() const {
    std::set<std::string> prims;
    for (const auto& place : transforms) prims.insert(place.address.prim);
    for (const auto& light : lights) prims.insert(light.address.prim);
    return prims;
}

void UsdRecording::Impl::writeCopy(UsdLayer& layer, const FollowedPresence& copy) const {
    UsdPrimSpec& prim = overAt(layer, copy.address.prim);
    prim.specifier = UsdSpecifier::def;
    addMetadata(prim.metadata, "active", copy.track.now || !timeless);
    addMetadata(prim.metadata, "instanceable", false);
    if (!prim.arcs) prim.arcs = std::make_unique<UsdArcs>();
    UsdReference reference;
    reference.path = copy.address.source;
    prim.arcs->references = {{UsdListOp::prepend, {reference}}};
    copy.track.visibility.write(prim, "visibility");
}

/// A reference brings what its target has now: the copy has what that had when it was made.
void UsdRecording::Impl::matchCopy(UsdLayer& layer, const UsdAddresses::Presence& copy,
                                   const std::set<std::string>& prims) const {
    const auto presenceOf = [&](const std::string& prim) {
        return std::find_if(presences.begin(), presences.end(),
                            [&](const auto& one) { return one.address.prim == prim; });
    };
    for (const std::string& prim : prims) {
        if (prim == copy.source || !isUsdPathWithin(prim, copy.source)) continue;
        const std::string same = counterpart(prim, copy);
        if (presenceOf(same) != presences.end()) continue; // is written by itself
        const bool has = prims.contains(same);
        const auto source = presenceOf(prim);
        if (has && source == presences.end()) continue;
        UsdPrimSpec& spec = overAt(layer, same);
        addMetadata(spec.metadata, "active", has);
        if (has) addText(spec, "token", "visibility", visibilityOf(true));
    }
}

void UsdRecording::Impl::writePresences(UsdLayer& layer) const {
    const std::set<std::string> prims = followedPrims();
    for (const FollowedPresence* const copy : copies(prims)) {
        writeCopy(layer, *copy);
        matchCopy(layer, copy->address, prims);
    }
    for (const auto& [address, track, revision] : presences) {
        const bool untold = address.prim.empty() || !address.source.empty(); // see missed()
        if (untold || !track.visibility.changes() || leftOut(address.prim)) continue;
        if (timeless && track.now) continue;
        UsdPrimSpec& prim = overAt(layer, address.prim);
        const bool hides = std::ranges::find(hidden, address.node.get()) != hidden.end();
        if (!timeless)
            track.visibility.write(prim, "visibility");
        else if (hides)
            addText(prim, "token", "visibility", visibilityOf(false));
        else
            addMetadata(prim.metadata, "active", false);
    }
}

void UsdRecording::Impl::writePlaces(UsdLayer& layer) const {
    for (const auto& [address, track, revision] : transforms) {
        const bool held = (animated && address.animated) || isOfCopy(address.prim);
        if ((!track.changes() && !held) || leftOut(address.prim)) continue;
        track.write(overAt(layer, address.prim), false);
    }
    if (timeless) return;
    for (const auto& [node, prim] : choices)
        addText(overAt(layer, prim), "token", "visibility", visibilityOf(node->visible()));
}

/// Where objects begin depends on where things are (UsdObjects). Those that stand elsewhere or have
/// come, and those above and below them, are to be found again as they are; also those above what
/// has gone.
void UsdRecording::Impl::writeObjects(UsdLayer& layer) const {
    std::vector<std::string> placed, gone;
    for (const auto& [address, track, revision] : transforms)
        if (track.changes()) placed.push_back(address.prim);
    for (const auto& [address, track, revision] : presences)
        if (track.visibility.changes() && !address.prim.empty())
            (address.source.empty() ? gone : placed).push_back(address.prim);
    for (const auto& [address, track, revision] : transforms) {
        const std::string& prim = address.prim;
        if (!address.node->beginsObject() || leftOut(prim)) continue;
        const bool written =
            std::ranges::any_of(placed,
                                [&](const std::string& one) {
                                    return isUsdPathWithin(prim, one) || isUsdPathWithin(one, prim);
                                }) ||
            std::ranges::any_of(gone, [&](const std::string& one) {
                return one != prim && isUsdPathWithin(one, prim);
            });
        if (written) addBool(overAt(layer, prim), "penumbra:movable", !address.apart);
    }
}

void UsdRecording::Impl::writeLights(UsdLayer& layer) const {
    for (const auto& [address, track, revision] : lights) {
        const bool held = animated || isOfCopy(address.prim);
        if ((!track.changes() && !held) || leftOut(address.prim)) continue;
        track.write(overAt(layer, address.prim));
    }
}

namespace {

void define(UsdPrimSpec& prim, const char* type) {
    prim.specifier = UsdSpecifier::def;
    prim.typeName = type;
}

/// A material for meshes that have none of their own. \return the path of its shader
std::string addPaint(UsdLayer& layer, const std::vector<std::string>& meshes) {
    const std::string path = meshes.front() + "/SessionPaint";
    std::string shader = path + "/Surface";
    UsdPrimSpec& material = overAt(layer, path);
    define(material, "Material");
    addConnection(material, "token", "outputs:surface", shader + ".outputs:surface");
    UsdPrimSpec& surface = overAt(layer, shader);
    define(surface, "Shader");
    addText(surface, "token", "info:id", "UsdPreviewSurface").uniform = true;
    declareAttribute(surface, "token", "outputs:surface");
    for (const std::string& mesh : meshes)
        addRelationship(overAt(layer, mesh), "material:binding", path);
    return shader;
}

} // namespace

void UsdRecording::Impl::writePaints(UsdLayer& layer) const {
    for (const auto& [address, track, revision] : paints) {
        if (!track.changes() && !(animated && !address.shader.empty())) continue;
        std::string shader = address.shader;
        if (shader.empty()) {
            if (address.meshes.empty()) continue; // see missed()
            shader = addPaint(layer, address.meshes);
        }
        track.diffuse.write(layer, shader, "inputs:diffuseColor", address.reflectance);
        track.emissive.write(layer, shader, "inputs:emissiveColor", address.emission);
        if (address.covering && !animated) continue;
        UsdPrimSpec& surface = overAt(layer, shader);
        addFloat(surface, "inputs:metallic", 0);
        surface.properties.back().targets = noConnection();
        addFloat(surface, "inputs:opacity", 1);
        surface.properties.back().targets = noConnection();
    }
}

void UsdRecording::Impl::writeCamera(UsdLayer& layer) const {
    if (eye.matrix.empty()) return;
    UsdPrimSpec& prim = overAt(layer, camera);
    if (ownCamera) define(prim, "Camera");
    focalLength.write(prim, "focalLength");
    aperture.write(prim, "horizontalAperture");
    clipping.write(prim, "clippingRange");
    eye.write(prim, true);
}

std::string UsdRecording::text(const std::filesystem::path& path) const {
    UsdLayer layer;
    const Scene& scene = *impl_->scene;
    UsdDictionary& metadata = layer.metadata;
    if (!impl_->defaultPrim.empty())
        addMetadata(metadata, "defaultPrim", UsdKind::token, impl_->defaultPrim);
    const bool timeless = impl_->timeless;
    addMetadata(metadata, "doc", UsdKind::string,
                timeless ? "Edits made in Penumbra." : "A recorded session of Penumbra.");
    addMetadata(metadata, "endTimeCode", timeless ? scene.endTimeCode : impl_->lastCode);
    addMetadata(metadata, "metersPerUnit", scene.metersPerUnit);
    addMetadata(metadata, "startTimeCode", timeless ? scene.startTimeCode : 1);
    addMetadata(metadata, "timeCodesPerSecond", timeless ? scene.timeCodesPerSecond : kRate);
    addMetadata(metadata, "upAxis", UsdKind::token, scene.upAxis == UpAxis::z ? "Z" : "Y");
    layer.subLayers.push_back({relativeAsset(impl_->file, path), {}, {}});
    impl_->writePresences(layer);
    impl_->writePlaces(layer);
    impl_->writeObjects(layer);
    impl_->writeLights(layer);
    impl_->writePaints(layer);
    impl_->writeCamera(layer);
    return usdLayerText(layer);
}

void UsdRecording::write(const std::filesystem::path& layer) const {
    writeFileAtomically(layer.string(), text(layer));
}

std::vector<std::string> UsdRecording::missed() const {
    std::vector<std::string> names;
    for (const auto& [address, track, revision] : impl_->paints)
        if (track.changes() && address.shader.empty() && address.meshes.empty())
            names.push_back(address.material->name());
    for (const auto& [address, track, revision] : impl_->presences)
        if (address.prim.empty() && track.visibility.changes())
            names.push_back(address.node->name());
    return names;
}

} // namespace penumbra
