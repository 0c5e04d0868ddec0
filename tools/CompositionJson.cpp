#include "tools/CompositionJson.h"

#include "base/Error.h"
#include "io/usd/scene/SceneFiles.h"
#include "io/usd/stage/UsdReport.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace penumbra {

namespace {

using Json = nlohmann::ordered_json;

// A layer once, where its strongest site is, with the path of its weakest.
Json folded(const UsdPrimReport::Sites& sites) {
    Json object = Json::object();
    for (const auto& [layer, path] : sites) object[layer] = path;
    return object;
}

std::string number(double value) {
    const std::string text = fmt::format("{:.2f}", value);
    return text == "-0.00" ? "0.00" : text;
}

Json timeOf(const UsdTimeReport& time) {
    Json object;
    if (!time.prim.empty()) object["children"] = Json::array();
    for (const UsdTimeReport& child : time.children) object["children"].push_back(timeOf(child));
    object["layer"] = time.layer;
    if (!time.prim.empty()) object["prim"] = time.prim;
    object["type"] = time.type;
    object["offset"] = number(time.offset.offset);
    object["scale"] = number(time.offset.scale);
    return object;
}

Json primOf(const UsdPrimReport& prim) {
    Json object;
    const auto set = [&](const char* key, Json value) {
        if (!value.empty()) object[key] = std::move(value);
    };
    set("Prim Stack", folded(prim.primStack));
    Json full = Json::array();
    for (const auto& [layer, path] : prim.primStack) full.push_back({layer, path});
    set("Full Prim Stack", std::move(full));
    Json times = Json::array();
    for (const UsdTimeReport& time : prim.times) times.push_back(timeOf(time));
    set("Time Offsets", std::move(times));
    set("Variant Selections", prim.variants);
    set("Child names", prim.childNames);
    set("Prohibited child names", prim.prohibited);
    set("Property names", prim.properties);
    Json stacks = Json::object();
    for (const std::string& property : prim.properties) {
        const std::string path = prim.path + "." + property;
        stacks[path] = folded(prim.propertyStacks.at(path));
    }
    set("Property stacks", std::move(stacks));
    set("Relationship targets", prim.targets);
    set("Attribute connections", prim.connections);
    set("Deleted target paths", prim.deleted);
    return object.is_null() ? Json::object() : object;
}

std::string textOf(const UsdCompositionErrors::Error& error) {
    const std::string where =
        error.prim.empty() ? "computing Layer Stack" : "composing <" + error.prim + ">";
    return "Errors while " + where + "\n" + error.text;
}

} // namespace

CompositionJson compositionJson(const std::filesystem::path& scene, bool allowOutside) {
    CompositionJson result;
    Json json;
    json["Entry"] = scene.filename().string();
    auto& prims = (json["Composing"] = Json::object()).get_ref<Json::object_t&>();
    Json errors = Json::array();
    const SceneFiles files(scene, allowOutside);
    try {
        UsdComposition composition(scene, {}, files);
        reportComposition(composition, [&](const UsdPrimReport& prim) {
            prims.emplace_back(prim.path, primOf(prim)); // paths differ: nothing to look up
        });
        json["Layer Stack"] = layerNames(composition);
        for (const auto& error : composition.errors().list()) errors.push_back(textOf(error));
        result.files = composition.files();
        result.diagnostics = composition.diagnostics().take();
    } catch (const SceneFileError& fault) { // its root layer is refused: nothing is composed
        errors.push_back(fault.what());
        result.files.push_back(scene);
        result.fault = fault.what();
    }
    result.files = files.withParts(std::move(result.files));
    if (!errors.empty()) json["Errors"] = std::move(errors);
    result.text = json.dump(4, ' ', false, Json::error_handler_t::replace) + "\n";
    return result;
}

} // namespace penumbra
