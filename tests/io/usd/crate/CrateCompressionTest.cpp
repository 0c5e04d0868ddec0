// The two ways in which crate files pack bytes.
#include "io/usd/crate/CrateCompression.h"
#include "tests/support/CrateWriter.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

std::string unpacked(const std::string& packed, std::uint64_t most) {
    const CrateBuffer buffer = unpackCrateBuffer(std::as_bytes(std::span(packed)), most, 0);
    return {reinterpret_cast<const char*>(buffer.data.get()), buffer.size};
}

template <class Int>
std::vector<Int> integers(const std::string& bytes, std::uint64_t count) {
    CrateBytes in(std::as_bytes(std::span(bytes)));
    return takeCrateIntegers<Int>(in, count);
}

/// Size and buffer of integers that are coded already.
std::string stored(const std::string& coded) {
    const std::string buffer = CrateWriter::packed(coded);
    const std::uint64_t size = buffer.size();
    return std::string(reinterpret_cast<const char*>(&size), 8) + buffer;
}

} // namespace

TEST(CrateCompression, ABufferIsOneBlockOrSeveralChunks) {
    EXPECT_EQ(unpacked(CrateWriter::packed("hello"), 100), "hello");
    const std::string block = CrateWriter::packed("hello").substr(1);
    const std::string size{char(block.size()), 0, 0, 0};
    EXPECT_EQ(unpacked("\2" + size + block + size + block, 100), "hellohello");
}

// Token 0x17: one literal, then 7 + 4 bytes from distance 1.
TEST(CrateCompression, AMatchMayReachIntoItsOwnOutput) {
    const std::string block{0, 0x17, 'a', 1, 0, 0x50, 'b', 'c', 'd', 'e', 'f'};
    EXPECT_EQ(unpacked(block, 100), "aaaaaaaaaaaabcdef");
}

TEST(CrateCompression, DamagedBuffersAreFaults) {
    const std::string far{0, 0x17, 'a', 9, 0, 0x50, 'b', 'c', 'd', 'e', 'f'};
    const std::string endless = std::string(1, '\0') + "\xf0" + std::string(40, char(255));
    for (const std::string& block :
         {std::string(), far, endless, std::string("\1\xff\xff\xff\xff", 5),
          std::string("\2\5\0\0\0", 5)})
        EXPECT_THROW(unpacked(block, 1000), CrateFault);
    EXPECT_THROW(unpacked(CrateWriter::packed("hello"), 4), CrateFault); // more than was stated
}

// Steps of 1, of one byte, two and four, also beyond the range of an int32.
TEST(CrateCompression, IntegersAreDifferences) {
    const std::vector<std::int32_t> numbers{5, 6, 7, 1000, 1001, -2'000'000'000, 2'000'000'000, -1};
    EXPECT_EQ(integers<std::int32_t>(CrateWriter::packedIntegers(numbers), numbers.size()),
              numbers);
    EXPECT_TRUE(integers<std::int32_t>(std::string(8, '\0'), 0).empty());
}

// Commonest difference 7; codes: int16, common, int32, int64.
TEST(CrateCompression, WideIntegersHaveWideLiterals) {
    std::string coded(8, '\0');
    coded[0] = 7;
    coded += char(1 | 0 << 2 | 2 << 4 | 3 << 6);
    coded += std::string("\xfe\xff", 2) + std::string("\0\0\0\1", 4) +
             std::string("\0\0\0\0\0\0\0\x10", 8);
    EXPECT_EQ(integers<std::int64_t>(stored(coded), 4),
              (std::vector<std::int64_t>{-2, 5, 5 + (1 << 24), 5 + (1 << 24) + (1ll << 60)}));
}

TEST(CrateCompression, IntegersThatCantBeThereAreFaults) {
    const std::string good = CrateWriter::packedIntegers({1, 500, 3});
    EXPECT_THROW(integers<std::int32_t>(good, 40), CrateFault);
    EXPECT_THROW(integers<std::int32_t>(good, std::uint64_t(1) << 60), CrateFault);
    EXPECT_THROW(integers<std::int32_t>(good.substr(0, good.size() - 1), 3), CrateFault);
    EXPECT_THROW(integers<std::int32_t>("1234567", 1), CrateFault);
}

} // namespace penumbra
