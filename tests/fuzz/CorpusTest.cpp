// What the fuzzers have found their ways by, tried again; and new ways, a few.
#include "tests/fuzz/CrateMutator.h"
#include "tests/fuzz/FuzzTargets.h"
#include "tests/fuzz/TokenMutator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

namespace penumbra {

namespace {

using Try = std::function<std::string(std::string_view)>;
using Mutate = std::function<std::string(std::string_view, FuzzRandom&)>;

struct Input {
    std::string name, bytes;
};

std::vector<Input> corpus(const std::string& kind) {
    std::vector<Input> inputs;
    const auto folder = std::filesystem::path(PENUMBRA_SOURCE_DIR) / "tests/data/fuzz" / kind;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        std::ifstream in(entry.path(), std::ios::binary);
        inputs.push_back(
            {entry.path().filename().string(), {std::istreambuf_iterator<char>(in), {}}});
    }
    std::sort(inputs.begin(), inputs.end(),
              [](const Input& a, const Input& b) { return a.name < b.name; });
    return inputs;
}

void replay(const std::string& kind, const Try& attempt) {
    const std::vector<Input> inputs = corpus(kind);
    EXPECT_GE(inputs.size(), 20u);
    for (const Input& input : inputs) EXPECT_EQ(attempt(input.bytes), "") << input.name;
}

/// Changes each input a few times over, as the fuzzer does.
void mutate(const std::string& kind, const Try& attempt, const Mutate& mutated) {
    FuzzRandom random(1);
    for (const Input& input : corpus(kind)) {
        std::string bytes = input.bytes;
        for (int i = 0; i < 10; ++i) {
            bytes = mutated(bytes, random);
            ASSERT_EQ(attempt(bytes), "") << input.name << ", change " << i + 1 << ":\n" << bytes;
        }
    }
}

} // namespace

TEST(FuzzCorpus, TextIsReadOrRefused) {
    replay("text", tryText);
}
TEST(FuzzCorpus, CratesAreReadOrRefused) {
    replay("crate", tryCrate);
}
TEST(FuzzCorpus, ScenesAreComposedOrRefused) {
    replay("composition", tryComposition);
}

TEST(FuzzCorpus, ChangedTextIsReadOrRefused) {
    mutate("text", tryText, [](std::string_view bytes, FuzzRandom& random) {
        return mutatedText(bytes, layerStatements(), random);
    });
}

TEST(FuzzCorpus, ChangedCratesAreReadOrRefused) {
    mutate("crate", tryCrate, [](std::string_view bytes, FuzzRandom& random) {
        return mutatedCrate(bytes, random).value_or(std::string(bytes));
    });
}

TEST(FuzzCorpus, ChangedScenesAreComposedOrRefused) {
    mutate("composition", tryComposition, [](std::string_view bytes, FuzzRandom& random) {
        return mutatedText(bytes, arcStatements(), random);
    });
}

} // namespace penumbra
