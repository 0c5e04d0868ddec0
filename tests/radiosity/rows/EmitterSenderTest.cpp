// Emitters as one receiver sees them.
#include "radiosity/rows/EmitterSender.h"
#include "radiosity/mesh/Emitters.h"
#include "radiosity/rows/FormFactor.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

#include <numbers>

namespace penumbra {

namespace {

/// Emitters of each kind one metre above the origin, facing down.
std::vector<Emitter> emitters() {
    std::vector<Emitter> list;
    for (const LightShape& shape : {LightShape(RectShape{0.8f, 0.6f}), LightShape(DiskShape{0.4f}),
                                    LightShape(SphereShape{0.3f})})
        list.push_back(lightEmitter(Light("lamp", shape, Rgb(1.0f)), moved(0, 0, 1)));
    return list;
}

RayMesh quadMesh(std::vector<glm::vec3> corners) {
    RayMesh mesh;
    mesh.vertices = std::move(corners);
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.solid = {0, 0};
    return mesh;
}

const Receiver kBelow{{0.1f, -0.2f, 0}, {0, 0, 1}};
const Receiver kMiddle{{0, 0, 0}, {0, 0, 1}};

TEST(EmitterSender, IsWhollySeenWhenNothingStandsBetween) {
    const RayScene nothing(std::span<const RayMesh>{});
    for (const Emitter& emitter : emitters())
        EXPECT_EQ(EmitterSender(emitter, 16, 64).visibility(nothing, kBelow, 0, 64), 1);
}

TEST(EmitterSender, IsHalfSeenWhenHalfIsCovered) {
    // A screen over x < 0, halfway up, seen from the middle: half of every emitter is left.
    const RayScene screen(
        std::array{quadMesh({{-3, -3, 0.5f}, {0, -3, 0.5f}, {0, 3, 0.5f}, {-3, 3, 0.5f}})});
    for (const Emitter& emitter : emitters()) {
        const EmitterSender sender(emitter, 16, 64);
        EXPECT_NEAR(sender.visibility(screen, kMiddle, 0, 16), 0.5, 0.03);
        EXPECT_NEAR(sender.visibility(screen, kMiddle, 0, 64), 0.5, 0.01);
    }
}

TEST(EmitterSender, IsNotSeenBehindAWall) {
    const RayScene wall(
        std::array{quadMesh({{-3, -3, 0.5f}, {3, -3, 0.5f}, {3, 3, 0.5f}, {-3, 3, 0.5f}})});
    for (const Emitter& emitter : emitters())
        EXPECT_EQ(EmitterSender(emitter, 16, 64).visibility(wall, kBelow, 0, 16), 0);
}

TEST(EmitterSender, HasTheFormFactorOfItsShape) {
    const auto list = emitters();
    const auto factor = [](const Emitter& emitter) {
        return EmitterSender(emitter, 16, 16).formFactor(kBelow);
    };
    EXPECT_EQ(factor(list[0]),
              polygonFormFactor(kBelow.position, kBelow.normal, list[0].polygons[0]));
    EXPECT_EQ(factor(list[1]), diskFormFactor(kBelow.position, kBelow.normal, {0, 0, 1}, {0, 0, -1},
                                              list[1].radius));
    EXPECT_EQ(factor(list[2]),
              sphereFormFactor(kBelow.position, kBelow.normal, {0, 0, 1}, list[2].radius));
}

TEST(EmitterSender, WeighsItsSamplesByTheKernelOfTheFormFactor) {
    // F = 1/pi * integral of cos cos / d^2, so the mean weight times area / pi is F. For the sphere
    // the area is that of its tangent disk.
    for (const Emitter& emitter : emitters()) {
        const EmitterSender sender(emitter, 64, 64);
        double sum = 0;
        SampleGroup group;
        for (int first = 0; first < 64; first += 16) {
            sender.sampleGroup(kBelow, first, group);
            for (float weight : group.weight) sum += double(weight) / 64;
        }
        double area = emitter.area;
        if (emitter.kind == Emitter::Kind::sphere) {
            const float r = tangentDisk(kBelow.position, emitter.centre, emitter.radius).radius;
            area = std::numbers::pi * r * r;
        }
        const float factor = sender.formFactor(kBelow);
        EXPECT_NEAR(sum * area / std::numbers::pi, factor, 0.01 * factor);
    }
}

TEST(EmitterSender, SamplesTheSideOfASphereThatFacesTheReceiver) {
    const Emitter sphere = emitters()[2];
    const EmitterSender sender(sphere, 16, 16);
    SampleGroup group;
    sender.sampleGroup(kBelow, 0, group);
    EXPECT_EQ(group.rays.used, 0xffffu);
    for (int i = 0; i < 16; ++i) {
        const glm::vec3 direction(group.rays.directionX[i], group.rays.directionY[i],
                                  group.rays.directionZ[i]);
        const glm::vec3 outward = kBelow.position + direction - sphere.centre;
        EXPECT_NEAR(glm::length(outward), sphere.radius, 1e-4f);
        EXPECT_LT(glm::dot(outward, direction), 1e-4f);
    }
}

TEST(EmitterSender, BehindTheReceiverCountsForNothing) {
    const RayScene nothing(std::span<const RayMesh>{});
    const Receiver down{{0, 0, 0}, {0, 0, -1}};
    for (const Emitter& emitter : emitters()) {
        const EmitterSender sender(emitter, 16, 16);
        EXPECT_EQ(sender.formFactor(down), 0);
        EXPECT_EQ(sender.visibility(nothing, down, 0, 16), 0);
    }
}

TEST(EmitterSender, OfASphereLightsNothingInsideOfIt) {
    // It emits outwards: its own facets, which lie inside of the exact sphere, receive nothing.
    const Emitter sphere = emitters()[2];
    const EmitterSender sender(sphere, 16, 16);
    const glm::vec3 out(0.6f, 0, 0.8f);
    EXPECT_EQ(sender.formFactor({sphere.centre + 0.99f * sphere.radius * out, out}), 0);
}

TEST(EmitterSender, RoundsItsSamplesUpToWholeGroups) {
    const Emitter emitter = emitters()[0];
    const EmitterSender sender(emitter, 17, 20);
    EXPECT_EQ(sender.baseSamples(), 32);
    EXPECT_EQ(sender.allSamples(), 32);
}

} // namespace

} // namespace penumbra
