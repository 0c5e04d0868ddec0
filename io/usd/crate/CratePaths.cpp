#include "io/usd/crate/CratePaths.h"

#include "io/usd/crate/CrateCompression.h"
#include "io/usd/layer/UsdPath.h"

#include <algorithm>

namespace penumbra {

using Kind = CratePaths::Kind;

/// What an element may be by its name. Each token is examined once: it may be long, and be named
/// by as many paths as the file likes.
class ElementNames {
public:
    explicit ElementNames(std::span<const std::string_view> tokens)
        : tokens_(tokens), known_(tokens.size(), 0) {}

    bool isPrim(std::uint32_t token) { return of(token) & kPrim; }
    bool isProperty(std::uint32_t token) { return of(token) & kProperty; }
    bool isVariant(std::uint32_t token) { return of(token) & kVariant; }
    bool isTarget(std::uint32_t token) { return of(token) & kTarget; }

private:
    enum : std::uint8_t { kExamined = 1, kPrim = 2, kProperty = 4, kVariant = 8, kTarget = 16 };

    std::uint8_t of(std::uint32_t token) {
        std::uint8_t& known = known_[token];
        if (known) return known;
        const std::string_view text = tokens_[token];
        known = kExamined;
        if (isUsdIdentifier(text)) known |= kPrim;
        if (isUsdPropertyName(text)) known |= kProperty;
        if (text.starts_with('[') && text.ends_with(']')) known |= kTarget;
        if (text.starts_with('{') && text.ends_with('}') &&
            text.find('=') != std::string_view::npos)
            known |= kVariant;
        return known;
    }

    std::span<const std::string_view> tokens_;
    std::vector<std::uint8_t> known_;
};

/// Builds the table, element by element, in the order of the tree.
class CratePathReader {
public:
    CratePathReader(std::uint64_t tableSize, std::span<const std::string_view> tokens,
                    std::uint64_t byte)
        : tokens_(tokens), names_(tokens), byte_(byte) {
        paths_.nodes_.resize(tableSize);
    }

    void readCompressed(CrateBytes& in, std::uint64_t count);
    void readRecords(CrateBytes& in, bool padded);
    CratePaths take() {
        paths_.index();
        return std::move(paths_);
    }

private:
    [[noreturn]] void fail(const char* text) const { throw CrateFault(byte_, text); }
    void add(std::uint32_t index, std::uint32_t parent, std::uint32_t token, bool property);
    Kind kindOf(std::uint32_t parent, std::uint32_t token, bool property);

    CratePaths paths_;
    std::span<const std::string_view> tokens_;
    ElementNames names_;
    std::uint64_t byte_;
};

// Mappers and expressions of old files lie below a property: nothing of ours reads them.
Kind CratePathReader::kindOf(std::uint32_t parent, std::uint32_t token, bool property) {
    const Kind above = paths_.nodes_[parent].kind;
    const bool aboveIsPrim = above == Kind::prim || above == Kind::variant;
    const std::size_t length = paths_.nodes_[parent].length + tokens_[token].size() + 1;
    if (above == Kind::invalid || length > CratePaths::kMaxLength) return Kind::invalid;
    if (property) { // of a prim, or of a relationship's target
        const bool good = (aboveIsPrim || above == Kind::target) && names_.isProperty(token);
        return good ? Kind::property : Kind::invalid;
    }
    if (above == Kind::property || above == Kind::target)
        return names_.isTarget(token) ? Kind::target : Kind::invalid;
    if (aboveIsPrim && names_.isVariant(token)) return Kind::variant;
    return names_.isPrim(token) ? Kind::prim : Kind::invalid;
}

void CratePathReader::add(std::uint32_t index, std::uint32_t parent, std::uint32_t token,
                          bool property) {
    if (index >= paths_.nodes_.size()) fail("a path's index is too large");
    CratePaths::Node& node = paths_.nodes_[index];
    if (node.kind != Kind::empty) fail("a path appears twice");
    if (parent == CratePaths::kNone) {
        node.kind = Kind::root;
        paths_.root_ = index;
        return;
    }
    if (token >= tokens_.size()) fail("a path's element is no token");
    const std::uint32_t depth = paths_.nodes_[parent].depth + 1u;
    if (depth > CratePaths::kMaxDepth) fail("paths are nested too deeply");
    const std::size_t length = paths_.nodes_[parent].length + tokens_[token].size() + 1;
    node = {parent, token, std::uint32_t(std::min<std::size_t>(length, CratePaths::kMaxLength)),
            std::uint16_t(depth), kindOf(parent, token, property)};
}

// Three lists: index in the table, element (negative: of a property), and where to go on: -2 leaf,
// -1 the next is a child, 0 the next is a sibling, more: the next is a child, the sibling is that
// much further on.
void CratePathReader::readCompressed(CrateBytes& in, std::uint64_t count) {
    const auto indices = takeCrateIntegers<std::uint32_t>(in, count);
    const auto elements = takeCrateIntegers<std::int32_t>(in, count);
    const auto jumps = takeCrateIntegers<std::int32_t>(in, count);
    struct Item {
        std::uint64_t item;
        std::uint32_t parent;
    };
    std::vector<Item> open;
    if (count > 0) open.push_back({0, CratePaths::kNone});
    for (std::uint64_t visits = 0; !open.empty(); ++visits) {
        const auto [item, parent] = open.back();
        open.pop_back();
        if (item >= count || visits >= count) fail("a path's sibling is no item");
        const std::int32_t element = elements[item], jump = jumps[item];
        const auto token = element < 0 ? 0u - std::uint32_t(element) : std::uint32_t(element);
        add(indices[item], parent, token, element < 0);
        if (jump < -2) fail("a path leads backwards");
        if (jump >= 0 && parent == CratePaths::kNone) fail("the root has a sibling");
        if (jump > 0) open.push_back({item + std::uint64_t(jump), parent});
        if (jump == 0) open.push_back({item + 1, parent});
        if (jump > 0 || jump == -1) open.push_back({item + 1, indices[item]});
    }
}

// Records one after the other: index, element, and bits: 1 a child follows, 2 there is a sibling,
// 4 a property. With a child and a sibling, the sibling's offset in the file comes first.
void CratePathReader::readRecords(CrateBytes& in, bool padded) {
    struct Place {
        std::uint64_t byte;
        std::uint32_t parent;
    };
    std::vector<Place> open{{in.at(), CratePaths::kNone}};
    std::uint64_t visits = in.left() / 12 + 1;
    while (!open.empty()) {
        const auto [byte, parent] = open.back();
        open.pop_back();
        if (visits-- == 0) fail("paths lead in circles");
        in.moveTo(byte);
        if (padded) in.take<std::uint32_t>();
        const auto index = in.take<std::uint32_t>();
        const auto token = in.take<std::uint32_t>();
        const unsigned bits = in.take<std::uint32_t>() & 0xff;
        add(index, parent, token, (bits & 4) != 0);
        const bool child = bits & 1, sibling = bits & 2;
        if (sibling && parent == CratePaths::kNone) fail("the root has a sibling");
        std::uint64_t next = in.at();
        if (child && sibling) {
            const auto place = in.take<std::uint64_t>();
            if (place < in.at()) in.fail("a path's sibling lies before it");
            next = in.at();
            open.push_back({place, parent});
        } else if (sibling) {
            open.push_back({next, parent});
        }
        if (child) open.push_back({next, index});
    }
}

CratePaths CratePaths::read(CrateBytes section, CrateVersion version,
                            std::span<const std::string_view> tokens, CrateBudget& budget) {
    const std::uint64_t byte = section.at();
    const auto tableSize = section.take<std::uint64_t>();
    budget.spend(tableSize, byte);
    if (tableSize >= kNone) section.fail("too many paths");
    if (!version.atLeast(4)) {
        CratePathReader reader(tableSize, tokens, byte);
        if (tableSize > 0) reader.readRecords(section, version.minor == 0);
        return reader.take();
    }
    const auto count = section.take<std::uint64_t>();
    budget.spend(count, byte);
    CratePathReader reader(tableSize, tokens, byte);
    reader.readCompressed(section, count);
    return reader.take();
}

namespace {

std::uint64_t keyOf(const CratePaths::Node& node) {
    return std::uint64_t(node.kind) << 32 | node.token;
}

} // namespace

void CratePaths::index() {
    begin_.assign(nodes_.size() + 1, 0);
    for (const Node& node : nodes_)
        if (node.parent != kNone) ++begin_[node.parent + 1];
    for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
    children_.resize(begin_.back());
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t i = 0; i < nodes_.size(); ++i)
        if (nodes_[i].parent != kNone) children_[next[nodes_[i].parent]++] = i;
    const auto byKey = [&](std::uint32_t a, std::uint32_t b) {
        return keyOf(nodes_[a]) < keyOf(nodes_[b]);
    };
    for (std::size_t i = 0; i + 1 < begin_.size(); ++i)
        std::sort(children_.begin() + begin_[i], children_.begin() + begin_[i + 1], byKey);
}

std::uint32_t CratePaths::child(std::uint32_t parent, Kind kind, std::uint32_t token) const {
    const std::uint64_t key = std::uint64_t(kind) << 32 | token;
    const auto end = children_.begin() + begin_[parent + 1];
    const auto found =
        std::lower_bound(children_.begin() + begin_[parent], end, key,
                         [&](std::uint32_t i, std::uint64_t k) { return keyOf(nodes_[i]) < k; });
    return found != end && keyOf(nodes_[*found]) == key ? *found : kNone;
}

bool CratePaths::inVariant(std::uint32_t index) const {
    for (; index != kNone; index = nodes_[index].parent)
        if (nodes_[index].kind == Kind::variant) return true;
    return false;
}

std::string CratePaths::text(std::uint32_t index, std::span<const std::string_view> tokens) const {
    if (nodes_[index].kind == Kind::invalid) return {};
    std::vector<std::uint32_t> elements;
    for (std::uint32_t i = index; i != kNone; i = nodes_[i].parent) elements.push_back(i);
    if (nodes_[index].kind == Kind::root) return "/";
    std::string path;
    for (std::size_t i = elements.size(); i-- > 0;) {
        const Node& node = nodes_[elements[i]];
        if (node.kind == Kind::prim) path.append("/").append(tokens[node.token]);
        if (node.kind == Kind::property) path.append(".").append(tokens[node.token]);
        if (node.kind == Kind::target) path += tokens[node.token];
    }
    return path;
}

} // namespace penumbra
