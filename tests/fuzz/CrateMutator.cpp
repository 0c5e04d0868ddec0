#include "tests/fuzz/CrateMutator.h"

#include "io/usd/crate/CrateCompression.h"
#include "tests/support/CrateWriter.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <vector>

namespace penumbra {

namespace {

constexpr std::size_t kHeader = 88, kEntry = 32; // bytes: of the file, of a section in the contents

template <class T>
T numberAt(std::string_view bytes, std::size_t at) {
    T value{};
    if (at <= bytes.size() && sizeof value <= bytes.size() - at)
        std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

template <class T>
void append(std::string& out, T value) {
    out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

struct Section {
    std::string name, bytes;
};

/// A crate file taken apart: its values with the header before them, and the sections.
struct Parts {
    std::string values;
    std::vector<Section> sections;
};

std::optional<Parts> takenApart(std::string_view file) {
    const auto contents = numberAt<std::uint64_t>(file, 16);
    const auto count = numberAt<std::uint64_t>(file, contents);
    if (file.size() < kHeader || contents > file.size() || count == 0 || count > 20) return {};
    Parts parts;
    std::uint64_t first = file.size();
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::size_t at = contents + 8 + i * kEntry;
        if (at + kEntry > file.size()) return {};
        const auto start = numberAt<std::uint64_t>(file, at + 16);
        const auto size = numberAt<std::uint64_t>(file, at + 24);
        if (start > file.size() || size > file.size() - start) return {};
        parts.sections.push_back(
            {std::string(file.substr(at, 16)), std::string(file.substr(start, size))});
        first = std::min(first, start);
    }
    parts.values = file.substr(0, first);
    return parts;
}

std::string putTogether(const Parts& parts) {
    std::string file = parts.values, contents;
    append(contents, std::uint64_t(parts.sections.size()));
    for (const Section& section : parts.sections) {
        contents += section.name;
        append(contents, std::uint64_t(file.size()));
        append(contents, std::uint64_t(section.bytes.size()));
        file += section.bytes;
    }
    const std::uint64_t at = file.size();
    if (file.size() >= 24) std::memcpy(file.data() + 16, &at, sizeof at);
    return file + contents;
}

/// Counts, indices and offsets that are wrong in some way, or right elsewhere.
std::uint64_t absurd(FuzzRandom& random) {
    static constexpr std::array<std::uint64_t, 12> numbers{
        0,          1,          2,          16,         88,         0x7fffffff,
        0x80000000, 0xffffffff, 1ull << 48, 1ull << 60, 1ull << 63, ~0ull};
    return random.one(3) ? random.below(300) : random.of(numbers);
}

/// One item of `size` bytes becomes another, a copy, absurd, or goes, or comes twice.
void changeItem(std::string& bytes, std::size_t size, FuzzRandom& random) {
    const std::size_t count = bytes.size() / size;
    if (count == 0) return bytes.append(size, '\0'), void();
    const std::size_t at = random.below(count) * size;
    const std::string other = bytes.substr(random.below(count) * size, size);
    std::uint64_t number = numberAt<std::uint64_t>(bytes + std::string(8, '\0'), at);
    switch (random.below(6)) {
    case 0:
        bytes.replace(at, size, other);
        return;
    case 1:
        bytes.insert(at, other);
        return;
    case 2:
        bytes.erase(at, size);
        return;
    case 3:
        number ^= 1ull << random.below(8 * size);
        break;
    case 4:
        number += random.below(9) - 4;
        break;
    default:
        number = absurd(random);
    }
    std::memcpy(bytes.data() + at, &number, size);
}

std::vector<std::int32_t> integersOf(std::string_view bytes) {
    std::vector<std::int32_t> numbers(bytes.size() / 4);
    if (!numbers.empty()) std::memcpy(numbers.data(), bytes.data(), 4 * numbers.size());
    return numbers;
}

/// Takes lists of integers and packed buffers apart, as a section of them has them, changes one
/// and packs all again.
class PackedSection {
public:
    explicit PackedSection(const std::string& bytes)
        : bytes_(bytes), in_(std::as_bytes(std::span(bytes_))) {}

    std::uint64_t number() { return in_.take<std::uint64_t>(); }
    std::string integers(std::uint64_t count) {
        const auto numbers = takeCrateIntegers<std::int32_t>(in_, count);
        return {reinterpret_cast<const char*>(numbers.data()), 4 * numbers.size()};
    }
    std::string buffer(std::uint64_t size) {
        const auto packed = in_.take(in_.take<std::uint64_t>());
        const CrateBuffer plain = unpackCrateBuffer(packed, size, 0);
        return {reinterpret_cast<const char*>(plain.data.get()), plain.size};
    }

private:
    std::string bytes_;
    CrateBytes in_;
};

std::string packedBuffer(const std::string& plain) {
    const std::string buffer = CrateWriter::packed(plain);
    std::string out;
    append(out, std::uint64_t(buffer.size()));
    return out + buffer;
}

std::string packedIntegers(const std::string& bytes) {
    return CrateWriter::packedIntegers(integersOf(bytes));
}

void changeTokens(std::string& section, FuzzRandom& random) {
    PackedSection in(section);
    const std::uint64_t count = in.number(), size = in.number();
    std::string text = in.buffer(size), out;
    changeItem(text, 1 + random.below(4), random);
    append(out, random.one(8) ? absurd(random) : count);
    append(out, std::uint64_t(text.size()));
    section = out + packedBuffer(text);
}

void changeFields(std::string& section, FuzzRandom& random) {
    PackedSection in(section);
    const std::uint64_t count = in.number();
    std::string names = in.integers(count), reps = in.buffer(8 * count), out;
    changeItem(random.one(3) ? names : reps, random.one(3) ? 4 : 8, random);
    append(out, std::uint64_t(std::min(names.size() / 4, reps.size() / 8)));
    section = out + packedIntegers(names) + packedBuffer(reps);
}

/// Lists of integers of one length, behind `heads` numbers of which the last is that length.
void changeLists(std::string& section, std::size_t heads, std::size_t lists, FuzzRandom& random) {
    PackedSection in(section);
    std::vector<std::uint64_t> head(heads);
    for (std::uint64_t& number : head) number = in.number();
    std::vector<std::string> list(lists);
    for (std::string& numbers : list) numbers = in.integers(head.back());
    changeItem(list[random.below(lists)], 4, random);
    head.back() = ~0ull;
    for (const std::string& numbers : list)
        head.back() = std::min<std::uint64_t>(head.back(), numbers.size() / 4);
    if (random.one(10)) head[random.below(heads)] = absurd(random);
    section.clear();
    for (const std::uint64_t number : head) append(section, number);
    for (const std::string& numbers : list) section += packedIntegers(numbers);
}

void changeSection(Section& section, FuzzRandom& random) {
    const std::string name = section.name.c_str();
    if (name == "TOKENS") return changeTokens(section.bytes, random);
    if (name == "FIELDS") return changeFields(section.bytes, random);
    if (name == "FIELDSETS") return changeLists(section.bytes, 1, 1, random);
    if (name == "PATHS") return changeLists(section.bytes, 2, 3, random);
    if (name == "SPECS") return changeLists(section.bytes, 1, 3, random);
    changeItem(section.bytes, 4, random);
}

/// Eight bytes somewhere in the values: counts, distances and representations are among them.
void changeValues(std::string& values, FuzzRandom& random) {
    if (values.size() < kHeader + 8) return;
    std::string body = values.substr(kHeader);
    const std::size_t size = body.size();
    changeItem(body, random.one(2) ? 8 : 1 + random.below(4), random);
    body.resize(size); // offsets in the file stay what they are
    values.replace(kHeader, size, body);
}

} // namespace

std::optional<std::string> mutatedCrate(std::string_view file, FuzzRandom& random) {
    std::optional<Parts> parts = takenApart(file);
    if (!parts) return {};
    try {
        if (random.one(4))
            changeValues(parts->values, random);
        else
            changeSection(parts->sections[random.below(parts->sections.size())], random);
    } catch (const CrateFault&) { // packed wrongly, or not at all (before 0.4.0)
        Section& section = parts->sections[random.below(parts->sections.size())];
        changeItem(section.bytes, random.one(2) ? 8 : 4, random);
    }
    if (random.one(200) && parts->values.size() > 10)
        parts->values[9] = char(random.below(16)); // the version
    return putTogether(*parts);
}

} // namespace penumbra
