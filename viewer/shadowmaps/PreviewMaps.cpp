#include "viewer/shadowmaps/PreviewMaps.h"

#include "radiosity/rays/Shaft.h"
#include "viewer/preview/SceneStates.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace penumbra {

namespace {

constexpr int kLayerSize = 1024;               // [texels]
constexpr int kTightTiles = 4, kCubeTiles = 5; // a side: 16 points, 4 points of 6 faces
constexpr int kCubePoints = 2;
constexpr float kFixedNear = 0.01f; // [m]; nearer to a light nothing casts shadows

/// A sphere around a light.
glm::vec4 sphereOf(const Emitter& source) {
    if (source.kind != Emitter::Kind::polygons) return {source.centre, source.radius};
    Bounds box;
    for (const auto& polygon : source.polygons)
        for (const glm::vec3 corner : polygon) box.add(corner);
    return {box.centre(), 0.5f * box.diagonal()};
}

Bounds boxOf(const Emitter& source) {
    Bounds box;
    for (const auto& polygon : source.polygons)
        for (const glm::vec3 corner : polygon) box.add(corner);
    if (source.kind != Emitter::Kind::polygons) {
        box.add(source.centre - source.radius);
        box.add(source.centre + source.radius);
    }
    return box;
}

/// What of a light's row does not depend on maps.
void describe(const Emitter& source, std::array<glm::vec4, kPreviewColumns>& row) {
    glm::vec3 normal = source.axis;
    if (source.kind == Emitter::Kind::polygons) {
        const auto& p = source.polygons.front();
        row[0].x = float(PreviewKind::quad);
        for (std::size_t i = 0; i < 4; ++i) row[1 + i] = glm::vec4(p[std::min(i, p.size() - 1)], 0);
        normal = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
    } else {
        const bool disk = source.kind == Emitter::Kind::disk;
        row[0].x = float(disk ? PreviewKind::disk : PreviewKind::sphere);
        row[1] = glm::vec4(source.centre, source.radius);
        row[2] = glm::vec4(source.axis, 0);
        if (!disk) normal = glm::vec3(0);
    }
    row[5] = sphereOf(source);
    row[10] = glm::vec4(normal, 0);
}

void describe(const ShadowView& view, int tileSize, std::array<glm::vec4, kPreviewColumns>& row) {
    row[7] = glm::vec4(view.right, 0);
    row[8] = glm::vec4(view.up, 0);
    row[9] = glm::vec4(view.axis, view.width / float(tileSize));
    for (std::size_t k = 0; k < view.points.size(); ++k) {
        const ShadowPoint& point = view.points[k];
        row[12 + 2 * k] = glm::vec4(point.origin, point.scale.x);
        row[13 + 2 * k] = glm::vec4(point.scale.y, point.offset, 0);
    }
}

} // namespace

PreviewMaps::PreviewMaps() : table_(makeTexture()) {}

/// The light in the frame of the maps.
Emitter PreviewMaps::placedLight(const Emitter& source) const {
    Emitter placed = source;
    const glm::vec3 shift(origin_);
    for (auto& polygon : placed.polygons)
        for (glm::vec3& corner : polygon) corner -= shift;
    placed.centre -= shift;
    return placed;
}

/// A box around what moves.
Bounds PreviewMaps::thingIn(const PreviewLighting& light, const SceneState& at) const {
    Bounds box;
    for (std::size_t o = 0; o < light.objects.size(); ++o) {
        const PreviewLighting::Object& object = light.objects[o];
        if (!object.moves || !object.geometry || !at.objects[o].visible) continue;
        glm::dmat4 place = at.objects[o].toWorld;
        place[3] -= glm::dvec4(origin_, 0);
        box.add(transformed(object.geometry->bounds(), place));
    }
    return box;
}

void PreviewMaps::startAnew(const PreviewLighting& light) {
    std::vector<bool> moves, lightMoves;
    std::vector<const LitGeometry*> geometries;
    for (const auto& object : light.objects) {
        moves.push_back(object.moves);
        geometries.push_back(object.geometry.get());
    }
    for (const auto& source : light.lights) lightMoves.push_back(source.moves);
    const int layers = int(kPreviewSlots * light.lights.size());
    bool anew = moved_.require(layers, kLayerSize);
    anew |= fixed_.require(layers, kLayerSize);
    if (!anew && moves == moves_ && lightMoves == lightMoves_ && geometries == geometries_ &&
        points_ == light.points)
        return;
    moves_ = std::move(moves);
    lightMoves_ = std::move(lightMoves);
    geometries_ = std::move(geometries);
    points_ = light.points;
    groups_ = {};
    origin_ = glm::dvec3(0);
    const Bounds thing = thingIn(light, *light.now);
    if (!thing.empty()) origin_ = glm::round(glm::dvec3(thing.centre()));
}

/// The group with the maps of a scene state, or one that is free.
std::size_t PreviewMaps::groupOf(const SceneStatePtr& sceneState) {
    for (std::size_t g = 0; g < groups_.size(); ++g)
        if (groups_[g].of == sceneState) return g;
    for (std::size_t g = 0; g < groups_.size(); ++g)
        if (!groups_[g].wanted) return g;
    assert(!"there are as many groups as scene states at a time");
    return 0;
}

std::vector<ShadowCaster> PreviewMaps::casters(const PreviewLighting& light, const SceneState& at,
                                               GeometryCache& cache, bool moving,
                                               const Reach& reach) const {
    std::vector<ShadowCaster> casters;
    for (std::size_t o = 0; o < light.objects.size(); ++o) {
        const PreviewLighting::Object& object = light.objects[o];
        if (!object.geometry || !at.objects[o].visible) continue;
        if (object.moves != moving && !reach.everywhere) continue;
        glm::dmat4 place = at.objects[o].toWorld;
        place[3] -= glm::dvec4(origin_, 0);
        ShadowCaster caster{&cache.peek(object.geometry), glm::mat4(place), {}};
        const LitMeshData& data = object.geometry->data();
        for (const TriangleChunk& chunk : caster.gpu->chunks()) {
            const MaterialRange& range = caster.gpu->ranges()[chunk.range];
            if (maxChannel(data.materials[range.material].emission) > 0) continue; // it emits
            const Bounds box = transformed(chunk.bounds, place);
            if (moving || reach.everywhere || shaftMeets(reach.source, box, reach.thing) ||
                shaftMeets(reach.source, reach.thing, box))
                caster.runs.add(chunk.firstIndex, chunk.indexCount);
        }
        if (!caster.runs.empty()) casters.push_back(std::move(caster));
    }
    return casters;
}

std::size_t PreviewMaps::drawTight(LightMaps& maps, const Emitter& source, int layer,
                                   const std::vector<ShadowCaster>& moved,
                                   const std::vector<ShadowCaster>& fixed) {
    const auto points = shadowPoints(source, std::size_t(points_), maps.reach.thing.centre());
    const ShadowView view = fitView(points, maps.reach.thing);
    const DepthRange near(view.near, view.far), whole(kFixedNear, 1000);
    describe(view, moved_.tileSize(kTightTiles), maps.row);
    if (source.kind == Emitter::Kind::sphere)
        maps.row[10] = glm::vec4(glm::normalize(maps.reach.thing.centre() - source.centre), 0);
    maps.row[11] = {near.a, near.b, whole.a, whole.b};
    moved_.begin(layer, kTightTiles);
    for (std::size_t k = 0; k < points.size(); ++k)
        moved_.drawTile(int(k), toClip(view, view.points[k], near), moved);
    moved_.end();
    fixed_.begin(layer, kTightTiles);
    for (std::size_t k = 0; k < points.size(); ++k)
        fixed_.drawTile(int(k), toClip(view, view.points[k], whole), fixed);
    fixed_.end();
    return 2 * points.size();
}

std::size_t PreviewMaps::drawCube(LightMaps& maps, const Emitter& source, int layer,
                                  const std::vector<ShadowCaster>& all) {
    std::vector<glm::vec3> points =
        shadowPoints(source, kCubePoints, source.centre + glm::vec3(0, 0, 1));
    const DepthRange whole(kFixedNear, 1000);
    maps.row[0].y = 1;
    maps.row[11] = {0, 0, whole.a, whole.b};
    fixed_.begin(layer, kCubeTiles);
    std::size_t drawn = 0;
    for (int face = 0; face < 6; ++face) {
        const ShadowView view = cubeView(points, face);
        describe(view, fixed_.tileSize(kCubeTiles), maps.row);
        const bool behind = source.kind != Emitter::Kind::sphere &&
                            glm::dot(glm::vec3(maps.row[10]), view.axis) < -0.99f;
        for (std::size_t k = 0; k < points.size() && !behind; ++k, ++drawn)
            fixed_.drawTile(int(6 * k) + face, toClip(view, view.points[k], whole), all);
    }
    fixed_.end();
    return drawn;
}

std::size_t PreviewMaps::draw(const PreviewLighting& light, GeometryCache& cache,
                              std::size_t group) {
    const SceneState& at = *groups_[group].of;
    std::vector<LightMaps>& lights = groups_[group].lights;
    lights.assign(light.lights.size(), {});
    std::size_t drawn = 0;
    const Bounds thing = thingIn(light, at);
    for (std::size_t l = 0; l < lights.size(); ++l) {
        if (!hasShadowMaps(at.lights[l])) continue; // hidden: PreviewKind::none
        const Emitter source = placedLight(at.lights[l].front());
        LightMaps& maps = lights[l];
        maps.reach = {boxOf(source), thing, light.lights[l].moves, l};
        describe(source, maps.row);
        const int layer = int(group * light.lights.size() + l);
        maps.row[10].w = float(layer);
        maps.row[6] = thing.empty() ? glm::vec4(0, 0, -1e6f, 0)
                                    : glm::vec4(thing.centre(), 0.5f * thing.diagonal());
        if (light.lights[l].moves) {
            drawn += drawCube(maps, source, layer, casters(light, at, cache, false, maps.reach));
        } else if (!thing.empty()) {
            drawn += drawTight(maps, source, layer, casters(light, at, cache, true, maps.reach),
                               casters(light, at, cache, false, maps.reach));
            maps.row[10].w = float(layer); // drawTight() may have turned it
        }
    }
    return drawn;
}

void PreviewMaps::writeTable(const PreviewLighting& light) {
    std::vector<glm::vec4> texels(std::size_t(kPreviewColumns) * kPreviewRows * kPreviewSlots);
    reaches_.clear();
    const auto write = [&](std::size_t slot, const SceneStatePtr& sceneState) {
        const Group& group = groups_[groupOf(sceneState)];
        for (std::size_t l = 0; l < light.lights.size(); ++l) {
            std::copy(group.lights[l].row.begin(), group.lights[l].row.end(),
                      texels.begin() + std::ptrdiff_t((kPreviewRows * slot + l) * kPreviewColumns));
            if (group.lights[l].row[0].x > 0) reaches_.push_back(group.lights[l].reach);
        }
    };
    write(0, light.now);
    for (std::size_t s = 0; s < light.anchors.size(); ++s)
        write(s + 1, light.anchors[s].sceneState);
    glBindTexture(GL_TEXTURE_2D, table_.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, kPreviewColumns, kPreviewRows * kPreviewSlots, 0,
                 GL_RGBA, GL_FLOAT, texels.data());
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
    glBindTexture(GL_TEXTURE_2D, 0);
}

std::size_t PreviewMaps::prepare(const PreviewLighting& light, GeometryCache& cache) {
    startAnew(light);
    std::vector<SceneStatePtr> wanted{light.now};
    for (const auto& anchor : light.anchors) wanted.push_back(anchor.sceneState);
    for (Group& group : groups_)
        group.wanted = std::find(wanted.begin(), wanted.end(), group.of) != wanted.end();
    std::size_t drawn = 0;
    for (const SceneStatePtr& sceneState : wanted) {
        const std::size_t g = groupOf(sceneState);
        if (groups_[g].of == sceneState) continue;
        groups_[g] = {sceneState, true, {}};
        drawn += draw(light, cache, g);
    }
    writeTable(light);
    return drawn;
}

void PreviewMaps::bind(const ShaderProgram& program) const {
    program.set("previewTable", 0);
    program.set("movedMaps", 1);
    program.set("fixedMaps", 2);
    program.set("tightPoints", points_);
    program.set("cubePoints", kCubePoints);
    program.set("tightTile", float(moved_.tileSize(kTightTiles)));
    program.set("cubeTile", float(fixed_.tileSize(kCubeTiles)));
    glActiveTexture(GL_TEXTURE2);
    glBindTexture(GL_TEXTURE_2D_ARRAY, fixed_.texture());
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D_ARRAY, moved_.texture());
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, table_.name());
}

} // namespace penumbra
