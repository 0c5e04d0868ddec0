// Which vertices of a dense mesh receive light.
#include "radiosity/clusters/DenseReceivers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace penumbra {

namespace {

constexpr float kElement = 0.1f;
constexpr int kCells = 50; // of two centimetres: more than an eighth of an element

using Role = DenseVertex::Role;

/// One cluster: a square metre over z = 0, raised by height(x, y).
DenseMesh plate(const std::function<float(float, float)>& height) {
    DenseMesh mesh;
    const auto at = [&](float x, float y) { return glm::vec3(x, y, height(x, y)); };
    for (int j = 0; j <= kCells; ++j)
        for (int i = 0; i <= kCells; ++i) {
            const float x = 0.02f * float(i), y = 0.02f * float(j), h = 1e-3f;
            const glm::vec3 normal = glm::normalize(
                glm::cross(at(x + h, y) - at(x - h, y), at(x, y + h) - at(x, y - h)));
            mesh.vertices.push_back({at(x, y), normal});
        }
    for (int j = 0; j < kCells; ++j)
        for (int i = 0; i < kCells; ++i) {
            const auto first = std::uint32_t(j * (kCells + 1) + i);
            mesh.faces.push_back({first, first + 1, first + kCells + 2, first + kCells + 1});
        }
    mesh.firstFace = {0, std::uint32_t(mesh.faces.size())};
    return mesh;
}

std::size_t receiversOf(const DenseMesh& mesh) {
    return std::size_t(std::ranges::count(mesh.vertices, Role::receives, &DenseVertex::role));
}

TEST(ChooseReceivers, ChoosesThemAnElementApartInsideOfWhatIsFlat) {
    DenseMesh mesh = plate([](float, float) { return 0.0f; });
    chooseReceivers(mesh, kElement);
    std::size_t inside = 0;
    for (const DenseVertex& vertex : mesh.vertices) {
        const glm::vec2 p(vertex.position);
        const bool border = std::min({p.x, p.y, 1 - p.x, 1 - p.y}) < 0.005f;
        EXPECT_EQ(vertex.flat, !border);
        if (border) EXPECT_EQ(vertex.role, Role::receives);
        if (!border && vertex.role == Role::receives) ++inside;
    }
    EXPECT_GT(inside, 60u);
    EXPECT_LT(inside, 200u);
}

TEST(ChooseReceivers, ChoosesThemNearerToEachOtherBesideWhatRises) {
    const auto ridge = [](float x, float) { return x > 0.5f ? 0.02f : 0.0f; };
    DenseMesh mesh = plate(ridge);
    chooseReceivers(mesh, kElement);
    for (const DenseVertex& vertex : mesh.vertices) {
        const float x = vertex.position.x, y = vertex.position.y;
        if (std::min(y, 1 - y) < 0.005f) continue;
        if (x > 0.47f && x < 0.49f) { // its foot
            EXPECT_FALSE(vertex.flat) << x;
            EXPECT_EQ(vertex.role, Role::receives) << x;
        }
        if (x > 0.55f && x < 0.95f) EXPECT_TRUE(vertex.flat) << x; // what is on top of it
    }
}

TEST(ChooseReceivers, LeavesOpenOnlyWhatOneStandsFor) {
    DenseMesh mesh = plate([](float x, float y) {
        return 0.01f * std::sin(20 * x) * std::sin(30 * y) + (y > 0.7f ? 0.03f : 0.0f);
    });
    chooseReceivers(mesh, kElement);
    EXPECT_LT(receiversOf(mesh), mesh.vertices.size() / 2);
    for (const DenseVertex& vertex : mesh.vertices) {
        if (vertex.role != Role::open) continue;
        EXPECT_TRUE(std::ranges::any_of(mesh.vertices, [&](const DenseVertex& other) {
            return other.role == Role::receives && (other.flat || !vertex.flat) &&
                   glm::distance(other.position, vertex.position) < kElement &&
                   isAlongside(vertex, other, 0.94f, 0.2f);
        }));
    }
}

TEST(ChooseReceivers, TakesThoseThatReceiveAnywayButForLoneOnes) {
    DenseMesh lone = plate([](float, float) { return 0.0f; });
    DenseMesh given = lone;
    for (DenseVertex& vertex : lone.vertices) vertex.role = Role::alone;
    lone.vertices[25 * (kCells + 1) + 25].role = Role::open;
    for (DenseVertex& vertex : given.vertices) vertex.role = Role::receives;
    given.vertices[25 * (kCells + 1) + 25].role = Role::open;
    chooseReceivers(lone, kElement);
    chooseReceivers(given, kElement);
    EXPECT_EQ(lone.vertices[25 * (kCells + 1) + 25].role, Role::receives);
    EXPECT_EQ(given.vertices[25 * (kCells + 1) + 25].role, Role::open);
}

TEST(ChooseReceivers, ChoosesAsManyHoweverManyBallsTrianglesAre) {
    const auto on = [](int rings) {
        DenseMesh mesh;
        const int around = 2 * rings;
        for (int i = 0; i <= rings; ++i)
            for (int j = 0; j < around; ++j) {
                const float theta = 3.14159265f * float(i) / float(rings);
                const float phi = 6.2831853f * float(j) / float(around);
                const glm::vec3 n(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                  std::cos(theta));
                mesh.vertices.push_back({0.5f * n, n});
            }
        for (int i = 1; i + 1 < rings; ++i)
            for (int j = 0; j < around; ++j) {
                const auto at = [&](int a, int b) {
                    return std::uint32_t(a * around + b % around);
                };
                mesh.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
            }
        mesh.firstFace = {0, std::uint32_t(mesh.faces.size())};
        chooseReceivers(mesh, kElement);
        return double(receiversOf(mesh));
    };
    EXPECT_LT(on(160), 1.3 * on(40));
}

} // namespace

} // namespace penumbra
