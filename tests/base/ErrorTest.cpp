#include "base/Error.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

TEST(Error, ASceneFileErrorSaysWhereAndWhat) {
    const SceneFileError error({"lamp.usda", 14, 9}, "unknown attribute 'radience'");
    EXPECT_STREQ(error.what(), "lamp.usda:14:9: error: unknown attribute 'radience'");
    EXPECT_EQ(error.where().line, 14u);
}

TEST(Error, ALocationSaysOnlyWhatIsKnown) {
    EXPECT_EQ((SourceLocation{"lamp.usda", 14, 0}.text()), "lamp.usda:14");
    EXPECT_EQ((SourceLocation{"lamp.usda", 0, 0}.text()), "lamp.usda");
}

TEST(Error, EveryErrorOfTheOutsideWorldIsOneFamily) {
    EXPECT_THROW(throw SceneFileError({"lamp.usda"}, "no such file"), Error);
}

} // namespace

} // namespace penumbra
