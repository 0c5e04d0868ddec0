#include "viewer/shadowmaps/MapPreview.h"

#include "radiosity/rays/Shaft.h"
#include "viewer/gl/Shaders.h"
#include "viewer/shadowmaps/PreviewMaps.h"

#include <epoxy/gl.h>

#include <glm/gtc/matrix_inverse.hpp>

#include <array>

namespace penumbra {

namespace {

constexpr std::array<const char*, kPreviewSlots> kPoseNames{"posesInMaps[0]", "posesInMaps[1]",
                                                            "posesInMaps[2]", "posesInMaps[3]"};
constexpr std::array<const char*, kPreviewSlots> kNormalNames{
    "normalsInMaps[0]", "normalsInMaps[1]", "normalsInMaps[2]", "normalsInMaps[3]"};

constexpr std::array<const char*, kMostPreviewedByMaps> kLightNames{"lightList[0]", "lightList[1]",
                                                                    "lightList[2]", "lightList[3]"};

} // namespace

struct MapPreview::Impl {
    Impl() : program(previewVertexShader(), screenFragmentShader()) {}

    void setPlaces(const LitItem& item);
    void setLights(unsigned mask) const;
    bool moves(const LitItem& item) const {
        const std::uint32_t object = item.geometry->object().value;
        return object < light.objects.size() && light.objects[object].moves &&
               light.objects[object].geometry.get() == item.geometry;
    }

    ShaderProgram program;
    PreviewMaps maps;
    PreviewLighting light; ///< that the maps are of
};

/// The item's poses now and in the anchors, in the frame of the maps.
void MapPreview::Impl::setPlaces(const LitItem& item) {
    const bool own = moves(item);
    program.set("ownMoves", int(own));
    for (std::size_t s = 0; s <= light.anchors.size(); ++s) {
        glm::dmat4 place = item.toWorld;
        if (s > 0 && own)
            place = light.anchors[s - 1].sceneState->objects[item.geometry->object().value].toWorld;
        place[3] -= glm::dvec4(maps.origin(), 0);
        program.set(kPoseNames[s], glm::mat4(place));
        program.set(kNormalNames[s], glm::mat3(glm::inverseTranspose(glm::dmat3(place))));
    }
}

MapPreview::MapPreview() = default;

MapPreview::~MapPreview() = default;

void MapPreview::update(const PreviewLighting& light, const ShownOf&, const View*) {
    light_ = light;
}

void MapPreview::rest(const PreviewLighting&, const ShownOf&, const View*) {
    light_ = {};
}

std::size_t MapPreview::prepare(GeometryCache& cache) {
    if (!impl_) impl_ = std::make_unique<Impl>();
    impl_->light = light_;
    return impl_->maps.prepare(light_, cache);
}

unsigned MapPreview::reaching(const LitItem& item, const TriangleChunk& chunk) const {
    if (impl_->moves(item)) return (1u << impl_->light.lights.size()) - 1;
    glm::dmat4 place = item.toWorld;
    place[3] -= glm::dvec4(impl_->maps.origin(), 0);
    const Bounds box = transformed(chunk.bounds, place);
    unsigned lights = 0;
    for (const PreviewMaps::Reach& reach : impl_->maps.reaches())
        if (reach.everywhere || shaftMeets(reach.source, box, reach.thing))
            lights |= 1u << reach.index;
    return lights;
}

/// The lights of a mask, one after the other.
void MapPreview::Impl::setLights(unsigned mask) const {
    int count = 0;
    for (int l = 0; l < int(kMostPreviewedByMaps); ++l)
        if (mask >> l & 1) program.set(kLightNames[std::size_t(count++)], l);
    program.set("previewedLights", count);
}

void MapPreview::draw(const std::vector<LitItem>& items, const std::vector<Runs>& runs,
                      TextureCache& textures) {
    const ShaderProgram& program = impl_->program;
    const PreviewLighting& light = impl_->light;
    program.use();
    impl_->maps.bind(program);
    program.set("anchorCount", int(light.anchors.size()));
    std::vector<glm::vec4> exitances, shares(1);
    for (const auto& source : light.lights)
        exitances.emplace_back(source.exitance.r, source.exitance.g, source.exitance.b, 0);
    for (const auto& anchor : light.anchors) shares.emplace_back(anchor.rest, anchor.behind, 0, 0);
    program.set("exitances", exitances);
    program.set("anchorShares", shares);
    glVertexAttrib4f(kFactors, -1, -1, -1, -1); // of surfaces that have none
    glVertexAttrib1f(kBehind, 0);
    const LitItem* last = nullptr;
    for (const Runs& run : runs) {
        const LitItem& item = items[run.item];
        if (&item != last) {
            setPose(program, item.place);
            impl_->setPlaces(item);
            item.gpu->bind();
            last = &item;
        }
        const LitMaterial& material =
            item.geometry->data().materials[item.gpu->ranges()[run.range].material];
        textures.setMaterial(program, material.reflectance, material.emission, material.textures);
        impl_->setLights(run.lights);
        run.runs.draw();
    }
    for (const GLenum unit : {GL_TEXTURE2, GL_TEXTURE1}) {
        glActiveTexture(unit);
        glBindTexture(GL_TEXTURE_2D_ARRAY, 0);
    }
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, 0);
}

} // namespace penumbra
