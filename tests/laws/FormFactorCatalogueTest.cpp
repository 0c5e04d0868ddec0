// Closed form factors against the analytic cases of tests/data/formfactors (Howell's catalogue, and
// integrals whose inner part is exact; each case says where its number comes from).
#include "io/usd/scene/UsdScene.h"
#include "radiosity/mesh/BuildPatches.h"
#include "radiosity/rays/RayScene.h"
#include "radiosity/rows/EmitterSender.h"
#include "radiosity/rows/FormFactor.h"
#include "scenegraph/Objects.h"
#include "tests/support/Reference.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <functional>
#include <numbers>

namespace penumbra {

namespace {

using Json = nlohmann::json;
using Polygon = std::vector<glm::vec3>;

constexpr double kTolerance = 1e-4; // relative

glm::vec3 vectorOf(const Json& json) {
    return {json[0], json[1], json[2]};
}

Polygon polygonOf(const Json& json) {
    Polygon polygon;
    for (const Json& point : json) polygon.push_back(vectorOf(point));
    return polygon;
}

/// All cases by name.
std::map<std::string, Json> cases() {
    std::ifstream file(dataFile("formfactors/formfactors.json"));
    std::map<std::string, Json> byName;
    for (const Json& entry : Json::parse(file)) byName[entry["name"]] = entry;
    return byName;
}

double valueOf(const Json& entry) {
    return std::stod(entry["value"].get<std::string>());
}

/// Gauss-Legendre quadrature on [0, 1].
struct Node {
    double x, weight;
};
std::vector<Node> gaussLegendre(int count) {
    std::vector<Node> nodes;
    for (int i = 0; i < count; ++i) {
        double x = std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5)), slope = 1;
        for (int step = 0; step < 8; ++step) { // Newton's method on the Legendre polynomial
            double p0 = 1, p1 = x;
            for (int k = 2; k <= count; ++k) {
                const double p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
                p0 = p1, p1 = p2;
            }
            slope = count * (x * p1 - p0) / (x * x - 1);
            x -= p1 / slope;
        }
        nodes.push_back({0.5 + 0.5 * x, 1 / ((1 - x * x) * slope * slope)});
    }
    return nodes;
}

/// Mean of f over [0, 1], with points crowded at both ends, where form factors between touching
/// surfaces change fast: x = 3 t^2 - 2 t^3.
double meanOverUnit(const std::function<double(double)>& f, int count = 32) {
    double sum = 0;
    for (const auto& [t, weight] : gaussLegendre(count))
        sum += weight * f(t * t * (3 - 2 * t)) * 6 * t * (1 - t);
    return sum;
}

/// Mean of f over a parallelogram.
double meanOver(const Polygon& p, const std::function<double(glm::vec3)>& f, int count = 32) {
    const auto at = [&](double s, double t) {
        return glm::vec3(glm::dvec3(p[0]) + s * glm::dvec3(p[1] - p[0]) +
                         t * glm::dvec3(p[3] - p[0]));
    };
    return meanOverUnit(
        [&](double s) { return meanOverUnit([&](double t) { return f(at(s, t)); }, count); },
        count);
}

glm::vec3 normalOf(const Polygon& p) {
    return glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
}

TEST(FormFactorCatalogue, OfPolygonToPolygonIsMetByQuadratureOfTheClosedForm) {
    int checked = 0;
    for (const auto& [name, entry] : cases()) {
        const Json& geometry = entry["geometry"];
        if (!geometry.contains("A1") || geometry.contains("blocker")) continue;
        const Polygon from = polygonOf(geometry["A1"]), to = polygonOf(geometry["A2"]);
        const double mean =
            meanOver(from, [&](glm::vec3 p) { return polygonFormFactor(p, normalOf(from), to); });
        EXPECT_NEAR(mean, valueOf(entry), kTolerance * valueOf(entry)) << name;
        ++checked;
    }
    EXPECT_EQ(checked, 18);
}

TEST(FormFactorCatalogue, OfElementToRectangleIsTheClosedFormItself) {
    int checked = 0;
    for (const auto& [name, entry] : cases()) {
        const Json& geometry = entry["geometry"];
        if (!geometry.contains("rect")) continue;
        Polygon rectangle = polygonOf(geometry["rect"]);
        const glm::vec3 p = vectorOf(geometry["element"]), n = vectorOf(geometry["normal"]);
        // The table does not care which way the rectangle faces: show its front.
        if (glm::dot(normalOf(rectangle), rectangle[0] - p) > 0)
            std::reverse(rectangle.begin(), rectangle.end());
        EXPECT_NEAR(polygonFormFactor(p, n, rectangle), valueOf(entry), kTolerance * valueOf(entry))
            << name;
        ++checked;
    }
    EXPECT_EQ(checked, 5);
}

TEST(FormFactorCatalogue, OfElementToDiskIsTheClosedFormItself) {
    int checked = 0;
    for (const auto& [name, entry] : cases()) {
        const Json& geometry = entry["geometry"];
        if (!geometry.contains("disk_r")) continue;
        const glm::vec3 n = vectorOf(geometry["normal"]);
        EXPECT_NEAR(diskFormFactor(vectorOf(geometry["element"]), n,
                                   vectorOf(geometry["disk_centre"]), -n, geometry["disk_r"]),
                    valueOf(entry), kTolerance * valueOf(entry))
            << name;
        ++checked;
    }
    EXPECT_EQ(checked, 6);
}

/// Mean over a disk of radius r around the z axis of what depends on the distance from it alone.
double meanOverDisk(double r, const std::function<double(double)>& f) {
    return meanOverUnit([&](double t) { return 2 * t * f(r * t); });
}

TEST(FormFactorCatalogue, OfCoaxialDisksIsTheMeanOverTheFirst) {
    for (const char* name :
         {"coaxial_disks_1_1_h1", "coaxial_disks_1_2_h1", "coaxial_disks_0.3_1_h2"}) {
        const Json entry = cases().at(name);
        const double r1 = entry["geometry"]["r1"], r2 = entry["geometry"]["r2"];
        const double h = entry["geometry"]["h"];
        const double mean = meanOverDisk(r1, [&](double r) {
            return diskFormFactor({r, 0, 0}, {0, 0, 1}, {0, 0, h}, {0, 0, -1}, float(r2));
        });
        EXPECT_NEAR(mean, valueOf(entry), kTolerance * valueOf(entry)) << name;
    }
}

TEST(FormFactorCatalogue, OfElementFacingASphereIsTheSquareOfRadiusOverDistance) {
    for (const char* name : {"element_sphere_facing_r1_h2", "element_sphere_facing_r0.5_h1"}) {
        const Json entry = cases().at(name);
        const float h = entry["geometry"]["h"];
        EXPECT_NEAR(sphereFormFactor({0, 0, 0}, {0, 0, 1}, {0, 0, h}, entry["geometry"]["r"]),
                    valueOf(entry), kTolerance * valueOf(entry))
            << name;
    }
}

TEST(FormFactorCatalogue, OfSphereToCoaxialDiskFollowsByReciprocityForAnySphere) {
    for (const char* name : {"sphere_disk_coaxial_r0.5_h1", "sphere_disk_coaxial_r0.3_h2"}) {
        const Json entry = cases().at(name);
        const double r = entry["geometry"]["r"], h = entry["geometry"]["h"];
        for (const double sphere : {0.1, 0.4, 0.9}) {
            const double toSphere = meanOverDisk(r, [&](double x) {
                return sphereFormFactor({x, 0, 0}, {0, 0, 1}, {0, 0, h}, float(sphere));
            });
            EXPECT_NEAR(toSphere * r * r / (4 * sphere * sphere), valueOf(entry),
                        kTolerance * valueOf(entry))
                << name << ", sphere of radius " << sphere;
        }
    }
}

TEST(FormFactorCatalogue, OfConcentricSpheresIsTheRatioOfTheirAreas) {
    const double expected = valueOf(cases().at("concentric_spheres_F21_r1=1_r2=2"));
    for (const glm::vec3 side : {glm::vec3(1, 0, 0), glm::vec3(0.6f, 0, -0.8f)})
        EXPECT_NEAR(sphereFormFactor(2.0f * side, -side, {0, 0, 0}, 1), expected,
                    kTolerance * expected);
}

TEST(FormFactorCatalogue, OfSquaresWithABlockerIsMetBySampledVisibility) {
    // 1024 samples a point, 16 x 16 points: the mean over the receiver is good to half a percent of
    // what the squares would exchange without the blocker.
    for (const auto& [name, entry] : cases()) {
        const Json& geometry = entry["geometry"];
        if (!geometry.contains("blocker")) continue;
        const Polygon from = polygonOf(geometry["A1"]);
        RayMesh blocker;
        blocker.vertices = polygonOf(geometry["blocker"]);
        blocker.triangles = {{0, 1, 2}, {0, 2, 3}};
        const RayScene rays(std::array{blocker});
        Emitter emitter;
        emitter.polygons = {polygonOf(geometry["A2"])};
        const EmitterSender sender(emitter, 1024, 1024);
        const double mean = meanOver(
            from,
            [&](glm::vec3 p) {
                const Receiver receiver{p, normalOf(from)};
                return sender.formFactor(receiver) * sender.visibility(rays, receiver, 0, 1024);
            },
            16);
        EXPECT_NEAR(mean, valueOf(entry), 0.005 * 0.1998) << name;
    }
}

TEST(FormFactorCatalogue, DirectLightInTheEmptyBoxIsTheClosedForm) {
    const LoadedScene loaded = loadUsdScene(dataFile("emptybox.usda"));
    const BuiltPatches built =
        buildPatches(placeScene(*loaded.scene), {.patchSize = 2, .elementSize = 2});
    ASSERT_EQ(built.patches.emitters.size(), 1u);
    const Emitter& light = built.patches.emitters[0];
    const EmitterSender sender(light, 16, 16);
    for (const auto& row : readCsv(dataFile("formfactors/emptybox_direct_analytic.csv"))) {
        const auto number = [&](const char* column) { return std::stof(row.at(column)); };
        const float factor = sender.formFactor(
            {{number("x"), number("y"), number("z")}, {number("nx"), number("ny"), number("nz")}});
        const float expected = number("form_factor_to_lamp");
        EXPECT_NEAR(factor, expected, kTolerance * expected);
        EXPECT_NEAR(factor * light.exitance.r, number("Edir_r"), kTolerance * number("Edir_r"));
        EXPECT_NEAR(factor * light.exitance.g, number("Edir_g"), kTolerance * number("Edir_g"));
        EXPECT_NEAR(factor * light.exitance.b, number("Edir_b"), kTolerance * number("Edir_b"));
    }
}

} // namespace

} // namespace penumbra
