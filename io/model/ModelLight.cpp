#include "io/model/ModelLight.h"

#include "io/model/PrimNames.h"
#include "io/model/VectorOf.h"
#include "io/usd/layer/UsdPrimSpecs.h"

#include <assimp/light.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace penumbra {

namespace {

constexpr double kPi = std::numbers::pi;

ModelLight::Kind kindOf(aiLightSourceType type) {
    switch (type) {
    case aiLightSource_POINT:
        return ModelLight::Kind::point;
    case aiLightSource_SPOT:
        return ModelLight::Kind::spot;
    case aiLightSource_AREA:
        return ModelLight::Kind::rect;
    case aiLightSource_DIRECTIONAL:
        return ModelLight::Kind::directional;
    case aiLightSource_AMBIENT:
        return ModelLight::Kind::ambient;
    default:
        return ModelLight::Kind::unknown;
    }
}

// Why there is no such light, or null.
const char* unsupported(const ModelLight& light) {
    switch (light.kind) {
    case ModelLight::Kind::directional:
        return "directional: a light at infinity";
    case ModelLight::Kind::ambient:
        return "ambient: light from nowhere";
    case ModelLight::Kind::unknown:
        return "of a kind that is not known";
    default:
        break;
    }
    for (int i = 0; i < 3; ++i)
        if (!std::isfinite(light.intensity[i]) || !std::isfinite(light.position[i]) ||
            light.intensity[i] < 0)
            return "it has no usable intensity or position";
    const bool flat = !(light.size.x > 0 && light.size.y > 0);
    return light.kind == ModelLight::Kind::rect && flat ? "it has no area" : nullptr;
}

// A frame at the light whose -Z is its direction, as lights of USD have it.
glm::dmat4 frameOf(const ModelLight& light) {
    glm::dmat4 frame(1);
    frame[3] = glm::dvec4(light.position, 1);
    const double length = glm::length(light.direction);
    if (light.kind == ModelLight::Kind::point || !(length > 0) || !std::isfinite(length))
        return frame;
    const glm::dvec3 z = -light.direction / length;
    if (z == glm::dvec3(0, 0, 1)) return frame;
    const glm::dvec3 other = std::abs(z.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 x = glm::normalize(glm::cross(other, z));
    frame[0] = glm::dvec4(x, 0);
    frame[1] = glm::dvec4(glm::cross(z, x), 0);
    frame[2] = glm::dvec4(z, 0);
    return frame;
}

// How much longer things become, on the average of all directions; 1 if they vanish.
double scaleOf(const glm::dmat4& m) {
    const double scale = std::cbrt(std::abs(glm::determinant(glm::dmat3(m))));
    return scale > 0 && std::isfinite(scale) ? scale : 1;
}

void addLuminance(UsdPrimSpec& spec, glm::dvec3 nits) {
    const double most = std::max({nits.r, nits.g, nits.b});
    addColour(spec, "inputs:color", most > 0 ? nits / most : glm::dvec3(1));
    addFloat(spec, "inputs:intensity", most);
}

void addSphere(UsdPrimSpec& spec, const ModelLight& light, double scale) {
    addLuminance(spec, light.intensity / (kPi * kPointRadius * kPointRadius));
    addFloat(spec, "inputs:radius", kPointRadius / scale);
    if (light.kind != ModelLight::Kind::spot) return;
    applySchema(spec, "ShapingAPI");
    addFloat(spec, "inputs:shaping:cone:angle",
             std::clamp(light.outerCone * 180 / kPi, 0.0, 180.0));
}

} // namespace

ModelLight modelLightOf(const aiLight& light) {
    ModelLight made;
    made.name = light.mName.C_Str();
    made.kind = kindOf(light.mType);
    made.intensity = {double(light.mColorDiffuse.r), double(light.mColorDiffuse.g),
                      double(light.mColorDiffuse.b)};
    made.position = vectorOf(light.mPosition);
    made.direction = vectorOf(light.mDirection);
    made.outerCone = double(light.mAngleOuterCone) / 2;
    made.size = {double(light.mSize.x), double(light.mSize.y)};
    return made;
}

std::optional<UsdPrimSpec> lightPrim(const ModelLight& light, const std::string& name,
                                     const glm::dmat4& toWorld, double unit,
                                     const SourceLocation& where, Diagnostics& diagnostics) {
    if (const char* why = unsupported(light)) {
        diagnostics.warn(where, "light '" + cleanText(light.name) + "' left out: " + why);
        return std::nullopt;
    }
    const double scale = unit * scaleOf(toWorld); // metres a unit of the light's own frame
    const bool rect = light.kind == ModelLight::Kind::rect;
    UsdPrimSpec spec = makePrim(rect ? "RectLight" : "SphereLight", name);
    if (rect) {
        addLuminance(spec, light.intensity / (light.size.x * light.size.y * scale * scale));
        addFloat(spec, "inputs:width", light.size.x);
        addFloat(spec, "inputs:height", light.size.y);
    } else {
        addSphere(spec, light, scale);
        addMetadata(spec.metadata, "doc", UsdKind::string,
                    "intensity is a luminance in cd/m2: the light's candelas divided by pi r^2, "
                    "r = 0.05 m");
    }
    if (light.kind == ModelLight::Kind::spot)
        diagnostics.warn(where, "spot light '" + cleanText(light.name) +
                                    "' is a sphere: its cone is written, but may be ignored");
    addTransform(spec, light.toParent * frameOf(light));
    keepDisplayName(spec, light.name);
    return spec;
}

} // namespace penumbra
