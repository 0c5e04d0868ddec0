// Damaged crate files and packages: a layer or one error, whatever the bytes are.
#include "io/usd/crate/CrateLayer.h"
#include "io/usd/crate/UsdFiles.h"
#include "io/usd/text/UsdLayerWriter.h"
#include "tests/io/usd/UsdTestFiles.h"
#include "tests/io/usd/crate/CrateSample.h"
#include "tests/io/usd/crate/LayerDifference.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>

namespace penumbra {
namespace {

struct Outcome {
    std::size_t read = 0, refused = 0;
};

// What was read must also be fit to be written and read again.
void tryReading(const std::string& bytes, Outcome& outcome) {
    std::string text;
    try {
        const UsdLayer layer = readCrateLayer(std::as_bytes(std::span(bytes)), "f.usdc");
        ++outcome.read;
        text = usdLayerText(layer);
        EXPECT_EQ(differenceOf(layer, parseUsdLayer(text, "f.usda")), "") << text;
    } catch (const SceneFileError& error) {
        const std::string what = error.what();
        EXPECT_TRUE(what.starts_with("f.usdc")) << what << "\n"
                                                << text; // written text always reads back
        EXPECT_EQ(what.find('\n'), std::string::npos);
        outcome.refused += what.starts_with("f.usdc");
    }
}

void print(const char* what, const Outcome& outcome) {
    std::cout << what << ": " << outcome.refused << " refused, " << outcome.read << " read\n";
}

std::string fileBytes(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// One to four bytes replaced: by any, by one with a bit changed, or by 0 or 255.
std::string damaged(std::string bytes, std::mt19937& random) {
    const int edits = 1 + int(random() % 4);
    for (int i = 0; i < edits; ++i) {
        char& byte = bytes[8 + random() % (bytes.size() - 8)];
        switch (random() % 4) {
        case 0:
            byte = char(random());
            break;
        case 1:
            byte = char(byte ^ (1 << (random() % 8)));
            break;
        case 2:
            byte = 0;
            break;
        default:
            byte = char(0xff);
            break;
        }
    }
    return bytes;
}

} // namespace

TEST(CrateFuzz, EveryTruncationIsRefusedOrRead) {
    for (const int minor : {0, 8}) {
        const std::string whole = sampleCrate(minor);
        Outcome outcome;
        for (std::size_t bytes = 0; bytes < whole.size(); ++bytes)
            tryReading(whole.substr(0, bytes), outcome);
        EXPECT_EQ(outcome.refused, whole.size()); // the contents are at the end
    }
}

TEST(CrateFuzz, DamagedBytesAreRefusedOrRead) {
    std::mt19937 random(1);
    Outcome outcome;
    for (const int minor : {0, 1, 4, 6, 8, 14}) {
        const std::string whole = sampleCrate(minor);
        for (int i = 0; i < 1000; ++i) tryReading(damaged(whole, random), outcome);
    }
    print("damaged copies of our own files", outcome);
    EXPECT_GT(outcome.read, 100u);
    EXPECT_GT(outcome.refused, 100u);
}

// Counts, offsets and indices: eight bytes at each place become what is too large in some way.
TEST(CrateFuzz, WrongCountsAreRefusedOrRead) {
    Outcome outcome;
    for (const int minor : {0, 8}) {
        const std::string whole = sampleCrate(minor);
        for (std::size_t at = 8; at + 8 <= whole.size(); ++at)
            for (const std::uint64_t count :
                 {std::uint64_t(1) << 60, ~std::uint64_t(0), std::uint64_t(1) << 31}) {
                std::string bytes = whole;
                std::memcpy(bytes.data() + at, &count, sizeof count);
                tryReading(bytes, outcome);
            }
    }
    print("wrong counts", outcome);
}

TEST(CrateFuzz, DamagedFilesOfOthersAreRefusedOrRead) {
    const auto shared = sharedFolder();
    if (!shared || !std::filesystem::exists(*shared / "assets/aousd"))
        GTEST_SKIP() << "the AOUSD files are not here";
    std::mt19937 random(2);
    Outcome outcome;
    for (const auto& entry : std::filesystem::directory_iterator(*shared / "assets/aousd/binary")) {
        if (entry.path().extension() != ".usdc" || entry.file_size() > 50'000) continue;
        const std::string whole = fileBytes(entry.path());
        for (int i = 0; i < 100; ++i) tryReading(damaged(whole, random), outcome);
    }
    print("damaged copies of others' files", outcome);
    EXPECT_GT(outcome.read + outcome.refused, 1000u);
}

} // namespace penumbra
