#include "io/usd/crate/CrateNumbers.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace penumbra {

namespace {

constexpr std::uint64_t kLeastCompressed = 16; // shorter arrays are stored plain

struct Half {
    std::uint16_t bits;
};

// From what lies in the file to what a UsdValue keeps.
template <class T>
T kept(T stored) {
    return stored;
}
float kept(Half stored) {
    return floatOfHalf(stored.bits);
}

/// Reads components that lie in the file as `Stored` and are kept as `Kept`.
template <class Stored, class Kept = Stored>
class NumberReader {
public:
    NumberReader(CrateFile& file, CrateRep rep, UsdType type)
        : file_(file), rep_(rep), type_(type) {}

    UsdValue read() {
        std::vector<Kept> numbers = rep_.array() ? array() : scalar();
        if (type_.quaternion) // i, j, k, real there, real first here
            for (std::size_t i = 0; i + 3 < numbers.size(); i += 4)
                std::rotate(&numbers[i], &numbers[i + 3], &numbers[i] + 4);
        if (type_.kind == UsdKind::boolean)
            for (Kept& number : numbers) number = number != 0;
        return {type_, std::move(numbers)};
    }

private:
    std::vector<Kept> scalar() {
        file_.budget.spend(type_.components(), rep_.payload());
        if (rep_.inlined() || sizeof(Stored) * type_.components() <= 4) return inlined();
        CrateBytes in = file_.at(rep_.payload());
        return plain(in, type_.components());
    }

    // The low 32 bits: the value itself; a smaller form of it; the components, or the diagonal of a
    // matrix, as int8.
    std::vector<Kept> inlined() const {
        const std::uint32_t low = rep_.low();
        if (type_.quaternion || rep_.type() == CrateType::timeCode)
            throw CrateFault(rep_.payload(), "a value that can't be inlined");
        if constexpr (sizeof(Stored) <= sizeof low)
            if (sizeof(Stored) * type_.components() <= sizeof low) return parts(low);
        if (type_.components() == 1) {
            if constexpr (std::is_floating_point_v<Kept>) return {Kept(std::bit_cast<float>(low))};
            if (std::is_signed_v<Kept>) return {Kept(std::int32_t(low))};
            return {Kept(low)};
        }
        std::vector<Kept> numbers(type_.components());
        const std::size_t step = type_.rows > 1 ? type_.columns + 1u : 1u;
        for (std::size_t i = 0; i < type_.columns; ++i) {
            const int byte = int(low >> (8 * i) & 0xff);
            numbers[i * step] = Kept(byte < 128 ? byte : byte - 256);
        }
        return numbers;
    }

    std::vector<Kept> parts(std::uint32_t low) const {
        std::vector<Kept> numbers;
        for (std::size_t i = 0; i < type_.components(); ++i) {
            Stored stored;
            std::memcpy(&stored, reinterpret_cast<const char*>(&low) + i * sizeof stored,
                        sizeof stored);
            numbers.push_back(kept(stored));
        }
        return numbers;
    }

    std::vector<Kept> array() {
        if (rep_.payload() == 0) return {};
        CrateBytes in = file_.at(rep_.payload());
        const std::uint64_t bytesEach = sizeof(Stored) * type_.components();
        const std::uint64_t count =
            takeCrateArrayCount(in, file_.tables.version, rep_.compressed() ? 0 : bytesEach);
        if (!rep_.compressed() || count < kLeastCompressed) {
            if (count > in.left() / bytesEach) in.fail("an array goes beyond the end of the file");
            file_.budget.spend(count * type_.components(), in.at());
            return plain(in, count * type_.components());
        }
        file_.budget.spend(count, in.at());
        if (type_.components() != 1 || sizeof(Stored) == 1)
            in.fail("an array of this type can't be compressed");
        return compressed(in, count);
    }

    std::vector<Kept> plain(CrateBytes& in, std::uint64_t count) {
        const auto bytes = in.take(count * sizeof(Stored));
        // A package may lie so that its numbers are not aligned.
        const bool aligned = reinterpret_cast<std::uintptr_t>(bytes.data()) % alignof(Stored) == 0;
        if (aligned) {
            const auto* first = reinterpret_cast<const Stored*>(bytes.data());
            if constexpr (std::is_same_v<Stored, Kept>)
                return std::vector<Kept>(first, first + count);
            std::vector<Kept> numbers(count);
            std::transform(first, first + count, numbers.begin(), [](Stored s) { return kept(s); });
            return numbers;
        }
        std::vector<Kept> numbers(count);
        for (std::uint64_t i = 0; i < count; ++i) {
            Stored stored;
            std::memcpy(&stored, bytes.data() + i * sizeof stored, sizeof stored);
            numbers[i] = kept(stored);
        }
        return numbers;
    }

    std::vector<Kept> compressed(CrateBytes& in, std::uint64_t count) {
        if constexpr (std::is_integral_v<Stored>) {
            if constexpr (sizeof(Stored) >= 4) return takeCrateIntegers<Stored>(in, count);
            in.fail("an array of this type can't be compressed");
        } else {
            const auto code = in.take<char>();
            if (code == 'i') {
                const auto integers = takeCrateIntegers<std::int32_t>(in, count);
                return std::vector<Kept>(integers.begin(), integers.end());
            }
            if (code != 't') in.fail("an array is compressed in an unknown way");
            const auto table = plain(in, in.takeCount<std::uint32_t>(sizeof(Stored)));
            std::vector<Kept> numbers;
            numbers.reserve(count);
            for (const std::uint32_t index : takeCrateIntegers<std::uint32_t>(in, count)) {
                if (index >= table.size()) in.fail("an array's index lies outside its table");
                numbers.push_back(table[index]);
            }
            return numbers;
        }
    }

    CrateFile& file_;
    CrateRep rep_;
    UsdType type_;
};

} // namespace

float floatOfHalf(std::uint16_t half) {
    const int exponent = (half >> 10) & 31;
    const auto mantissa = std::uint32_t(half & 0x3ff);
    const std::uint32_t sign = std::uint32_t(half & 0x8000) << 16;
    if (exponent == 0) {
        const float magnitude = std::ldexp(float(mantissa), -24);
        return sign ? -magnitude : magnitude;
    }
    const std::uint32_t wide = exponent == 31 ? 255u : std::uint32_t(exponent + 112);
    return std::bit_cast<float>(sign | wide << 23 | mantissa << 13);
}

std::uint64_t takeCrateArrayCount(CrateBytes& in, CrateVersion version, std::uint64_t itemBytes) {
    if (!version.atLeast(5)) in.take<std::uint32_t>(); // the rank, always 1
    const std::uint64_t count =
        version.atLeast(7) ? in.take<std::uint64_t>() : in.take<std::uint32_t>();
    if (itemBytes > 0 && count > in.left() / itemBytes)
        in.fail("an array of " + std::to_string(count) + " goes beyond the end of the file");
    return count;
}

UsdValue crateNumbers(CrateFile& file, CrateRep rep) {
    const UsdType type = usdTypeOf(rep);
    switch (type.kind) {
    case UsdKind::boolean:
    case UsdKind::uchar:
        return NumberReader<std::uint8_t>(file, rep, type).read();
    case UsdKind::int32:
        return NumberReader<std::int32_t>(file, rep, type).read();
    case UsdKind::uint32:
        return NumberReader<std::uint32_t>(file, rep, type).read();
    case UsdKind::int64:
        return NumberReader<std::int64_t>(file, rep, type).read();
    case UsdKind::uint64:
        return NumberReader<std::uint64_t>(file, rep, type).read();
    case UsdKind::float16:
        return NumberReader<Half, float>(file, rep, type).read();
    case UsdKind::float32:
        return NumberReader<float>(file, rep, type).read();
    case UsdKind::float64:
        return NumberReader<double>(file, rep, type).read();
    default:
        throw CrateFault(rep.payload(), "a value without numbers where some are expected");
    }
}

} // namespace penumbra
