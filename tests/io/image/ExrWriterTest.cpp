#include "io/image/ExrWriter.h"

#include "ImageSamples.h"
#include "base/Error.h"

#include <Imath/ImathMatrix.h>
#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <glm/gtc/matrix_transform.hpp>
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace penumbra {

namespace {

View sampleView(int width = 5, int height = 3) {
    Lens lens;
    lens.horizontalApertureOffset = 2; // not symmetric, so that mistakes show
    const glm::dmat4 place = glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(3, 2, 1)), 0.7,
                                         glm::dvec3(0.3, 0.9, 0.1));
    return makeView(lens, place, width, height);
}

/// One channel of a file, converted to float by OpenEXR.
std::vector<float> channelOf(Imf::InputFile& file, const std::string& name) {
    const Imath::Box2i window = file.header().dataWindow();
    const int width = window.max.x + 1, height = window.max.y + 1;
    std::vector<float> values(std::size_t(width * height));
    Imf::FrameBuffer pixels;
    pixels.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()),
                                   sizeof(float), sizeof(float) * std::size_t(width)));
    file.setFrameBuffer(pixels);
    file.readPixels(0, height - 1);
    return values;
}

/// Every colour channel of the sample against what was written.
void expectColours(Imf::InputFile& file, const FrameLayers& frame, float relative) {
    const auto check = [&](const std::string& name, auto expected) {
        const std::vector<float> values = channelOf(file, name);
        for (std::size_t i = 0; i < values.size(); ++i)
            EXPECT_NEAR(values[i], expected(i), relative * std::abs(expected(i))) << name << i;
    };
    const std::pair<std::string, const std::vector<Rgb>&> layers[] = {
        {"", frame.beauty},
        {"direct.", frame.direct},
        {"indirect.", frame.indirect},
        {"albedo.", frame.albedo},
        {"illuminance.", frame.illuminance}};
    for (const auto& [prefix, layer] : layers) {
        check(prefix + "R", [&](std::size_t i) { return layer[i].r; });
        check(prefix + "G", [&](std::size_t i) { return layer[i].g; });
        check(prefix + "B", [&](std::size_t i) { return layer[i].b; });
    }
    check("A", [&](std::size_t i) { return frame.alpha[i]; });
    check("N.X", [&](std::size_t i) { return frame.normal[i].x; });
    check("N.Y", [&](std::size_t i) { return frame.normal[i].y; });
    check("N.Z", [&](std::size_t i) { return frame.normal[i].z; });
}

TEST(ExrWriter, ValuesComeBackWithinHalfPrecision) {
    const TemporaryFolder folder;
    const FrameLayers frame = sampleFrame();
    EXPECT_EQ(writeExr(folder.file("a.exr"), frame, sampleView()), 0u);
    Imf::InputFile file(folder.file("a.exr").c_str());
    EXPECT_EQ(file.header().channels().findChannel("R")->type, Imf::HALF);
    expectColours(file, frame, 1.0f / 2048); // half an ulp of 11 significant bits
    EXPECT_EQ(folder.fileCount(), 1);
}

TEST(ExrWriter, FloatsComeBackExactly) {
    const TemporaryFolder folder;
    FrameLayers frame = sampleFrame();
    frame.beauty[3].g = 1e9f;
    EXPECT_EQ(writeExr(folder.file("a.exr"), frame, sampleView(), {}, {.half = false}), 0u);
    Imf::InputFile file(folder.file("a.exr").c_str());
    EXPECT_EQ(file.header().channels().findChannel("R")->type, Imf::FLOAT);
    expectColours(file, frame, 0);
}

TEST(ExrWriter, DepthAndObjectIdAreExactEvenWithHalfColours) {
    const TemporaryFolder folder;
    const FrameLayers frame = sampleFrame();
    writeExr(folder.file("a.exr"), frame, sampleView());
    Imf::InputFile file(folder.file("a.exr").c_str());
    EXPECT_EQ(channelOf(file, "Z"), frame.depth);
    ASSERT_EQ(file.header().channels().findChannel("objectId")->type, Imf::UINT);
    std::vector<ObjectId> ids(frame.pixelCount());
    Imf::FrameBuffer pixels;
    pixels.insert("objectId", Imf::Slice(Imf::UINT, reinterpret_cast<char*>(ids.data()), 4, 4 * 5));
    file.setFrameBuffer(pixels);
    file.readPixels(0, 2);
    EXPECT_EQ(ids, frame.objectId);
}

TEST(ExrWriter, WhatHalfCannotHoldIsClampedAndCounted) {
    const TemporaryFolder folder;
    FrameLayers frame(3, 1);
    frame.beauty[0] = {65504, 1e6f, std::numeric_limits<float>::infinity()};
    frame.beauty[1].r = -1e6f;
    frame.beauty[2].r = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(writeExr(folder.file("a.exr"), frame, sampleView(3, 1)), 3u);
    Imf::InputFile file(folder.file("a.exr").c_str());
    EXPECT_EQ(channelOf(file, "R")[0], 65504);
    EXPECT_EQ(channelOf(file, "G")[0], 65504);
    EXPECT_EQ(channelOf(file, "B")[0], 65504);
    EXPECT_EQ(channelOf(file, "R")[1], -65504);
    EXPECT_TRUE(std::isnan(channelOf(file, "R")[2])); // a fault must stay visible
}

TEST(ExrWriter, SaysWhatItsColoursAre) {
    const TemporaryFolder folder;
    ExrMetadata metadata;
    metadata.texts = {{"software", "Penumbra"}, {"penumbra:scene", "room.usda"}};
    metadata.numbers = {{"penumbra:certificate", 0.001f}};
    writeExr(folder.file("a.exr"), sampleFrame(), sampleView(), metadata);
    const Imf::InputFile file(folder.file("a.exr").c_str());
    const Imf::Header& header = file.header();
    EXPECT_EQ(header.compression(), Imf::ZIP_COMPRESSION);
    EXPECT_EQ(Imf::whiteLuminance(header), 1.0f);
    // Rec. ITU-R BT.709-6, items 1.3 and 1.4
    const Imf::Chromaticities& c = Imf::chromaticities(header);
    EXPECT_EQ(c.red, Imath::V2f(0.64f, 0.33f));
    EXPECT_EQ(c.green, Imath::V2f(0.30f, 0.60f));
    EXPECT_EQ(c.blue, Imath::V2f(0.15f, 0.06f));
    EXPECT_EQ(c.white, Imath::V2f(0.3127f, 0.3290f));
    EXPECT_EQ(header.typedAttribute<Imf::StringAttribute>("software").value(), "Penumbra");
    EXPECT_EQ(header.typedAttribute<Imf::StringAttribute>("penumbra:scene").value(), "room.usda");
    EXPECT_EQ(header.typedAttribute<Imf::FloatAttribute>("penumbra:certificate").value(), 0.001f);
}

TEST(ExrWriter, ItsMatricesTakePointsToWhereTheyAreInThePicture) {
    const TemporaryFolder folder;
    const View view = sampleView();
    writeExr(folder.file("a.exr"), sampleFrame(), view);
    const Imf::InputFile file(folder.file("a.exr").c_str());
    const Imath::M44f& toCamera = Imf::worldToCamera(file.header());
    const Imath::M44f& toNdc = Imf::worldToNDC(file.header());

    // A point 4 m in front of the camera, 1 m to the right and 0.5 m up.
    const glm::dvec3 p(glm::inverse(view.worldToCamera) * glm::dvec4(1, 0.5, -4, 1));
    const Imath::V3f world{float(p.x), float(p.y), float(p.z)};
    EXPECT_TRUE((world * toCamera).equalWithAbsError(Imath::V3f(1, 0.5f, 4), 1e-5f));

    // The ray through the picture's upper left corner has clip coordinates (-1, 1).
    const glm::dvec4 corner = glm::inverse(view.worldToClip()) * glm::dvec4(-1, 1, 0.5, 1);
    const glm::dvec3 q = glm::dvec3(corner) / corner.w;
    const Imath::V3f ndc = Imath::V3f{float(q.x), float(q.y), float(q.z)} * toNdc;
    EXPECT_NEAR(ndc.x, 0, 1e-4);
    EXPECT_NEAR(ndc.y, 0, 1e-4);

    // The screen window at distance 1 is that of the lens: aperture / focal length, moved by
    // offset.
    EXPECT_NEAR(file.header().screenWindowWidth(), 20.955f / 50, 1e-5);
    EXPECT_NEAR(file.header().screenWindowCenter().x, 2.0f / 50, 1e-5);
    EXPECT_NEAR(file.header().screenWindowCenter().y, 0, 1e-5);
}

TEST(ExrWriter, AFullDiskLeavesTheOldPicture) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.exr");
    writeExr(path, sampleFrame(), sampleView());
    const std::string before = contentOf(path);
    {
        const FileSizeLimit limit(512);
        EXPECT_THROW(writeExr(path, sampleFrame(64, 64), sampleView(64, 64)), Error);
    }
    EXPECT_EQ(contentOf(path), before);
    EXPECT_EQ(folder.fileCount(), 1);
}

TEST(ExrWriter, ErrorsAreOneLineAndBeginWithTheFile) {
    try {
        writeExr("/nonexistent/a.exr", sampleFrame(), sampleView());
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(),
                     "/nonexistent/a.exr: error: can't write: its folder does not exist (create it "
                     "first)");
    }
    const TemporaryFolder folder;
    ExrMetadata clash; // an attribute that OpenEXR itself needs, with another type
    clash.numbers = {{"channels", 1.0f}};
    EXPECT_THROW(writeExr(folder.file("a.exr"), sampleFrame(), sampleView(), clash), Error);
    EXPECT_EQ(folder.fileCount(), 0);
}

} // namespace

} // namespace penumbra
