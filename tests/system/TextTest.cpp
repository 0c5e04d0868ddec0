// penumbra info --text: a file of any kind as USD text; and commands that read other kinds.
#include "Program.h"
#include "tests/support/CrateWriter.h"

#include <gmock/gmock.h>

namespace penumbra {

namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// A binary layer that takes the small room in.
std::string roomInBinary() {
    CrateWriter out;
    const std::uint64_t names = out.here();
    out.put(std::uint64_t(1)).put(out.string("room.usda"));
    out.spec(0, 7,
             {{"subLayers", CrateWriter::rep(50, names)},
              {"metersPerUnit", CrateWriter::inlined(9, 0x3f800000)},
              {"upAxis", CrateWriter::inlined(11, out.token("Z"))}});
    return out.bytes();
}

} // namespace

TEST(InfoText, WritesABinaryLayerAsText) {
    const Workplace here;
    const std::string file = here.write("room.usd", roomInBinary());
    const Outcome info = runPenumbra({"info", file, "--text", here.path("out.usda")});
    EXPECT_EQ(info.exitCode, 0) << info.err;
    EXPECT_THAT(info.out, IsEmpty());
    const std::string text = R"(#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
    subLayers = [
        @room.usda@,
    ]
)
)";
    EXPECT_EQ(readFile(here.path("out.usda")), text);
    EXPECT_EQ(runPenumbra({"info", file, "--text", "-"}).out, text);
}

TEST(InfoText, DoesNotOverwriteTheFileItReads) {
    const Workplace here;
    const std::string file = here.write("room.usda", smallRoom());
    const Outcome info = runPenumbra({"info", file, "--text", file});
    EXPECT_NE(info.exitCode, 0);
    EXPECT_EQ(readFile(file), smallRoom());
}

TEST(InfoText, ASceneMayBeABinaryFile) {
    const Workplace here;
    here.write("room.usda", smallRoom());
    const Outcome info = runPenumbra({"info", here.write("room.usd", roomInBinary())});
    EXPECT_EQ(info.exitCode, 0) << info.err;
    EXPECT_THAT(info.out, HasSubstr("1 lights"));
    const Outcome cut =
        runPenumbra({"info", here.write("cut.usdc", roomInBinary().substr(0, 200))});
    EXPECT_EQ(cut.exitCode, 1);
    EXPECT_THAT(cut.err, HasSubstr("cut.usdc: error: damaged binary USD"));
}

TEST(InfoFlatten, WritesTheComposedSceneAsOneFile) {
    const Workplace here;
    here.write("part.usda", "#usda 1.0\n(defaultPrim = \"p\")\ndef Mesh \"p\"\n{\n"
                            " int[] faceVertexCounts = [3]\n int[] faceVertexIndices = [0, 1, 2]\n"
                            " point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]\n}\n");
    const std::string scene =
        here.write("a.usda", "#usda 1.0\ndef Xform \"a\" (references = @part.usda@)\n{\n}\n"
                             "def \"b\" (payload = @part.usda@)\n{\n}\n");
    const std::string flat = here.path("flat.usda");
    const Outcome written = runPenumbra({"info", scene, "--flatten", flat});
    EXPECT_EQ(written.exitCode, 0) << written.err;
    EXPECT_THAT(readFile(flat), Not(HasSubstr("part.usda")));
    EXPECT_EQ(runPenumbra({"info", scene, "--flatten", "-"}).out, readFile(flat));
    const auto counts = [](const Outcome& info) { return info.out.substr(info.out.find('\n')); };
    EXPECT_EQ(counts(runPenumbra({"info", flat})), counts(runPenumbra({"info", scene})));
}

TEST(InfoFlatten, DoesNotOverwriteALayerOfTheScene) {
    const Workplace here;
    const std::string part = here.write("part.usda", "#usda 1.0\ndef \"p\"\n{\n}\n");
    const std::string scene =
        here.write("a.usda", "#usda 1.0\ndef \"a\" (references = @part.usda@</p>)\n{\n}\n");
    const std::string before = readFile(part);
    const Outcome refused = runPenumbra({"info", scene, "--flatten", part});
    EXPECT_EQ(refused.exitCode, 2);
    EXPECT_THAT(refused.err, HasSubstr("would overwrite"));
    EXPECT_EQ(readFile(part), before);
}

} // namespace penumbra
