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

/// A scene that is played.
class Player {
public:
    Player(const Playback& playback, const ComparisonOptions& options)
        : playback_(playback), options_(options), placed_(playback.show(playback.frames.front())),
          lit_(placed_, options.meshing, options.solving) {
        settle();
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
    /// In no order that is watched.
    void settle() {
        lit_.solver().setOrder(UpdateOrder::importance);
        lit_.solver().settle();
    }

    /// Tells the solver in which order to go about it, as a viewer would at each frame.
    /// \param truth for the order that knows it
    /// \param before the cut, if there is one
    void order(const OrderUnderTest& order, const Truth& truth, bool before) {
        using Kind = OrderUnderTest::Kind;
        Solver& solver = lit_.solver();
        switch (order.kind) {
        case Kind::plain:
            return solver.setOrder(UpdateOrder::plain);
        case Kind::bound:
            return solver.setDirectOrder(std::make_shared<BoundOrder>());
        case Kind::random:
            return solver.setDirectOrder(std::make_shared<RandomOrder>(order.seed));
        case Kind::importance:
            return solver.attend(attention(order, before));
        case Kind::oracle:
            return solver.setDirectOrder(std::make_shared<OracleOrder>(
                lit_.patches(), solver.emitterRows(), truth.factors, *drawn_, adaptation_));
        }
    }

    LitScene& lit() { return lit_; }
    double pixelsPerDegree() const { return viewpoint(view_).pixelsPerDegree(); }
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
    Viewpoint viewpoint(const View& view) const {
        return Viewpoint(view, options_.width, options_.height);
    }
    Attention attention(const OrderUnderTest& order, bool before) const {
        std::optional<Bounds> moved;
        for (ObjectId object : moved_) {
            if (!moved) moved.emplace();
            moved->add(boundsOf(lit_.patches(), object));
        }
        GazeHints hints;
        if (moved) hints.dragged = glm::dvec3(moved->centre());
        const Viewpoint from = viewpoint(before ? playback_.viewBefore(placed_) : view_);
        return {from, Gaze(from, hints), adaptation_, moved, order.factors};
    }

    const Playback& playback_;
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
    /// \param cut after so much work the viewer looks elsewhere [rays]; 0: never
    Watch(Player& player, const OrderUnderTest& order, const Truth& truth,
          const ComparisonOptions& options, OrderResult& result, bool film, double cut)
        : player_(player), order_(order), truth_(truth), options_(options), result_(result),
          film_(film), cut_(cut), before_(player.lit().solver().done()) {
        result_.frames.emplace_back();
    }

    void run() {
        look();
        Solver& solver = player_.lit().solver();
        tellOrder(cut_ > 0);
        bool more = true;
        for (double next = options_.firstLook; more;
             next = std::max(next, work()) * options_.growth) {
            while (more && work() < next) {
                const double start = now();
                more = solver.work(std::size_t(std::clamp((next - work()) / 8, 512.0, 65536.0)));
                seconds_ += now() - start;
                if (cut_ > 0 && work() >= cut_) cut_ = 0, tellOrder(false);
            }
            const double start = now();
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
    void tellOrder(bool beforeCut) {
        const double start = now();
        player_.order(order_, truth_, beforeCut);
        seconds_ += now() - start;
    }
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
    const OrderUnderTest& order_;
    const Truth& truth_;
    const ComparisonOptions& options_;
    OrderResult& result_;
    bool film_;
    double cut_;
    WorkDone before_;
    double seconds_ = 0;
    std::size_t filmed_ = 0;
};

/// Settles a frame, to know what is to come out.
Truth findTruth(Player& player, double frame, double& work) {
    Solver& solver = player.lit().solver();
    const double before = solver.done().inRays();
    player.edit(frame);
    player.settle();
    work = player.lit().solver().done().inRays() - before;
    return {player.luminances(),
            factorsOf(player.lit().solver().emitterRows(), player.lit().patches().vertices.size())};
}

void describe(Player& player, ComparisonResult& result) {
    const PatchSet& patches = player.lit().patches();
    result.elements = patches.elements.size();
    result.patches = patches.patches.size();
    result.lamps = patches.emitters.size();
    result.truth = player.picture();
    result.pixelsPerDegree = player.pixelsPerDegree();
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
        {"no-look", &ValueFactors::look},
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
    for (std::uint32_t seed = 2; seed <= 5; ++seed)
        orders.push_back({.kind = OrderUnderTest::Kind::random,
                          .name = "random" + std::to_string(seed),
                          .seed = seed});
    OrderUnderTest geometry{.kind = OrderUnderTest::Kind::importance, .name = "geometry"};
    geometry.factors.change = geometry.factors.contrast = false;
    orders.push_back(geometry);
    return orders;
}

ComparisonResult compareOrders(const Playback& playback, const std::vector<OrderUnderTest>& orders,
                               const ComparisonOptions& options, const Progress& progress) {
    ComparisonResult result;
    result.filmFrame = options.filmFrame;
    for (const OrderUnderTest& order : orders) result.orders.emplace_back().name = order.name;
    if (progress) progress("the light at first", 0);
    Player player(playback, options);
    const double steps = double(playback.frames.size() - 1) * double(orders.size());
    for (std::size_t i = 1; i < playback.frames.size(); ++i) {
        const bool film = int(i) - 1 == options.filmFrame;
        double work = 0;
        const Truth truth = findTruth(player, playback.frames[i], work);
        result.frames.push_back(playback.frames[i]);
        if (film) describe(player, result);
        for (std::size_t o = 0; o < orders.size(); ++o) {
            if (progress)
                progress(orders[o].name.c_str(),
                         (double(i - 1) * double(orders.size()) + double(o)) / steps);
            player.edit(playback.frames[i - 1]);
            player.settle();
            player.edit(playback.frames[i]);
            const double cut = playback.viewBefore ? options.cutAt * work : 0;
            Watch(player, orders[o], truth, options, result.orders[o], film, cut).run();
        }
    }
    return result;
}

} // namespace penumbra
