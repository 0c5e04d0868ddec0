// What the fuzzers have found their ways by, tried again; and new ways, a few.
#include "tests/fuzz/FuzzTargets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace penumbra {

namespace {

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

class FuzzCorpus : public testing::TestWithParam<FuzzTarget> {};

} // namespace

TEST_P(FuzzCorpus, IsReadOrRefused) {
    const std::vector<Input> inputs = corpus(GetParam().name);
    EXPECT_GE(inputs.size(), 20u);
    for (const Input& input : inputs) EXPECT_EQ(GetParam().attempt(input.bytes), "") << input.name;
}

// Each input is changed a few times over, as the fuzzer does.
TEST_P(FuzzCorpus, ChangedIsReadOrRefused) {
    FuzzRandom random(1);
    for (const Input& input : corpus(GetParam().name)) {
        std::string bytes = input.bytes;
        for (int i = 0; i < 10; ++i) {
            bytes = GetParam().mutated(bytes, random).value_or(bytes);
            ASSERT_EQ(GetParam().attempt(bytes), "") << input.name << ", change " << i + 1 << ":\n"
                                                     << bytes;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Of, FuzzCorpus,
                         testing::Values(textTarget(), crateTarget(), compositionTarget()),
                         [](const auto& of) { return std::string(of.param.name); });

} // namespace penumbra
