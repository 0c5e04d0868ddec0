// Our OpenEXR files read by another library: OpenImageIO's programs (Debian: openimageio-tools).
#include "ImageSamples.h"
#include "io/image/ExrWriter.h"
#include "tests/support/Command.h"

#include <gmock/gmock.h>

namespace penumbra {

namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

class ExrTools : public testing::Test {
protected:
    void SetUp() override {
        if (outputOf("command -v oiiotool").empty())
            GTEST_SKIP() << "no oiiotool in PATH (Debian: openimageio-tools)";
        FrameLayers frame = sampleFrame(16, 9);
        for (Rgb& pixel : frame.beauty) pixel = {0.25f, 0.5f, 1234};
        writeExr(folder.file("a.exr"), frame, makeView({}, glm::dmat4(1.0), 16, 9),
                 {.texts = {{"penumbra:scene", "room.usda"}}, .numbers = {}});
    }

    TemporaryFolder folder;
};

TEST_F(ExrTools, ReadNamesTypesAndAttributes) {
    const std::string info = outputOf("oiiotool --info -v " + folder.file("a.exr"));
    EXPECT_THAT(info, ContainsRegex("16 x +9, 21 channel"));
    for (const char* name :
         {"R (half)", "A (half)", "Z (float)", "N.X (half)", "N.Z (half)", "albedo.G (half)",
          "direct.R (half)", "indirect.B (half)", "illuminance.R (half)", "objectId (uint)"})
        EXPECT_THAT(info, HasSubstr(name));
    EXPECT_THAT(info, HasSubstr("0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329"));
    EXPECT_THAT(info, ContainsRegex("whiteLuminance: 1\n"));
    EXPECT_THAT(info, HasSubstr("penumbra:scene: \"room.usda\""));
    EXPECT_THAT(info, HasSubstr("compression: \"zip\""));
    EXPECT_THAT(info, HasSubstr("worldToCamera: 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1"));
}

TEST_F(ExrTools, ReadPixelValues) {
    const std::string dump = outputOf("oiiotool --dumpdata " + folder.file("a.exr"));
    EXPECT_THAT(dump, HasSubstr("Pixel (3, 2): 0.250000000 0.500000000 1234.000000000"));
}

} // namespace

} // namespace penumbra
