#include "comparison/CompareOrders.h"

#include "comparison/OracleOrder.h"
#include "importance/Adaptation.h"
#include "importance/Viewpoint.h"
#include "radiosity/DrawnView.h"
#include "radiosity/LitScene.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>

namespace penumbra {

namespace {

double now() {
    using namespace std::chrono;
    return duration<double>(steady_clock::now().time_since_epoch()).count();
}

/// What is to come out of an edit.
struct Truth {
    Plane luminances;
    VertexFactors factors;
};
using Truths = std::vector<Truth>;

SolverOptions optionsFor(const OrderUnderTest& order, SolverOptions options) {
    const bool plain = order.kind == OrderUnderTest::Kind::plain;
    options.order = plain ? UpdateOrder::plain : UpdateOrder::bound;
    return options;
}

/// A scene that is played under one order.
class Player {
public:
    Player(const Playback& playback, const OrderUnderTest& order, const ComparisonOptions& options)
        : playback_(playback), order_(order), options_(options),
          placed_(playback.show(playback.frames.front())),
          lit_(placed_, options.meshing, optionsFor(order, options.solving)) {
        lit_.solver().settle();
        look();
    }

    /// Goes to a frame, without any work on its light.
    void edit(double frame) {
        placed_ = playback_.show(frame);
        const LitScene::Followed followed = lit_.follow(placed_);
        moved_.clear();
        if (!followed.rebuilt) moved_ = followed.change.objects;
        look();
    }

    /// Tells the solver in which order to go about it, as a viewer would at each frame. \param
    /// truth for the order that knows it
    void order(const Truth& truth) {
        using Kind = OrderUnderTest::Kind;
        Solver& solver = lit_.solver();
        if (order_.kind == Kind::random)
            solver.setOrder(std::make_shared<RandomOrder>(order_.seed));
        if (order_.kind == Kind::importance) solver.attend(attention());
        if (order_.kind == Kind::oracle)
            solver.setOrder(std::make_shared<OracleOrder>(lit_.patches(), solver.emitterRows(),
                                                          truth.factors, *drawn_, adaptation_));
    }

    LitScene& lit() { return lit_; }
    double pixelsPerDegree() const { return viewpoint().pixelsPerDegree(); }
    Picture picture() const {
        return {options_.width, options_.height, drawn_->colours(lit_.solver().lighting())};
    }
    Plane luminances() const { return drawn_->luminances(lit_.solver().lighting()); }

private:
    void look() {
        view_ = playback_.view(placed_);
        drawn_ =
            std::make_unique<DrawnView>(lit_.patches(), view_, options_.width, options_.height);
        adaptation_ = meanAdaptation(luminances().values);
    }
    Viewpoint viewpoint() const { return Viewpoint(view_, options_.width, options_.height); }
    Attention attention() const {
        std::optional<Bounds> moved;
        for (ObjectId object : moved_) {
            if (!moved) moved.emplace();
            moved->add(boundsOf(lit_.patches(), object));
        }
        GazeHints hints;
        if (moved) hints.dragged = glm::dvec3(moved->centre());
        const Viewpoint from = viewpoint();
        return {from, Gaze(from, hints), adaptation_, moved, order_.factors};
    }

    const Playback& playback_;
    const OrderUnderTest& order_;
    const ComparisonOptions& options_;
    PlacedScene placed_;
    LitScene lit_;
    std::vector<ObjectId> moved_;
    View view_;
    std::unique_ptr<DrawnView> drawn_;
    double adaptation_ = 100; ///< [nit]
};

/// One edit, worked off and looked at every now and then.
class Watch {
public:
    Watch(Player& player, const Truth& truth, const ComparisonOptions& options, OrderResult& result,
          bool film)
        : player_(player), truth_(truth), options_(options), result_(result), film_(film),
          before_(player.lit().solver().done()) {
        result_.frames.emplace_back();
    }

    void run() {
        look();
        Solver& solver = player_.lit().solver();
        const double begun = now();
        player_.order(truth_);
        seconds_ += now() - begun;
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
            visibleDifference(player_.luminances(), truth_.luminances, player_.pixelsPerDegree());
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
    const Truth& truth_;
    const ComparisonOptions& options_;
    OrderResult& result_;
    bool film_;
    WorkDone before_;
    double seconds_ = 0;
    std::size_t filmed_ = 0;
};

/// Settles every frame, to know what is to come out.
Truths findTruths(const Playback& playback, const ComparisonOptions& options,
                  ComparisonResult& result, const Progress& progress) {
    Truths truths;
    const OrderUnderTest order{.name = "truth"};
    Player player(playback, order, options);
    for (std::size_t i = 1; i < playback.frames.size(); ++i) {
        if (progress) progress("the settled light", double(i) / double(playback.frames.size()));
        player.edit(playback.frames[i]);
        player.lit().solver().settle();
        truths.push_back({player.luminances(), factorsOf(player.lit().solver().emitterRows(),
                                                         player.lit().patches().vertices.size())});
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

std::vector<OrderUnderTest> usualOrders() {
    using Kind = OrderUnderTest::Kind;
    return {{.kind = Kind::plain, .name = "plain"},
            {.kind = Kind::importance, .name = "importance"},
            {.kind = Kind::random, .name = "random"},
            {.kind = Kind::bound, .name = "bound"},
            {.kind = Kind::oracle, .name = "oracle"}};
}

std::vector<OrderUnderTest> allOrders() {
    std::vector<OrderUnderTest> orders = usualOrders();
    const std::pair<const char*, bool ValueFactors::*> factors[] = {
        {"no-change", &ValueFactors::change},
        {"no-contrast", &ValueFactors::contrast},
        {"no-size", &ValueFactors::size},
        {"no-frustum", &ValueFactors::frustum},
        {"no-occlusion", &ValueFactors::occlusion},
        {"no-eccentricity", &ValueFactors::eccentricity},
        {"no-proximity", &ValueFactors::proximity}};
    for (const auto& [name, factor] : factors) {
        OrderUnderTest order{.kind = OrderUnderTest::Kind::importance, .name = name};
        order.factors.*factor = false;
        orders.push_back(order);
    }
    return orders;
}

ComparisonResult compareOrders(const Playback& playback, const std::vector<OrderUnderTest>& orders,
                               const ComparisonOptions& options, const Progress& progress) {
    ComparisonResult result;
    result.filmFrame = options.filmFrame;
    const Truths truths = findTruths(playback, options, result, progress);
    for (const OrderUnderTest& order : orders) {
        OrderResult& one = result.orders.emplace_back();
        one.name = order.name;
        Player player(playback, order, options);
        player.order(truths.front()); // what is found once, a viewer has found long before
        for (std::size_t i = 1; i < playback.frames.size(); ++i) {
            if (progress) progress(order.name.c_str(), double(i) / double(playback.frames.size()));
            player.edit(playback.frames[i]);
            Watch(player, truths[i - 1], options, one, int(i) - 1 == options.filmFrame).run();
        }
    }
    return result;
}

} // namespace penumbra
