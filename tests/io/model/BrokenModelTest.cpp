// What can't be used is refused in one line that names the file.
#include "base/Error.h"
#include "tests/io/model/LayerParts.h"
#include "tests/support/ModelTexts.h"
#include "tests/support/TemporaryFolder.h"

#include <gmock/gmock.h>

#include <sys/stat.h>

namespace penumbra {

namespace {

using testing::HasSubstr;

class BrokenModel : public testing::Test {
protected:
    TemporaryFolder here;

    /// The line with which a model is refused; empty if it is not.
    std::string refusal(const std::string& name, const std::string& text) {
        return refusalOf(here.write(name, text));
    }
    static std::string refusalOf(const std::filesystem::path& file,
                                 const ImportOptions& options = {}) {
        try {
            importModel(file, options);
        } catch (const SceneFileError& error) {
            EXPECT_THAT(error.what(), testing::StartsWith(file.string() + ": error: "));
            EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
            return error.what();
        }
        return {};
    }
};

TEST_F(BrokenModel, FilesThatAreNoModels) {
    EXPECT_THAT(refusal("a.txt", "v 0 0 0"), HasSubstr("no known model"));
    EXPECT_THAT(refusal("a.gltf", ""), HasSubstr("empty"));
    EXPECT_THAT(refusal("a.gltf", "{\"asset\""), HasSubstr("no JSON"));
    EXPECT_THAT(refusal("b.gltf", std::string("\xff\xfe\0x", 4)), HasSubstr("no JSON"));
    for (const char* name : {"c.glb", "c.fbx", "c.dae", "c.ply", "c.stl", "c.obj"})
        EXPECT_NE(refusal(name, "this is a letter to my aunt\n"), "") << name;
    EXPECT_THAT(refusalOf(here.path() / "gone.obj"), HasSubstr("can't read"));
    std::filesystem::create_directory(here.path() / "folder.obj");
    EXPECT_THAT(refusalOf(here.path() / "folder.obj"), HasSubstr("can't read"));
}

TEST_F(BrokenModel, WhatHasNothingToShow) {
    EXPECT_THAT(refusal("a.gltf", R"({"asset": {"version": "2.0"}, "scene": 0,
                                     "scenes": [{"nodes": [0]}], "nodes": [{}]})"),
                HasSubstr("nothing in it to show"));
    EXPECT_NE(refusal("a.obj", "v 0 0 0\nv 1 0 0\n"), "");
}

TEST_F(BrokenModel, IndicesOutOfRange) {
    EXPECT_THAT(refusal("a.gltf", gltfText(R"([{"mesh": 0}])", "", 4)), HasSubstr("out of range"));
    EXPECT_NE(refusal("a.gltf", gltfText(R"([{"mesh": 1}])")), "");
    EXPECT_THAT(refusal("a.gltf", gltfText(R"([{"mesh": 0, "children": [7]}])")),
                HasSubstr("node 7 is not there"));
    EXPECT_THAT(refusal("a.gltf", gltfText(R"([{"mesh": 0, "camera": 2}])")),
                HasSubstr("camera that is not there"));
    EXPECT_NE(refusal("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 9\n"), "");
}

TEST_F(BrokenModel, NumbersThatAreNotFinite) {
    EXPECT_THAT(refusal("a.obj", "v 0 0 0\nv 1e39 0 0\nv 1 1 0\nf 1 2 3\n"),
                HasSubstr("not finite"));
    EXPECT_THAT(refusal("a.gltf", gltfText(R"([{"mesh": 0, "translation": [1e39, 0, 0]}])")),
                HasSubstr("not finite"));
}

TEST_F(BrokenModel, NodesInACircleOrTooDeep) {
    EXPECT_THAT(refusal("a.gltf", gltfText(R"([{"mesh": 0, "children": [0]}])")),
                HasSubstr("below itself"));
    std::string chain = R"([{"children": [1]})";
    for (int i = 1; i < 20'000; ++i) chain += R"(, {"children": [)" + std::to_string(i + 1) + "]}";
    EXPECT_THAT(refusal("b.gltf", gltfText(chain + R"(, {"mesh": 0}])")),
                HasSubstr("nested too deeply"));
    std::string nodes, ends;
    for (int i = 0; i < 100'000; ++i) nodes += "<node>", ends += "</node>";
    EXPECT_THAT(refusal("c.dae", "<COLLADA>" + nodes + ends + "</COLLADA>"),
                HasSubstr("nested too deeply"));
    EXPECT_THAT(refusal("d.fbx", "; FBX 7.4.0 project file\n" + std::string(100'000, '{')),
                HasSubstr("nested too deeply"));
}

TEST_F(BrokenModel, TextOnWhichAssimpWouldHang) {
    std::string text = colladaText("");
    text[text.find("0 1 2 3</p>")] = 'K';
    EXPECT_THAT(refusal("a.dae", text), HasSubstr("something else than indices"));
    EXPECT_THAT(refusal("b.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"), HasSubstr("no end"));
    EXPECT_THAT(refusal("c.ply", "ply\nformat ascii 1.0\nelement vertex 4000000000\n"
                                 "property float x\nend_header\n0\n"),
                HasSubstr("wrong number of elements"));
}

TEST_F(BrokenModel, APipeIsRefusedNotWaitedFor) {
    for (const char* name : {"f.gltf", "f.ply", "f.dae", "f.obj"}) {
        const auto pipe = here.path() / name;
        ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
        EXPECT_THAT(refusalOf(pipe), HasSubstr("it is a device or a pipe"));
    }
    ASSERT_EQ(::mkfifo((here.path() / "a.mtl").c_str(), 0600), 0); // which a model names
    EXPECT_EQ(refusal("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n"), "");
}

TEST_F(BrokenModel, AFileThatCrashesAssimpIsRefused) {
    std::string text = colladaText(""); // an array without a count, which Assimp 5.2 reads beyond
    text.erase(text.find(R"( count="12")"), 11);
    EXPECT_THAT(refusal("a.dae", text), HasSubstr("breaks down"));
}

TEST_F(BrokenModel, BeginningsOfAModelAreRefused) {
    const std::string texts[] = {gltfText(R"([{"mesh": 0}])"), colladaText("<unit meter=\"1\"/>"),
                                 glbBytes(R"([{"mesh": 0}])")};
    const char* names[] = {"a.gltf", "a.dae", "a.glb"};
    for (int i = 0; i < 3; ++i)
        for (std::size_t size = 1; size < texts[i].size(); size += 37)
            EXPECT_NE(refusal(names[i], texts[i].substr(0, size)), "") << names[i] << " " << size;
}

TEST_F(BrokenModel, TooLargeAFile) {
    const auto file = here.write("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
    EXPECT_THAT(refusalOf(file, {.maxFileBytes = 10}), HasSubstr("too large"));
}

} // namespace

} // namespace penumbra
