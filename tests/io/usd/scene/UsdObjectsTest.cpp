// Which prims become one thing that people pick up.
#include "tests/io/usd/UsdTestFiles.h"

#include "scenegraph/Objects.h"

#include <gmock/gmock.h>

namespace penumbra {

namespace {

using testing::ElementsAre;

std::vector<std::string> objectsOf(const std::string& prims) {
    std::vector<std::string> paths;
    const LoadedScene loaded = loadText("(metersPerUnit = 1)\n" + prims);
    for (const Object& object : placeScene(*loaded.scene).objects) paths.push_back(object.path);
    return paths;
}

/// A cube of that edge at x. \param placed by a transform of its own, rather than by its parent's
std::string cube(const std::string& name, double edge, double x = 0) {
    return "def Cube \"" + name + "\"\n{\n double size = " + std::to_string(edge) +
           "\n double3 xformOp:translate = (" + std::to_string(x) +
           ", 0, 0)\n uniform token[] xformOpOrder = [\"xformOp:translate\"]\n}\n";
}
std::string cubeInPlace(const std::string& name, double edge) {
    return "def Cube \"" + name + "\"\n{\n double size = " + std::to_string(edge) + "\n}\n";
}
std::string xform(const std::string& name, const std::string& content,
                  const std::string& kind = "") {
    return "def Xform \"" + name + "\"" + (kind.empty() ? "" : " (kind = \"" + kind + "\")") +
           "\n{\n" + content + "}\n";
}

TEST(UsdObjects, EveryShapeWithATransformIsOne) {
    EXPECT_THAT(objectsOf(cube("a", 1) + cube("b", 1, 5)), ElementsAre("/a", "/b"));
    EXPECT_THAT(objectsOf(xform("World", cube("a", 1) + cube("b", 1, 5))),
                ElementsAre("/World/a", "/World/b"));
}

TEST(UsdObjects, AShapeOfAFileIsOneEvenWithoutATransform) {
    EXPECT_THAT(
        objectsOf("def Scope \"S\"\n{\n" + cubeInPlace("a", 1) + cubeInPlace("b", 2) + "}\n"),
        ElementsAre("/S/a", "/S/b"));
}

TEST(UsdObjects, SmallPartsThatTouchAreOneThing) {
    const std::string table = xform("Table", cube("leg", 0.5) + cube("top", 1, 0.7));
    EXPECT_THAT(objectsOf(table + cube("floor", 9)), ElementsAre("/Table", "/floor"));
}

TEST(UsdObjects, PartsOfOneThingAreFoundHoweverDeepTheyAre) {
    const auto seat = [](const std::string& name, double x) {
        return xform(name, cube("leg", 0.5, x) + xform("Back", cube("rail", 0.5, x + 0.4)));
    };
    EXPECT_THAT(objectsOf(seat("Seat1", 0) + seat("Seat2", 20) + seat("Seat3", 40)),
                ElementsAre("/Seat1", "/Seat2", "/Seat3"));
}

TEST(UsdObjects, PartsThatDoNotTouchAreThingsOfTheirOwn) {
    const std::string cups = xform("Cups", cube("one", 0.1) + cube("two", 0.1, 0.3));
    EXPECT_THAT(objectsOf(cups + cube("floor", 9)),
                ElementsAre("/Cups/one", "/Cups/two", "/floor"));
}

TEST(UsdObjects, WhatNobodyCouldCarryIsTakenApart) {
    const std::string room = xform("Room", cube("floor", 6) + cube("sofa", 2, 3));
    EXPECT_THAT(objectsOf(room + cube("sun", 1, 90)),
                ElementsAre("/Room/floor", "/Room/sofa", "/sun"));
}

TEST(UsdObjects, AFewShapesInOnePlaceAreOneHoweverLarge) {
    const std::string walls = xform("Walls", cubeInPlace("a", 8) + cubeInPlace("b", 9));
    EXPECT_THAT(objectsOf(walls + cube("c", 1)), ElementsAre("/Walls", "/c"));
}

TEST(UsdObjects, APileOfShapesIsTakenApart) {
    std::string pile;
    for (int i = 0; i < 17; ++i) pile += cubeInPlace("c" + std::to_string(i), 3 + i);
    EXPECT_EQ(objectsOf(xform("Geometry", pile)).size(), 17u);
}

TEST(UsdObjects, ALightBesideItDoesNotMakeARoomOneThing) {
    const std::string light = "def SphereLight \"Lamp\"\n{\n}\n";
    EXPECT_THAT(objectsOf(xform("File", cube("a", 1) + cube("b", 1, 1), "component") + light),
                ElementsAre("/File/a", "/File/b", "/Lamp"));
    EXPECT_THAT(objectsOf(xform("File", cube("a", 1) + cube("b", 1, 1)) + light),
                ElementsAre("/File/a", "/File/b", "/Lamp"));
}

TEST(UsdObjects, ARoomThatOthersStandInIsNoThingWhateverItsKind) {
    const std::string room = xform("Room", cube("walls", 6) + cube("desk", 1, 1), "component");
    EXPECT_THAT(objectsOf(room + cube("seat", 0.5, 2)),
                ElementsAre("/Room/walls", "/Room/desk", "/seat"));
    EXPECT_THAT(objectsOf(room + cube("shed", 3, 40)), ElementsAre("/Room", "/shed"));
    std::string many = cube("walls", 6);
    for (int i = 0; i < 64; ++i) many += cube("c" + std::to_string(i), 0.1);
    EXPECT_EQ(objectsOf(xform("Room", many, "component") + cube("shed", 3, 40)).size(), 66u);
}

TEST(UsdObjects, AModelOfModelsIsOneIfItCanBeCarried) {
    const auto both = [](double x) {
        return xform("Seat",
                     xform("A", cube("a", 0.5), "component") +
                         xform("B", cube("b", 0.5, x), "component"),
                     "component");
    };
    EXPECT_THAT(objectsOf(both(1) + cube("floor", 9, 40)), ElementsAre("/Seat", "/floor"));
    EXPECT_THAT(objectsOf(both(5) + cube("floor", 9, 40)),
                ElementsAre("/Seat/A", "/Seat/B", "/floor"));
}

TEST(UsdObjects, TheSmallestModelIsOneWhateverItHolds) {
    const std::string seats = xform("Seat1", cube("leg", 1) + cube("far", 1, 40), "component") +
                              xform("Seat2", cube("leg", 1, -5), "component");
    EXPECT_THAT(objectsOf(xform("Hall", seats, "component")),
                ElementsAre("/Hall/Seat1", "/Hall/Seat2"));
}

TEST(UsdObjects, AModelThatHoldsAllOfTheSceneIsNone) {
    EXPECT_THAT(objectsOf(xform("File", cube("a", 1) + cube("b", 1, 5), "component")),
                ElementsAre("/File/a", "/File/b"));
}

TEST(UsdObjects, WhatTheFileMarksIsOneWithinAnother) {
    const std::string drawer =
        "def Xform \"Drawer\"\n{\n bool penumbra:movable = 1\n" + cube("front", 0.3) + "}\n";
    EXPECT_THAT(objectsOf(xform("Desk", cube("top", 1) + drawer) + cube("floor", 9)),
                ElementsAre("/Desk", "/Desk/Drawer", "/floor"));
}

TEST(UsdObjects, WhatTheFileSaysIsNotOneIsTakenApart) {
    const std::string desk = "def Xform \"Desk\"\n{\n bool penumbra:movable = 0\n" +
                             cube("top", 1) + cube("lamp", 0.5) + "}\n";
    EXPECT_THAT(objectsOf(desk + cube("floor", 9)),
                ElementsAre("/Desk/top", "/Desk/lamp", "/floor"));
}

} // namespace

} // namespace penumbra
