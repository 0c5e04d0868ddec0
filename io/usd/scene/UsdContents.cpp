#include "io/usd/scene/UsdContents.h"

#include "io/usd/stage/UsdStage.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace penumbra {

std::string contentsOf(const UsdStage& stage) {
    constexpr std::size_t kMostTypes = 4;
    std::map<std::string, std::size_t> types;
    std::size_t undefined = 0;
    for (std::size_t p = 1; p < stage.prims().size(); ++p) { // [0] is the root
        const UsdPrim& prim = stage.prims()[p];
        if (!prim.defined || prim.abstract) ++undefined;
        ++types[prim.typeName.empty() ? "without a type" : prim.typeName];
    }
    const std::size_t count = stage.prims().size() - 1;
    if (count == 0) return "it has no prims";
    std::vector<std::pair<std::string, std::size_t>> most(types.begin(), types.end());
    std::stable_sort(most.begin(), most.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });
    std::string text = std::to_string(count) + (count == 1 ? " prim (" : " prims (");
    for (std::size_t t = 0; t < std::min(most.size(), kMostTypes); ++t)
        text += (t > 0 ? ", " : "") + std::to_string(most[t].second) + " " + most[t].first;
    text += most.size() > kMostTypes ? ", ...)" : ")";
    if (undefined > 0) text += ", " + std::to_string(undefined) + " of them classes or overs";
    return text;
}

} // namespace penumbra
