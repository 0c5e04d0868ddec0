#include "io/usd/scene/UsdGprims.h"

#include "io/usd/layer/UsdNumber.h"
#include "io/usd/text/UsdValueText.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace penumbra {

namespace {

constexpr int kSegments = 32;
constexpr int kHalfRings = 8; // from pole to equator
constexpr double kPi = std::numbers::pi;

void addFace(UsdPolygons& p, std::initializer_list<std::int32_t> corners) {
    p.counts.push_back(std::int32_t(corners.size()));
    p.indices.insert(p.indices.end(), corners);
}

// A circle of kSegments points about Z; returns the index of its first one.
std::int32_t addRing(UsdPolygons& p, double radius, double z) {
    const auto first = std::int32_t(p.points.size());
    for (int i = 0; i < kSegments; ++i) {
        const double phi = 2 * kPi * i / kSegments;
        p.points.emplace_back(float(radius * std::cos(phi)), float(radius * std::sin(phi)),
                              float(z));
    }
    return first;
}

void joinRings(UsdPolygons& p, std::int32_t lower, std::int32_t upper) {
    for (std::int32_t i = 0; i < kSegments; ++i) {
        const std::int32_t j = (i + 1) % kSegments;
        addFace(p, {lower + i, lower + j, upper + j, upper + i});
    }
}

// Triangles from a ring to a point above (or, turned round, below) it.
void joinPole(UsdPolygons& p, std::int32_t ring, double z, bool above) {
    const auto pole = std::int32_t(p.points.size());
    p.points.emplace_back(0.0f, 0.0f, float(z));
    for (std::int32_t i = 0; i < kSegments; ++i) {
        const std::int32_t j = (i + 1) % kSegments;
        if (above)
            addFace(p, {ring + i, ring + j, pole});
        else
            addFace(p, {ring + j, ring + i, pole});
    }
}

void addCap(UsdPolygons& p, std::int32_t ring, bool above) {
    p.counts.push_back(kSegments);
    for (std::int32_t i = 0; i < kSegments; ++i)
        p.indices.push_back(ring + (above ? i : kSegments - 1 - i));
}

void makeCube(UsdPolygons& p, double size) {
    const float h = float(size / 2);
    for (int i = 0; i < 8; ++i)
        p.points.emplace_back(i & 1 ? h : -h, i & 2 ? h : -h, i & 4 ? h : -h);
    addFace(p, {0, 2, 3, 1});
    addFace(p, {4, 5, 7, 6});
    addFace(p, {0, 1, 5, 4});
    addFace(p, {2, 6, 7, 3});
    addFace(p, {0, 4, 6, 2});
    addFace(p, {1, 3, 7, 5});
}

// Two half spheres, `height` apart: a capsule, or with height 0 a sphere.
void makeCapsule(UsdPolygons& p, double radius, double height) {
    std::int32_t previous = -1;
    for (int i = -kHalfRings + 1; i <= kHalfRings - 1; ++i) {
        const double latitude = 0.5 * kPi * i / kHalfRings;
        const double r = radius * std::cos(latitude);
        const double z = radius * std::sin(latitude);
        const std::int32_t ring = addRing(p, r, z + (i > 0 ? height / 2 : -height / 2));
        if (previous < 0)
            joinPole(p, ring, -radius - height / 2, false);
        else
            joinRings(p, previous, ring);
        previous = ring;
        if (i != 0 || height == 0) continue;
        const std::int32_t upper = addRing(p, r, height / 2);
        joinRings(p, ring, upper);
        previous = upper;
    }
    joinPole(p, previous, radius + height / 2, true);
}

void makeCylinder(UsdPolygons& p, double radius, double height) {
    const std::int32_t lower = addRing(p, radius, -height / 2);
    const std::int32_t upper = addRing(p, radius, height / 2);
    joinRings(p, lower, upper);
    addCap(p, lower, false);
    addCap(p, upper, true);
}

void makeCone(UsdPolygons& p, double radius, double height) {
    const std::int32_t base = addRing(p, radius, -height / 2);
    joinPole(p, base, height / 2, true);
    addCap(p, base, false);
}

// Axis X: width along Z, length along Y. Axis Y: width X, length Z. Axis Z: width X, length Y.
void makePlane(UsdPolygons& p, double width, double length, char axis) {
    const float w = float(width / 2);
    const float l = float(length / 2);
    if (axis == 'X')
        p.points = {{0, -l, w}, {0, -l, -w}, {0, l, -w}, {0, l, w}};
    else if (axis == 'Y')
        p.points = {{-w, 0, l}, {w, 0, l}, {w, 0, -l}, {-w, 0, -l}};
    else
        p.points = {{-w, -l, 0}, {w, -l, 0}, {w, l, 0}, {-w, l, 0}};
    addFace(p, {0, 1, 2, 3});
}

// The true surface's normal at a corner of a face, before it is turned to its axis; zero where it
// is the face's own. \param middle of the face: an apex has no normal of its own
glm::vec3 normalAt(const std::string& type, glm::vec3 corner, glm::vec3 middle, double radius,
                   double height) {
    const glm::vec3 outwards = glm::normalize(glm::vec3(middle.x, middle.y, 0));
    const bool apex = corner.x == 0 && corner.y == 0;
    const glm::vec3 side = apex ? outwards : glm::normalize(glm::vec3(corner.x, corner.y, 0));
    if (type == "Sphere") return glm::normalize(corner);
    if (type == "Cylinder") return side;
    if (type == "Cone")
        return glm::normalize(float(height) * side + glm::vec3(0, 0, float(radius)));
    const float straight = float(height / 2); // a capsule's, either way from its middle
    return glm::normalize(corner - glm::vec3(0, 0, std::clamp(corner.z, -straight, straight)));
}

// Normals of the round sides, so that these are lit as round. Caps and flat things stay flat.
void addNormals(UsdPolygons& p, const std::string& type, double radius, double height) {
    if (type == "Cube" || type == "Plane") return;
    std::size_t offset = 0;
    for (const std::int32_t count : p.counts) {
        glm::vec3 middle(0);
        for (std::int32_t k = 0; k < count; ++k)
            middle += p.points[std::size_t(p.indices[offset + std::size_t(k)])] / float(count);
        for (std::int32_t k = 0; k < count; ++k, ++offset) {
            const glm::vec3 corner = p.points[std::size_t(p.indices[offset])];
            p.normals.push_back(
                count == kSegments ? glm::vec3(0) : normalAt(type, corner, middle, radius, height));
        }
    }
}

// What was made about Z is turned to another axis by exchanging coordinates cyclically.
void turnToAxis(UsdPolygons& p, char axis) {
    const auto turn = [&](glm::vec3& v) {
        if (axis == 'X') v = {v.z, v.x, v.y};
        if (axis == 'Y') v = {v.y, v.z, v.x};
    };
    std::for_each(p.points.begin(), p.points.end(), turn);
    std::for_each(p.normals.begin(), p.normals.end(), turn);
}

} // namespace

bool isUsdGprim(std::string_view typeName) {
    constexpr std::array<std::string_view, 6> kTypes{"Cube", "Sphere",  "Cylinder",
                                                     "Cone", "Capsule", "Plane"};
    return std::find(kTypes.begin(), kTypes.end(), typeName) != kTypes.end();
}

UsdPolygons makeUsdGprim(const UsdAttributes& prim, Diagnostics& diagnostics) {
    const std::string& type = prim.prim().typeName;
    bool usable = true;
    const auto size = [&](std::string_view name, double fallback) {
        const double value = prim.number(name, fallback);
        usable = usable && std::isfinite(roundToFloat(value)) && value > 0;
        return value;
    };
    const std::string axisName = prim.text("axis", "Z");
    const char axis = axisName.size() == 1 ? axisName[0] : 'Z';
    UsdPolygons p;
    if (type == "Cube") makeCube(p, size("size", 2));
    const bool round = type != "Cube" && type != "Plane";
    const bool capsule = type == "Capsule";
    const double radius = round ? size("radius", capsule ? 0.5 : 1) : 0;
    const double height = round && type != "Sphere" ? size("height", capsule ? 1 : 2) : 0;
    if (type == "Sphere" || capsule) makeCapsule(p, radius, height);
    if (type == "Cylinder") makeCylinder(p, radius, height);
    if (type == "Cone") makeCone(p, radius, height);
    if (type == "Plane") makePlane(p, size("width", 2), size("length", 2), axis);
    if (usable) addNormals(p, type, radius, height);
    if (type != "Plane" && type != "Cube" && type != "Sphere") turnToAxis(p, axis);
    if (!usable) {
        diagnostics.warn(prim.prim().location(), "a " + type + " without size left out");
        return {};
    }
    p.kept.assign(p.counts.size(), 1);
    p.doubleSided = prim.flag("doubleSided", type == "Plane");
    p.leftHanded = prim.text("orientation", "rightHanded") == "leftHanded";
    return p;
}

std::string usdGprimKey(const UsdAttributes& prim) {
    std::string key = prim.prim().typeName;
    for (const UsdOpinion& opinion : prim.prim().opinions)
        for (const UsdProperty& property : opinion.spec->properties) {
            const std::string& name = property.name;
            if (name.starts_with("primvars:")) return {};
            if (property.relationship || name == "visibility" || name == "extent" ||
                name.starts_with("xformOp"))
                continue;
            key.append("\n").append(name).append(" ");
            if (const UsdResolved value = prim.value(name)) appendUsdText(key, *value, 0);
        }
    return key += '\n';
}

} // namespace penumbra
