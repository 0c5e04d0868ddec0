#include "viewer/LivePass.h"

#include "radiosity/Shaft.h"
#include "viewer/LiveMaps.h"
#include "viewer/Shaders.h"

#include <epoxy/gl.h>

#include <glm/gtc/matrix_inverse.hpp>

#include <array>

namespace penumbra {

namespace {

constexpr std::array<const char*, kLiveSlots> kPlaceNames{"livePlaces[0]", "livePlaces[1]",
                                                          "livePlaces[2]", "livePlaces[3]"};
constexpr std::array<const char*, kLiveSlots> kNormalNames{"liveNormals[0]", "liveNormals[1]",
                                                           "liveNormals[2]", "liveNormals[3]"};

constexpr std::array<const char*, kMostLampsByMaps> kLampNames{"lampList[0]", "lampList[1]",
                                                               "lampList[2]", "lampList[3]"};

} // namespace

struct LivePass::Impl {
    Impl() : program(liveVertexShader().c_str(), kScreenFragmentShader) {}

    void setPlaces(const LitItem& item);
    void setLamps(unsigned mask);
    bool moves(const LitItem& item) const {
        const std::uint32_t object = item.geometry->object().value;
        return object < light.objects.size() && light.objects[object].moves &&
               light.objects[object].geometry.get() == item.geometry;
    }

    ShaderProgram program;
    LiveMaps maps;
    LiveLight light;
    LiveStatistics statistics;
};

/// The item's places now and in the anchors, in the frame of the maps.
void LivePass::Impl::setPlaces(const LitItem& item) {
    const bool own = moves(item);
    program.set("ownMoves", int(own));
    for (std::size_t s = 0; s <= light.anchors.size(); ++s) {
        glm::dmat4 place = item.toWorld;
        if (s > 0 && own)
            place =
                light.anchors[s - 1].arrangement->objects[item.geometry->object().value].toWorld;
        place[3] -= glm::dvec4(maps.origin(), 0);
        program.set(kPlaceNames[s], glm::mat4(place));
        program.set(kNormalNames[s], glm::mat3(glm::inverseTranspose(glm::dmat3(place))));
    }
}

LivePass::LivePass() : impl_(std::make_unique<Impl>()) {}

LivePass::~LivePass() = default;

void LivePass::prepare(const LiveLight& light, GeometryCache& cache) {
    impl_->light = light;
    impl_->statistics = {};
    impl_->statistics.maps = impl_->maps.prepare(light, cache);
}

unsigned LivePass::reaching(const LitItem& item, const TriangleChunk& chunk) const {
    if (impl_->moves(item)) return (1u << impl_->light.lamps.size()) - 1;
    glm::dmat4 place = item.toWorld;
    place[3] -= glm::dvec4(impl_->maps.origin(), 0);
    const Bounds box = transformed(chunk.bounds, place);
    unsigned lamps = 0;
    for (const LiveMaps::Reach& reach : impl_->maps.reaches())
        if (reach.everywhere || shaftMeets(reach.lamp, box, reach.thing))
            lamps |= 1u << reach.index;
    return lamps;
}

/// The lamps of a mask, one after the other.
void LivePass::Impl::setLamps(unsigned mask) {
    int count = 0;
    for (int l = 0; l < int(kMostLampsByMaps); ++l)
        if (mask >> l & 1) program.set(kLampNames[std::size_t(count++)], l);
    program.set("liveLamps", count);
}

void LivePass::draw(const std::vector<LitItem>& items, const std::vector<Runs>& runs) {
    const ShaderProgram& program = impl_->program;
    const LiveLight& light = impl_->light;
    program.use();
    impl_->maps.bind(program);
    program.set("liveAnchors", int(light.anchors.size()));
    std::vector<glm::vec4> exitances, shares(1);
    for (const auto& lamp : light.lamps)
        exitances.emplace_back(lamp.exitance.r, lamp.exitance.g, lamp.exitance.b, 0);
    for (const auto& anchor : light.anchors) shares.emplace_back(anchor.rest, anchor.behind, 0, 0);
    program.set("liveExitances", exitances);
    program.set("anchorShares", shares);
    glVertexAttrib4f(kFactors, -1, -1, -1, -1); // of surfaces that have none
    glVertexAttrib1f(kBehind, 0);
    const LitItem* last = nullptr;
    for (const Runs& run : runs) {
        const LitItem& item = items[run.item];
        if (&item != last) {
            setPlace(program, item.place);
            impl_->setPlaces(item);
            item.gpu->bind();
            last = &item;
        }
        const LitMaterial& material =
            item.geometry->data().materials[item.gpu->ranges()[run.range].material];
        program.set("reflectance", material.reflectance);
        program.set("emission", material.emission);
        impl_->setLamps(run.lamps);
        run.runs.draw();
    }
    for (const GLenum unit : {GL_TEXTURE2, GL_TEXTURE1}) {
        glActiveTexture(unit);
        glBindTexture(GL_TEXTURE_2D_ARRAY, 0);
    }
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, 0);
}

const LiveStatistics& LivePass::statistics() const {
    return impl_->statistics;
}

} // namespace penumbra
