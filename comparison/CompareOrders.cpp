#include "comparison/CompareOrders.h"

#include "importance/Viewpoint.h"
#include "radiosity/DrawnView.h"
#include "radiosity/LitScene.h"

#include <algorithm>
#include <chrono>
#include <memory>

namespace penumbra {

namespace {

double now() {
    using namespace std::chrono;
    return duration<double>(steady_clock::now().time_since_epoch()).count();
}

/// What the settled light of each edit looks like.
using Truths = std::vector<Plane>;

/// A scene that is played under one order.
class Player {
public:
    Player(const Playback& playback, const SolverOptions& solving, const ComparisonOptions& options)
        : playback_(playback), options_(options), placed_(playback.show(playback.frames.front())),
          lit_(placed_, options.meshing, solving) {
        lit_.solver().settle();
    }

    /// Goes to a frame, without any work on its light.
    void edit(double frame) {
        placed_ = playback_.show(frame);
        lit_.follow(placed_);
        view_ = playback_.view(placed_);
        drawn_ =
            std::make_unique<DrawnView>(lit_.patches(), view_, options_.width, options_.height);
    }
    LitScene& lit() { return lit_; }
    const DrawnView& drawn() const { return *drawn_; }
    double pixelsPerDegree() const {
        return Viewpoint(view_, options_.width, options_.height).pixelsPerDegree();
    }
    Picture picture() const {
        return {options_.width, options_.height, drawn_->colours(lit_.solver().lighting())};
    }
    Plane luminances() const { return drawn_->luminances(lit_.solver().lighting()); }

private:
    const Playback& playback_;
    const ComparisonOptions& options_;
    PlacedScene placed_;
    LitScene lit_;
    View view_;
    std::unique_ptr<DrawnView> drawn_;
};

/// One edit, worked off and looked at every now and then.
class Watch {
public:
    Watch(Player& player, const Plane& truth, const ComparisonOptions& options, OrderResult& result,
          bool film)
        : player_(player), truth_(truth), options_(options), result_(result), film_(film),
          before_(player.lit().solver().done()) {
        result_.frames.emplace_back();
    }

    void run() {
        look();
        Solver& solver = player_.lit().solver();
        bool more = true;
        for (double next = options_.firstLook; more;
             next = std::max(next, work()) * options_.growth) {
            const double start = now();
            while (more && work() < next)
                more = solver.work(std::size_t(std::clamp((next - work()) / 8, 512.0, 65536.0)));
            solver.sumUp();
            seconds_ += now() - start;
            look();
        }
        result_.work.push_back(work());
        result_.seconds.push_back(seconds_);
        result_.differsFromTruth =
            std::max(result_.differsFromTruth, result_.frames.back().back().error.most);
    }

private:
    /// Since the edit.
    double work() const { return player_.lit().solver().done().inRays() - before_.inRays(); }

    void look() {
        const Plane jnd =
            visibleDifference(player_.luminances(), truth_, player_.pixelsPerDegree());
        const WorkDone done = player_.lit().solver().done();
        const ErrorSample sample{work(), seconds_, done.rays - before_.rays,
                                 done.shots - before_.shots, summarise(jnd)};
        result_.frames.back().push_back(sample);
        const std::size_t before = filmed_;
        while (film_ && filmed_ < options_.filmSeconds.size() &&
               seconds_ >= options_.filmSeconds[filmed_])
            ++filmed_;
        if (filmed_ > before)
            result_.film.push_back({seconds_, work(), player_.picture(), jnd, sample.error});
    }

    Player& player_;
    const Plane& truth_;
    const ComparisonOptions& options_;
    OrderResult& result_;
    bool film_;
    WorkDone before_;
    double seconds_ = 0;
    std::size_t filmed_ = 0;
};

/// Settles every frame, to know what is to come out.
Truths findTruths(const Playback& playback, const SolverOptions& solving,
                  const ComparisonOptions& options, ComparisonResult& result,
                  const Progress& progress) {
    Truths truths;
    Player player(playback, solving, options);
    for (std::size_t i = 1; i < playback.frames.size(); ++i) {
        if (progress) progress("the settled light", double(i) / double(playback.frames.size()));
        player.edit(playback.frames[i]);
        player.lit().solver().settle();
        truths.push_back(player.luminances());
        result.frames.push_back(playback.frames[i]);
        if (int(i) - 1 != options.filmFrame) continue;
        result.truth = player.picture();
        result.pixelsPerDegree = player.pixelsPerDegree();
    }
    const PatchSet& patches = player.lit().patches();
    result.elements = patches.elements.size();
    result.patches = patches.patches.size();
    result.lamps = patches.emitters.size();
    return truths;
}

} // namespace

ComparisonResult compareOrders(const Playback& playback, const std::vector<OrderUnderTest>& orders,
                               const ComparisonOptions& options, const Progress& progress) {
    ComparisonResult result;
    result.filmFrame = options.filmFrame;
    const Truths truths = findTruths(playback, orders.front().options, options, result, progress);
    for (const OrderUnderTest& order : orders) {
        OrderResult& one = result.orders.emplace_back();
        one.name = order.name;
        Player player(playback, order.options, options);
        for (std::size_t i = 1; i < playback.frames.size(); ++i) {
            if (progress) progress(order.name.c_str(), double(i) / double(playback.frames.size()));
            player.edit(playback.frames[i]);
            Watch(player, truths[i - 1], options, one, int(i) - 1 == options.filmFrame).run();
        }
    }
    return result;
}

} // namespace penumbra
