#include "scenegraph/Material.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

TEST(Material, ReflectanceStaysBelowOneSoThatLightSettles) {
    Material paint("paint");
    paint.setReflectance({1, -0.5f, 0.3f});
    EXPECT_EQ(paint.reflectance(), Rgb(Material::kMaxReflectance, 0, 0.3f));
    EXPECT_LT(Material::kMaxReflectance, 1);
}

TEST(Material, OneLitChannelMakesItEmissive) {
    Material paint("paint");
    EXPECT_FALSE(paint.emissive());
    paint.setEmission({0, 0, 2});
    EXPECT_TRUE(paint.emissive());
}

TEST(Material, EveryEditRaisesTheRevision) {
    Material paint("paint");
    const auto before = paint.revision();
    paint.setReflectance(Rgb(0.2f));
    const auto repainted = paint.revision();
    EXPECT_GT(repainted, before);
    paint.setEmission(Rgb(5));
    EXPECT_GT(paint.revision(), repainted);
}

} // namespace

} // namespace penumbra
