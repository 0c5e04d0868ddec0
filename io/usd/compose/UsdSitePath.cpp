#include "io/usd/compose/UsdSitePath.h"

#include "io/usd/layer/UsdPath.h"

#include <vector>

namespace penumbra {

UsdSitePath UsdSitePath::prefix(std::size_t length) const {
    const UsdPathElement* at = element_;
    while (at->length > length) at = at->parent;
    return UsdSitePath(at);
}

bool UsdSitePath::hasPrefix(UsdSitePath other) const {
    return length() >= other.length() && prefix(other.length()) == other;
}

UsdSitePath UsdSitePath::replacePrefix(UsdSitePath from, UsdSitePath to) const {
    if (from == to) return *this;
    std::vector<UsdSitePath> tail;
    for (UsdSitePath at = *this; at.length() > from.length(); at = at.parent()) tail.push_back(at);
    for (std::size_t i = tail.size(); i-- > 0;) to = to.append(tail[i]);
    return to;
}

UsdSitePath UsdSitePath::child(std::string_view name) const {
    return UsdSitePath(element_->table->child(element_, name, {}, false));
}

UsdSitePath UsdSitePath::withChoice(std::string_view set, std::string_view choice) const {
    return UsdSitePath(element_->table->child(element_, set, choice, true));
}

UsdSitePath UsdSitePath::append(UsdSitePath other) const {
    return UsdSitePath(
        element_->table->child(element_, other.name(), other.choice(), other.isChoice()));
}

UsdSitePath UsdSitePath::root() const {
    return element_->table->root();
}

UsdSitePath UsdSitePath::fromText(std::string_view text) const {
    return element_->table->path(text);
}

std::string UsdSitePath::text() const {
    if (isRoot()) return "/";
    std::vector<UsdSitePath> elements;
    for (UsdSitePath at = *this; !at.isRoot(); at = at.parent()) elements.push_back(at);
    std::string text;
    for (std::size_t i = elements.size(); i-- > 0;) {
        const UsdSitePath at = elements[i];
        if (at.isChoice())
            text += "{" + at.name() + "=" + at.choice() + "}";
        else
            text += (at.parent().isChoice() ? "" : "/") + at.name();
    }
    return text;
}

UsdPathTable::UsdPathTable() {
    UsdPathElement& root = elements_.emplace_back();
    root.table = this;
    root.plain = &root;
}

UsdSitePath UsdPathTable::path(std::string_view text) {
    if (text.empty() || text.front() != '/') return {};
    text.remove_prefix(1);
    const UsdPathElement* path = &elements_.front();
    while (!text.empty()) {
        const std::size_t slash = text.find('/');
        const std::string_view name = text.substr(0, slash);
        if (!isUsdIdentifier(name) || path->length == kMaxLength) return {};
        path = child(path, name, {}, false);
        if (slash == std::string_view::npos) break;
        text.remove_prefix(slash + 1);
    }
    return UsdSitePath(path);
}

const UsdPathElement* UsdPathTable::child(const UsdPathElement* parent, std::string_view name,
                                          std::string_view choice, bool isChoice) {
    const auto found = children_.find(keyOf(parent, name, choice, isChoice));
    if (found != children_.end()) return found->second;
    UsdPathElement made;
    made.table = this;
    made.parent = parent;
    made.name = name;
    made.choice = choice;
    made.isChoice = isChoice;
    made.length = parent->length + 1;
    made.levels = parent->levels + (isChoice ? 0 : 1);
    if (isChoice)
        made.plain = parent->plain;
    else if (parent->plain != parent)
        made.plain = child(parent->plain, name, {}, false); // one step: that path is plain itself
    made.id = std::uint32_t(elements_.size());
    UsdPathElement& kept = elements_.emplace_back(std::move(made));
    if (!kept.plain) kept.plain = &kept;
    children_[keyOf(parent, kept.name, kept.choice, isChoice)] = &kept;
    return &kept;
}

UsdPathTable::Key UsdPathTable::keyOf(const UsdPathElement* parent, std::string_view name,
                                      std::string_view choice, bool isChoice) {
    const std::hash<std::string_view> text;
    std::size_t sum = parent->id;
    for (const std::size_t part : {text(name), text(choice), std::size_t(isChoice)})
        sum = (sum ^ part) * 0x9e3779b97f4a7c15u + (sum >> 17);
    return {sum, parent, name, choice, isChoice};
}

} // namespace penumbra
