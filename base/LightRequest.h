// What somebody asks of the light of a scene: a file, a command line, a person at the panel.
#pragma once

#include <cstdint>
#include <optional>

namespace penumbra {

/// When edits are sent to be lit.
enum class Trigger {
    implicit,  ///< at once, but those of a node in someone's hand when it is grabbed and let go
    onDemand,  ///< when RadiosityNode::requestUpdate() is called
    continuous ///< at once, while it is being dragged as well
};

/// In which order dirty blocks are updated. Changes when what is right, not what comes out.
enum class PolicyKind : std::uint8_t {
    importance, ///< what the viewer gains most from; if there is none, what may change most
    plain,      ///< sender by sender: the original method, and the yardstick
    random      ///< the same each time
};

/// What nobody asked for is empty.
struct LightRequest {
    std::optional<double> patchSize = {};   ///< longest edge of a patch [m]
    std::optional<double> elementSize = {}; ///< longest edge of an element [m]
    std::optional<double> residual = {};    ///< see SolverOptions::residual
    std::optional<Trigger> trigger = {};
    std::optional<PolicyKind> policy = {};

    /// This, and what `other` asks for where this asks for nothing: option, else file.
    LightRequest orElse(const LightRequest& other) const {
        const auto first = [](const auto& a, const auto& b) { return a ? a : b; };
        return {first(patchSize, other.patchSize), first(elementSize, other.elementSize),
                first(residual, other.residual), first(trigger, other.trigger),
                first(policy, other.policy)};
    }
    friend bool operator==(const LightRequest&, const LightRequest&) = default;
};

} // namespace penumbra
