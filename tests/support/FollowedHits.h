// What rays meet while things move, followed in pieces.
#pragma once

#include "base/Parallel.h"
#include "tests/support/EditedScenes.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <string>

namespace penumbra {

/// Random edits of random rooms are taken in while earlier ones are still worked off: what is found
/// in the end is what new hits find, on any number of threads.
/// \param Hits made of a PatchSet and the rays through it, with apply(SceneChange)
/// \param work(hits) does a piece of work; false: there is none left
/// \param difference(set, a, b) what two know differently, or nothing
template <class Hits, class Work, class Difference>
void expectEditsInStepsEndAsNew(const Work& work, const Difference& difference) {
    const auto settle = [&](Hits& hits) {
        while (work(hits)) {
        }
    };
    for (std::uint32_t seed = 1; seed <= 12; ++seed) {
        EditableRoom room(seed);
        LitScene lit(placeScene(room.scene()), EditableRoom::meshing(), {.directOnly = true});
        auto hits = std::make_unique<Hits>(lit.patches(), lit.rays());
        if (seed % 2 == 0) settle(*hits); // else edits come before all is known
        std::mt19937 random(seed);
        std::string said;
        for (int edit = 0; edit < 12; ++edit) {
            said += room.edit();
            const LitScene::Followed followed = lit.follow(placeScene(room.scene()));
            if (followed.rebuilt || followed.added)
                hits = std::make_unique<Hits>(lit.patches(), lit.rays());
            else
                hits->apply(followed.change);
            for (std::uint32_t pieces = random() % 20; pieces > 0; --pieces) work(*hits);
        }
        settle(*hits);
        const ThreadLimit one(1); // of the new ones: any number gives the same
        Hits fresh(lit.patches(), lit.rays());
        settle(fresh);
        ASSERT_EQ(difference(lit.patches(), *hits, fresh), "") << "seed " << seed << ": " << said;
    }
}

} // namespace penumbra
