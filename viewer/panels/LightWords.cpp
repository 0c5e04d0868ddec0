#include "viewer/panels/LightWords.h"

namespace penumbra {

namespace {

std::string solutionWords(const RadiosityState& light) {
    if (light.stopped) return "light stopped at its limit of work";
    if (light.solution == SolutionState::working)
        return (light.task.empty() ? "light" : light.task) + " " +
               std::to_string(int(100 * light.progress)) + " %";
    if (light.held > 0) return "waiting for an update (U)";
    return std::string("light ") + nameOf(light.solution);
}

} // namespace

std::string lightWords(const RadiosityState& light) {
    using Phase = RadiosityState::Phase;
    switch (light.phase) {
    case Phase::off:
        return "light is off";
    case Phase::connecting:
        return "starting the light";
    case Phase::meshing:
        return "cutting surfaces into patches";
    case Phase::solving:
        return solutionWords(light);
    case Phase::failed:
        break;
    }
    return "the light failed";
}

} // namespace penumbra
