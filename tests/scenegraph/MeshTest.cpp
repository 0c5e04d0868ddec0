#include "scenegraph/Mesh.h"

#include "SceneParts.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

TEST(Mesh, BoundsHoldAllPoints) {
    const auto mesh = polygon("wedge", {{0, 0, -1}, {3, 0, 0}, {0, 2, 5}});
    EXPECT_EQ(mesh->bounds().lower, glm::vec3(0, 0, -1));
    EXPECT_EQ(mesh->bounds().upper, glm::vec3(3, 2, 5));
}

TEST(Mesh, FacesHaveTheirOwnMaterialOrTheFirst) {
    MeshData data = square("floor")->data();
    data.materials = {std::make_shared<Material>("oak"), std::make_shared<Material>("tile")};
    EXPECT_EQ(Mesh("floor", data).materialOf(0)->name(), "oak");
    data.faceMaterial = {1};
    EXPECT_EQ(Mesh("floor", data).materialOf(0)->name(), "tile");
}

} // namespace

} // namespace penumbra
