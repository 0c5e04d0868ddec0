#include "viewer/overlay/BlockAges.h"

#include "radiosity/process/RadiosityNode.h"
#include "tests/viewer/gl/LitScenes.h"

namespace penumbra {

namespace {

/// Three blocks of vertices, the last of them short.
std::vector<LitObject> threeBlocks() {
    LitMeshData data;
    data.positions.resize(160);
    data.normals.resize(160);
    data.direct.assign(160, kDirect);
    data.indirect.assign(160, kIndirect);
    return {{"", glm::dmat4(1.0), true, glm::dmat4(1.0), litNode(std::move(data))}};
}

void edit(LitObject& object, std::size_t block, float factor) {
    object.geometry->setBlock(block, [&](LitMeshData& data) {
        for (std::size_t v = 64 * block; v < std::min<std::size_t>(160, 64 * block + 64); ++v)
            data.indirect[v] = data.indirect[v] * factor;
    });
}

std::vector<double> timesOf(const BlockAges& ages, const LitObject& object) {
    const std::span<const double> times = ages.times(*object.geometry);
    return {times.begin(), times.end()};
}

TEST(BlockAges, ABlockIsAsOldAsItsLastChange) {
    std::vector<LitObject> objects = threeBlocks();
    BlockAges ages;
    EXPECT_TRUE(ages.times(*objects[0].geometry).empty());
    ages.advance(objects, 1);
    EXPECT_EQ(timesOf(ages, objects[0]), (std::vector<double>{1, 1, 1}));
    edit(objects[0], 2, 1.001f);
    ages.advance(objects, 2);
    ages.advance(objects, 3);
    EXPECT_EQ(timesOf(ages, objects[0]), (std::vector<double>{1, 1, 2}));
    EXPECT_EQ(ages.newest(), 2);
}

TEST(BlockAges, WhatIsPublishedAgainAsItWasIsNotYounger) {
    std::vector<LitObject> objects = threeBlocks();
    BlockAges ages;
    ages.advance(objects, 1);
    objects[0].geometry->setLights(2);
    edit(objects[0], 0, 1);
    ages.advance(objects, 2);
    EXPECT_EQ(timesOf(ages, objects[0]), (std::vector<double>{1, 1, 1}));
    EXPECT_EQ(ages.newest(), 1);
}

TEST(BlockAges, AGeometryThatIsGoneIsForgotten) {
    std::vector<LitObject> objects = threeBlocks();
    BlockAges ages;
    ages.advance(objects, 1);
    const std::shared_ptr<LitGeometry> before = objects[0].geometry;
    objects = threeBlocks();
    ages.advance(objects, 2);
    EXPECT_EQ(timesOf(ages, objects[0]), (std::vector<double>{2, 2, 2}));
}

} // namespace

} // namespace penumbra
