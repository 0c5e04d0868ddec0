#include "viewer/LiveMaps.h"

#include "radiosity/Shaft.h"
#include "viewer/Arrangements.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace penumbra {

namespace {

constexpr int kLayerSize = 1024;               // [texels]
constexpr int kTightTiles = 4, kCubeTiles = 5; // a side: 16 points, 4 points of 6 faces
constexpr int kCubePoints = 2;
constexpr float kFixedNear = 0.01f; // [m]; nearer to a lamp nothing casts shadows

/// A sphere around a lamp.
glm::vec4 sphereOf(const Emitter& lamp) {
    if (lamp.kind != Emitter::Kind::polygons) return {lamp.centre, lamp.radius};
    Bounds box;
    for (const auto& polygon : lamp.polygons)
        for (const glm::vec3 corner : polygon) box.add(corner);
    return {box.centre(), 0.5f * box.diagonal()};
}

Bounds boxOf(const Emitter& lamp) {
    Bounds box;
    for (const auto& polygon : lamp.polygons)
        for (const glm::vec3 corner : polygon) box.add(corner);
    if (lamp.kind != Emitter::Kind::polygons) {
        box.add(lamp.centre - lamp.radius);
        box.add(lamp.centre + lamp.radius);
    }
    return box;
}

/// What of a lamp's row does not depend on maps.
void describe(const Emitter& lamp, std::array<glm::vec4, kLiveColumns>& row) {
    glm::vec3 normal = lamp.axis;
    if (lamp.kind == Emitter::Kind::polygons) {
        const auto& p = lamp.polygons.front();
        row[0].x = float(LiveKind::quad);
        for (std::size_t i = 0; i < 4; ++i) row[1 + i] = glm::vec4(p[std::min(i, p.size() - 1)], 0);
        normal = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
    } else {
        const bool disk = lamp.kind == Emitter::Kind::disk;
        row[0].x = float(disk ? LiveKind::disk : LiveKind::sphere);
        row[1] = glm::vec4(lamp.centre, lamp.radius);
        row[2] = glm::vec4(lamp.axis, 0);
        if (!disk) normal = glm::vec3(0);
    }
    row[5] = sphereOf(lamp);
    row[10] = glm::vec4(normal, 0);
}

void describe(const ShadowView& view, int tileSize, std::array<glm::vec4, kLiveColumns>& row) {
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

LiveMaps::LiveMaps() : table_(makeTexture()) {}

/// The lamp in the frame of the maps.
Emitter LiveMaps::placedLamp(const Emitter& lamp) const {
    Emitter placed = lamp;
    const glm::vec3 shift(origin_);
    for (auto& polygon : placed.polygons)
        for (glm::vec3& corner : polygon) corner -= shift;
    placed.centre -= shift;
    return placed;
}

/// A box around what moves.
Bounds LiveMaps::thingIn(const LiveLight& light, const Arrangement& at) const {
    Bounds box;
    for (std::size_t o = 0; o < light.objects.size(); ++o) {
        const LiveLight::Object& object = light.objects[o];
        if (!object.moves || !object.geometry || !at.objects[o].visible) continue;
        glm::dmat4 place = at.objects[o].toWorld;
        place[3] -= glm::dvec4(origin_, 0);
        box.add(transformed(object.geometry->bounds(), place));
    }
    return box;
}

void LiveMaps::startAnew(const LiveLight& light) {
    std::vector<bool> moves, lampMoves;
    std::vector<const LitGeometry*> geometries;
    for (const auto& object : light.objects) {
        moves.push_back(object.moves);
        geometries.push_back(object.geometry.get());
    }
    for (const auto& lamp : light.lamps) lampMoves.push_back(lamp.moves);
    const int layers = int(kLiveSlots * light.lamps.size());
    bool anew = moved_.require(layers, kLayerSize);
    anew |= fixed_.require(layers, kLayerSize);
    if (!anew && moves == moves_ && lampMoves == lampMoves_ && geometries == geometries_ &&
        points_ == light.points)
        return;
    moves_ = std::move(moves);
    lampMoves_ = std::move(lampMoves);
    geometries_ = std::move(geometries);
    points_ = light.points;
    groups_ = {};
    origin_ = glm::dvec3(0);
    const Bounds thing = thingIn(light, *light.now);
    if (!thing.empty()) origin_ = glm::round(glm::dvec3(thing.centre()));
}

/// The group with the maps of an arrangement, or one that nobody wants.
std::size_t LiveMaps::groupOf(const ArrangementPtr& arrangement) {
    for (std::size_t g = 0; g < groups_.size(); ++g)
        if (groups_[g].of == arrangement) return g;
    for (std::size_t g = 0; g < groups_.size(); ++g)
        if (!groups_[g].wanted) return g;
    assert(!"there are as many groups as arrangements at a time");
    return 0;
}

std::vector<ShadowCaster> LiveMaps::casters(const LiveLight& light, const Arrangement& at,
                                            GeometryCache& cache, bool moving,
                                            const Reach& reach) const {
    std::vector<ShadowCaster> casters;
    for (std::size_t o = 0; o < light.objects.size(); ++o) {
        const LiveLight::Object& object = light.objects[o];
        if (!object.geometry || !at.objects[o].visible) continue;
        if (object.moves != moving && !reach.everywhere) continue;
        glm::dmat4 place = at.objects[o].toWorld;
        place[3] -= glm::dvec4(origin_, 0);
        ShadowCaster caster{&cache.peek(object.geometry), glm::mat4(place), {}};
        const LitMeshData& data = object.geometry->data();
        for (const TriangleChunk& chunk : caster.gpu->chunks()) {
            const MaterialRange& range = caster.gpu->ranges()[chunk.range];
            if (maxChannel(data.materials[range.material].emission) > 0) continue; // it shines
            const Bounds box = transformed(chunk.bounds, place);
            if (moving || reach.everywhere || shaftMeets(reach.lamp, box, reach.thing) ||
                shaftMeets(reach.lamp, reach.thing, box))
                caster.runs.add(chunk.firstIndex, chunk.indexCount);
        }
        if (!caster.runs.empty()) casters.push_back(std::move(caster));
    }
    return casters;
}

std::size_t LiveMaps::drawTight(LampMaps& maps, const Emitter& lamp, int layer,
                                const std::vector<ShadowCaster>& moved,
                                const std::vector<ShadowCaster>& fixed) {
    const auto points = shadowPoints(lamp, std::size_t(points_), maps.reach.thing.centre());
    const ShadowView view = fitView(points, maps.reach.thing);
    const DepthRange near(view.near, view.far), whole(kFixedNear, 1000);
    describe(view, moved_.tileSize(kTightTiles), maps.row);
    if (lamp.kind == Emitter::Kind::sphere)
        maps.row[10] = glm::vec4(glm::normalize(maps.reach.thing.centre() - lamp.centre), 0);
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

std::size_t LiveMaps::drawCube(LampMaps& maps, const Emitter& lamp, int layer,
                               const std::vector<ShadowCaster>& all) {
    std::vector<glm::vec3> points =
        shadowPoints(lamp, kCubePoints, lamp.centre + glm::vec3(0, 0, 1));
    const DepthRange whole(kFixedNear, 1000);
    maps.row[0].y = 1;
    maps.row[11] = {0, 0, whole.a, whole.b};
    fixed_.begin(layer, kCubeTiles);
    std::size_t drawn = 0;
    for (int face = 0; face < 6; ++face) {
        const ShadowView view = cubeView(points, face);
        describe(view, fixed_.tileSize(kCubeTiles), maps.row);
        const bool behind = lamp.kind != Emitter::Kind::sphere &&
                            glm::dot(glm::vec3(maps.row[10]), view.axis) < -0.99f;
        for (std::size_t k = 0; k < points.size() && !behind; ++k, ++drawn)
            fixed_.drawTile(int(6 * k) + face, toClip(view, view.points[k], whole), all);
    }
    fixed_.end();
    return drawn;
}

std::size_t LiveMaps::draw(const LiveLight& light, GeometryCache& cache, std::size_t group) {
    const Arrangement& at = *groups_[group].of;
    std::vector<LampMaps>& lamps = groups_[group].lamps;
    lamps.assign(light.lamps.size(), {});
    std::size_t drawn = 0;
    const Bounds thing = thingIn(light, at);
    for (std::size_t l = 0; l < lamps.size(); ++l) {
        if (!hasShadowMaps(at.lamps[l])) continue; // hidden: LiveKind::none
        const Emitter lamp = placedLamp(at.lamps[l].front());
        LampMaps& maps = lamps[l];
        maps.reach = {boxOf(lamp), thing, light.lamps[l].moves, l};
        describe(lamp, maps.row);
        const int layer = int(group * light.lamps.size() + l);
        maps.row[10].w = float(layer);
        maps.row[6] = thing.empty() ? glm::vec4(0, 0, -1e6f, 0)
                                    : glm::vec4(thing.centre(), 0.5f * thing.diagonal());
        if (light.lamps[l].moves) {
            drawn += drawCube(maps, lamp, layer, casters(light, at, cache, false, maps.reach));
        } else if (!thing.empty()) {
            drawn += drawTight(maps, lamp, layer, casters(light, at, cache, true, maps.reach),
                               casters(light, at, cache, false, maps.reach));
            maps.row[10].w = float(layer); // drawTight() may have said anew where it faces
        }
    }
    return drawn;
}

void LiveMaps::writeTable(const LiveLight& light) {
    std::vector<glm::vec4> texels(std::size_t(kLiveColumns) * kLiveRows * kLiveSlots);
    reaches_.clear();
    const auto write = [&](std::size_t slot, const ArrangementPtr& arrangement) {
        const Group& group = groups_[groupOf(arrangement)];
        for (std::size_t l = 0; l < light.lamps.size(); ++l) {
            std::copy(group.lamps[l].row.begin(), group.lamps[l].row.end(),
                      texels.begin() + std::ptrdiff_t((kLiveRows * slot + l) * kLiveColumns));
            if (group.lamps[l].row[0].x > 0) reaches_.push_back(group.lamps[l].reach);
        }
    };
    write(0, light.now);
    for (std::size_t s = 0; s < light.anchors.size(); ++s)
        write(s + 1, light.anchors[s].arrangement);
    glBindTexture(GL_TEXTURE_2D, table_.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, kLiveColumns, kLiveRows * kLiveSlots, 0, GL_RGBA,
                 GL_FLOAT, texels.data());
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
    glBindTexture(GL_TEXTURE_2D, 0);
}

std::size_t LiveMaps::prepare(const LiveLight& light, GeometryCache& cache) {
    startAnew(light);
    std::vector<ArrangementPtr> wanted{light.now};
    for (const auto& anchor : light.anchors) wanted.push_back(anchor.arrangement);
    for (Group& group : groups_)
        group.wanted = std::find(wanted.begin(), wanted.end(), group.of) != wanted.end();
    std::size_t drawn = 0;
    for (const ArrangementPtr& arrangement : wanted) {
        const std::size_t g = groupOf(arrangement);
        if (groups_[g].of == arrangement) continue;
        groups_[g] = {arrangement, true, {}};
        drawn += draw(light, cache, g);
    }
    writeTable(light);
    return drawn;
}

void LiveMaps::bind(const ShaderProgram& program) const {
    program.set("liveTable", 0);
    program.set("movedMaps", 1);
    program.set("fixedMaps", 2);
    program.set("livePoints", points_);
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
