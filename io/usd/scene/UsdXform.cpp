#include "io/usd/scene/UsdXform.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace penumbra {

namespace {

constexpr std::string_view kInvert = "!invert!";
constexpr std::string_view kReset = "!resetXformStack!";

/// Rays are traced in single precision: what is some such steps farther away overflows it.
constexpr double kFarthest = 1e7; ///< [units of the scene]

bool usable(const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(),
                       [](double v) { return std::abs(v) <= kFarthest; });
}

bool finite(const glm::dmat4& m) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            if (!std::isfinite(m[c][r])) return false;
    return true;
}

glm::dmat4 translation(glm::dvec3 t) {
    glm::dmat4 m(1.0);
    m[3] = glm::dvec4(t, 1);
    return m;
}

glm::dmat4 scaling(glm::dvec3 s) {
    glm::dmat4 m(1.0);
    for (int i = 0; i < 3; ++i) m[i][i] = s[i];
    return m;
}

// About axis 0, 1 or 2 by an angle in degrees, counter-clockwise seen from the axis' tip.
glm::dmat4 rotation(int axis, double degrees) {
    const double angle = glm::radians(degrees);
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    glm::dmat4 m(1.0);
    m[u][u] = m[v][v] = std::cos(angle);
    m[u][v] = std::sin(angle);
    m[v][u] = -std::sin(angle);
    return m;
}

// `letters` is the order of application: the first turns first, so it is rightmost.
glm::dmat4 eulerRotation(std::string_view letters, const std::vector<double>& degrees) {
    glm::dmat4 m(1.0);
    for (const char letter : letters) {
        const int axis = letter - 'X';
        m = rotation(axis, degrees[std::size_t(axis)]) * m;
    }
    return m;
}

glm::dmat4 orientation(const std::vector<double>& q) {
    const glm::dquat quaternion(q[0], q[1], q[2], q[3]);
    const double length = glm::length(quaternion);
    return length > 0 ? glm::mat4_cast(quaternion / length) : glm::dmat4(1.0);
}

// USD's rows are our columns.
glm::dmat4 fromRows(const std::vector<double>& v) {
    glm::dmat4 m;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            m[row][column] = v[4 * std::size_t(row) + std::size_t(column)];
    return m;
}

// How many numbers an op of that type takes; 0 for an unknown type.
std::size_t argumentCount(std::string_view type) {
    if (type == "transform") return 16;
    if (type == "orient") return 4;
    if (type == "translate" || type == "scale") return 3;
    for (const std::string_view stem : {"rotate", "translate", "scale"}) {
        if (!type.starts_with(stem)) continue;
        const std::string_view letters = type.substr(stem.size());
        if (letters == "X" || letters == "Y" || letters == "Z") return 1;
        std::string sorted(letters);
        std::sort(sorted.begin(), sorted.end());
        if (stem == "rotate" && sorted == "XYZ") return 3;
    }
    return 0;
}

glm::dmat4 opMatrix(std::string_view type, const std::vector<double>& v) {
    if (type == "transform") return fromRows(v);
    if (type == "orient") return orientation(v);
    if (type == "translate") return translation({v[0], v[1], v[2]});
    if (type == "scale") return scaling({v[0], v[1], v[2]});
    const int axis = type.back() - 'X';
    if (type.starts_with("rotate") && v.size() == 1) return rotation(axis, v[0]);
    if (type.starts_with("rotate")) return eulerRotation(type.substr(6), v);
    glm::dvec3 one(type.starts_with("scale") ? 1.0 : 0.0);
    one[axis] = v[0];
    return type.starts_with("scale") ? scaling(one) : translation(one);
}

// `translate` of `xformOp:translate:pivot`.
std::string_view opType(std::string_view attribute) {
    constexpr std::string_view kPrefix = "xformOp:";
    if (!attribute.starts_with(kPrefix)) return {};
    attribute.remove_prefix(kPrefix.size());
    return attribute.substr(0, attribute.find(':'));
}

std::optional<glm::dmat4> evaluate(const UsdAttributes& prim, const std::string& attribute,
                                   Diagnostics& diagnostics) {
    const auto skip = [&](const char* why) -> std::optional<glm::dmat4> {
        diagnostics.warn(prim.location(attribute), std::string("transform op skipped: ") + why);
        return std::nullopt;
    };
    const std::string_view type = opType(attribute);
    const std::size_t count = argumentCount(type);
    if (count == 0) return skip("unknown type");
    if (!UsdStage::property(prim.prim(), attribute))
        return skip("xformOpOrder lists it, but it is not there");
    const UsdResolved value = prim.value(attribute);
    if (!value) return std::nullopt; // declared without a value: no change
    const std::vector<double> numbers = value->numbers();
    if (value->type.array || numbers.size() != count) return skip("its value has the wrong type");
    if (!usable(numbers)) return skip("its value is not finite, or beyond 1e7");
    glm::dmat4 matrix = opMatrix(type, numbers);
    const bool affine =
        matrix[0][3] == 0 && matrix[1][3] == 0 && matrix[2][3] == 0 && matrix[3][3] == 1;
    if (!affine) {
        diagnostics.warn(prim.location(attribute), "projective part of a transform ignored");
        for (int c = 0; c < 4; ++c) matrix[c][3] = c == 3 ? 1 : 0;
    }
    return matrix;
}

struct Op {
    explicit Op(const std::string& entry) : inverted(entry.starts_with(kInvert)) {
        attribute = inverted ? entry.substr(kInvert.size()) : entry;
    }
    bool inverted;
    std::string attribute;
};

constexpr const char* kNoMatrix =
    "transform op skipped: its matrix is not finite or can't be inverted";

} // namespace

UsdLocalTransform usdLocalTransform(const UsdAttributes& prim, Diagnostics& diagnostics) {
    UsdLocalTransform result;
    for (const std::string& entry : prim.texts("xformOpOrder")) {
        result.authored = true;
        if (entry == kReset) {
            result.matrix = glm::dmat4(1.0);
            result.resetsStack = true;
            continue;
        }
        const Op op(entry);
        result.animated = result.animated || UsdStage::animated(prim.prim(), op.attribute);
        auto matrix = evaluate(prim, op.attribute, diagnostics);
        if (!matrix) continue;
        if (op.inverted) matrix = glm::inverse(*matrix);
        const glm::dmat4 product = result.matrix * *matrix;
        if (finite(product))
            result.matrix = product;
        else
            diagnostics.warn(prim.location(op.attribute), kNoMatrix);
    }
    return result;
}

void checkUsdTransform(const UsdPrim& prim, UsdSampleCheck& check) {
    for (const std::string& entry : UsdAttributes(prim, std::nullopt).texts("xformOpOrder")) {
        if (entry == kReset) continue;
        const Op op(entry);
        const std::string_view name = op.attribute;
        check.each(prim, {&name, 1}, "op", [&](const UsdAttributes& at, Diagnostics& found) {
            evaluate(at, op.attribute, found);
        });
        if (!op.inverted) continue;
        check.each(prim, {&name, 1}, "inverse", [&](const UsdAttributes& at, Diagnostics& found) {
            Diagnostics reported; // by the op itself
            const auto matrix = evaluate(at, op.attribute, reported);
            if (matrix && !finite(glm::inverse(*matrix)))
                found.warn(at.location(op.attribute), kNoMatrix);
        });
    }
}

glm::dmat4 relativeToParent(const UsdLocalTransform& local, const glm::dmat4& parentToWorld) {
    const glm::dmat4 relative = glm::inverse(parentToWorld) * local.matrix;
    return finite(relative) ? relative : local.matrix;
}

} // namespace penumbra
