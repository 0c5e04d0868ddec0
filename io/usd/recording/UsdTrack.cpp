#include "io/usd/recording/UsdTrack.h"

#include "io/usd/layer/UsdPrimSpecs.h"

#include <glm/gtc/quaternion.hpp>

#include <cmath>
#include <optional>
#include <string>

namespace penumbra {

namespace {

/// A transform as it is written: M = translate * orient * scale.
struct Parts {
    glm::dvec3 translate{0.0};
    glm::dquat orient{1, 0, 0, 0};
    glm::dvec3 scale{1.0};
};

/// None: the axes are sheared, mirrored or flat.
std::optional<Parts> partsOf(const glm::dmat4& matrix) {
    Parts parts;
    parts.translate = glm::dvec3(matrix[3]);
    glm::dmat3 axes(matrix);
    for (int i = 0; i < 3; ++i) {
        parts.scale[i] = glm::length(axes[i]);
        if (!(parts.scale[i] > 0)) return std::nullopt;
        axes[i] /= parts.scale[i];
        if (std::abs(parts.scale[i] - 1) < 1e-14) parts.scale[i] = 1; // of rounding alone
    }
    const double skew = std::abs(glm::dot(axes[0], axes[1])) +
                        std::abs(glm::dot(axes[1], axes[2])) + std::abs(glm::dot(axes[2], axes[0]));
    if (skew > 1e-9 || glm::determinant(axes) < 0) return std::nullopt;
    parts.orient = glm::normalize(glm::quat_cast(axes));
    return parts;
}

} // namespace

void UsdTrack::put(double code, UsdValue value) {
    if (!samples_.empty()) {
        const UsdTimeSample last = samples_.back();
        if (last.value == value) return;
        changed_ = true;
        if (last.time == code)
            samples_.pop_back(); // the last of several within one time code counts
        else if (last.time < code - 1)
            samples_.push_back({code - 1, last.value});
    }
    samples_.push_back({code, std::move(value)});
}

void UsdTrack::write(UsdPrimSpec& prim, std::string_view name) const {
    UsdProperty& property = declareAttribute(prim, type_, name);
    property.hasSamples = samples_.size() > 1;
    if (property.hasSamples)
        property.samples = samples_;
    else
        property.value = samples_.front().value;
}

void UsdPoseTrack::put(double code, const glm::dmat4& value) {
    const double* const first = &value[0][0]; // USD's rows are our columns
    matrix.put(code, std::vector<double>(first, first + 16));
    const auto parts = partsOf(value);
    rigid = rigid && parts;
    if (!rigid) return;
    translate.put(code, listOf(parts->translate));
    const glm::dquat& q = parts->orient;
    orient.put(code, std::vector{q.w, q.x, q.y, q.z});
    scale.put(code, listOf(parts->scale));
}

void UsdPoseTrack::write(UsdPrimSpec& prim, bool absolute) const {
    std::vector<std::string> order;
    const auto add = [&](const UsdTrack& track, const char* op) {
        track.write(prim, op);
        order.emplace_back(op);
    };
    if (absolute) order.emplace_back("!resetXformStack!");
    if (rigid) {
        add(translate, "xformOp:translate:session");
        add(orient, "xformOp:orient:session");
        if (scale.changes() || scale.first() != std::vector{1.0, 1.0, 1.0})
            add(scale, "xformOp:scale:session");
    } else {
        add(matrix, "xformOp:transform:session");
    }
    addAttribute(prim, "token[]", "xformOpOrder", std::move(order)).uniform = true;
}

void UsdLightTrack::put(double code, Rgb nits) {
    const float most = maxChannel(nits);
    if (most > 0)
        colour.put(code, listOf(glm::vec3(nits.r, nits.g, nits.b) / most));
    else if (colour.empty())
        colour.put(code, listOf(glm::vec3(1)));
    intensity.put(code, std::vector{most});
}

void UsdLightTrack::write(UsdPrimSpec& light) const {
    colour.write(light, "inputs:color");
    intensity.write(light, "inputs:intensity");
    addFloat(light, "inputs:exposure", 0);
    addFloat(light, "inputs:diffuse", 1);
    addBool(light, "inputs:normalize", false);
    addBool(light, "inputs:enableColorTemperature", false);
}

} // namespace penumbra
