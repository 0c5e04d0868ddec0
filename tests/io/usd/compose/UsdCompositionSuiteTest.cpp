// The public suite of compositions, in the words of its pcp.json: what each prim is made of.
#include "io/usd/crate/UsdFiles.h"
#include "io/usd/stage/UsdReport.h"
#include "tests/io/usd/UsdTestFiles.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <set>
#include <sstream>
#include <tuple>

namespace penumbra {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A case, and the folder in it that has its layers: `.` in binary, `usda` as text.
struct Case {
    std::string name, layers;
};

fs::path suiteFolder() {
    const auto shared = sharedFolder();
    return shared ? *shared / "assets/aousd/composition" : fs::path();
}

fs::path entryOf(const Case& one) {
    Json want;
    std::ifstream(suiteFolder() / one.name / "pcp.json") >> want;
    return suiteFolder() / one.name / one.layers / want["Entry"].get<std::string>();
}

/// All cases, in binary where they have that: three that are to be refused are text alone.
std::vector<Case> cases() {
    std::vector<Case> list;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(suiteFolder(), none))
        if (fs::exists(entry.path() / "pcp.json"))
            for (const char* layers : {".", "usda"})
                if (const Case one{entry.path().filename(), layers}; fs::exists(entryOf(one)))
                    list.push_back(one);
    std::sort(list.begin(), list.end(), [](const Case& a, const Case& b) {
        return std::tie(a.name, a.layers) < std::tie(b.name, b.layers);
    });
    return list;
}

using Sites = UsdPrimReport::Sites;

// As the suite has stacks: a layer is there once, where its strongest site is, with the path of its
// weakest.
Sites folded(const Sites& sites) {
    Sites list;
    for (const auto& [layer, path] : sites) {
        const auto there = std::find_if(list.begin(), list.end(),
                                        [&](const auto& one) { return one.first == layer; });
        if (there == list.end())
            list.emplace_back(layer, path);
        else
            there->second = path;
    }
    return list;
}

Sites sitesOf(const Json& prim, const char* key) {
    Sites list;
    if (prim.contains(key))
        for (const auto& [layer, path] : prim[key].items()) list.emplace_back(layer, path);
    return list;
}

std::vector<std::string> namesOf(const Json& prim, const char* key) {
    return prim.contains(key) ? prim[key].get<std::vector<std::string>>()
                              : std::vector<std::string>{};
}

template <class Map>
Map mapOf(const Json& prim, const char* key) {
    Map map;
    if (prim.contains(key))
        for (const auto& [name, value] : prim[key].items())
            map[name] = value.template get<typename Map::mapped_type>();
    return map;
}

std::string twoDigits(double number) {
    const std::string text = fmt::format("{:.2f}", number);
    return text == "-0.00" ? "0.00" : text;
}

std::vector<std::string> timesOf(const std::vector<UsdTimeReport>& times) {
    std::vector<std::string> lines;
    for (const UsdTimeReport& time : times) {
        lines.push_back(fmt::format("{} {} {} {} {}", time.layer, time.prim, time.type,
                                    twoDigits(time.offset.offset), twoDigits(time.offset.scale)));
        for (const UsdTimeReport& child : time.children)
            lines.push_back(fmt::format("- {} {} {} {}", child.layer, child.type,
                                        twoDigits(child.offset.offset),
                                        twoDigits(child.offset.scale)));
    }
    return lines;
}

std::vector<std::string> timesOf(const Json& prim) {
    std::vector<std::string> lines;
    if (!prim.contains("Time Offsets")) return lines;
    const auto text = [](const Json& entry, const char* key) {
        return entry[key].get<std::string>();
    };
    for (const Json& time : prim["Time Offsets"]) {
        lines.push_back(fmt::format("{} {} {} {} {}", text(time, "layer"), text(time, "prim"),
                                    text(time, "type"), text(time, "offset"), text(time, "scale")));
        for (const Json& child : time["children"])
            lines.push_back(fmt::format("- {} {} {} {}", text(child, "layer"), text(child, "type"),
                                        text(child, "offset"), text(child, "scale")));
    }
    return lines;
}

// The stacks of pcp.txt, which are not folded.
std::map<std::string, Sites> fullStacks(const fs::path& file) {
    std::map<std::string, Sites> stacks;
    std::ifstream in(file);
    std::string line, prim;
    bool inStack = false;
    const std::string title = "Results for composing <";
    while (std::getline(in, line)) {
        if (line.starts_with(title))
            prim = line.substr(title.size(), line.find('>') - title.size());
        if (line.empty()) inStack = false;
        if (inStack) {
            std::istringstream words(line);
            std::string layer, path;
            words >> layer >> path;
            stacks[prim].emplace_back(layer, path);
        }
        if (line == "Prim Stack:") inStack = true;
    }
    return stacks;
}

void comparePrim(const UsdPrimReport& got, const Json& want) {
    SCOPED_TRACE(got.path);
    EXPECT_EQ(folded(got.primStack), sitesOf(want, "Prim Stack"));
    EXPECT_EQ(timesOf(got.times), timesOf(want));
    EXPECT_EQ(got.childNames, namesOf(want, "Child names"));
    EXPECT_EQ(got.prohibited, namesOf(want, "Prohibited child names"));
    using Names = std::map<std::string, std::string>;
    EXPECT_EQ(got.variants, mapOf<Names>(want, "Variant Selections"));
    EXPECT_EQ(got.properties, namesOf(want, "Property names"));
    using Paths = UsdPrimReport::Paths;
    EXPECT_EQ(got.targets, mapOf<Paths>(want, "Relationship targets"));
    EXPECT_EQ(got.connections, mapOf<Paths>(want, "Attribute connections"));
    EXPECT_EQ(got.deleted, mapOf<Paths>(want, "Deleted target paths"));
    const Json none = Json::object();
    const Json& stacks = want.contains("Property stacks") ? want["Property stacks"] : none;
    EXPECT_EQ(got.propertyStacks.size(), stacks.size());
    for (const auto& [property, sites] : got.propertyStacks)
        EXPECT_EQ(folded(sites), sitesOf(stacks, property.c_str())) << property;
}

std::string testName(const testing::TestParamInfo<Case>& info) {
    std::string name = info.param.name + (info.param.layers == "." ? "_binary" : "_text");
    std::erase_if(name, [](unsigned char c) { return !std::isalnum(c) && c != '_'; });
    return name;
}

class UsdCompositionSuite : public testing::TestWithParam<Case> {};

} // namespace

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(UsdCompositionSuite);
INSTANTIATE_TEST_SUITE_P(Aousd, UsdCompositionSuite, testing::ValuesIn(cases()), testName);

TEST(UsdCompositionSuiteCases, AreThere) {
    if (!sharedFolder()) GTEST_SKIP() << "../shared/assets is not there";
    const auto all = cases();
    const auto text = [](const Case& one) { return one.layers == "usda"; };
    EXPECT_EQ(std::count_if(all.begin(), all.end(), text), 106);
    EXPECT_EQ(all.size(), 106u + 103u);
}

TEST_P(UsdCompositionSuite, IsComposedAsItSays) {
    const fs::path folder = suiteFolder() / GetParam().name;
    Json want;
    std::ifstream(folder / "pcp.json") >> want;
    const fs::path entry = entryOf(GetParam());
    const UsdFiles files;
    if (want["Composing"].empty()) { // variant selections where there may be none
        EXPECT_THROW(UsdComposition(entry, {}, files), SceneFileError);
        return;
    }
    UsdComposition composition(entry, {}, files);
    EXPECT_EQ(layerNames(composition), namesOf(want, "Layer Stack"));
    auto stacks = fullStacks(folder / "pcp.txt");
    std::set<std::string> seen;
    reportComposition(composition, [&](const UsdPrimReport& prim) {
        seen.insert(prim.path);
        ASSERT_TRUE(want["Composing"].contains(prim.path)) << prim.path;
        comparePrim(prim, want["Composing"][prim.path]);
        EXPECT_EQ(prim.primStack, stacks[prim.path]) << prim.path;
    });
    EXPECT_EQ(seen.size(), want["Composing"].size());
    EXPECT_EQ(composition.errors().list().empty(), !want.contains("Errors"));
}

} // namespace penumbra
