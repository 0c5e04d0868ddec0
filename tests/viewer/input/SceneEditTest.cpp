// Edits, and the way back.
#include "viewer/input/SceneEdit.h"

#include "tests/scenegraph/SceneParts.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace penumbra {

namespace {

struct Things {
    std::shared_ptr<Transform> seat = objectOf("seat", {});
    std::shared_ptr<Light> source = light("lamp");
    std::shared_ptr<Material> paint = std::make_shared<Material>("paint");

    std::vector<double> state() const {
        return {seat->matrix()[3][0], source->luminance().r, paint->reflectance().g,
                paint->emission().b};
    }
    MoveEdit moveTo(double x) const {
        return {seat, seat->matrix(), glm::translate(glm::dmat4(1.0), {x, 0, 0})};
    }
    LightEdit dimTo(float nits) const { return {source, source->luminance(), Rgb(nits)}; }
    PaintEdit paintIn(Rgb colour) const {
        return {paint, {paint->reflectance(), paint->emission()}, {colour, {}}};
    }
};

TEST(SceneEdit, IsMadeAndTakenBackAndChangesNothingThatIsSoAlready) {
    const Things things;
    const auto before = things.state();
    const std::vector<SceneEdit> edits{
        things.moveTo(3), things.dimTo(7),
        PaintEdit{things.paint, {things.paint->reflectance(), {}}, {Rgb(0.9f), Rgb(4)}}};
    for (const SceneEdit& edit : edits) {
        apply(edit);
        EXPECT_TRUE(changes(edit));
    }
    EXPECT_EQ(things.state(), (std::vector<double>{3, 7, double(0.9f), 4}));
    const auto revision = things.source->revision();
    apply(edits[1]);
    EXPECT_EQ(things.source->revision(), revision) << "radiosity is not asked for nothing";
    for (const SceneEdit& edit : edits) takeBack(edit);
    EXPECT_EQ(things.state(), before);
    EXPECT_FALSE(changes(things.dimTo(things.source->luminance().r)));
}

RC_GTEST_PROP(EditHistory, UndoingEverythingComesBackToTheStartAndRedoingToTheEnd, ()) {
    const Things things;
    EditHistory history;
    const auto start = things.state();
    std::vector<std::vector<double>> states{start};
    const int steps = *rc::gen::inRange(1, 12);
    double time = 0;
    for (int i = 0; i < steps; ++i) {
        time += 10; // too late to be merged
        const int value = *rc::gen::inRange(1, 9);
        switch (*rc::gen::inRange(0, 4)) {
        case 0:
            history.make({things.moveTo(value)}, time);
            break;
        case 1:
            history.make({things.dimTo(float(value)), things.moveTo(-value)}, time);
            break;
        case 2:
            history.make({things.paintIn(Rgb(0.1f * float(value)))}, time);
            break;
        default:
            if (history.undo()) states.pop_back();
            continue;
        }
        if (things.state() != states.back()) states.push_back(things.state());
    }
    RC_ASSERT(history.undoable() == states.size() - 1);
    const auto end = things.state();
    const std::size_t count = history.undoable();
    while (history.undo())
        ;
    RC_ASSERT(things.state() == start);
    for (std::size_t i = 0; i < count; ++i) history.redo();
    RC_ASSERT(things.state() == end);
}

TEST(EditHistory, AHeldKeyIsTakenBackAtOnceButNotWhatCameLater) {
    const Things things;
    EditHistory history;
    for (int i = 1; i <= 5; ++i) history.make({things.moveTo(i)}, 0.1 * i);
    history.make({things.moveTo(9)}, 3);
    EXPECT_EQ(history.undoable(), 2u);
    history.undo();
    EXPECT_EQ(things.seat->matrix()[3][0], 5);
    history.undo();
    EXPECT_EQ(things.seat->matrix()[3][0], 0);
}

TEST(EditHistory, OtherThingsAndDragsStandAlone) {
    const Things things;
    EditHistory history;
    history.make({things.moveTo(1)}, 0);
    history.make({things.dimTo(5)}, 0.1);
    history.make({things.moveTo(2)}, 0.2);
    EXPECT_EQ(history.undoable(), 3u);
    const MoveEdit drag = things.moveTo(3);
    apply(drag);
    history.note({drag});
    history.make({things.moveTo(4)}, 0.3);
    EXPECT_EQ(history.undoable(), 5u);
}

TEST(EditHistory, ANewEditForgetsWhatWasTakenBack) {
    const Things things;
    EditHistory history;
    history.make({things.moveTo(1)}, 0);
    history.undo();
    EXPECT_EQ(history.redoable(), 1u);
    history.make({things.dimTo(3)}, 1);
    EXPECT_FALSE(history.redo());
    EXPECT_EQ(things.seat->matrix()[3][0], 0);
}

} // namespace

} // namespace penumbra
