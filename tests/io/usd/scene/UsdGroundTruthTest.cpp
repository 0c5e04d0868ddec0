// Scenes made by others, against what OpenUSD 24.11 itself composes from them (one JSON object a
// prim). The files lie beside the project; without them these tests skip.
#include "io/usd/shade/UsdMaterial.h"
#include "tests/io/usd/UsdTestFiles.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <numbers>

namespace penumbra {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct TruthFile {
    fs::path scene;
    std::vector<json> prims; // with a path
    bool readable = true;
};

TruthFile readTruth(const fs::path& jsonl, const fs::path& scene) {
    TruthFile truth{scene, {}, true};
    std::ifstream in(jsonl);
    for (std::string line; std::getline(in, line);) {
        json object = json::parse(line);
        if (object.contains("layer") && object["layer"] == "unreadable") truth.readable = false;
        if (object.contains("path")) truth.prims.push_back(std::move(object));
    }
    return truth;
}

std::vector<TruthFile> allTruth(const fs::path& shared) {
    std::vector<TruthFile> files;
    for (const auto& entry : fs::directory_iterator(shared / "assets/expected")) {
        std::string name = entry.path().stem().string();
        if (entry.path().extension() != ".jsonl") continue;
        std::replace(name.begin(), name.end(), '~', '/');
        files.push_back(readTruth(entry.path(), shared / "assets" / name));
    }
    for (const char* name : {"lib_chair", "lights", "refs", "xform_ops"}) {
        const fs::path base = shared / "assets/compose" / name;
        files.push_back(readTruth(base.string() + ".jsonl", base.string() + ".usda"));
    }
    std::sort(files.begin(), files.end(), [](auto& a, auto& b) { return a.scene < b.scene; });
    return files;
}

// OpenUSD's row-vector matrix as columns; the identity if it is left out.
glm::dmat4 worldOf(const json& prim) {
    glm::dmat4 m(1.0);
    if (prim.contains("world"))
        for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = prim["world"][std::size_t(i)];
    return m;
}

double largestDifference(const glm::dmat4& a, const glm::dmat4& b) {
    double largest = 0;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            largest =
                std::max(largest, std::abs(a[c][r] - b[c][r]) / std::max(1.0, std::abs(b[c][r])));
    return largest;
}

// The scene's frame in file units, as OpenUSD reports it.
glm::dmat4 inFileUnits(glm::dmat4 toWorld, double metersPerUnit) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 3; ++r) toWorld[c][r] /= metersPerUnit;
    return toWorld;
}

Rgb colourOf(const json& prim, const char* key, Rgb fallback) {
    if (!prim.contains(key)) return fallback;
    return {prim[key][0], prim[key][1], prim[key][2]};
}

// Calls check(prim, node with its transform, in file units) for each prim of each readable file
// that has a node; returns how many.
template <class Check>
std::size_t forEachPrim(const fs::path& shared, Check check) {
    std::size_t checked = 0;
    for (const TruthFile& truth : allTruth(shared)) {
        if (!truth.readable) continue;
        const LoadedScene loaded = loadUsdScene(truth.scene, {.allowOutside = true});
        const auto nodes = nodesByPath(*loaded.scene);
        for (const json& prim : truth.prims) {
            const std::string path = prim["path"];
            SCOPED_TRACE(truth.scene.string() + " " + path);
            const bool group = prim["type"] == "Xform" || !nodes.contains(path);
            const PlacedNode* leaf = group ? nullptr : leafOf(nodes, path);
            if (!leaf && !nodes.contains(path)) continue;
            PlacedNode placed = leaf ? *leaf : nodes.at(path);
            placed.toWorld = inFileUnits(placed.toWorld, loaded.scene->metersPerUnit);
            check(prim, placed, loaded);
            ++checked;
        }
    }
    return checked;
}

// Whether a prim of the truth is drawn, as far as its own line tells.
bool isDrawn(const json& prim) {
    const std::string purpose = prim.value("purpose", "default");
    return prim.value("visibility", "inherited") != "invisible" &&
           (purpose == "default" || purpose == "render");
}

} // namespace

TEST(UsdGroundTruth, FilesLoadExactlyWhenOpenUsdLoadsThem) {
    const auto shared = sharedFolder();
    if (!shared) GTEST_SKIP() << "the shared scenes are not here";
    for (const TruthFile& truth : allTruth(*shared)) {
        SCOPED_TRACE(truth.scene.string());
        if (truth.readable)
            EXPECT_NO_THROW(loadUsdScene(truth.scene, {.allowOutside = true}));
        else
            EXPECT_THROW(loadUsdScene(truth.scene, {.allowOutside = true}), SceneFileError);
    }
}

TEST(UsdGroundTruth, EveryShapeLightAndCameraHasANode) {
    const auto shared = sharedFolder();
    if (!shared) GTEST_SKIP() << "the shared scenes are not here";
    const std::vector<std::string> shown{
        "Mesh",  "Cube",      "Sphere",    "Cylinder",    "Cone",          "Capsule", "Plane",
        "Xform", "RectLight", "DiskLight", "SphereLight", "CylinderLight", "Camera"};
    std::size_t files = 0;
    for (const TruthFile& truth : allTruth(*shared)) {
        if (!truth.readable) continue;
        const LoadedScene loaded = loadUsdScene(truth.scene, {.allowOutside = true});
        ++files;
        const auto nodes = nodesByPath(*loaded.scene);
        for (const json& prim : truth.prims) {
            const std::string path = prim["path"];
            const bool wanted =
                std::find(shown.begin(), shown.end(), prim["type"]) != shown.end() &&
                isDrawn(prim) && !(prim.contains("area") && prim["area"] == 0);
            EXPECT_TRUE(!wanted || nodes.contains(path)) << truth.scene << " " << path;
            EXPECT_TRUE(isDrawn(prim) || !nodes.contains(path)) << truth.scene << " " << path;
        }
    }
    EXPECT_GE(files, 40u);
}

TEST(UsdGroundTruth, NodesStandWhereOpenUsdHasThem) {
    const auto shared = sharedFolder();
    if (!shared) GTEST_SKIP() << "the shared scenes are not here";
    const std::size_t checked = forEachPrim(
        *shared, [](const json& prim, const PlacedNode& placed, const LoadedScene& loaded) {
            // OpenUSD says no matrix for what isn't xformable; ours are affine.
            if (prim["type"] == "" || prim["type"] == "Scope" || countOf(loaded, "projective") > 0)
                return;
            EXPECT_LT(largestDifference(placed.toWorld, worldOf(prim)), 1e-6);
        });
    EXPECT_GE(checked, 400u);
}

TEST(UsdGroundTruth, MeshesHaveTheFacesAndTheAreaThatOpenUsdCounts) {
    const auto shared = sharedFolder();
    if (!shared) GTEST_SKIP() << "the shared scenes are not here";
    std::size_t meshes = 0;
    forEachPrim(
        *shared, [&](const json& prim, const PlacedNode& placed, const LoadedScene& loaded) {
            const Mesh* mesh = placed.mesh();
            // Area 0: points of a type that OpenUSD doesn't take (we take doubles).
            if (!mesh || prim["type"] != "Mesh" || prim["area"] == 0) return;
            if (countOf(loaded, "projective") > 0) return; // ours are affine
            ++meshes;
            // Faces without area are left out.
            const std::size_t faces = prim["faces"];
            EXPECT_LE(mesh->faceCount(), faces);
            EXPECT_GE(mesh->faceCount() + countOf(loaded, "left out"), faces);
            const double area = prim["area"];
            EXPECT_NEAR(surfaceArea(*mesh, placed.toWorld), area, 1e-5 * area);
            EXPECT_EQ(mesh->data().doubleSided, prim.value("doubleSided", false));
            EXPECT_EQ(mesh->data().scheme == SubdivisionScheme::none,
                      prim["subdiv"] == "none" || countOf(loaded, "Loop subdivision needs") > 0);
            const bool bound = prim.contains("material") && mesh->data().materials.size() == 1;
            const std::string material = bound ? prim["material"] : "";
            EXPECT_TRUE(!bound || material.ends_with("/" + mesh->data().materials[0]->name()));
        });
    EXPECT_GE(meshes, 300u);
}

TEST(UsdGroundTruth, ColoursWithoutMaterialAreTheDisplayColour) {
    const auto shared = sharedFolder();
    if (!shared) GTEST_SKIP() << "the shared scenes are not here";
    std::size_t coloured = 0;
    forEachPrim(*shared, [&](const json& prim, const PlacedNode& placed, const LoadedScene&) {
        const Mesh* mesh = placed.mesh();
        const bool constant = prim.contains("displayColor") && !prim.contains("material");
        if (!mesh || !constant || mesh->data().materials.size() != 1) return;
        ++coloured;
        const Rgb wanted = colourOf(prim, "displayColor", Rgb());
        const Rgb found = mesh->data().materials[0]->reflectance();
        const auto expectChannel = [](float is, float should) {
            EXPECT_NEAR(is, std::min(should, Material::kMaxReflectance), 1e-6);
        };
        expectChannel(found.r, wanted.r);
        expectChannel(found.g, wanted.g);
        expectChannel(found.b, wanted.b);
    });
    EXPECT_GE(coloured, 15u);
}

TEST(UsdGroundTruth, CamerasSeeTheAngleThatOpenUsdComputes) {
    const auto shared = sharedFolder();
    if (!shared) GTEST_SKIP() << "the shared scenes are not here";
    std::size_t cameras = 0;
    forEachPrim(*shared, [&](const json& prim, const PlacedNode& placed, const LoadedScene&) {
        const Camera* camera = placed.camera();
        if (!camera) return;
        ++cameras;
        const auto angle = [&](double aperture) {
            return 2 * std::atan(aperture / (2 * double(camera->lens().focalLength))) * 180 /
                   std::numbers::pi;
        };
        EXPECT_NEAR(angle(camera->lens().horizontalAperture), prim["fovH"], 1e-4);
        EXPECT_NEAR(angle(camera->lens().verticalAperture), prim["fovV"], 1e-4);
    });
    EXPECT_GE(cameras, 25u);
}

TEST(UsdGroundTruth, LightsSendWhatTheirInputsSay) {
    const auto shared = sharedFolder();
    if (!shared) GTEST_SKIP() << "the shared scenes are not here";
    std::size_t lights = 0;
    forEachPrim(*shared, [&](const json& prim, const PlacedNode& placed, const LoadedScene&) {
        const Light* light = placed.light();
        if (!light) return;
        ++lights;
        double factor =
            double(prim["inputs:intensity"]) * std::exp2(double(prim["inputs:exposure"]));
        double size = 1; // of the unit shape in the light's plane
        if (const auto* rect = std::get_if<RectShape>(&light->shape())) {
            EXPECT_FLOAT_EQ(rect->width, prim["inputs:width"]);
            EXPECT_FLOAT_EQ(rect->height, prim["inputs:height"]);
            size = double(rect->width) * double(rect->height);
        } else if (const auto* disk = std::get_if<DiskShape>(&light->shape())) {
            EXPECT_FLOAT_EQ(disk->radius, prim["inputs:radius"]);
        } else {
            EXPECT_FLOAT_EQ(std::get<SphereShape>(light->shape()).radius, prim["inputs:radius"]);
        }
        const glm::dmat3 m(placed.toWorld);
        if (prim["inputs:normalize"]) factor /= size * glm::length(glm::cross(m[0], m[1]));
        Rgb wanted = colourOf(prim, "inputs:color", Rgb(1)) * float(factor);
        if (prim.contains("blackbody")) wanted = wanted * colourOf(prim, "blackbody", Rgb(1));
        EXPECT_NEAR(light->luminance().r, wanted.r, 0.004f * wanted.r);
        EXPECT_NEAR(light->luminance().g, wanted.g, 0.004f * wanted.g);
        EXPECT_NEAR(light->luminance().b, wanted.b, 0.008f * wanted.b);
    });
    EXPECT_GE(lights, 14u);
}

TEST(UsdGroundTruth, MaterialsReflectTheirDiffuseColour) {
    const auto shared = sharedFolder();
    if (!shared) GTEST_SKIP() << "the shared scenes are not here";
    std::size_t materials = 0;
    for (const TruthFile& truth : allTruth(*shared)) {
        if (!truth.readable) continue;
        UsdStage stage = UsdStage::open(truth.scene);
        UsdMaterials reader(stage, std::nullopt, stage.diagnostics());
        for (const json& prim : truth.prims) {
            if (prim.value("surface", "") != "UsdPreviewSurface" ||
                !prim.contains("diffuseColor") || !prim["diffuseColor"].is_array())
                continue;
            SCOPED_TRACE(truth.scene.string() + " " + std::string(prim["path"]));
            const UsdSurface& surface = reader.at(prim["path"]);
            ASSERT_TRUE(surface.material);
            const float cover = prim.value("opacity", 1.0f) * (1 - prim.value("metallic", 0.0f));
            const Rgb wanted = colourOf(prim, "diffuseColor", Rgb()) * cover;
            const Rgb found = surface.material->reflectance();
            const float limit = Material::kMaxReflectance;
            EXPECT_NEAR(found.r, std::min(wanted.r, limit), 1e-6);
            EXPECT_NEAR(found.g, std::min(wanted.g, limit), 1e-6);
            EXPECT_NEAR(found.b, std::min(wanted.b, limit), 1e-6);
            ++materials;
        }
    }
    EXPECT_GE(materials, 90u);
}

} // namespace penumbra
