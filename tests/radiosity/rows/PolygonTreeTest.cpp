// Many polygons that send as few.
#include "radiosity/rows/PolygonTree.h"
#include "radiosity/mesh/Emitters.h"
#include "radiosity/rows/EmitterSender.h"
#include "radiosity/rows/FormFactor.h"
#include "tests/support/BallData.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

std::vector<std::vector<glm::vec3>> polygonsOf(const MeshData& mesh) {
    std::vector<std::vector<glm::vec3>> polygons;
    std::size_t first = 0;
    for (const std::int32_t count : mesh.faceVertexCounts) {
        std::vector<glm::vec3>& polygon = polygons.emplace_back();
        for (std::size_t i = first; i < first + std::size_t(count); ++i)
            polygon.push_back(mesh.points[std::size_t(mesh.faceVertexIndices[i])]);
        first += std::size_t(count);
    }
    return polygons;
}

float sumOf(std::span<const std::vector<glm::vec3>> polygons, glm::vec3 p, glm::vec3 n) {
    double sum = 0;
    for (const auto& polygon : polygons) sum += polygonFormFactor(p, n, polygon);
    return float(sum);
}

/// Receivers all around, from a hundredth of the radius to fifty of them away, turned in any way.
template <class Check>
void forReceiversAround(float radius, Check check) {
    for (int i = 0; i < 400; ++i) {
        const auto turn = [&](double step) { return float(std::fmod(i * step, 1.0)); };
        const auto direction = [](float u, float v) {
            const float z = 2 * u - 1, r = std::sqrt(1 - z * z);
            return glm::vec3(r * std::cos(6.2831853f * v), r * std::sin(6.2831853f * v), z);
        };
        const float distance = radius * (1 + 0.01f * std::pow(5000.0f, turn(0.7548777)));
        const glm::vec3 away = direction(turn(0.5698403), turn(0.6180340));
        const glm::vec3 any = direction(turn(0.3247180), turn(0.8191725));
        check(distance * away, glm::normalize(any - 1.2f * away));
    }
}

TEST(PolygonTree, SendsWhatItsPolygonsAddUpTo) {
    const auto ball = polygonsOf(ballData(24, 0.3f));
    const PolygonTree tree(ball);
    double error = 0, sum = 0;
    forReceiversAround(0.3f, [&](glm::vec3 p, glm::vec3 n) {
        const float expected = sumOf(ball, p, n);
        EXPECT_NEAR(tree.formFactor(p, n), expected, 0.01 * expected + 1e-5);
        error += std::abs(tree.formFactor(p, n) - expected), sum += expected;
    });
    EXPECT_LT(error, 0.003 * sum);
}

TEST(PolygonTree, ComesToTheClosedFormOfTheShapeThatItApproaches) {
    const auto ball = polygonsOf(ballData(120, 0.3f)); // 57,120 triangles
    const PolygonTree tree(ball);
    double error = 0, sum = 0;
    forReceiversAround(0.3f, [&](glm::vec3 p, glm::vec3 n) {
        const float expected = sphereFormFactor(p, n, glm::vec3(0), 0.3f);
        error += std::abs(tree.formFactor(p, n) - expected), sum += expected;
    });
    EXPECT_LT(error, 0.004 * sum);
}

TEST(PolygonTree, OfNoAreaSendsNothing) {
    const std::vector<std::vector<glm::vec3>> flat(100, {{0, 0, 1}, {1, 0, 1}, {2, 0, 1}});
    EXPECT_EQ(PolygonTree(flat).formFactor({0, 0, 0}, {0, 0, 1}), 0);
    EXPECT_EQ(PolygonTree({}).formFactor({0, 0, 0}, {0, 0, 1}), 0);
}

} // namespace

} // namespace penumbra
