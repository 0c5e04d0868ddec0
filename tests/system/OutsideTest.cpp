// Files outside of a scene's folder: opened only with --allow-outside.
#include "Program.h"

#include <gmock/gmock.h>

#include <filesystem>

namespace penumbra {

namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kSquare =
    "def Mesh \"square\"\n{\n int[] faceVertexCounts = [4]\n int[] faceVertexIndices = [0, 1, 2, "
    "3]\n point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]\n}\n";

class Outside : public testing::Test {
protected:
    Workplace here;
    std::string part = here.write("part.usda", "#usda 1.0\n(defaultPrim = \"square\")\n" + kSquare);

    Outside() { std::filesystem::create_directories(here.path("scene/parts")); }

    Outcome info(const std::string& scene, std::vector<std::string> more = {}) {
        std::vector<std::string> arguments{"info", scene};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPenumbra(arguments);
    }
};

TEST_F(Outside, AReferenceIsNamedAndLeftOutUnlessAllIsAllowed) {
    for (const std::string& asset : {std::string("../part.usda"), part}) {
        const std::string scene =
            here.write("scene/a.usda", "#usda 1.0\n" + kSquare + "def \"more\" (references = @" +
                                           asset + "@)\n{\n}\n");
        const Outcome kept = info(scene);
        EXPECT_EQ(kept.exitCode, 0) << kept.err;
        EXPECT_THAT(kept.out, HasSubstr(" 1 meshes"));
        EXPECT_THAT(kept.err + kept.out, HasSubstr("outside the scene's folder (--allow-outside"));
        EXPECT_THAT(kept.err + kept.out, HasSubstr("</more>"));
        const Outcome all = info(scene, {"--allow-outside"});
        EXPECT_EQ(all.exitCode, 0) << all.err;
        EXPECT_THAT(all.out, HasSubstr(" 2 meshes"));
        EXPECT_THAT(all.out + all.err, Not(HasSubstr("outside")));
    }
}

TEST_F(Outside, ASceneOfNothingElseIsRefusedWithTheOptionThatOpensIt) {
    const std::string scene =
        here.write("scene/a.usda", "#usda 1.0\ndef \"more\" (references = @../part.usda@)\n{\n}\n");
    const Outcome refused = runPenumbra({"solve", scene, "--quiet"});
    EXPECT_EQ(refused.exitCode, 1);
    EXPECT_THAT(refused.err, HasSubstr("--allow-outside"));
}

TEST_F(Outside, ALinkOutOfTheFolderIsOutside) {
    std::filesystem::create_symlink(part, here.path("scene/parts/link.usda"));
    const std::string scene =
        here.write("scene/a.usda", "#usda 1.0\n" + kSquare +
                                       "def \"more\" (payload = @./parts/link.usda@)\n{\n}\n");
    EXPECT_THAT(info(scene).out, HasSubstr(" 1 meshes"));
    EXPECT_THAT(info(scene, {"--allow-outside"}).out, HasSubstr(" 2 meshes"));
}

// A layer over a scene, such as a recorded session, is put anywhere: its sublayers are the scene.
TEST_F(Outside, SublayersBringTheirFoldersIn) {
    here.write("scene/parts/part.usda", "#usda 1.0\n(defaultPrim = \"square\")\n" + kSquare);
    here.write("scene/a.usda", "#usda 1.0\ndef \"more\" (references = @parts/part.usda@)\n{\n}\n"
                               "def \"else\" (references = @../part.usda@)\n{\n}\n");
    std::filesystem::create_directories(here.path("takes"));
    const std::string take =
        here.write("takes/take.usda", "#usda 1.0\n(subLayers = [@../scene/a.usda@])\n");
    const Outcome opened = info(take);
    EXPECT_EQ(opened.exitCode, 0) << opened.err;
    EXPECT_THAT(opened.out, HasSubstr(" 1 meshes")); // parts/part.usda, but not ../part.usda
    EXPECT_THAT(info(take, {"--allow-outside"}).out, HasSubstr(" 2 meshes"));
}

TEST_F(Outside, CompositionNamesWhatWasNotOpened) {
    const std::string scene =
        here.write("scene/a.usda", "#usda 1.0\ndef \"more\" (references = @../part.usda@)\n{\n}\n");
    EXPECT_THAT(info(scene, {"--composition", "-"}).out, HasSubstr("outside the scene's folder"));
    EXPECT_THAT(info(scene, {"--composition", "-", "--allow-outside"}).out, HasSubstr("/square"));
}

} // namespace

} // namespace penumbra
