#include "io/usd/crate/CrateTables.h"

#include "io/usd/layer/UsdText.h"

#include <algorithm>
#include <string>

namespace penumbra {

namespace {

constexpr int kNewestMinor = 14;

class TableReader {
public:
    TableReader(std::span<const std::byte> file, CrateBudget& budget)
        : file_(file), budget_(budget) {}

    CrateTables read() {
        header();
        tokens(section("TOKENS"));
        strings(section("STRINGS"));
        fields(section("FIELDS"));
        fieldSets(section("FIELDSETS"));
        tables_.paths =
            CratePaths::read(section("PATHS"), tables_.version, tables_.tokens, budget_);
        specs(section("SPECS"));
        return std::move(tables_);
    }

private:
    struct Section {
        std::string name;
        std::uint64_t start = 0, size = 0;
    };

    void header();
    CrateBytes section(const std::string& name) const;
    void tokens(CrateBytes in);
    void splitTokens(std::uint64_t count, std::uint64_t byte);
    void strings(CrateBytes in);
    void fields(CrateBytes in);
    void fieldSets(CrateBytes in);
    void specs(CrateBytes in);

    /// A count of things that take an element each.
    std::uint64_t count(CrateBytes& in) {
        const auto n = in.take<std::uint64_t>();
        budget_.spend(n, in.at());
        return n;
    }

    std::span<const std::byte> file_;
    CrateBudget& budget_;
    CrateTables tables_;
    std::vector<Section> sections_;
};

void TableReader::header() {
    CrateBytes in(file_);
    in.take(8); // PXR-USDC: the caller has checked
    tables_.version.major = in.take<std::uint8_t>();
    tables_.version.minor = in.take<std::uint8_t>();
    if (tables_.version.major != 0 || tables_.version.minor > kNewestMinor)
        throw CrateFault(8, "binary USD version " + std::to_string(tables_.version.major) + "." +
                                std::to_string(tables_.version.minor) +
                                " is not supported (this program reads 0.0 to 0.14)");
    in.moveTo(16);
    in.moveTo(in.take<std::uint64_t>());
    const std::uint64_t sections = in.takeCount(32);
    for (std::uint64_t i = 0; i < std::min<std::uint64_t>(sections, 64); ++i) {
        const auto name = in.take(16);
        const std::string text(reinterpret_cast<const char*>(name.data()), name.size());
        Section section{text.substr(0, text.find('\0'))};
        section.start = in.take<std::uint64_t>();
        section.size = in.take<std::uint64_t>();
        sections_.push_back(std::move(section));
    }
}

CrateBytes TableReader::section(const std::string& name) const {
    const auto found = std::find_if(sections_.begin(), sections_.end(),
                                    [&](const Section& s) { return s.name == name; });
    if (found == sections_.end()) throw CrateFault(16, "there is no section " + name);
    if (found->start > file_.size() || found->size > file_.size() - found->start)
        throw CrateFault(16, "section " + name + " lies outside the file");
    return CrateBytes(file_.subspan(found->start, found->size), found->start);
}

void TableReader::tokens(CrateBytes in) {
    const std::uint64_t byte = in.at();
    const std::uint64_t tokenCount = count(in);
    const auto size = in.take<std::uint64_t>();
    if (tables_.version.atLeast(4)) {
        const auto packed = in.take(in.take<std::uint64_t>());
        if (size > 0) tables_.tokenBytes = unpackCrateBuffer(packed, size, byte);
        if (tables_.tokenBytes.size != size) in.fail("the tokens are not of the stated size");
    } else {
        const auto plain = in.take(size);
        tables_.tokenBytes = makeCrateBuffer(size);
        std::copy(plain.begin(), plain.end(), tables_.tokenBytes.data.get());
    }
    splitTokens(tokenCount, byte);
}

void TableReader::splitTokens(std::uint64_t tokenCount, std::uint64_t byte) {
    char* text = reinterpret_cast<char*>(tables_.tokenBytes.data.get());
    tables_.badText = replaceBadUtf8({text, tables_.tokenBytes.size});
    std::string_view rest(text, tables_.tokenBytes.size);
    tables_.tokens.reserve(std::min<std::uint64_t>(tokenCount, rest.size()));
    for (std::uint64_t i = 0; i < tokenCount; ++i) {
        const std::size_t end = rest.find('\0');
        if (end == std::string_view::npos) throw CrateFault(byte, "there are too few tokens");
        tables_.tokens.push_back(rest.substr(0, end));
        rest.remove_prefix(end + 1);
    }
}

void TableReader::strings(CrateBytes in) {
    const std::uint64_t n = in.takeCount(4);
    budget_.spend(n, in.at());
    tables_.strings.resize(n);
    for (std::uint32_t& token : tables_.strings) {
        token = in.take<std::uint32_t>();
        if (token >= tables_.tokens.size()) in.fail("a string is no token");
    }
}

void TableReader::fields(CrateBytes in) {
    const std::uint64_t n = count(in);
    if (tables_.version.atLeast(4)) {
        const auto names = takeCrateIntegers<std::uint32_t>(in, n);
        const std::uint64_t byte = in.at();
        const auto packed = in.take(in.take<std::uint64_t>());
        if (n > (std::uint64_t(1) << 40)) in.fail("too many fields");
        const CrateBuffer values = n > 0 ? unpackCrateBuffer(packed, n * 8, byte) : CrateBuffer();
        CrateBytes reps(values.bytes(), byte);
        tables_.fields.reserve(n);
        for (const std::uint32_t name : names)
            tables_.fields.push_back({name, CrateRep(reps.take<std::uint64_t>())});
    } else {
        if (n > in.left() / 16) in.fail("the fields can't be in so few bytes");
        tables_.fields.resize(n);
        for (CrateField& field : tables_.fields) {
            in.take<std::uint32_t>();
            field.name = in.take<std::uint32_t>();
            field.value = CrateRep(in.take<std::uint64_t>());
        }
    }
    for (const CrateField& field : tables_.fields)
        if (field.name >= tables_.tokens.size()) in.fail("the name of a field is no token");
}

void TableReader::fieldSets(CrateBytes in) {
    const std::uint64_t n = count(in);
    if (tables_.version.atLeast(4)) {
        tables_.fieldSets = takeCrateIntegers<std::uint32_t>(in, n);
    } else {
        if (n > in.left() / 4) in.fail("the field sets can't be in so few bytes");
        tables_.fieldSets.resize(n);
        for (std::uint32_t& field : tables_.fieldSets) field = in.take<std::uint32_t>();
    }
    for (const std::uint32_t field : tables_.fieldSets)
        if (field != kEndOfFieldSet && field >= tables_.fields.size())
            in.fail("a field set names no field");
    if (!tables_.fieldSets.empty() && tables_.fieldSets.back() != kEndOfFieldSet)
        in.fail("the last field set has no end");
}

void TableReader::specs(CrateBytes in) {
    const std::uint64_t n = count(in);
    if (tables_.version.atLeast(4)) {
        const auto paths = takeCrateIntegers<std::uint32_t>(in, n);
        const auto sets = takeCrateIntegers<std::uint32_t>(in, n);
        const auto forms = takeCrateIntegers<std::uint32_t>(in, n);
        tables_.specs.reserve(n);
        for (std::uint64_t i = 0; i < n; ++i)
            tables_.specs.push_back({paths[i], sets[i], forms[i]});
        return;
    }
    const bool padded = tables_.version.minor == 0;
    if (n > in.left() / (padded ? 16 : 12)) in.fail("the specs can't be in so few bytes");
    tables_.specs.resize(n);
    for (CrateSpec& spec : tables_.specs) {
        if (padded) in.take<std::uint32_t>();
        spec.path = in.take<std::uint32_t>();
        spec.fieldSet = in.take<std::uint32_t>();
        spec.form = in.take<std::uint32_t>();
    }
}

} // namespace

CrateTables readCrateTables(std::span<const std::byte> file, CrateBudget& budget) {
    return TableReader(file, budget).read();
}

} // namespace penumbra
