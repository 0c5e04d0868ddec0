// Layers of any kind, and what is in packages.
#include "io/usd/crate/UsdFiles.h"
#include "io/usd/crate/UsdPackage.h"
#include "io/usd/crate/UsdPackagePath.h"
#include "io/usd/stage/UsdStage.h"
#include "tests/io/usd/UsdTestFiles.h"
#include "tests/io/usd/crate/CrateSample.h"
#include "tests/io/usd/crate/LayerDifference.h"
#include "tests/io/usd/crate/ZipSample.h"

#include <gmock/gmock.h>

#include <random>

namespace penumbra {
namespace {

using testing::HasSubstr;

std::string text(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string layerText(const std::string& sub, const std::string& prim) {
    return "#usda 1.0\n(subLayers = [" + sub + "])\ndef \"" + prim + "\"\n{\n}\n";
}

std::string errorOf(const std::string& package) {
    try {
        UsdPackage(std::as_bytes(std::span(package)), "p.usdz");
    } catch (const SceneFileError& error) {
        return error.what();
    }
    return "no error";
}

} // namespace

TEST(UsdAssets, WhatIsNotThereHasOneCanonicalNameAsWell) { // a picture within a model
    const UsdAssets assets;
    EXPECT_EQ(assets.canonical("none.glb[picture.png]"),
              assets.canonical("./none.glb[picture.png]"));
}

TEST(UsdFiles, TheKindOfALayerIsToldByItsContent) {
    const TemporaryFolder folder;
    const UsdLayer expected = parseUsdLayer(std::string(kSampleText), "t");
    const auto write = [&](const char* name, const std::string& bytes) {
        return folder.write(name, bytes);
    };
    for (const auto& file :
         {write("a.usd", std::string(kSampleText)), write("b.usd", sampleCrate(8)),
          write("c.usda", sampleCrate(8)), write("d.usdz", zipOf({{"x.usd", sampleCrate(8)}})),
          write("e.USDZ", zipOf({{"x.usda", std::string(kSampleText)}}))})
        EXPECT_EQ(differenceOf(readAnyUsdLayer(file), expected), "") << file;
}

TEST(UsdFiles, APackageOfAnotherNameCantBeAddressed) {
    const TemporaryFolder folder;
    const auto file = folder.write("a.usd", zipOf({{"x.usda", "#usda 1.0\n"}}));
    EXPECT_THROW(readAnyUsdLayer(file), SceneFileError);
}

TEST(UsdFiles, AFileInAPackageIsReadWhereItLies) {
    const TemporaryFolder folder;
    const std::string inner = zipOf({{"c.usda", "#usda 1.0\n"}, {"t/x.png", "picture"}});
    const std::string file =
        folder.write("a.usdz", zipOf({{"a.usda", "#usda 1.0\n"}, {"b/n.usdz", inner}}));
    const UsdFiles files;
    EXPECT_EQ(text(files.bytes(file + "[a.usda]").bytes), "#usda 1.0\n");
    EXPECT_EQ(text(files.bytes(file + "[b/n.usdz[t/x.png]]").bytes), "picture");
    EXPECT_EQ(files.layer(file + "[b/n.usdz]", {}).file, file + "[b/n.usdz[c.usda]]");
    EXPECT_EQ(files.fileOf(file + "[b/n.usdz[t/x.png]]"), file);
    EXPECT_THROW(files.bytes(file + "[b]"), SceneFileError);
    EXPECT_THROW(files.bytes(file + "[a.usda[b]]"), SceneFileError);
    const auto bytes = files.bytes(file + "[a.usda]").bytes;
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(bytes.data()) % 64, 0u);
}

TEST(UsdFiles, PathsInAPackageLeadFromTheLayerThenFromTheRootLayerThenOutside) {
    const TemporaryFolder folder;
    const std::string file = folder.write("p/a.usdz", zipOf({{"root/r.usda", "#usda 1.0\n"},
                                                             {"root/s/l.usda", "#usda 1.0\n"},
                                                             {"root/s/near.usda", "#usda 1.0\n"},
                                                             {"root/far.usda", "#usda 1.0\n"}}));
    const UsdFiles files;
    const std::string layer = file + "[root/s/l.usda]";
    EXPECT_EQ(files.resolve(layer, "near.usda"), file + "[root/s/near.usda]");
    EXPECT_EQ(files.resolve(layer, "./near.usda"), file + "[root/s/near.usda]");
    EXPECT_EQ(files.resolve(layer, "../far.usda"), file + "[root/far.usda]");
    EXPECT_EQ(files.resolve(layer, "far.usda"), file + "[root/far.usda]");
    EXPECT_EQ(files.resolve(layer, "./far.usda"), folder.file("p/./far.usda"));
    EXPECT_EQ(files.resolve(layer, "out.usda"), folder.file("p/out.usda"));
    EXPECT_EQ(files.resolve(layer, "/abs.usda"), "/abs.usda");
    EXPECT_EQ(files.resolve(folder.file("x.usda"), "p/a.usdz[root/r.usda]"),
              folder.file("p/a.usdz[root/r.usda]"));
}

TEST(UsdFiles, AStageIsPutTogetherOfAllKinds) {
    const TemporaryFolder folder;
    folder.write("sub.usdc", sampleCrate(8));
    folder.write("out.usda", layerText("", "Out"));
    folder.write("p.usdz", zipOf({{"r.usda", layerText("@in.usda@, @out.usda@", "Root")},
                                  {"in.usda", layerText("", "In")}}));
    const auto root = folder.write("s.usda", layerText("@sub.usdc@, @p.usdz@", "S"));
    UsdStage stage = UsdStage::open(root, {}, UsdFiles());
    for (const char* path : {"/S", "/A", "/Root", "/In", "/Out"})
        EXPECT_NE(stage.find(path), nullptr) << path;
    EXPECT_THAT(stage.files(),
                testing::ElementsAre(root, folder.file("sub.usdc"), folder.file("p.usdz"),
                                     folder.file("p.usdz"), folder.file("out.usda")));
}

TEST(UsdFiles, PackagesInPackagesEnd) {
    const TemporaryFolder folder;
    std::string package = zipOf({{"a.usda", "#usda 1.0\n"}});
    for (int i = 0; i < 20; ++i) package = zipOf({{"a.usdz", package}});
    try {
        readAnyUsdLayer(folder.write("a.usdz", package));
        ADD_FAILURE() << "no error";
    } catch (const SceneFileError& error) {
        EXPECT_THAT(error.what(), HasSubstr("nested too deeply"));
    }
}

// As a layer may name it: each bracket must not cost another copy of all.
TEST(UsdFiles, AnAddressOfAHundredThousandPackagesIsRefusedAtOnce) {
    std::string address, closing;
    for (int i = 0; i < 100'000; ++i) address += "a.usdz[", closing += "]";
    const TemporaryFolder folder;
    const UsdFiles files;
    const std::string there = files.resolve(folder.file("x.usda"), address + "b" + closing);
    EXPECT_EQ(files.fileOf(there), folder.file("a.usdz"));
    EXPECT_NO_THROW(files.canonical(there));
    EXPECT_THROW(files.bytes(there), SceneFileError);
    const auto root = folder.write("s.usda", layerText("@" + address + "b" + closing + "@", "S"));
    EXPECT_EQ(UsdStage::open(root, {}, files).diagnostics().list().size(), 1u);
}

TEST(UsdPackage, WhatIsNoHonestPackageIsRefused) {
    const std::string good = zipOf({{"a.usda", "#usda 1.0\n"}, {"b.png", "picture"}});
    EXPECT_EQ(errorOf(good), "no error");
    EXPECT_THAT(errorOf("PK\3\4"), HasSubstr("too short"));
    EXPECT_THAT(errorOf(good.substr(0, good.size() - 1)), HasSubstr("directory is missing"));
    EXPECT_THAT(errorOf(zipOf({})), HasSubstr("no file in it"));
    for (const char* name : {"../a.usda", "/a.usda", "x/../a", "a\\b", "a[b]", "", "a//b", "\xff"})
        EXPECT_THAT(errorOf(zipOf({{name, "x"}})), HasSubstr("no name for a file")) << name;
    EXPECT_THAT(errorOf(zipOf({{"a", "x"}, {"a", "y"}})), HasSubstr("twice"));
    const std::size_t local = good.find("b.png") - 30, central = good.rfind("b.png") - 46;
    const auto changed = [&](std::size_t at, const std::string& bytes) {
        std::string package = good;
        return package.replace(at, bytes.size(), bytes);
    };
    EXPECT_THAT(errorOf(changed(central + 10, "\x8")), HasSubstr("compressed"));
    EXPECT_THAT(errorOf(changed(central + 8, "\x1")), HasSubstr("encrypted"));
    EXPECT_THAT(errorOf(changed(local + 22, "\x9")), HasSubstr("contradicts the directory"));
    EXPECT_THAT(errorOf(changed(central + 42, "\xff\xff\xff\xff")), HasSubstr("zip64"));
    EXPECT_THAT(errorOf(changed(central + 42, "\x7f\xff\xff\x7f")), HasSubstr("leads out"));
    // Both entries at one place: their bytes overlap.
    const std::string twins = zipOf({{"a.usda", "12345"}, {"b.usda", "12345"}});
    std::string overlapping = twins;
    const std::size_t first = twins.find("a.usda"), second = twins.rfind("b.usda");
    overlapping.replace(first, 1, "b");
    overlapping.replace(twins.rfind("a.usda"), 1, "b");
    overlapping.replace(second - 4, 4, std::string(4, '\0'));
    EXPECT_THAT(errorOf(overlapping), HasSubstr("overlaps"));
}

TEST(UsdPackage, DamagedOnesAreRefusedOrRead) {
    const std::string whole =
        zipOf({{"a.usdc", sampleCrate(8)}, {"b/c.usda", std::string(kSampleText)}});
    std::mt19937 random(3);
    std::size_t read = 0;
    for (std::size_t bytes = 0; bytes < whole.size(); bytes += 7)
        EXPECT_THAT(errorOf(whole.substr(0, bytes)), HasSubstr("p.usdz: error"));
    for (int i = 0; i < 3000; ++i) {
        std::string package = whole;
        const std::size_t at =
            random() % 3 == 0 ? random() % package.size() : package.size() - 1 - random() % 150;
        package[at] = char(random());
        read += errorOf(package) == "no error";
    }
    EXPECT_GT(read, 100u);
}

TEST(UsdPackagePath, SplitsAtTheInnermostPackage) {
    const auto path = splitPackagePath("/d/a.usdz[b/c.usdz[e.usd]]");
    ASSERT_TRUE(path);
    EXPECT_EQ(path->package, "/d/a.usdz[b/c.usdz]");
    EXPECT_EQ(path->name, "e.usd");
    EXPECT_EQ(joinPackagePath(path->package, path->name), "/d/a.usdz[b/c.usdz[e.usd]]");
    EXPECT_FALSE(splitPackagePath("/d/a[1].usda"));
    EXPECT_FALSE(splitPackagePath("/d/a.usdz"));
    EXPECT_FALSE(splitPackagePath("/d/a.usdz[b"));
    EXPECT_EQ(packageDepth("/d/a.usdz[b/c.usdz[e.usd]]"), 2);
    EXPECT_EQ(pathInPackage("a/b.usd", "../c.usd"), "c.usd");
    EXPECT_FALSE(pathInPackage("a/b.usd", "../../c.usd"));
}

} // namespace penumbra
