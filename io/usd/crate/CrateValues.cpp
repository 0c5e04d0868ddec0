#include "io/usd/crate/CrateValues.h"

#include "io/usd/crate/CrateNumbers.h"
#include "io/usd/layer/UsdPath.h"

#include <cmath>
#include <unordered_set>

namespace penumbra {

namespace {

constexpr int kMaxDepth = 64; // of dictionaries and values in values

UsdValue valueAt(CrateFile& file, CrateRep rep, int depth);

void expectType(CrateRep rep, CrateType type, const char* name) {
    if (rep.type() != type || rep.array())
        throw CrateFault(rep.payload(), std::string("this is not of type ") + name);
}

// Strings and what is stored as an index of one. An asset path's index means a token in a scalar
// and a string in an array.
UsdValue texts(CrateFile& file, CrateRep rep, UsdType type) {
    const bool viaStrings = type.array
                                ? rep.type() != CrateType::token
                                : rep.type() != CrateType::token && rep.type() != CrateType::asset;
    const auto text = [&](std::uint32_t index, std::uint64_t byte) {
        const std::string_view found =
            viaStrings ? file.string(index, byte) : file.token(index, byte);
        return file.copied(found, byte);
    };
    std::vector<std::string> result;
    if (!type.array && rep.type() == CrateType::pathExpression) {
        CrateBytes in = file.at(rep.payload());
        const auto index = in.take<std::uint32_t>();
        result.push_back(text(index, in.at()));
    } else if (!type.array) {
        result.push_back(text(rep.low(), rep.payload()));
    } else if (rep.payload() != 0) {
        CrateBytes in = file.at(rep.payload());
        const std::uint64_t count = takeCrateArrayCount(in, file.tables.version, 4);
        result.reserve(count);
        for (std::uint64_t i = 0; i < count; ++i)
            result.push_back(text(in.take<std::uint32_t>(), in.at()));
    }
    return {type, std::move(result)};
}

// An entry's value and the type that it states.
UsdNamedValue entryOf(CrateFile& file, CrateBytes& in, std::string_view name, int depth) {
    const std::uint64_t byte = in.at();
    const CrateRep rep = takeCrateRep(file, in);
    file.budget.spend(CrateBudget::kEntry, byte);
    UsdNamedValue entry{file.copied(name, byte), {}, {}};
    if (rep.type() == CrateType::tokenVector || rep.type() == CrateType::stringVector) {
        std::vector<std::string> strings;
        if (rep.type() == CrateType::stringVector)
            strings = crateStrings(file, rep);
        else
            for (const std::uint32_t token : crateTokens(file, rep))
                strings.push_back(file.copied(file.tables.tokens[token], byte));
        const bool tokens = rep.type() == CrateType::tokenVector;
        entry.typeName = tokens ? "token" : "string";
        entry.value = {usdTypeNamed(entry.typeName), std::move(strings)};
        entry.value.type.array = true;
        return entry;
    }
    entry.value = valueAt(file, rep, depth + 1);
    entry.typeName = usdTypeNameOf(rep.type());
    if (entry.typeName.empty()) throw CrateFault(byte, "a dictionary holds what it can't hold");
    return entry;
}

UsdValue valueAt(CrateFile& file, CrateRep rep, int depth) {
    if (depth > kMaxDepth) throw CrateFault(rep.payload(), "values are nested too deeply");
    if (rep.arrayEdit()) throw CrateFault(rep.payload(), "array edits are not supported");
    if (rep.type() == CrateType::valueBlock) return {{}, UsdBlock{}};
    if (rep.type() == CrateType::value) {
        CrateBytes in = file.at(rep.payload());
        return valueAt(file, takeCrateRep(file, in), depth + 1);
    }
    const UsdType type = usdTypeOf(rep);
    switch (type.kind) {
    case UsdKind::unknown:
        throw CrateFault(rep.payload(), "values of type " + std::to_string(unsigned(rep.type())) +
                                            " can't be read");
    case UsdKind::string:
    case UsdKind::token:
    case UsdKind::asset:
        return texts(file, rep, type);
    case UsdKind::dictionary: {
        if (rep.array()) throw CrateFault(rep.payload(), "an array of dictionaries");
        if (rep.inlined()) return {type, UsdDictionary()};
        CrateBytes in = file.at(rep.payload());
        return {type, takeCrateDictionary(file, in, depth)};
    }
    default:
        return crateNumbers(file, rep);
    }
}

std::vector<double> sampleTimes(CrateFile& file, CrateRep rep) {
    expectType(rep, CrateType::doubleVector, "double vector");
    CrateBytes in = file.at(rep.payload());
    const std::uint64_t count = in.takeCount(8);
    file.budget.spend(count, in.at());
    std::vector<double> times(count);
    for (double& time : times) time = in.take<double>();
    for (std::size_t i = 0; i < times.size(); ++i)
        if (!std::isfinite(times[i]) || (i > 0 && !(times[i] > times[i - 1])))
            throw CrateFault(rep.payload(), "the times of samples don't rise");
    return times;
}

} // namespace

CrateRep takeCrateRep(CrateFile& file, CrateBytes& in) {
    const std::uint64_t begin = in.at();
    in.moveFrom(begin, in.take<std::int64_t>());
    file.budget.spend(1, begin);
    return CrateRep(in.take<std::uint64_t>());
}

UsdDictionary takeCrateDictionary(CrateFile& file, CrateBytes& in, int depth) {
    if (depth > kMaxDepth) in.fail("dictionaries are nested too deeply");
    const auto count = in.take<std::uint64_t>();
    UsdDictionary dictionary;
    std::unordered_set<std::string_view> names; // of tokens, which stay where they are
    for (std::uint64_t i = 0; i < count; ++i) {
        const auto key = in.take<std::uint32_t>();
        const std::string_view name = file.string(key, in.at());
        UsdNamedValue entry = entryOf(file, in, name, depth);
        if (!name.empty() && names.insert(name).second) dictionary.push_back(std::move(entry));
    }
    return dictionary;
}

UsdValue crateValue(CrateFile& file, CrateRep rep) {
    return valueAt(file, rep, 1);
}

std::vector<std::uint32_t> crateTokens(CrateFile& file, CrateRep rep) {
    expectType(rep, CrateType::tokenVector, "token vector");
    CrateBytes in = file.at(rep.payload());
    std::vector<std::uint32_t> tokens(in.takeCount(4));
    file.budget.spend(tokens.size(), in.at());
    for (std::uint32_t& token : tokens) {
        token = in.take<std::uint32_t>();
        file.token(token, in.at());
    }
    return tokens;
}

std::vector<std::string> crateStrings(CrateFile& file, CrateRep rep) {
    expectType(rep, CrateType::stringVector, "string vector");
    CrateBytes in = file.at(rep.payload());
    const std::uint64_t count = in.takeCount(4);
    std::vector<std::string> strings;
    for (std::uint64_t i = 0; i < count; ++i) {
        const auto index = in.take<std::uint32_t>();
        strings.push_back(file.copied(file.string(index, in.at()), in.at()));
    }
    return strings;
}

std::vector<UsdLayerOffset> crateLayerOffsets(CrateFile& file, CrateRep rep) {
    expectType(rep, CrateType::layerOffsetVector, "layer offsets");
    CrateBytes in = file.at(rep.payload());
    std::vector<UsdLayerOffset> offsets(in.takeCount(16));
    file.budget.spend(offsets.size(), in.at());
    for (UsdLayerOffset& offset : offsets) {
        offset.offset = in.take<double>();
        offset.scale = in.take<double>();
    }
    return offsets;
}

UsdDictionary crateVariantSelections(CrateFile& file, CrateRep rep) {
    expectType(rep, CrateType::variantSelections, "variant selections");
    CrateBytes in = file.at(rep.payload());
    const std::uint64_t count = in.takeCount(8);
    UsdDictionary selections;
    std::unordered_set<std::string_view> sets;
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::string_view set = file.string(in.take<std::uint32_t>(), in.at());
        const std::string_view choice = file.string(in.take<std::uint32_t>(), in.at());
        std::string name = file.copied(set, in.at()); // first: it bounds the time
        if (set.empty() || !sets.insert(set).second) continue;
        UsdValue value{usdTypeNamed("string"),
                       std::vector<std::string>{file.copied(choice, in.at())}};
        selections.push_back({std::move(name), "string", std::move(value)});
    }
    return selections;
}

std::vector<UsdRelocate> crateRelocates(CrateFile& file, CrateRep rep) {
    expectType(rep, CrateType::relocates, "relocates");
    CrateBytes in = file.at(rep.payload());
    const std::uint64_t count = in.takeCount(8);
    std::vector<UsdRelocate> relocates;
    for (std::uint64_t i = 0; i < count; ++i) {
        UsdRelocate& relocate = relocates.emplace_back();
        relocate.source = file.path(in.take<std::uint32_t>(), in.at());
        relocate.target = file.path(in.take<std::uint32_t>(), in.at());
        const bool prims =
            !isUsdPropertyPath(relocate.source) && !isUsdPropertyPath(relocate.target);
        if (relocate.source.empty() || !prims) in.fail("a relocate of what is no prim");
    }
    return relocates;
}

std::vector<UsdTimeSample> crateTimeSamples(CrateFile& file, CrateRep rep) {
    expectType(rep, CrateType::timeSamples, "time samples");
    CrateBytes in = file.at(rep.payload());
    const std::vector<double> times = sampleTimes(file, takeCrateRep(file, in));
    const std::uint64_t place = in.at();
    in.moveFrom(place, in.take<std::int64_t>());
    const std::uint64_t count = in.takeCount(8);
    if (count != times.size()) in.fail("there are not as many samples as times");
    file.budget.spend(CrateBudget::kSample * count, in.at());
    std::vector<UsdTimeSample> samples;
    samples.reserve(count);
    for (const double time : times) {
        const CrateRep value(in.take<std::uint64_t>());
        samples.push_back({time, crateValue(file, value)});
    }
    return samples;
}

} // namespace penumbra
