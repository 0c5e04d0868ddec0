// Specs of attributes and relationships.
#pragma once

#include "io/usd/crate/CrateFile.h"
#include "io/usd/layer/UsdLayer.h"

#include <functional>
#include <unordered_map>

namespace penumbra {

/// What a field of a spec could not be read for: its name, and why.
using CrateFieldFaults = std::function<void(std::string_view field, const std::string& why)>;

/// Calls `visit(name, field)` for each field of a set, from the set's first entry on.
template <class Visit>
void visitCrateFields(CrateFile& file, std::uint32_t fieldSet, Visit visit) {
    const auto& sets = file.tables.fieldSets;
    for (std::size_t i = fieldSet; i < sets.size() && sets[i] != kEndOfFieldSet; ++i) {
        file.budget.spend(1, 0);
        const CrateField& field = file.tables.fields[sets[i]];
        visit(file.tables.tokens[field.name], field);
    }
}

/// Reads properties; remembers the declared types that it has met.
class CratePropertyReader {
public:
    explicit CratePropertyReader(CrateFile& file) : file_(file) {}

    /// Into `property`, whose name is set. False if nothing declares it.
    bool read(const CrateSpec& spec, UsdProperty& property, const CrateFieldFaults& faults);

private:
    bool declare(const CrateSpec& spec, UsdProperty& property);
    void field(std::string_view name, CrateRep rep, UsdProperty& property,
               const CrateFieldFaults& faults);
    void samples(CrateRep rep, UsdProperty& property, const CrateFieldFaults& faults);

    CrateFile& file_;
    struct Declared {
        std::string name;
        UsdType type;
    };
    std::unordered_map<std::uint32_t, Declared> types_; ///< by token
};

} // namespace penumbra
