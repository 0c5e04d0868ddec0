#include "io/usd/crate/CrateSpecs.h"

#include "io/usd/layer/UsdText.h"

#include <unordered_set>

namespace penumbra {

using Kind = CratePaths::Kind;

CrateSpecs::CrateSpecs(const CrateFile& file, CrateWarnings& warnings)
    : file_(file), warnings_(warnings), specOf_(file.tables.paths.size(), kNone),
      taken_(file.tables.paths.size(), false) {
    const CrateTables& tables = file.tables;
    for (std::uint32_t i = 0; i < tables.specs.size(); ++i) {
        const CrateSpec& spec = tables.specs[i];
        const bool placed = spec.path < tables.paths.size() &&
                            tables.paths[spec.path].kind != Kind::empty &&
                            tables.paths[spec.path].kind != Kind::invalid;
        if (!placed)
            warnings_.warn("a spec without a path left out");
        else if (spec.form < 1 || spec.form > 11)
            warnings_.warn("a spec of unknown form " + std::to_string(spec.form) + " left out");
        else if (spec.fieldSet >= tables.fieldSets.size())
            warnings_.warn("a spec without fields left out");
        else if (specOf_[spec.path] != kNone)
            warnings_.warn("a second spec of one path left out");
        else
            specOf_[spec.path] = i;
    }
    for (std::uint32_t i = 0; i < tables.tokens.size(); ++i)
        if (tables.tokens[i].starts_with('{')) variantTokens_.try_emplace(tables.tokens[i], i);
}

bool CrateSpecs::is(std::uint32_t path, CrateForm form) const {
    const CrateSpec* spec = at(path);
    return spec && spec->form == std::uint32_t(form);
}

void CrateSpecs::missing(std::string_view name, std::uint32_t parent) {
    warnings_.warn("'" + printable(name) + "' of <" +
                   file_.tables.paths.text(parent, file_.tables.tokens) +
                   "> left out: it is not there, or listed twice");
}

// Names are compared as text: damaged files have one in several tokens.
std::vector<std::uint32_t> CrateSpecs::children(const std::vector<std::uint32_t>& names,
                                                std::uint32_t parent, Kind kind) {
    std::vector<std::uint32_t> found;
    found.reserve(names.size());
    std::unordered_set<std::string_view> seen;
    seen.reserve(names.size());
    for (const std::uint32_t name : names) {
        const std::uint32_t path = file_.tables.paths.child(parent, kind, name);
        const bool there =
            path != kNone && (kind == Kind::prim ? is(path, CrateForm::prim)
                                                 : is(path, CrateForm::attribute) ||
                                                       is(path, CrateForm::relationship));
        if (there && seen.insert(file_.tables.tokens[name]).second)
            found.push_back(path);
        else
            missing(file_.tables.tokens[name], parent);
    }
    return found;
}

std::vector<std::uint32_t> CrateSpecs::prims(const std::vector<std::uint32_t>& names,
                                             std::uint32_t parent) {
    return children(names, parent, Kind::prim);
}

std::vector<std::uint32_t> CrateSpecs::properties(const std::vector<std::uint32_t>& names,
                                                  std::uint32_t parent) {
    return children(names, parent, Kind::property);
}

std::uint32_t CrateSpecs::variant(std::uint32_t parent, std::string_view set,
                                  std::string_view choice) {
    if (set.size() + choice.size() > CratePaths::kMaxLength) {
        missing(choice, parent);
        return kNone;
    }
    std::string element = "{";
    element.append(set).append("=").append(choice).append("}");
    const auto token = variantTokens_.find(element);
    const std::uint32_t path = token == variantTokens_.end()
                                   ? kNone
                                   : file_.tables.paths.child(parent, Kind::variant, token->second);
    const CrateForm form = choice.empty() ? CrateForm::variantSet : CrateForm::variant;
    if (path == kNone || set.empty() || taken_[path] || !is(path, form)) {
        missing(element, parent);
        return kNone;
    }
    taken_[path] = true;
    return path;
}

} // namespace penumbra
