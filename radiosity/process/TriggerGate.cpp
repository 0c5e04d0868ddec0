#include "radiosity/process/TriggerGate.h"

#include <utility>

namespace penumbra {

namespace {

/// The node that an edit is of; none: a material.
std::optional<std::uint32_t> nodeOf(const GraphEdit& edit) {
    return std::visit(
        [](const auto& e) -> std::optional<std::uint32_t> {
            if constexpr (requires { e.node; })
                return e.node;
            else
                return std::nullopt;
        },
        edit);
}

} // namespace

void TriggerGate::setTrigger(std::uint32_t node, std::optional<Trigger> trigger) {
    if (trigger)
        nodeTriggers_[node] = *trigger;
    else
        nodeTriggers_.erase(node);
}

void TriggerGate::add(GraphEdit edit) {
    const auto [place, fresh] = places_.emplace(keyOf(edit), held_.size());
    if (fresh)
        held_.push_back(std::move(edit));
    else
        held_[place->second] = std::move(edit);
}

bool TriggerGate::isDue(const GraphEdit& edit) const {
    if (std::holds_alternative<SetChildren>(edit)) return true;
    const std::optional<std::uint32_t> node = nodeOf(edit);
    Trigger trigger = trigger_;
    if (node)
        if (const auto own = nodeTriggers_.find(*node); own != nodeTriggers_.end())
            trigger = own->second;
    switch (trigger) {
    case Trigger::continuous:
        return true;
    case Trigger::onDemand:
        return false;
    case Trigger::implicit:
        return !node || !grabbed_.contains(*node);
    }
    return true;
}

std::vector<GraphEdit> TriggerGate::takeDue() {
    std::vector<GraphEdit> due, rest;
    for (GraphEdit& edit : held_) (isDue(edit) ? due : rest).push_back(std::move(edit));
    held_ = std::move(rest);
    places_.clear();
    for (std::size_t i = 0; i < held_.size(); ++i) places_[keyOf(held_[i])] = i;
    return due;
}

std::vector<GraphEdit> TriggerGate::takeAll() {
    places_.clear();
    return std::exchange(held_, {});
}

} // namespace penumbra
