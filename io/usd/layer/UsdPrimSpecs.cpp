#include "io/usd/layer/UsdPrimSpecs.h"

#include <algorithm>

namespace penumbra {

UsdPrimSpec makePrim(std::string_view type, std::string_view name) {
    UsdPrimSpec spec;
    spec.typeName = type;
    spec.name = name;
    return spec;
}

UsdPrimSpec& overAt(UsdLayer& layer, std::string_view path) {
    assert(path.size() > 1 && path.front() == '/');
    std::vector<UsdPrimSpec>* siblings = &layer.prims;
    UsdPrimSpec* spec = nullptr;
    while (!path.empty()) {
        path.remove_prefix(1); // a slash
        const std::string_view name = path.substr(0, path.find('/'));
        path.remove_prefix(name.size());
        auto found = std::find_if(siblings->begin(), siblings->end(),
                                  [&](const UsdPrimSpec& one) { return one.name == name; });
        if (found == siblings->end()) {
            found = siblings->insert(found, makePrim("", name));
            found->specifier = UsdSpecifier::over;
        }
        spec = &*found;
        siblings = &spec->children;
    }
    return *spec;
}

UsdProperty& declareAttribute(UsdPrimSpec& spec, std::string_view type, std::string_view name) {
    UsdProperty& property = spec.properties.emplace_back();
    const bool array = type.ends_with("[]");
    property.name = name;
    property.typeName = type.substr(0, type.size() - (array ? 2 : 0));
    property.type = usdTypeNamed(property.typeName);
    assert(property.type.kind != UsdKind::unknown);
    property.type.array = array;
    return property;
}

UsdProperty& addText(UsdPrimSpec& spec, std::string_view type, std::string_view name,
                     std::string value) {
    return addAttribute(spec, type, name, std::vector{std::move(value)});
}

UsdProperty& addColour(UsdPrimSpec& spec, std::string_view name, glm::dvec3 rgb) {
    return addAttribute(spec, "color3f", name,
                        std::vector{float(rgb.r), float(rgb.g), float(rgb.b)});
}

void addConnection(UsdPrimSpec& spec, std::string_view type, std::string_view name,
                   std::string source) {
    declareAttribute(spec, type, name)
        .targets.push_back({UsdListOp::explicitly, {std::move(source)}});
}

void addRelationship(UsdPrimSpec& spec, std::string_view name, std::string target) {
    UsdProperty& property = spec.properties.emplace_back();
    property.name = name;
    property.relationship = true;
    property.targets.push_back({UsdListOp::explicitly, {std::move(target)}});
}

void addMetadata(UsdDictionary& metadata, std::string_view name, UsdKind kind, std::string text) {
    assign(metadata, {std::string(name), {}, {{kind}, std::vector{std::move(text)}}});
}

void addMetadata(UsdDictionary& metadata, std::string_view name, bool flag) {
    assign(metadata,
           {std::string(name), {}, {{UsdKind::boolean}, std::vector<std::uint8_t>{flag}}});
}

void addMetadata(UsdDictionary& metadata, std::string_view name, double number) {
    assign(metadata, {std::string(name), {}, {{UsdKind::float64}, std::vector{number}}});
}

void applySchema(UsdPrimSpec& spec, std::string_view schema) {
    if (!spec.arcs) spec.arcs = std::make_unique<UsdArcs>();
    if (spec.arcs->apiSchemas.empty()) spec.arcs->apiSchemas.push_back({UsdListOp::prepend, {}});
    spec.arcs->apiSchemas.front().items.emplace_back(schema);
}

void addTransform(UsdPrimSpec& spec, const glm::dmat4& matrix) {
    if (matrix == glm::dmat4(1)) return;
    std::vector<double> rows; // USD's rows are our columns
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) rows.push_back(matrix[c][r]);
    addAttribute(spec, "matrix4d", "xformOp:transform", std::move(rows));
    addAttribute(spec, "token[]", "xformOpOrder", std::vector<std::string>{"xformOp:transform"})
        .uniform = true;
}

} // namespace penumbra
