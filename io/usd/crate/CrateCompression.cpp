#include "io/usd/crate/CrateCompression.h"

#include <lz4.h>

#include <algorithm>
#include <new>

namespace penumbra {

namespace {

constexpr std::uint64_t kLargestChunk = LZ4_MAX_INPUT_SIZE; // unpacked: 0x7E000000

// An LZ4 block ends with literals, and a byte of a length stands for at most 255 bytes.
std::uint64_t mostOf(std::uint64_t packed, std::uint64_t most) {
    return std::min(most, 255 * packed + 64);
}

class Unpacker {
public:
    Unpacker(std::uint64_t capacity, std::uint64_t byte) : capacity_(capacity), byte_(byte) {
        buffer_.data = makeCrateBuffer(capacity).data;
    }
    void add(std::span<const std::byte> block) {
        const std::uint64_t room = std::min(capacity_ - buffer_.size, kLargestChunk);
        if (block.size() > std::uint64_t(LZ4_MAX_INPUT_SIZE))
            throw CrateFault(byte_, "a packed block is too large");
        const int made =
            LZ4_decompress_safe(reinterpret_cast<const char*>(block.data()),
                                reinterpret_cast<char*>(buffer_.data.get() + buffer_.size),
                                int(block.size()), int(room));
        if (made < 0) throw CrateFault(byte_, "a packed block is damaged");
        buffer_.size += std::size_t(made);
    }
    CrateBuffer take() { return std::move(buffer_); }

private:
    CrateBuffer buffer_;
    std::uint64_t capacity_;
    std::uint64_t byte_;
};

// The coding of integers for one width: what the codes 1, 2 and 3 stand for.
template <std::size_t Bytes>
struct Coding;
template <>
struct Coding<4> {
    using Small = std::int8_t;
    using Medium = std::int16_t;
    using Large = std::int32_t;
};
template <>
struct Coding<8> {
    using Small = std::int16_t;
    using Medium = std::int32_t;
    using Large = std::int64_t;
};

/// Takes literals off the end of the unpacked bytes.
class Literals {
public:
    Literals(std::span<const std::byte> bytes, std::uint64_t byte)
        : next_(bytes.data()), end_(next_ + bytes.size()), byte_(byte) {}
    template <class T>
    T take() {
        if (std::size_t(end_ - next_) < sizeof(T))
            throw CrateFault(byte_, "coded integers end too soon");
        T value;
        std::memcpy(&value, next_, sizeof(T));
        next_ += sizeof(T);
        return value;
    }

private:
    const std::byte* next_;
    const std::byte* end_;
    std::uint64_t byte_;
};

template <class Int>
std::vector<Int> decode(std::span<const std::byte> coded, std::uint64_t count, std::uint64_t byte) {
    using Widths = Coding<sizeof(Int)>;
    using Unsigned = std::make_unsigned_t<Int>;
    CrateBytes in(coded, byte);
    const auto common = Unsigned(in.take<typename Widths::Large>());
    const auto codes = in.take((count + 3) / 4);
    Literals literals(coded.subspan(sizeof(Int) + codes.size()), byte);
    std::vector<Int> numbers(count);
    Unsigned number = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
        const unsigned code = (unsigned(codes[i / 4]) >> (2 * (i % 4))) & 3;
        if (code == 0)
            number += common;
        else if (code == 1)
            number += Unsigned(literals.template take<typename Widths::Small>());
        else if (code == 2)
            number += Unsigned(literals.template take<typename Widths::Medium>());
        else
            number += Unsigned(literals.template take<typename Widths::Large>());
        numbers[i] = Int(number);
    }
    return numbers;
}

} // namespace

// Zeros: a block with a distance of 0, which is none, takes what is there already.
CrateBuffer makeCrateBuffer(std::size_t size) {
    CrateBuffer buffer;
    buffer.data.reset(static_cast<std::byte*>(std::calloc(std::max<std::size_t>(size, 1), 1)));
    if (!buffer.data) throw std::bad_alloc();
    buffer.size = size;
    return buffer;
}

CrateBuffer unpackCrateBuffer(std::span<const std::byte> packed, std::uint64_t most,
                              std::uint64_t byte) {
    CrateBytes in(packed, byte);
    const auto chunks = in.take<std::uint8_t>();
    Unpacker out(mostOf(packed.size(), most), byte);
    if (chunks == 0) out.add(in.take(in.left()));
    for (int i = 0; i < chunks; ++i) {
        const auto size = in.take<std::int32_t>();
        if (size < 0) in.fail("a packed block of negative size");
        out.add(in.take(std::uint64_t(size)));
    }
    return out.take();
}

template <class Int>
std::vector<Int> takeCrateIntegers(CrateBytes& in, std::uint64_t count) {
    const auto packedSize = in.take<std::uint64_t>();
    const std::uint64_t byte = in.at();
    const auto packed = in.take(packedSize);
    if (count == 0) return {};
    // A packed byte makes 255 of codes at most, and each holds four.
    if (count / 1020 > packedSize)
        in.fail(std::to_string(count) + " integers can't be in " + std::to_string(packedSize) +
                " packed bytes");
    const std::uint64_t most = sizeof(Int) + (count + 3) / 4 + count * sizeof(Int);
    const CrateBuffer coded = unpackCrateBuffer(packed, most, byte);
    return decode<Int>(coded.bytes(), count, byte);
}

template std::vector<std::int32_t> takeCrateIntegers(CrateBytes&, std::uint64_t);
template std::vector<std::uint32_t> takeCrateIntegers(CrateBytes&, std::uint64_t);
template std::vector<std::int64_t> takeCrateIntegers(CrateBytes&, std::uint64_t);
template std::vector<std::uint64_t> takeCrateIntegers(CrateBytes&, std::uint64_t);

} // namespace penumbra
