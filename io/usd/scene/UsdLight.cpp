#include "io/usd/scene/UsdLight.h"

#include "io/usd/layer/UsdNumber.h"
#include "scenegraph/Light.h"
#include "scenegraph/Mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

namespace penumbra {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kTubeSides = 24;
constexpr std::array<std::string_view, 4> kSizes{"inputs:width", "inputs:height", "inputs:radius",
                                                 "inputs:length"};

// Chromaticity of the Planckian locus, 1667 K and up (Kang et al. 2002, eqs. 3 and 4).
glm::dvec2 planckianLocus(double t) {
    const double x =
        t < 4000 ? -0.2661239e9 / (t * t * t) - 0.2343589e6 / (t * t) + 0.8776956e3 / t + 0.179910
                 : -3.0258469e9 / (t * t * t) + 2.1070379e6 / (t * t) + 0.2226347e3 / t + 0.240390;
    const double y = t < 2222   ? ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683
                     : t < 4000 ? ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867
                                : ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483;
    return {x, y};
}

// XYZ to linear Rec. 709 (IEC 61966-2-1).
glm::dvec3 toRec709(glm::dvec3 c) {
    return {3.2404542 * c.x - 1.5371385 * c.y - 0.4985314 * c.z,
            -0.9692660 * c.x + 1.8760108 * c.y + 0.0415560 * c.z,
            0.0556434 * c.x - 0.2040259 * c.y + 1.0572252 * c.z};
}

glm::dvec3 planckianRgb(double t) {
    const glm::dvec2 xy = planckianLocus(t);
    return glm::max(toRec709({xy.x / xy.y, 1.0, (1 - xy.x - xy.y) / xy.y}), glm::dvec3(0));
}

// Lagrange's parabola through the colours at 1000, 1500 and 2000 K, red being 1.
glm::dvec3 emberRgb(double t) {
    const glm::dvec3 at1000(1, 0.02749, 0); // measured: OpenUSD 24.11
    const glm::dvec3 at1500(1, 0.14967, 0);
    const glm::dvec3 warm = planckianRgb(2000);
    const double u = (t - 1000) / 500;
    return glm::max(at1000 * ((u - 1) * (u - 2) / 2) - at1500 * (u * (u - 2)) +
                        warm / warm.r * (u * (u - 1) / 2),
                    glm::dvec3(0));
}

} // namespace

Rgb blackbodyColour(double kelvin) {
    const double t = kelvin > 1000 ? std::min(kelvin, 10000.0) : 1000.0; // also for NaN
    const glm::dvec3 c = t < 2000 ? emberRgb(t) : planckianRgb(t);
    const double y = 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
    return {float(c.r / y), float(c.g / y), float(c.b / y)};
}

namespace {

void warnOfIgnoredInputs(const UsdAttributes& light, Diagnostics& diagnostics) {
    const auto warn = [&](std::string_view input, const char* text) {
        diagnostics.warn(light.location(input), text);
    };
    for (const std::string_view input : {"inputs:texture:file", "inputs:shaping:ies:file"})
        if (!light.text(input, "").empty()) warn(input, "texture or profile of a light ignored");
    const bool focused = light.number("inputs:shaping:focus", 0) != 0;
    const bool cone = light.number("inputs:shaping:cone:angle", 90) < 90;
    if (focused || cone) warn("inputs:shaping:cone:angle", "shaping of a light ignored");
    if (!light.flag("inputs:shadow:enable", true))
        warn("inputs:shadow:enable", "a light without shadows casts them all the same");
    for (const std::string_view input : {"treatAsPoint", "treatAsLine"})
        if (light.flag(input, false)) warn(input, "a light of no size keeps its size");
    for (const std::string_view name : {"intensity", "color", "exposure", "radius", "width"})
        if (UsdStage::property(light.prim(), name))
            warn(name, "old light attribute without 'inputs:' ignored, as OpenUSD does");
    for (const std::string_view name :
         {"light:filters", "collection:lightLink:includes", "collection:lightLink:excludes"})
        if (!UsdStage::targets(light.prim(), name).empty())
            warn(name, "light filters and linking ignored");
}

Rgb luminanceOf(const UsdAttributes& light, double area, Diagnostics& diagnostics) {
    double factor = light.number("inputs:intensity", 1) *
                    std::exp2(light.number("inputs:exposure", 0)) *
                    light.number("inputs:diffuse", 1);
    if (light.flag("inputs:normalize", false)) factor /= area;
    Rgb colour = light.colour("inputs:color", Rgb(1));
    if (light.flag("inputs:enableColorTemperature", false))
        colour = colour * blackbodyColour(light.number("inputs:colorTemperature", 6500));
    bool usable = true;
    const auto channel = [&](float c) {
        const float nits = roundToFloat(factor * double(c));
        usable = usable && std::isfinite(nits) && nits >= 0;
        return std::isfinite(nits) ? std::max(nits, 0.0f) : 0.0f;
    };
    const Rgb luminance(channel(colour.r), channel(colour.g), channel(colour.b));
    if (!usable)
        diagnostics.warn(light.location("inputs:intensity"),
                         "a light whose luminance is negative or not finite sends none");
    return luminance;
}

} // namespace

Rgb usdLightLuminance(const UsdAttributes& light, double area, Diagnostics& diagnostics) {
    warnOfIgnoredInputs(light, diagnostics);
    return luminanceOf(light, area, diagnostics);
}

// What a light ignores is reported once, a sample that gives no light each time.
void checkUsdLight(const UsdPrim& light, UsdSampleCheck& check) {
    constexpr std::array<std::string_view, 7> kIgnored{
        "inputs:texture:file",  "inputs:shaping:ies:file",
        "inputs:shaping:focus", "inputs:shaping:cone:angle",
        "inputs:shadow:enable", "treatAsPoint",
        "treatAsLine"};
    constexpr std::array<std::string_view, 6> kFactors{"inputs:intensity",
                                                       "inputs:exposure",
                                                       "inputs:diffuse",
                                                       "inputs:color",
                                                       "inputs:enableColorTemperature",
                                                       "inputs:colorTemperature"};
    check.firsts(light, kIgnored, "ignored", warnOfIgnoredInputs);
    check.each(light, kFactors, "luminance",
               [](const UsdAttributes& at, Diagnostics& found) { luminanceOf(at, 1, found); });
    check.each(light, kSizes, "size", [](const UsdAttributes& at, Diagnostics& found) {
        const glm::dvec3 size = usdLightSize(at);
        if (size.x * size.y * size.z == 0)
            found.warn(at.prim().location(), "a light without area left out");
    });
}

namespace {

// Length of the parallelogram's normal: how much a local area spanned by a and b grows.
double areaFactor(const glm::dmat3& m, glm::dvec3 a, glm::dvec3 b) {
    return glm::length(glm::cross(m * a, m * b));
}

// A sphere under a linear map: midpoint sums over latitude and longitude, scaled so that the sum
// for the sphere itself is exact.
double sphereArea(const glm::dmat3& m, double radius) {
    constexpr int kRings = 64;
    constexpr int kSegments = 128;
    double sum = 0;
    double unit = 0;
    for (int i = 0; i < kRings; ++i) {
        const double theta = kPi * (i + 0.5) / kRings;
        for (int j = 0; j < kSegments; ++j) {
            const double phi = 2 * kPi * (j + 0.5) / kSegments;
            const glm::dvec3 south(std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi),
                                   -std::sin(theta));
            const glm::dvec3 east(-std::sin(phi), std::cos(phi), 0);
            sum += areaFactor(m, south, east) * std::sin(theta);
            unit += std::sin(theta);
        }
    }
    return 4 * kPi * radius * radius * sum / unit;
}

// The side of a cylinder about X.
double tubeArea(const glm::dmat3& m, double radius, double length) {
    constexpr int kSegments = 128;
    double sum = 0;
    for (int j = 0; j < kSegments; ++j) {
        const double phi = 2 * kPi * (j + 0.5) / kSegments;
        sum += areaFactor(m, {1, 0, 0}, {0, -std::sin(phi), std::cos(phi)});
    }
    return 2 * kPi * radius * length * sum / kSegments;
}

// The regular polygon that replaces the circle has its area per length of side, hence the
// light's flux: the corners lie outside the circle by (pi/n) / sin(pi/n).
NodePtr makeTube(const std::string& name, const std::string& material, double radius, double length,
                 Rgb luminance) {
    const double corner = radius * (kPi / kTubeSides) / std::sin(kPi / kTubeSides);
    MeshData data;
    for (int i = 0; i < kTubeSides; ++i) {
        const double phi = 2 * kPi * i / kTubeSides;
        const glm::dvec2 yz(corner * std::cos(phi), corner * std::sin(phi));
        data.points.emplace_back(float(-length / 2), float(yz.x), float(yz.y));
        data.points.emplace_back(float(length / 2), float(yz.x), float(yz.y));
        const int next = (i + 1) % kTubeSides;
        data.faceVertexCounts.push_back(4);
        for (const int point : {2 * i, 2 * next, 2 * next + 1, 2 * i + 1})
            data.faceVertexIndices.push_back(point);
    }
    auto paint = std::make_shared<Material>(material);
    paint->setReflectance(Rgb());
    paint->setEmission(luminance);
    data.materials.push_back(std::move(paint));
    return std::make_shared<Mesh>(name, std::move(data));
}

} // namespace

glm::dvec3 usdLightSize(const UsdAttributes& light) {
    const std::string& type = light.prim().typeName;
    const auto size = [&](std::string_view input, double fallback) {
        const double value = double(roundToFloat(light.number(input, fallback)));
        return value > 0 && std::isfinite(value) ? value : 0;
    };
    if (type == "RectLight") return {size("inputs:width", 1), size("inputs:height", 1), 1};
    const double r = size("inputs:radius", 0.5);
    if (type == "DiskLight") return {r, r, 1};
    if (type == "SphereLight") return {r, r, r};
    return {size("inputs:length", 1), r, r};
}

std::vector<std::string_view> animatedUsdLightSizes(const UsdPrim& light) {
    std::vector<std::string_view> sizes;
    std::ranges::copy_if(kSizes, std::back_inserter(sizes),
                         [&](std::string_view size) { return UsdStage::animated(light, size); });
    return sizes;
}

double usdLightArea(const UsdAttributes& light, const glm::dmat4& toWorld) {
    const std::string& type = light.prim().typeName;
    const glm::dmat3 linear(toWorld);
    const glm::dvec3 size = usdLightSize(light);
    const double flat = areaFactor(linear, {1, 0, 0}, {0, 1, 0});
    if (type == "RectLight") return size.x * size.y * flat;
    if (type == "DiskLight") return kPi * size.x * size.y * flat;
    if (type == "SphereLight") return sphereArea(linear, size.x);
    return tubeArea(linear, size.y, size.x);
}

NodePtr makeUsdLight(const std::string& name, const UsdAttributes& light, const glm::dmat4& toWorld,
                     Diagnostics& diagnostics) {
    const std::string& type = light.prim().typeName;
    const double area = usdLightArea(light, toWorld);
    if (!(area > 0) || !std::isfinite(area)) {
        diagnostics.warn(light.prim().location(), "a light without area left out");
        return nullptr;
    }
    const Rgb luminance = usdLightLuminance(light, area, diagnostics);
    const auto size = [&](std::string_view input, double fallback) {
        return roundToFloat(light.number(input, fallback));
    };
    if (type == "RectLight") {
        const RectShape rect{size("inputs:width", 1), size("inputs:height", 1)};
        return std::make_shared<Light>(name, rect, luminance);
    }
    const float radius = size("inputs:radius", 0.5);
    if (type == "DiskLight") return std::make_shared<Light>(name, DiskShape{radius}, luminance);
    if (type == "SphereLight") return std::make_shared<Light>(name, SphereShape{radius}, luminance);
    return makeTube(name, light.prim().name, double(radius), light.number("inputs:length", 1),
                    luminance);
}

bool isUsdLightWithoutArea(std::string_view typeName) {
    constexpr std::array<std::string_view, 6> kTypes{
        "DistantLight", "DomeLight", "DomeLight_1", "PortalLight", "GeometryLight", "PluginLight"};
    return std::find(kTypes.begin(), kTypes.end(), typeName) != kTypes.end();
}

bool isUsdAreaLight(std::string_view typeName) {
    constexpr std::array<std::string_view, 4> kTypes{"RectLight", "DiskLight", "SphereLight",
                                                     "CylinderLight"};
    return std::find(kTypes.begin(), kTypes.end(), typeName) != kTypes.end();
}

} // namespace penumbra
