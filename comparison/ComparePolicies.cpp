#include "comparison/ComparePolicies.h"

#include "base/Clock.h"
#include "comparison/EditPlayer.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace penumbra {

namespace {

constexpr int kPanSteps = 20; ///< in which a viewer turns

bool knowsTheView(const PolicyUnderTest& policy) {
    return policy.kind == PolicyUnderTest::Kind::importance ||
           policy.kind == PolicyUnderTest::Kind::oracle;
}

/// How the viewer moves while an edit is worked off, by the work that is done.
struct ViewerMotion {
    double cut = 0;              ///< after so much work they look elsewhere [rays]; 0: never
    double pan = 0, panWork = 1; ///< turn so far in all [degrees], while so much is done [rays]
};

/// One edit, worked off, with pictures of it every now and then.
class Watch {
public:
    Watch(EditPlayer& player, const PolicyUnderTest& policy, const Truth& truth,
          const ComparisonOptions& options, PolicyResult& result, bool film,
          const ViewerMotion& motion)
        : player_(player), policy_(policy), truth_(truth), options_(options), result_(result),
          film_(film), cut_(motion.cut), motion_(motion), before_(player.lit().solver().done()) {
        result_.frames.emplace_back();
    }

    void run() {
        turn();
        aim();
        Solver& solver = player_.lit().solver();
        sendPolicy(cut_ > 0);
        bool more = true;
        for (double next = options_.firstLook; more;
             next = std::max(next, work()) * options_.growth) {
            while (more && work() < next) {
                const double start = steadySeconds();
                more = solver.work(std::size_t(std::clamp((next - work()) / 8, 512.0, 65536.0)));
                seconds_ += steadySeconds() - start;
                if (cut_ > 0 && work() >= cut_) cut_ = 0, sendPolicy(false);
                if (turn() && knowsTheView(policy_)) sendPolicy(false);
            }
            const double start = steadySeconds();
            solver.sumUp();
            seconds_ += steadySeconds() - start;
            aim();
        }
        result_.work.push_back(work());
        result_.seconds.push_back(seconds_);
        result_.differsFromTruth =
            std::max(result_.differsFromTruth, result_.frames.back().back().error.most);
    }

private:
    void sendPolicy(bool beforeCut) {
        const double start = steadySeconds();
        player_.policy(policy_, truth_, beforeCut);
        seconds_ += steadySeconds() - start;
    }
    /// Turns the viewer as far as the work has come; whether that is any further.
    bool turn() {
        if (motion_.pan == 0) return false;
        const int step = int(kPanSteps * std::min(1.0, work() / motion_.panWork));
        if (step == std::exchange(panStep_, step)) return false;
        player_.aim(motion_.pan * (double(step) / kPanSteps - 0.5));
        return true;
    }
    /// Since the edit.
    double work() const { return player_.lit().solver().done().inRays() - before_.inRays(); }

    void aim() {
        const Plane jnd =
            visibleDifference(player_.luminances(player_.lit().solver().lighting()),
                              player_.luminances(truth_.light), player_.pixelsPerDegree());
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

    EditPlayer& player_;
    const PolicyUnderTest& policy_;
    const Truth& truth_;
    const ComparisonOptions& options_;
    PolicyResult& result_;
    bool film_;
    double cut_;
    ViewerMotion motion_;
    int panStep_ = -1;
    WorkDone before_;
    double seconds_ = 0;
    std::size_t filmed_ = 0;
};

/// Settles a frame, to know what is to come out.
Truth findTruth(EditPlayer& player, double frame) {
    player.edit(frame);
    player.settle();
    const Solver& solver = player.lit().solver();
    return {player.lit().patches().elements, solver.lighting(),
            factorsOf(solver.emitterRows(), player.lit().patches().vertices.size())};
}

/// Goes from the settled light of one frame to the next, on which nothing has been done.
/// \return the truth by the vertices as they are now
Truth startEdit(EditPlayer& player, double from, double to, const Truth& truth,
                DirtySetKind dirty) {
    player.edit(from);
    player.settle();
    player.edit(to);
    Truth now = truthBy(player.lit().patches(), truth);
    if (dirty == DirtySetKind::perfect) player.knowWhatChanges(now);
    return now;
}

void endEdit(EditPlayer& player, DirtySetKind dirty) {
    if (dirty == DirtySetKind::perfect) player.catchUp();
}

/// The work of an edit that nobody watches. \pre startEdit()
double unwatchedDirty(EditPlayer& player, DirtySetKind dirty) {
    const double before = player.lit().solver().done().inRays();
    player.settle();
    const double work = player.lit().solver().done().inRays() - before;
    endEdit(player, dirty);
    return work;
}

void describe(EditPlayer& player, ComparisonResult& result) {
    const PatchSet& patches = player.lit().patches();
    result.elements = patches.elements.size();
    result.patches = patches.patchCount();
    result.lights = patches.emitters.size();
    result.truth = player.picture();
    result.pixelsPerDegree = player.pixelsPerDegree();
}

} // namespace

std::vector<PolicyUnderTest> usualPolicies() {
    using Kind = PolicyUnderTest::Kind;
    return {{.kind = Kind::plain, .name = "plain"},
            {.kind = Kind::importance, .name = "importance"},
            {.kind = Kind::random, .name = "random"},
            {.kind = Kind::bound, .name = "bound"},
            {.kind = Kind::oracle, .name = "oracle"}};
}

std::vector<PolicyUnderTest> allPolicies() {
    std::vector<PolicyUnderTest> policies = usualPolicies();
    const std::pair<const char*, bool PriorityFactors::*> factors[] = {
        {"no-change", &PriorityFactors::change},
        {"no-probe", &PriorityFactors::probe},
        {"no-contrast", &PriorityFactors::contrast},
        {"no-size", &PriorityFactors::size},
        {"no-frustum", &PriorityFactors::frustum},
        {"no-occlusion", &PriorityFactors::occlusion},
        {"no-eccentricity", &PriorityFactors::eccentricity},
        {"no-proximity", &PriorityFactors::proximity}};
    for (const auto& [name, factor] : factors) {
        PolicyUnderTest policy{.kind = PolicyUnderTest::Kind::importance, .name = name};
        policy.factors.*factor = false;
        policies.push_back(policy);
    }
    for (std::uint32_t seed = 2; seed <= 5; ++seed)
        policies.push_back({.kind = PolicyUnderTest::Kind::random,
                            .name = "random" + std::to_string(seed),
                            .seed = seed});
    PolicyUnderTest geometry{.kind = PolicyUnderTest::Kind::importance, .name = "geometry"};
    geometry.factors.change = geometry.factors.contrast = false;
    policies.push_back(geometry);
    return policies;
}

ComparisonResult comparePolicies(const Playback& playback,
                                 const std::vector<PolicyUnderTest>& policies,
                                 const ComparisonOptions& options, const Progress& progress) {
    ComparisonResult result;
    result.filmFrame = options.filmFrame;
    result.dirty = options.dirty;
    for (const PolicyUnderTest& policy : policies)
        result.policies.emplace_back().name = policy.name;
    if (progress) progress("the light at first", 0);
    EditPlayer player(playback, options);
    const double steps = double(playback.frames.size() - 1) * double(policies.size());
    for (std::size_t i = 1; i < playback.frames.size(); ++i) {
        const bool film = int(i) - 1 == options.filmFrame;
        const double from = playback.frames[i - 1], to = playback.frames[i];
        const Truth truth = findTruth(player, to);
        result.frames.push_back(to);
        if (film) describe(player, result);
        ViewerMotion motion;
        if (playback.viewBefore || playback.pan != 0) {
            startEdit(player, from, to, truth, options.dirty);
            const double work = unwatchedDirty(player, options.dirty);
            if (playback.viewBefore) motion.cut = options.cutAt * work;
            motion.pan = playback.pan, motion.panWork = work;
        }
        for (std::size_t o = 0; o < policies.size(); ++o) {
            if (progress)
                progress(policies[o].name.c_str(),
                         (double(i - 1) * double(policies.size()) + double(o)) / steps);
            const Truth known = startEdit(player, from, to, truth, options.dirty);
            Watch(player, policies[o], known, options, result.policies[o], film, motion).run();
            endEdit(player, options.dirty);
        }
    }
    return result;
}

} // namespace penumbra
