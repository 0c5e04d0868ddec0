// A light is let into a closed box, of which the inside is dark until then: the rays, beside those
// that it can't do without.
#include "bench/BenchCase.h"
#include "bench/BenchScene.h"
#include "bench/LeastRays.h"
#include "radiosity/transport/LitScene.h"
#include "scenegraph/Light.h"
#include "tests/support/Scenes.h"

#include <memory>
#include <stdexcept>

namespace penumbra {

namespace {

std::uint64_t raysOf(const Solver& solver) {
    return solver.statistics().direct.rays.total();
}

void letIn(benchmark::State& state) {
    SolverOptions options;
    options.directOnly = true;
    for (auto _ : state) {
        const LoadedScene loaded = loadScene("office-seat");
        const glm::dmat4 place = moved(1.2, 1.2, 0.9);
        const auto box =
            objectOf("box", {std::make_shared<Mesh>("mesh", boxData({-0.3f, -0.3f, -0.3f},
                                                                    {0.3f, 0.3f, 0.3f}, false))});
        const auto light =
            objectOf("bulb", {std::make_shared<Light>("light", SphereShape{0.03f}, Rgb(20000))});
        box->setMatrix(place);
        light->setMatrix(moved(0, 0, 0.6) * place);
        loaded.scene->root->add(box);
        loaded.scene->root->add(light);
        LitScene lit(placeScene(*loaded.scene), meshingOf(loaded.asked, 0), options);
        lit.solver().settle();
        Solver before(lit.patches(), lit.rays(), options); // keeps the rows as they are now
        before.settle();
        const std::uint64_t first = raysOf(lit.solver());
        light->setMatrix(place);
        const Stopwatch watch;
        const LitScene::Followed followed = lit.follow(placeScene(*loaded.scene));
        if (followed.rebuilt || !followed.added) throw std::runtime_error("the box was not remade");
        lit.solver().settle();
        const double cpu = watch.cpu();
        const auto rays = double(raysOf(lit.solver()) - first);
        const LeastRays least =
            leastRays(lit.patches(), lit.rays(), options.samples, followed.change,
                      before.emitterRows(), lit.solver().emitterRows());
        report(state, {{"update_rays", rays},
                       {"update_cpu_s", cpu},
                       {"least_rays", double(least.total())},
                       {"rays_over_minimum", rays / double(least.total())},
                       {"ray_ratio", double(first) / rays}});
        state.SetIterationTime(cpu);
    }
}

const bool registered = [] {
    addCase("edit/let-in/office", benchmark::kMillisecond, letIn);
    return true;
}();

} // namespace

} // namespace penumbra
