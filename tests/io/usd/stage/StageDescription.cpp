#include "tests/io/usd/stage/StageDescription.h"

#include "io/usd/text/UsdValueText.h"

#include <fmt/format.h>

#include <set>

namespace penumbra {

namespace {

/// Numbers to nine digits: a time that was scaled is the same but for rounding.
std::string described(const UsdValue& value) {
    const std::vector<double> numbers = value.numbers();
    if (numbers.empty()) return usdText(value);
    std::string text = value.type.array ? "array" : "";
    for (const double number : numbers) text += fmt::format(" {:.9g}", number);
    return text;
}

/// All properties of a prim with what they say, at three times and without one.
void describeProperties(const UsdPrim& prim, std::string& text) {
    std::set<std::string> names;
    for (const UsdOpinion& opinion : prim.opinions)
        for (const UsdProperty& property : opinion.spec->properties) names.insert(property.name);
    for (const std::string& name : names) {
        const UsdProperty& strongest = *UsdStage::property(prim, name);
        text.append(" ").append(name).append(strongest.custom ? " custom" : "");
        text += strongest.uniform ? " uniform" : "";
        for (const UsdTime time : {UsdTime(), UsdTime(0.0), UsdTime(2.5), UsdTime(7.0)})
            if (const UsdResolved value = UsdStage::value(prim, name, time))
                if (value->type.kind != UsdKind::asset) text.append(" ").append(described(*value));
        for (const std::string& target : UsdStage::targets(prim, name))
            text.append(" <").append(target).append(">");
        if (const UsdValue* value = UsdStage::metadata(prim, name, "interpolation"))
            text.append(" ").append(usdText(*value));
        text += "\n";
    }
}

} // namespace

std::string described(const UsdStage& stage) {
    std::string text;
    for (const UsdPrim& prim : stage.prims()) {
        text.append(prim.path).append(" ").append(prim.typeName).append(" ");
        text.append(std::to_string(int(prim.specifier))).append("\n");
        describeProperties(prim, text);
    }
    return text;
}

} // namespace penumbra
