#include "io/usd/crate/CrateListOps.h"

#include "io/usd/crate/CrateValues.h"
#include "io/usd/layer/UsdNumber.h"
#include "io/usd/text/UsdValueText.h"

#include <algorithm>
#include <array>
#include <utility>

namespace penumbra {

namespace {

constexpr unsigned kExplicit = 1;

// The lists in their order, with the bit that says that each is there.
constexpr std::array<std::pair<unsigned, UsdListOp>, 6> kLists{{
    {2, UsdListOp::explicitly},
    {4, UsdListOp::add},
    {32, UsdListOp::prepend},
    {64, UsdListOp::append},
    {8, UsdListOp::remove},
    {16, UsdListOp::reorder},
}};

/// `item(in)` reads one item of at least `itemBytes` bytes; it may find it to be none.
template <class Item, class Read>
UsdListEdits<Item> editsOf(CrateFile& file, CrateRep rep, std::uint64_t itemBytes, Read item) {
    if (rep.array()) throw CrateFault(rep.payload(), "an array of list edits");
    CrateBytes in = file.at(rep.payload());
    const auto bits = in.take<std::uint8_t>();
    UsdListEdits<Item> edits;
    for (const auto& [bit, op] : kLists) {
        if (!(bits & bit)) continue;
        const std::uint64_t count = in.takeCount(itemBytes);
        const bool texts = std::is_same_v<Item, std::string>; // count for themselves
        file.budget.spend(texts ? count : CrateBudget::kReference * count, in.at());
        UsdListEdit<Item> edit{op, {}};
        for (std::uint64_t i = 0; i < count; ++i) {
            Item read = item(in);
            if constexpr (std::is_same_v<Item, std::string>)
                if (read.empty()) continue;
            edit.items.push_back(std::move(read));
        }
        const bool isExplicit = op == UsdListOp::explicitly;
        if (isExplicit == bool(bits & kExplicit)) edits.push_back(std::move(edit));
    }
    if ((bits & kExplicit) && edits.empty()) edits.push_back({UsdListOp::explicitly, {}});
    return edits;
}

// A path of a reference, which has to be that of a prim outside of variants.
std::string arcPath(CrateFile& file, CrateBytes& in) {
    const auto index = in.take<std::uint32_t>();
    std::string path = file.path(index, in.at());
    const bool good = path.empty() || (path.find('.') == std::string::npos && path != "/" &&
                                       !file.tables.paths.inVariant(index));
    if (!good) in.fail("<" + path + "> is not the path of a prim");
    return path;
}

UsdLayerOffset takeOffset(CrateBytes& in) {
    UsdLayerOffset offset;
    offset.offset = in.take<double>();
    offset.scale = in.take<double>();
    return offset;
}

UsdReference payload(CrateFile& file, CrateBytes& in) {
    UsdReference item;
    const auto asset = in.take<std::uint32_t>();
    item.asset = file.layerAsset(asset, in.at());
    item.path = arcPath(file, in);
    if (file.tables.version.atLeast(8)) item.offset = takeOffset(in);
    return item;
}

UsdReference reference(CrateFile& file, CrateBytes& in) {
    UsdReference item;
    const auto asset = in.take<std::uint32_t>();
    item.asset = file.layerAsset(asset, in.at());
    item.path = arcPath(file, in);
    item.offset = takeOffset(in);
    item.customData = takeCrateDictionary(file, in);
    return item;
}

template <class T>
UsdListEdits<std::string> integerEdits(CrateFile& file, CrateRep rep) {
    return editsOf<std::string>(file, rep, sizeof(T),
                                [](CrateBytes& in) { return std::to_string(in.take<T>()); });
}

// An item of metadata whose type nobody knows: a string is text as it stood in a text file.
std::string unregisteredItem(CrateFile& file, CrateBytes& in) {
    CrateRep rep = takeCrateRep(file, in);
    if (rep.type() == CrateType::unregistered) {
        CrateBytes inner = file.at(rep.payload());
        rep = takeCrateRep(file, inner);
    }
    const UsdValue value = crateValue(file, rep);
    return value.type.kind == UsdKind::string && value.text() ? *value.text() : usdText(value);
}

} // namespace

bool isCrateListOp(CrateType type) {
    return (type >= CrateType::tokenListOp && type <= CrateType::uint64ListOp) ||
           type == CrateType::unregisteredListOp || type == CrateType::payloadListOp;
}

UsdListEdits<std::string> crateTextEdits(CrateFile& file, CrateRep rep) {
    const auto index = [&](CrateBytes& in) { return in.take<std::uint32_t>(); };
    const auto copied = [&](std::string_view text, CrateBytes& in) {
        return file.copied(text, in.at());
    };
    switch (rep.type()) {
    case CrateType::tokenListOp:
        return editsOf<std::string>(file, rep, 4, [&](CrateBytes& in) {
            return copied(file.token(index(in), in.at()), in);
        });
    case CrateType::stringListOp:
        return editsOf<std::string>(file, rep, 4, [&](CrateBytes& in) {
            return copied(file.string(index(in), in.at()), in);
        });
    case CrateType::pathListOp:
        return editsOf<std::string>(file, rep, 4,
                                    [&](CrateBytes& in) { return file.path(index(in), in.at()); });
    default:
        throw CrateFault(rep.payload(), "this is no list of tokens, strings or paths");
    }
}

UsdListEdits<UsdReference> crateReferenceEdits(CrateFile& file, CrateRep rep) {
    if (rep.type() == CrateType::payload && !rep.array()) {
        CrateBytes in = file.at(rep.payload());
        UsdReference item = payload(file, in);
        std::vector<UsdReference> items;
        if (!item.asset.empty() || !item.path.empty()) items.push_back(std::move(item));
        return {{UsdListOp::explicitly, std::move(items)}};
    }
    if (rep.type() == CrateType::payloadListOp)
        return editsOf<UsdReference>(file, rep, 8,
                                     [&](CrateBytes& in) { return payload(file, in); });
    if (rep.type() != CrateType::referenceListOp)
        throw CrateFault(rep.payload(), "this is no list of references");
    return editsOf<UsdReference>(file, rep, 32,
                                 [&](CrateBytes& in) { return reference(file, in); });
}

UsdListEdits<std::string> crateWrittenEdits(CrateFile& file, CrateRep rep) {
    switch (rep.type()) {
    case CrateType::intListOp:
        return integerEdits<std::int32_t>(file, rep);
    case CrateType::int64ListOp:
        return integerEdits<std::int64_t>(file, rep);
    case CrateType::uintListOp:
        return integerEdits<std::uint32_t>(file, rep);
    case CrateType::uint64ListOp:
        return integerEdits<std::uint64_t>(file, rep);
    case CrateType::unregisteredListOp:
        return editsOf<std::string>(file, rep, 8,
                                    [&](CrateBytes& in) { return unregisteredItem(file, in); });
    default:
        break;
    }
    UsdListEdits<std::string> edits = crateTextEdits(file, rep);
    const auto write = [&](std::string& item) {
        if (rep.type() == CrateType::pathListOp)
            item.insert(0, "<").push_back('>');
        else
            item = usdLiteral(item);
    };
    for (auto& edit : edits) std::for_each(edit.items.begin(), edit.items.end(), write);
    return edits;
}

} // namespace penumbra
