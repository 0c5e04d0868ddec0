// From the scene graph to flat arrays.
#include "tests/support/Scenes.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

namespace penumbra {

namespace {

/// A room with a box and a light, all `scale` times a few metres.
Scene room(double scale) {
    return sceneOf({placed("world", scaled(scale),
                           {object("room", boxData({0, 0, 0}, {4, 3, 2.5f}, true)),
                            object("box", boxData({1, 1, 0}, {1.7f, 1.6f, 0.8f}, false)),
                            ceilingLight({2, 1.5f, 2.4f}, 1, 0.5f)})});
}

TEST(BuildPatches, CutsARoomAlikeWhateverItsSize) {
    const PatchSet metres = meshed(room(1)).patches;
    EXPECT_GT(metres.patches.size(), 1500u);
    EXPECT_LT(metres.patches.size(), 10000u);
    for (double scale : {0.01, 0.1}) {
        const PatchSet other = meshed(room(scale)).patches;
        EXPECT_NEAR(other.patchSize, metres.patchSize * scale, 1e-4 * metres.patchSize * scale);
        EXPECT_EQ(other.patches.size(), metres.patches.size());
        EXPECT_EQ(other.elements.size(), metres.elements.size());
    }
}

TEST(BuildPatches, CutsAHallIntoAFewTimesAsManyPatchesAsARoom) {
    // See defaultPatchSize(): from area / 1650 up to area / 6000.
    const std::size_t patches = meshed(room(1)).patches.patches.size();
    EXPECT_LE(meshed(room(100)).patches.patches.size(), 4 * patches);
}

TEST(BuildPatches, AGroundBeyondTheRoomDoesNotMakeItsPatchesLarge) {
    const Scene within = room(1);
    Scene outside = room(1);
    outside.root->add(object("ground", floorData(-110, 110, -110, 110, -0.1f)));
    const float room = resolvedSizes(placeScene(within), {}).patchSize;
    const MeshingOptions sizes = resolvedSizes(placeScene(outside), {});
    EXPECT_FLOAT_EQ(sizes.patchSize, room);
    const PatchSet set = meshed(outside).patches;
    EXPECT_EQ(set.patchSize, sizes.patchSize);
    EXPECT_LT(set.patches.size(), 6500 + meshed(within).patches.patches.size());
}

TEST(BuildPatches, GivesLightThatDoesNotDependOnTheScale) {
    // Illuminance has no length in it.
    const MeshingOptions coarse{.patchSize = 0.5f, .elementSize = 0.25f};
    const Solution metres(room(1), coarse);
    for (double scale : {0.01, 100.0}) {
        const Solution other(room(scale),
                             {.patchSize = float(0.5 * scale), .elementSize = float(0.25 * scale)});
        ASSERT_EQ(other.patches().vertices.size(), metres.patches().vertices.size());
        double sum = 0, difference = 0;
        for (std::size_t v = 0; v < metres.patches().vertices.size(); ++v) {
            sum += metres.at(v).r;
            difference += std::abs(other.at(v).r - metres.at(v).r);
        }
        EXPECT_LT(difference, 2e-3 * sum) << "scale " << scale;
    }
}

TEST(BuildPatches, NamesTheObjectOfEveryElementAndPatch) {
    const PatchSet set = meshed(room(1), {.patchSize = 0.5f}).patches;
    ASSERT_EQ(set.elementObject.size(), set.elements.size());
    ASSERT_EQ(set.rayMeshes.size(), set.objects.size());
    std::set<std::string> seen;
    for (std::size_t e = 0; e < set.elements.size(); ++e) {
        const std::string& path = set.objects[set.elementObject[e].value].path;
        seen.insert(path);
        const glm::vec3 p = set.vertices[set.elements[e].vertices[0]].position;
        const bool onBox = p.x >= 0.99f && p.x <= 1.71f && p.y >= 0.99f && p.y <= 1.61f &&
                           p.z > 0.01f && p.z < 0.81f;
        EXPECT_EQ(path == "/world/box", onBox || (path == "/world/box" && p.z < 0.01f));
        if (set.elements[e].patch != Element::kNone) {
            EXPECT_EQ(set.patches[set.elements[e].patch].object, set.elementObject[e]);
        }
    }
    EXPECT_EQ(seen, (std::set<std::string>{"/world/room", "/world/box", "/world/lamp"}));
}

TEST(BuildPatches, HasConsistentArrays) {
    const PatchSet set = meshed(room(1), {.patchSize = 0.5f}).patches;
    ASSERT_EQ(set.vertexCoordinates.size(), set.vertices.size());
    std::vector<int> owned(set.elements.size());
    double area = 0;
    for (std::uint32_t p = 0; p < set.patches.size(); ++p) {
        const Patch& patch = set.patches[p];
        double sum = 0;
        for (std::uint32_t i = 0; i < patch.elementCount; ++i) {
            const std::uint32_t e = set.patchElements[patch.firstElement + i];
            EXPECT_EQ(set.elements[e].patch, p);
            ++owned[e];
            sum += elementArea(set, set.elements[e]);
        }
        EXPECT_NEAR(patch.area, sum, 1e-5 * sum);
        EXPECT_LT(patch.centreNode, set.nodes.size());
        area += sum;
    }
    for (std::size_t e = 0; e < owned.size(); ++e)
        EXPECT_EQ(owned[e], set.elements[e].patch == Element::kNone ? 0 : 1);
    EXPECT_NEAR(set.area, area, 1e-4 * area);
}

TEST(BuildPatches, CountsPolygonsOfTheSceneNotOfItsLights) {
    EXPECT_EQ(meshed(room(1), {.patchSize = 1}).patches.polygons, 12u);
}

TEST(BuildPatches, MakesEmittersOfLightsAndOfGlowingFaces) {
    MeshData glowing = boxData({0, 0, 0}, {1, 1, 1}, false, paint(Rgb(0.0f)));
    glowing.materials.push_back(paint(Rgb(0.5f), {2, 2, 2}));
    glowing.faceMaterial = {0, 1, 0, 0, 1, 0}; // two faces of 1 m^2
    const auto scene = sceneOf({object("glow", glowing), ceilingLight({0, 0, 3}, 1, 2)});

    // With large patches the two faces are one emitter, like those of a bulb.
    const PatchSet coarse = meshed(scene, {.patchSize = 1, .elementSize = 0.5f}).patches;
    ASSERT_EQ(coarse.emitters.size(), 2u);
    EXPECT_EQ(coarse.emitters[0].polygons.size(), 2u);
    EXPECT_NEAR(coarse.emitters[0].area, 2, 1e-6);
    EXPECT_FLOAT_EQ(coarse.emitters[0].exitance.r, 2 * std::numbers::pi_v<float>);
    EXPECT_EQ(coarse.emitters[0].path, "/glow/mesh");
    EXPECT_NEAR(coarse.emitters[1].area, 2, 1e-6);

    // With small ones they are large senders and are cut; nothing is lost.
    const PatchSet fine = meshed(scene, {.patchSize = 0.1f, .elementSize = 0.1f}).patches;
    double area = 0;
    for (const Emitter& emitter : fine.emitters)
        if (emitter.path == "/glow/mesh") area += emitter.area;
    EXPECT_GT(fine.emitters.size(), 3u);
    EXPECT_NEAR(area, 2, 1e-5);
}

TEST(BuildPatches, CutsWhatGlowsAlikeWhateverElseOfItsMeshGlows) {
    const auto emittersOf = [](const std::shared_ptr<Material>& other) {
        MeshData glowing = boxData({0, 0, 0}, {1, 1, 1}, false, paint(Rgb(0.5f), {2, 2, 2}));
        glowing.materials.push_back(other);
        glowing.faceMaterial = {0, 1, 1, 1, 1, 1};
        const PatchSet set =
            meshed(sceneOf({object("glow", glowing)}), {.patchSize = 0.04f}).patches;
        return std::ranges::count(set.emitters, Rgb(2.0f * std::numbers::pi_v<float>),
                                  &Emitter::exitance);
    };
    EXPECT_GT(emittersOf(paint(Rgb(0.5f))), 4);
    EXPECT_EQ(emittersOf(paint(Rgb(0.5f))), emittersOf(paint(Rgb(0.5f), {3, 3, 3})));
}

TEST(BuildPatches, WarnsOnceOfFacesLeftOutAndOfDarkness) {
    MeshData floor = floorData(0, 1, 0, 1, 0);
    for (int i = 0; i < 3; ++i) {
        floor.faceVertexCounts.push_back(3);
        for (int k : {0, 1, 1}) floor.faceVertexIndices.push_back(k);
    }
    const auto off = std::make_shared<Light>("light", RectShape{}, Rgb(0.0f));
    const BuiltPatches built =
        meshed(sceneOf({object("floor", floor), placed("off", moved(0, 0, 1), {off})}));
    ASSERT_EQ(built.warnings.size(), 2u);
    EXPECT_EQ(built.warnings[0].substr(0, 2), "3 ");
    EXPECT_NE(built.warnings[1].find("no light of the scene shines"), std::string::npos);
}

TEST(BuildPatches, HoldsPatchesBelowTheSizeAskedFor) {
    const PatchSet set = meshed(room(1), {.patchSize = 0.3f, .elementSize = 0.1f}).patches;
    for (const Patch& patch : set.patches) EXPECT_LE(patch.area, 0.3f * 0.3f * 1.01f);
    for (const Element& element : set.elements)
        EXPECT_LE(elementArea(set, element), 0.1f * 0.1f * 1.01f);
}

TEST(BuildPatches, OfNothingIsNothing) {
    const BuiltPatches built = meshed(Scene());
    EXPECT_TRUE(built.patches.elements.empty());
    EXPECT_TRUE(built.patches.patches.empty());
}

/// Lights a scene and returns the messages about it; all light is to be finite.
std::vector<std::string> warningsOf(Scene scene) {
    const Solution solution(std::move(scene), {.patchSize = 0.5f, .elementSize = 0.25f});
    for (std::size_t v = 0; v < solution.patches().vertices.size(); ++v)
        EXPECT_TRUE(std::isfinite(luminance(solution.at(v)))) << v;
    return {solution.lit.warnings().begin(), solution.lit.warnings().end()};
}

TEST(BuildPatches, LightsASubdivisionCageThatIsScaledFlat) {
    // A usual way to hide things. Normals around the rim of what is left face both ways.
    MeshData cage = boxData({0, 0, 0}, {1, 1, 1}, false);
    cage.scheme = SubdivisionScheme::catmullClark;
    const glm::dmat4 flat = glm::scale(glm::dmat4(1.0), glm::dvec3(1, 1, 0));
    const auto warnings = warningsOf(
        sceneOf({placed("flat", flat, {object("cage", cage)}), ceilingLight({1, 1, 2}, 1, 1)}));
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0], "4 faces without area, folded over or with too many corners left out "
                           "(/flat/cage/mesh)");
}

TEST(BuildPatches, TakesACageThatIsRefusedForItsPolygonsInEveryWay) {
    // A round table top in 128 triangles: OpenSubdiv takes no more than 100 at a point. Its flat
    // cells blocked rays as all of their elements.
    MeshData data;
    data.materials = {paint(Rgb(0.5f))};
    data.points.emplace_back(0, 0, 1);
    for (int i = 0; i < 128; ++i) {
        const double angle = 2 * std::numbers::pi * i / 128;
        data.points.emplace_back(std::cos(angle), std::sin(angle), 1);
        data.faceVertexCounts.push_back(3);
        for (int corner : {0, i + 1, (i + 1) % 128 + 1}) data.faceVertexIndices.push_back(corner);
    }
    const auto patches = [&](SubdivisionScheme scheme) {
        data.scheme = scheme;
        return meshed(sceneOf({object("table", data), ceilingLight({0, 0, 2.4f}, 1, 0.5f)}),
                      {.patchSize = 0.2f, .elementSize = 0.02f})
            .patches;
    };
    const PatchSet plain = patches(SubdivisionScheme::none);
    const PatchSet refused = patches(SubdivisionScheme::catmullClark);
    EXPECT_EQ(refused.patches.size(), plain.patches.size());
    EXPECT_EQ(refused.nodes.size(), plain.nodes.size());
    EXPECT_EQ(refused.rayMeshes[0].triangles.size(), plain.rayMeshes[0].triangles.size());
}

TEST(BuildPatches, LightsABowTie) {
    // Its two halves face opposite ways; where they meet there is no side.
    MeshData bow = polygonData({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}});
    bow.scheme = SubdivisionScheme::bilinear;
    const auto warnings =
        warningsOf(sceneOf({object("bow", bow), ceilingLight({0.5f, 0.5f, 1}, 1, 1)}));
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0],
              "1 face without area, folded over or with too many corners left out (/bow/mesh)");
}

TEST(BuildPatches, LeavesOutLightsThatAreTooSmallToBeTraced) {
    for (const LightShape& shape : {LightShape(DiskShape{5e-7f}), LightShape(SphereShape{1e-38f})})
        for (const float x : {0.0f, 0.5f}) {
            const auto light = std::make_shared<Light>("light", shape, Rgb(1.0f));
            const auto warnings = warningsOf(sceneOf({object("floor", floorData(-1, 1, -1, 1, -1)),
                                                      placed("tiny", moved(x, x, 1), {light})}));
            const bool nothing = std::holds_alternative<SphereShape>(shape);
            ASSERT_EQ(warnings.size(), nothing ? 2u : 0u);
            if (!nothing) continue;
            EXPECT_EQ(warnings[0], "1 light too small to be traced left out (/tiny/light)");
            EXPECT_THAT(warnings[1], testing::HasSubstr("no light"));
        }
}

TEST(BuildPatches, SaysHowFarItHasComeAndNeverGoesBack) {
    std::vector<double> shares;
    const LitScene lit(placeScene(room(1)), {.patchSize = 0.5f}, {}, true,
                       [&](const char*, double done) { shares.push_back(done); });
    EXPECT_GE(shares.size(), 8u);
    EXPECT_TRUE(std::ranges::is_sorted(shares));
    EXPECT_GE(shares.front(), 0);
    EXPECT_LE(shares.back(), 1);
    double longest = 0;
    for (std::size_t i = 1; i < shares.size(); ++i)
        longest = std::max(longest, shares[i] - shares[i - 1]);
    EXPECT_LT(longest, 0.3);
}

} // namespace

} // namespace penumbra
