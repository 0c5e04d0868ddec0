#include "io/usd/crate/CrateProperties.h"

#include "io/usd/crate/CrateFields.h"
#include "io/usd/crate/CrateListOps.h"
#include "io/usd/crate/CrateMetadata.h"
#include "io/usd/crate/CrateSpecs.h"
#include "io/usd/crate/CrateValues.h"
#include "io/usd/layer/UsdPath.h"

#include <algorithm>
#include <iterator>
#include <unordered_set>

namespace penumbra {

namespace {

// An identifier that text could not tell from a keyword is no type.
bool isTypeName(std::string_view name) {
    constexpr std::string_view kKeywords[] = {
        "add",  "append",  "class", "config",  "custom",  "def",        "delete",
        "over", "prepend", "rel",   "reorder", "uniform", "variantSet", "varying"};
    return isUsdIdentifier(name) &&
           std::find(std::begin(kKeywords), std::end(kKeywords), name) == std::end(kKeywords);
}

// A list of targets has each once.
void dropRepeats(std::vector<std::string>& items) {
    std::unordered_set<std::string> seen;
    std::erase_if(items, [&](const std::string& item) { return !seen.insert(item).second; });
}

void fit(UsdValue& value, UsdType type, CrateRep rep) {
    if (!fitUsdValue(value, type))
        throw CrateFault(rep.payload(), "a value of another type than its attribute's");
}

} // namespace

// The type, without which no value can be understood.
bool CratePropertyReader::declare(const CrateSpec& spec, UsdProperty& property) {
    property.relationship = spec.form == std::uint32_t(CrateForm::relationship);
    if (property.relationship) return true;
    std::uint32_t token = kEndOfFieldSet;
    visitCrateFields(file_, spec.fieldSet, [&](std::string_view name, const CrateField& field) {
        if (name == "typeName" && field.value.type() == CrateType::token) token = field.value.low();
    });
    if (token >= file_.tables.tokens.size()) return false;
    const auto [place, isNew] = types_.try_emplace(token);
    if (isNew) {
        std::string_view name = file_.tables.tokens[token];
        const bool array = name.ends_with("[]");
        if (array) name.remove_suffix(2);
        if (isTypeName(name)) place->second = {std::string(name), usdTypeNamed(name)};
        place->second.type.array = array;
    }
    property.typeName = place->second.name;
    property.type = place->second.type;
    return !property.typeName.empty();
}

void CratePropertyReader::samples(CrateRep rep, UsdProperty& property,
                                  const CrateFieldFaults& faults) {
    property.samples = crateTimeSamples(file_, rep);
    property.hasSamples = true;
    std::erase_if(property.samples, [&](UsdTimeSample& sample) {
        const bool fits = fitUsdValue(sample.value, property.type);
        if (!fits) faults("timeSamples", "a sample of another type than its attribute's");
        return !fits;
    });
}

void CratePropertyReader::field(std::string_view name, CrateRep rep, UsdProperty& property,
                                const CrateFieldFaults& faults) {
    const bool attribute = !property.relationship;
    switch (crateFieldNamed(name)) {
    case CrateFieldName::typeName:
    case CrateFieldName::ignored:
        return;
    case CrateFieldName::custom:
        property.custom = rep.low() & 1;
        return;
    case CrateFieldName::variability:
        (attribute ? property.uniform : property.varying) = attribute == (rep.low() != 0);
        return;
    case CrateFieldName::defaultValue:
        if (!attribute) return;
        property.value = crateValue(file_, rep);
        return fit(property.value, property.type, rep);
    case CrateFieldName::timeSamples:
        if (attribute) samples(rep, property, faults);
        return;
    case CrateFieldName::spline:
        return faults("spline", "splines are not read");
    case CrateFieldName::connectionPaths:
    case CrateFieldName::targetPaths:
        if (rep.type() != CrateType::pathListOp)
            throw CrateFault(rep.payload(), "targets are no list of paths");
        property.targets = crateTextEdits(file_, rep);
        for (auto& edit : property.targets) dropRepeats(edit.items);
        return;
    default:
        return addCrateMetadata(file_, name, rep, property.metadata);
    }
}

bool CratePropertyReader::read(const CrateSpec& spec, UsdProperty& property,
                               const CrateFieldFaults& faults) {
    if (!declare(spec, property)) return false;
    visitCrateFields(file_, spec.fieldSet, [&](std::string_view name, const CrateField& value) {
        try {
            field(name, value.value, property, faults);
        } catch (const CrateRefused&) {
            throw;
        } catch (const CrateFault& fault) {
            if (name == "default") property.value = {};
            faults(name, fault.what());
        }
    });
    return true;
}

} // namespace penumbra
