// A dense mesh made by hand.
#pragma once

#include "tests/support/Scenes.h"

#include <cmath>
#include <numbers>

namespace penumbra {

/// A ball of about 4 rings^2 triangles around the origin.
inline MeshData ballData(int rings, float radius,
                         std::shared_ptr<Material> material = paint(Rgb(0.5f))) {
    MeshData mesh;
    const int around = 2 * rings;
    for (int i = 0; i <= rings; ++i)
        for (int j = 0; j < around; ++j) {
            const double theta = std::numbers::pi * i / rings, phi = std::numbers::pi * j / rings;
            mesh.points.emplace_back(double(radius) * glm::dvec3(std::sin(theta) * std::cos(phi),
                                                                 std::sin(theta) * std::sin(phi),
                                                                 std::cos(theta)));
        }
    const auto triangle = [&](int a, int b, int c) {
        mesh.faceVertexCounts.push_back(3);
        mesh.faceVertexIndices.insert(mesh.faceVertexIndices.end(), {a, b, c});
    };
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < around; ++j) {
            const int a = i * around, b = a + around, next = (j + 1) % around;
            if (i + 1 < rings) triangle(a + j, b + j, b + next);
            if (i > 0) triangle(a + j, b + next, a + next);
        }
    mesh.materials = {std::move(material)};
    return mesh;
}

} // namespace penumbra
