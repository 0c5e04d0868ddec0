#include "io/usd/scene/UsdInstances.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>
#include <string>
#include <string_view>

namespace penumbra {

namespace {

constexpr double kFarthest = 1e7; ///< [scene units], as of transform ops

bool usable(glm::dvec3 v) {
    return std::abs(v.x) <= kFarthest && std::abs(v.y) <= kFarthest && std::abs(v.z) <= kFarthest;
}

// The whole numbers in the text of a list, `[1, 2]`: `inactiveIds` is kept as it was written.
std::vector<std::int64_t> numbersIn(std::string_view text) {
    std::vector<std::int64_t> numbers;
    const char* const end = text.data() + text.size();
    for (const char* at = text.data(); at < end;) {
        std::int64_t number = 0;
        const auto [next, fault] = std::from_chars(at, end, number);
        if (fault == std::errc()) numbers.push_back(number);
        at = fault == std::errc() ? next : at + 1;
    }
    return numbers;
}

// The prim's metadata `inactiveIds`, a list that each layer may edit.
std::set<std::int64_t> inactiveIds(const UsdPrim& prim) {
    std::set<std::int64_t> ids;
    const auto edit = [&](const UsdPrimSpec& spec, const std::string& key, auto apply) {
        const UsdValue* const value = find(spec.metadata, key);
        const auto* const raw = value ? std::get_if<UsdRaw>(&value->data) : nullptr;
        for (const std::int64_t id : raw ? numbersIn(raw->text) : std::vector<std::int64_t>{})
            apply(id);
        return value != nullptr;
    };
    const auto insert = [&](std::int64_t id) { ids.insert(id); };
    for (std::size_t i = prim.opinions.size(); i-- > 0;) { // from the weakest
        const UsdPrimSpec& spec = *prim.opinions[i].spec;
        if (find(spec.metadata, "inactiveIds")) ids.clear();
        edit(spec, "inactiveIds", insert);
        edit(spec, "delete inactiveIds", [&](std::int64_t id) { ids.erase(id); });
        for (const char* const op : {"add", "prepend", "append"})
            edit(spec, std::string(op) + " inactiveIds", insert);
    }
    return ids;
}

// The arrays of an instancer, each empty or with one entry an instance.
class InstanceArrays {
public:
    InstanceArrays(const UsdAttributes& prim, std::size_t count, Diagnostics& diagnostics)
        : prim_(prim), diagnostics_(diagnostics), count_(count) {
        positions_ = fitting("positions", prim.points("positions"), 1);
        scales_ = fitting("scales", prim.points("scales"), 1);
        orientations_ = fitting("orientationsf", prim.numbers("orientationsf"), 4);
        if (orientations_.empty())
            orientations_ = fitting("orientations", prim.numbers("orientations"), 4);
        ids_ = fitting("ids", prim.wideIntegers("ids"), 1);
        hidden_ = inactiveIds(prim.prim());
        for (const std::int64_t id : prim.wideIntegers("invisibleIds")) hidden_.insert(id);
    }
    bool positioned() const { return !positions_.empty(); }
    bool hidden(std::size_t i) const {
        return hidden_.contains(ids_.empty() ? std::int64_t(i) : ids_[i]);
    }
    bool usable(std::size_t i) const {
        return penumbra::usable(positions_[i]) && (scales_.empty() || penumbra::usable(scales_[i]));
    }
    glm::dmat4 matrix(std::size_t i) const {
        glm::dmat4 m = orientations_.empty() ? glm::dmat4(1.0) : rotation(i);
        if (!scales_.empty())
            for (int axis = 0; axis < 3; ++axis) m[axis] *= double(scales_[i][axis]);
        m[3] = glm::dvec4(glm::dvec3(positions_[i]), 1.0);
        return m;
    }

private:
    glm::dmat4 rotation(std::size_t i) const {
        const double* const q = orientations_.data() + 4 * i;
        const glm::dquat quaternion(q[0], q[1], q[2], q[3]);
        const double length = glm::length(quaternion);
        const bool turns = length > 0 && std::isfinite(length);
        return turns ? glm::mat4_cast(quaternion / length) : glm::dmat4(1.0);
    }
    template <class T>
    std::vector<T> fitting(const char* name, std::vector<T> entries, std::size_t each) {
        if (entries.empty() || entries.size() == each * count_) return entries;
        diagnostics_.warn(prim_.location(name),
                          std::string(name) + " of a PointInstancer ignored: " +
                              std::to_string(entries.size() / each) + " for " +
                              std::to_string(count_) + " instances");
        return {};
    }

    const UsdAttributes& prim_;
    Diagnostics& diagnostics_;
    std::size_t count_;
    std::vector<glm::vec3> positions_, scales_;
    std::vector<double> orientations_; // real, i, j, k
    std::vector<std::int64_t> ids_;
    std::set<std::int64_t> hidden_;
};

void warnOfAnimation(const UsdAttributes& instancer, Diagnostics& diagnostics) {
    constexpr std::array kArrays{"protoIndices",  "positions", "orientations",
                                 "orientationsf", "scales",    "invisibleIds"};
    for (const char* const name : kArrays)
        if (UsdStage::animated(instancer.prim(), name))
            diagnostics.warn(instancer.location(name), "animated instances are held");
}

} // namespace

std::vector<UsdInstance> readUsdInstances(const UsdAttributes& instancer, std::size_t prototypes,
                                          Diagnostics& diagnostics) {
    warnOfAnimation(instancer, diagnostics);
    const std::vector<std::int32_t> of = instancer.integers("protoIndices");
    const InstanceArrays arrays(instancer, of.size(), diagnostics);
    std::vector<UsdInstance> instances;
    if (of.empty()) return instances;
    if (!arrays.positioned()) {
        diagnostics.warn(instancer.prim().location(),
                         "a PointInstancer without positions left out");
        return instances;
    }
    std::size_t unknown = 0, faulty = 0;
    for (std::size_t i = 0; i < of.size(); ++i) {
        if (arrays.hidden(i)) continue;
        const bool known = of[i] >= 0 && std::size_t(of[i]) < prototypes;
        unknown += !known;
        faulty += known && !arrays.usable(i);
        if (known && arrays.usable(i))
            instances.push_back({i, std::size_t(of[i]), arrays.matrix(i)});
    }
    const auto warn = [&](const char* name, const char* text, std::size_t count) {
        if (count > 0) diagnostics.warn(instancer.location(name), text, count);
    };
    warn("protoIndices", "instance of a prototype that is not there left out", unknown);
    warn("positions", "instance beyond 1e7, or with a number that is not finite, left out", faulty);
    return instances;
}

} // namespace penumbra
