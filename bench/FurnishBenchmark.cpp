// What it costs to bring a thing into a lit room, to resize it and to take it out, beside moving
// it.
#include "bench/BenchCase.h"
#include "bench/BenchScene.h"
#include "radiosity/transport/LitScene.h"
#include "scenegraph/Find.h"
#include "scenegraph/Transform.h"

#include <glm/gtc/matrix_transform.hpp>

#include <memory>
#include <stdexcept>
#include <string>

namespace penumbra {

namespace {

struct Cost {
    double rays = 0, cpu = 0, follow = 0; ///< processor time [s], of it until work can begin
};

/// A lit scene of which every edit is followed until it is exact.
class Furnished {
public:
    Furnished(const char* layer, const SolverOptions& options)
        : loaded_(loadScene(layer)),
          lit_(placeScene(scene()), meshingOf(loaded_.asked, 0), options) {
        const Stopwatch watch;
        lit_.solver().settle();
        first_ = {double(lit_.solver().done().rays), watch.cpu(), 0};
    }

    const Scene& scene() const { return *loaded_.scene; }
    const Cost& first() const { return first_; }
    Cost follow() {
        const Stopwatch watch;
        const std::uint64_t before = lit_.solver().done().rays;
        const bool rebuilt = lit_.follow(placeScene(scene())).rebuilt;
        const double followed = watch.cpu();
        lit_.solver().settle();
        return {double(lit_.solver().done().rays - (rebuilt ? 0 : before)), watch.cpu(), followed};
    }

private:
    LoadedScene loaded_;
    LitScene lit_;
    Cost first_;
};

void furnish(benchmark::State& state, const char* layer, const char* path,
             const SolverOptions& options) {
    for (auto _ : state) {
        Furnished room(layer, options);
        const auto thing = findAt<Transform>(*room.scene().root, path);
        if (!thing) throw std::runtime_error(std::string("no ") + path);
        const auto aside = [](double metres) {
            return glm::translate(glm::dmat4(1.0), glm::dvec3(metres, 0, 0));
        };
        const glm::dmat4 home = thing->matrix();
        thing->setMatrix(aside(0.4) * home);
        const Cost move = room.follow();
        const auto another = std::make_shared<Transform>("another");
        for (const NodePtr& child : thing->children()) another->add(child);
        another->setBeginsObject(true);
        another->setMatrix(aside(-0.4) * home);
        room.scene().root->add(another);
        const Cost add = room.follow();
        another->setMatrix(another->matrix() * glm::scale(glm::dmat4(1.0), glm::dvec3(1.1)));
        const Cost resize = room.follow();
        room.scene().root->remove(another);
        const Cost remove = room.follow();
        report(state, {{"first_rays", room.first().rays},
                       {"first_cpu_s", room.first().cpu},
                       {"move_rays", move.rays},
                       {"move_cpu_s", move.cpu},
                       {"add_rays", add.rays},
                       {"add_cpu_s", add.cpu},
                       {"add_follow_cpu_s", add.follow},
                       {"add_over_move_rays", add.rays / move.rays},
                       {"add_over_move_cpu", add.cpu / move.cpu},
                       {"first_over_add_cpu", room.first().cpu / add.cpu},
                       {"resize_over_move_rays", resize.rays / move.rays},
                       {"resize_over_move_cpu", resize.cpu / move.cpu},
                       {"remove_over_move_rays", remove.rays / move.rays},
                       {"remove_over_move_cpu", remove.cpu / move.cpu}});
        state.SetIterationTime(add.cpu);
    }
}

const bool registered = [] {
    SolverOptions direct, all, fine;
    direct.directOnly = true;
    all.detail = false;
    for (const auto& [name, options] :
         {std::pair("direct", direct), std::pair("total", all), std::pair("fine", fine)})
        addCase(std::string("furnish/office/seat/") + name, benchmark::kMillisecond, furnish,
                "office-seat", "/World/Seat", options);
    return true;
}();

} // namespace

} // namespace penumbra
