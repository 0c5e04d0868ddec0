#include "comparison/EditPlayer.h"

#include "importance/Adaptation.h"

#include <optional>

namespace penumbra {

Truth truthBy(const PatchSet& now, const Truth& truth) {
    const std::size_t vertices = now.vertices.size();
    Truth result{now.elements, {}, {}};
    result.light.direct.resize(vertices), result.light.indirect.resize(vertices);
    result.factors.assign(truth.factors.size(), std::vector<float>(vertices));
    for (std::size_t e = 0; e < now.elements.size(); ++e)
        for (std::size_t k = 0; k < now.elements[e].vertices.size(); ++k) {
            const std::uint32_t to = now.elements[e].vertices[k];
            const std::uint32_t from = truth.elements[e].vertices[k];
            result.light.direct[to] = truth.light.direct[from];
            result.light.indirect[to] = truth.light.indirect[from];
            for (std::size_t row = 0; row < truth.factors.size(); ++row)
                result.factors[row][to] = truth.factors[row][from];
        }
    return result;
}

EditPlayer::EditPlayer(const Playback& playback, const ComparisonOptions& options)
    : playback_(playback), options_(options), placed_(playback.show(playback.frames.front())),
      lit_(placed_, options.meshing, options.solving) {
    settle();
    aim();
}

void EditPlayer::edit(double frame) {
    placed_ = playback_.show(frame);
    const LitScene::Followed followed = lit_.follow(placed_);
    change_ = followed.rebuilt ? SceneChange() : followed.change;
    aim();
}

void EditPlayer::knowWhatChanges(const Truth& truth) {
    Solver& solver = lit_.solver();
    while (!solver.direct().dirtyKnown() && solver.work(65536)) {
    }
    const VertexFactors now = factorsOf(solver.emitterRows(), lit_.patches().vertices.size());
    solver.narrowDirect([&](std::uint32_t emitter, std::uint32_t block) {
        const std::vector<float>&before = now[emitter], &after = truth.factors[emitter];
        std::uint64_t changes = 0;
        const std::size_t first = std::size_t(block) * PatchSet::kBlock;
        for (std::size_t r = 0; r < PatchSet::kBlock && first + r < before.size(); ++r)
            changes |= std::uint64_t(before[first + r] != after[first + r]) << r;
        return changes;
    });
}

void EditPlayer::catchUp() {
    lit_.solver().apply(change_);
    settle();
}

void EditPlayer::settle() {
    lit_.solver().setPolicy(PolicyKind::importance);
    lit_.solver().settle();
}

void EditPlayer::policy(const PolicyUnderTest& policy, const Truth& truth, bool before) {
    using Kind = PolicyUnderTest::Kind;
    Solver& solver = lit_.solver();
    switch (policy.kind) {
    case Kind::plain:
        return solver.setPolicy(PolicyKind::plain);
    case Kind::bound:
        return solver.setDirectPolicy(std::make_shared<BoundPolicy>());
    case Kind::random:
        return solver.setDirectPolicy(std::make_shared<RandomPolicy>(policy.seed));
    case Kind::importance:
        return solver.attend(attention(policy, before));
    case Kind::oracle:
        return solver.setDirectPolicy(std::make_shared<OraclePolicy>(
            lit_.patches(), solver.emitterRows(), truth.factors, *drawn_, adaptation_));
    }
}

void EditPlayer::aim(double turn) {
    view_ = playback_.view(placed_);
    if (turn != 0) view_ = turned(view_, playback_.up, turn);
    drawn_ = std::make_unique<DrawnView>(lit_.patches(), view_, options_.width, options_.height);
    adaptation_ = meanAdaptation(luminances(lit_.solver().lighting()).values);
}

Picture EditPlayer::picture() const {
    const Lighting light = lit_.solver().lighting();
    return {options_.width, options_.height, drawn_->colours(light), drawn_->metered(light)};
}

Viewpoint EditPlayer::viewpoint(const View& view) const {
    return Viewpoint(view, options_.width, options_.height);
}

Attention EditPlayer::attention(const PolicyUnderTest& policy, bool before) const {
    std::optional<Bounds> moved;
    for (ObjectId object : change_.objects) {
        if (!moved) moved.emplace();
        moved->add(boundsOf(lit_.patches(), object));
    }
    GazeHints hints;
    if (moved) hints.dragged = glm::dvec3(moved->centre());
    const Viewpoint from = viewpoint(before ? playback_.viewBefore(placed_) : view_);
    return {from, Gaze(from, hints), adaptation_, moved, policy.factors};
}

} // namespace penumbra
