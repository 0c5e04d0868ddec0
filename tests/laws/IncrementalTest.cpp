// After any sequence of edits the settled light is that of the scene as it stands, however it came
// to be.
#include "tests/support/EditedScenes.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace penumbra {

namespace {

const SolverOptions kTight{.residual = 1e-5};

std::unique_ptr<LitScene> fromScratch(const Scene& scene, const LitScene& like) {
    auto lit = std::make_unique<LitScene>(placeScene(scene), sizesOf(like.patches()), kTight);
    lit->solver().settle();
    return lit;
}

RC_GTEST_PROP(Incremental, EqualsFromScratchAfterAnyEdits, ()) {
    const auto seed = *rc::gen::arbitrary<std::uint32_t>();
    const int edits = *rc::gen::inRange(1, 31);
    EditableRoom room(seed);
    LitScene lit(placeScene(room.scene()), EditableRoom::meshing(), kTight);
    std::mt19937 random(seed);
    std::string said;
    for (int i = 0; i < edits; ++i) {
        said += room.edit();
        lit.follow(placeScene(room.scene()));
        // Settled, interrupted, or not begun when the next edit comes.
        if (random() % 3 == 0) lit.solver().settle();
        if (random() % 3 == 0) lit.solver().step(0.002);
    }
    lit.solver().settle();
    const auto scratch = fromScratch(room.scene(), lit);
    const std::string differs = difference(lit, *scratch);
    if (!differs.empty()) RC_FAIL("after " + said + "\n" + differs);
}

} // namespace

} // namespace penumbra
