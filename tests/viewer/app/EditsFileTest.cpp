// Edits are saved as a layer, and people are asked before they are lost.
#include "viewer/app/EditsFile.h"

#include "base/Error.h"
#include "scenegraph/Find.h"
#include "scenegraph/Mesh.h"
#include "scenegraph/Objects.h"
#include "tests/support/TemporaryFolder.h"
#include "viewer/input/LeaveQuestion.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace penumbra {

namespace {

using Answer = LeaveQuestion::Answer;

const Departure kOther{Departure::To::another, "other.usda"};
const Departure kAgain{Departure::To::itselfAgain};
const Departure kEnd{Departure::To::nothing};

TEST(LeaveQuestion, IsNotAskedWhereNothingWouldBeLost) {
    for (const Departure& next : {kOther, kAgain, kEnd}) {
        LeaveQuestion question;
        EXPECT_TRUE(question.ask(next, false));
        EXPECT_FALSE(question.next());
    }
}

TEST(LeaveQuestion, GoesOnceTheEditsAreSavedOrDiscarded) {
    for (const Departure& next : {kOther, kAgain, kEnd})
        for (const auto& [answer, saves, goes] :
             {std::tuple{Answer::save, true, true}, std::tuple{Answer::save, false, false},
              std::tuple{Answer::discard, true, true}, std::tuple{Answer::cancel, true, false}}) {
            LeaveQuestion question;
            EXPECT_FALSE(question.ask(next, true));
            EXPECT_EQ(question.next(), next);
            int saved = 0;
            const auto to = question.answer(answer, [&, could = saves] {
                ++saved;
                return could;
            });
            EXPECT_EQ(to, goes ? std::optional(next) : std::nullopt);
            EXPECT_EQ(saved, answer == Answer::save);
            EXPECT_FALSE(question.next()) << "it is asked once";
        }
}

TEST(LeaveQuestion, WhoAsksForTheEndTwiceMeansIt) {
    LeaveQuestion question;
    EXPECT_FALSE(question.ask(kEnd, true));
    EXPECT_TRUE(question.ask(kEnd, true));
    EXPECT_FALSE(question.ask(kAgain, true));
    EXPECT_FALSE(question.ask(kEnd, true)) << "it was another question";
}

class EditsFile : public testing::Test {
protected:
    EditsFile() {
        folder.write("room.usda", R"(#usda 1.0
(
    metersPerUnit = 1
    startTimeCode = 3
    endTimeCode = 7
)
def Cube "Seat"
{
    color3f[] primvars:displayColor = [(0.5, 0.1, 0.1)]
    double3 xformOp:translate = (1, 2, 3)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Cube "Flag"
{
    token visibility.timeSamples = { 3: "inherited", 7: "invisible" }
}
def SphereLight "Lamp"
{
    float inputs:intensity = 100
}
)");
        file = folder.file("room.usda");
        scene = loadUsdScene(file);
    }
    std::shared_ptr<Transform> seat() const {
        for (const auto& address : scene.addresses.transforms)
            if (address.prim == "/Seat") return address.node;
        return nullptr;
    }
    LoadedScene saved() {
        const std::filesystem::path layer = folder.file("room-edited.usda");
        EXPECT_TRUE(saveEdits(scene, file, history, layer).empty());
        return loadUsdScene(layer);
    }

    TemporaryFolder folder;
    std::filesystem::path file;
    LoadedScene scene;
    EditHistory history;
};

TEST_F(EditsFile, HasWhatWasMovedDimmedAndRepainted) {
    const auto node = seat();
    ASSERT_TRUE(node);
    const glm::dmat4 before = node->matrix(), after = glm::translate(before, {0.5, 0, 0});
    history.make({MoveEdit{node, before, after}}, 0);
    const auto light = scene.addresses.lights.at(0).light;
    history.make({LightEdit{light, light->luminance(), Rgb(20)}}, 10);
    EXPECT_TRUE(history.edited());
    const LoadedScene again = saved();
    EXPECT_EQ(node->matrix(), after) << "it is as it was";
    EXPECT_EQ(again.addresses.lights.at(0).light->luminance(), Rgb(20));
    const PlacedScene then = placeScene(*again.scene), now = placeScene(*scene.scene);
    ASSERT_EQ(then.meshes.size(), now.meshes.size());
    for (std::size_t i = 0; i < now.meshes.size(); ++i)
        EXPECT_EQ(then.meshes[i].toWorld, now.meshes[i].toWorld);
}

TEST_F(EditsFile, LeavesTheAnimationAsItIs) {
    const auto light = scene.addresses.lights.at(0).light;
    history.make({LightEdit{light, light->luminance(), Rgb(20)}}, 0);
    const LoadedScene again = saved();
    EXPECT_EQ(again.scene->startTimeCode, 3);
    EXPECT_EQ(again.scene->endTimeCode, 7);
    ASSERT_TRUE(again.animation);
    const auto shown = [&](double time) {
        again.animation->setTime(time);
        const PlacedScene placed = placeScene(*again.scene);
        std::size_t visible = 0;
        for (const auto& mesh : placed.meshes) visible += placed.objects[mesh.object.value].visible;
        return visible;
    };
    EXPECT_EQ(shown(3), shown(7) + 1);
}

TEST_F(EditsFile, IsNotNeededForWhatWasTakenBack) {
    const auto node = seat();
    history.make({MoveEdit{node, node->matrix(), glm::translate(node->matrix(), {1, 0, 0})}}, 0);
    EXPECT_TRUE(history.edited());
    history.undo();
    EXPECT_FALSE(history.edited());
}

constexpr const char* kTray = R"(#usda 1.0
(
    metersPerUnit = 1
)
def Cube "Floor"
{
    double size = 9
}
def Xform "Tray"
{
    def Cube "Cup"
    {
        double size = 0.1
        double3 xformOp:translate = (0, 0, 6)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def Cube "Other"
    {
        double size = 0.1
        double3 xformOp:translate = (0.3, 0, 6)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
}
def Xform "Lamp"
{
    def Cube "Foot"
    {
        double size = 0.2
        double3 xformOp:translate = (2, 0, 6)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def Xform "Shade"
    {
        bool penumbra:movable = 1
        def Cube "Cone"
        {
            double size = 0.2
            double3 xformOp:translate = (2, 0, 6.2)
            uniform token[] xformOpOrder = ["xformOp:translate"]
        }
    }
    def Cube "Bulb"
    {
        double size = 0.1
        double3 xformOp:translate = (2, 0, 6.15)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
}
)";

std::vector<std::string> objectsOf(const Scene& scene) {
    std::vector<std::string> paths;
    for (const Object& object : placeScene(scene).objects) paths.push_back(object.path);
    return paths;
}

TEST_F(EditsFile, HasTheSameObjectsWhereverThingsTouchNow) {
    folder.write("room.usda", kTray);
    scene = loadUsdScene(file);
    const std::vector<std::string> before{"/Floor", "/Tray/Cup", "/Tray/Other", "/Lamp",
                                          "/Lamp/Shade"};
    ASSERT_EQ(objectsOf(*scene.scene), before);
    for (const auto& [path, shift] : {std::pair("/Tray/Cup", 0.2), std::pair("/Lamp/Shade", 1.0)}) {
        const auto node = findAt<Transform>(*scene.scene->root, path);
        history.make({MoveEdit{node, node->matrix(),
                               glm::translate(glm::dmat4(1.0), {shift, 0, 0}) * node->matrix()}},
                     0);
    }
    EXPECT_EQ(objectsOf(*saved().scene), before) << "two cups in touch, a foot without its shade";
}

TEST_F(EditsFile, ThatCanNotBeWrittenIsAnErrorAndChangesNothing) {
    const auto node = seat();
    const glm::dmat4 after = glm::translate(node->matrix(), {0.5, 0, 0});
    history.make({MoveEdit{node, node->matrix(), after}}, 0);
    EXPECT_THROW(saveEdits(scene, file, history, folder.path() / "none" / "a.usda"), Error);
    EXPECT_EQ(node->matrix(), after);
}

TEST_F(EditsFile, TakesANameThatIsFree) {
    const std::string name = folder.file("room");
    EXPECT_EQ(freeEditsName(name), name + "-edited.usda");
    folder.write("room-edited.usda", "");
    EXPECT_EQ(freeEditsName(name), name + "-edited-2.usda");
}

} // namespace

} // namespace penumbra
