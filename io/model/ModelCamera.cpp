#include "io/model/ModelCamera.h"

#include "io/model/PrimNames.h"
#include "io/model/VectorOf.h"
#include "io/usd/layer/UsdPrimSpecs.h"

#include <assimp/camera.h>

#include <cmath>
#include <numbers>

namespace penumbra {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kAspect = 16.0 / 9.0;
constexpr double kFarByNear = 1e6; // of a camera that sees without an end, as USD's standard has it

bool usable(const glm::dmat4& m) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            if (!std::isfinite(m[c][r])) return false;
    return true;
}

} // namespace

// Assimp's documentation has half the horizontal angle; all its readers give the whole one.
ModelCamera modelCameraOf(const aiCamera& camera) {
    ModelCamera made;
    made.name = camera.mName.C_Str();
    const double aspect = double(camera.mAspect);
    if (aspect > 0.01 && aspect < 100) made.aspect = aspect;
    const double fov = double(camera.mHorizontalFOV);
    const double shape = made.aspect > 0 ? made.aspect : kAspect;
    if (fov > 0 && fov < kPi) made.verticalFov = 2 * std::atan(std::tan(fov / 2) / shape);
    made.orthographicWidth = 2 * double(camera.mOrthographicWidth);
    made.nearPlane = double(camera.mClipPlaneNear);
    made.farPlane = double(camera.mClipPlaneFar);
    const glm::dvec3 back = -vectorOf(camera.mLookAt), up = vectorOf(camera.mUp);
    const glm::dvec3 right = glm::cross(up, back);
    glm::dmat4 frame(1);
    frame[3] = glm::dvec4(vectorOf(camera.mPosition), 1);
    if (glm::length(right) > 0) {
        frame[0] = glm::dvec4(glm::normalize(right), 0);
        frame[2] = glm::dvec4(glm::normalize(back), 0);
        frame[1] = glm::dvec4(glm::cross(glm::dvec3(frame[2]), glm::dvec3(frame[0])), 0);
    }
    if (usable(frame)) made.toNode = frame;
    return made;
}

UsdPrimSpec cameraPrim(const ModelCamera& camera, const std::string& name) {
    UsdPrimSpec spec = makePrim("Camera", name);
    const double aspect = camera.aspect > 0 ? camera.aspect : kAspect;
    double width = 36; // a film of 36 mm; the angles decide, not the unit
    if (camera.orthographicWidth > 0) {
        addText(spec, "token", "projection", "orthographic");
        width = 10 * camera.orthographicWidth; // tenths of a unit
    }
    const double fov =
        camera.verticalFov > 0 ? camera.verticalFov : 2 * std::atan(std::tan(kPi / 6) / aspect);
    addFloat(spec, "horizontalAperture", width);
    addFloat(spec, "verticalAperture", width / aspect);
    addFloat(spec, "focalLength", width / aspect / (2 * std::tan(fov / 2)));
    const bool bounded = camera.farPlane > camera.nearPlane && camera.farPlane < 1e30;
    const double farPlane = bounded ? camera.farPlane : kFarByNear * camera.nearPlane;
    if (camera.nearPlane > 0 && farPlane < 1e30)
        addAttribute(spec, "float2", "clippingRange",
                     std::vector{float(camera.nearPlane), float(farPlane)});
    addTransform(spec, camera.toNode);
    keepDisplayName(spec, camera.name);
    return spec;
}

} // namespace penumbra
