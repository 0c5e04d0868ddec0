#include "io/usd/scene/UsdSharedContents.h"

#include "io/usd/layer/UsdPath.h"

#include <type_traits>
#include <vector>

namespace penumbra {

namespace {

template <class T>
void put(std::string& key, const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    key.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

} // namespace

std::uint32_t UsdSharedContents::originalOf(std::uint32_t instance) {
    return originals_.try_emplace(keyOf(instance), instance).first->second;
}

std::string UsdSharedContents::inOriginal(const std::string& path, std::uint32_t copy,
                                          std::uint32_t original) const {
    const std::string& from = stage_.prims()[copy].path;
    return isUsdPathWithin(path, from) ? movedUsdPath(path, from, stage_.prims()[original].path)
                                       : path;
}

// Breadth first, each prim's number of children with it: equal keys mean equal trees.
std::string UsdSharedContents::keyOf(std::uint32_t instance) const {
    std::string key;
    std::vector<std::uint32_t> open{instance};
    for (std::size_t i = 0; i < open.size(); ++i) {
        const UsdPrim& prim = stage_.prims()[open[i]];
        put(key, prim.children.size());
        open.insert(open.end(), prim.children.begin(), prim.children.end());
        if (i == 0) continue;
        put(key, prim.name.size());
        key += prim.name;
        put(key, prim.opinions.size());
        for (const UsdOpinion& opinion : prim.opinions) {
            put(key, reinterpret_cast<std::uintptr_t>(opinion.spec));
            put(key, reinterpret_cast<std::uintptr_t>(opinion.layer));
            put(key, opinion.offset.offset);
            put(key, opinion.offset.scale);
        }
    }
    return key;
}

} // namespace penumbra
