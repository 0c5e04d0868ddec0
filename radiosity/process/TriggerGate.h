// Which edits are due.
#pragma once

#include "radiosity/process/RadiosityOptions.h"
#include "radiosity/process/snapshot/SceneSnapshot.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace penumbra {

/// Holds edits back until the trigger lets them through. Of several edits of the same thing only
/// the last one is kept, where the first was in the queue. Which children a node has is never held
/// back.
class TriggerGate {
public:
    explicit TriggerGate(Trigger trigger) : trigger_(trigger) {}

    void setTrigger(Trigger trigger) { trigger_ = trigger; }
    void setTrigger(std::uint32_t node, std::optional<Trigger> trigger);
    /// Someone holds a node, or lets go of it. What is due before it is grabbed is to be taken
    /// first.
    void grab(std::uint32_t node) { grabbed_.insert(node); }
    void release(std::uint32_t node) { grabbed_.erase(node); }

    void add(GraphEdit edit);
    /// The edits that are due, in order; they are held no longer.
    std::vector<GraphEdit> takeDue();
    /// All that are held, whatever the triggers say.
    std::vector<GraphEdit> takeAll();
    std::size_t held() const { return held_.size(); }

private:
    bool isDue(const GraphEdit& edit) const;

    Trigger trigger_;
    std::unordered_map<std::uint32_t, Trigger> nodeTriggers_;
    std::unordered_set<std::uint32_t> grabbed_;
    std::vector<GraphEdit> held_;
    std::unordered_map<std::uint64_t, std::size_t> places_; ///< in held_, by keyOf()
};

} // namespace penumbra
