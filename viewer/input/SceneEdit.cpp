#include "viewer/input/SceneEdit.h"

#include <algorithm>
#include <type_traits>
#include <unordered_set>

namespace penumbra {

namespace {

void put(const MoveEdit& edit, const glm::dmat4& matrix) {
    if (edit.node->matrix() != matrix) edit.node->setMatrix(matrix);
}
void put(const LightEdit& edit, Rgb luminance) {
    if (edit.light->luminance() != luminance) edit.light->setLuminance(luminance);
}
void put(const PaintEdit& edit, const PaintEdit::Paint& paint) {
    Material& material = *edit.material;
    if (material.reflectance() != paint.reflectance) material.setReflectance(paint.reflectance);
    if (material.emission() != paint.emission) material.setEmission(paint.emission);
}

void put(const PresenceEdit& edit, bool present) {
    if (present == edit.parent->has(edit.node)) return;
    if (present)
        edit.parent->insert(edit.place, edit.node);
    else
        edit.parent->remove(edit.node);
}

const void* target(const MoveEdit& edit) {
    return edit.node.get();
}
const void* target(const LightEdit& edit) {
    return edit.light.get();
}
const void* target(const PaintEdit& edit) {
    return edit.material.get();
}
const void* target(const PresenceEdit& edit) {
    return edit.node.get();
}

/// Whether both do the same kind of thing to the same thing.
bool sameThing(const SceneEdit& a, const SceneEdit& b) {
    if (a.index() != b.index()) return false;
    const auto thing = [](const SceneEdit& edit) {
        return std::visit([](const auto& e) { return target(e); }, edit);
    };
    return thing(a) == thing(b);
}

/// Makes one edit of two of the same thing.
void goOn(SceneEdit& first, const SceneEdit& second) {
    std::visit(
        [&](auto& edit) { edit.after = std::get<std::decay_t<decltype(edit)>>(second).after; },
        first);
}

} // namespace

void apply(const SceneEdit& edit) {
    std::visit([](const auto& e) { put(e, e.after); }, edit);
}

void takeBack(const SceneEdit& edit) {
    std::visit([](const auto& e) { put(e, e.before); }, edit);
}

bool changes(const SceneEdit& edit) {
    return std::visit([](const auto& e) { return !(e.before == e.after); }, edit);
}

bool EditHistory::merge(const Step& step, double time) {
    if (made_ == 0 || made_ < steps_.size() || time - last_ > kMergeSeconds) return false;
    Step& before = steps_.back();
    if (before.size() != step.size()) return false;
    for (std::size_t i = 0; i < step.size(); ++i)
        if (!sameThing(before[i], step[i])) return false;
    for (std::size_t i = 0; i < step.size(); ++i) goOn(before[i], step[i]);
    return true;
}

void EditHistory::push(const Step& step) {
    steps_.resize(made_);
    steps_.push_back(step);
    ++made_;
}

void EditHistory::make(const Step& step, double time) {
    if (std::none_of(step.begin(), step.end(), changes)) return;
    for (const SceneEdit& edit : step) apply(edit);
    if (!merge(step, time)) push(step);
    last_ = time;
}

void EditHistory::note(const Step& step) {
    if (std::none_of(step.begin(), step.end(), changes)) return;
    push(step);
    last_ = kNever;
}

bool EditHistory::edited() const {
    return std::any_of(
        steps_.begin(), steps_.begin() + std::ptrdiff_t(made_),
        [](const Step& step) { return std::any_of(step.begin(), step.end(), changes); });
}

std::vector<PresenceEdit> EditHistory::hidden() const {
    std::vector<PresenceEdit> hidden;
    std::unordered_set<const Node*> known; // what came or went later
    for (std::size_t s = made_; s-- > 0;)
        for (std::size_t e = steps_[s].size(); e-- > 0;) {
            const auto* edit = std::get_if<PresenceEdit>(&steps_[s][e]);
            if (!edit || !known.insert(edit->node.get()).second) continue;
            if (edit->hides && !edit->after) hidden.push_back(*edit);
        }
    return hidden;
}

bool EditHistory::undo() {
    last_ = kNever;
    if (made_ == 0) return false;
    const Step& step = steps_[--made_];
    std::for_each(step.rbegin(), step.rend(), takeBack);
    return true;
}

bool EditHistory::redo() {
    last_ = kNever;
    if (made_ == steps_.size()) return false;
    for (const SceneEdit& edit : steps_[made_++]) apply(edit);
    return true;
}

} // namespace penumbra
