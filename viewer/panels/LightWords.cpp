#include "viewer/panels/LightWords.h"

#include "radiosity/transport/LitLevel.h"

#include <cstdio>

namespace penumbra {

namespace {

std::string percent(const RadiosityState& light) {
    return std::to_string(int(100 * light.progress)) + " %";
}

std::string solutionWords(const RadiosityState& light) {
    if (light.stopped) return "stopped: the light gets no better";
    if (light.solution == SolutionState::working)
        return "computing " + (light.task.empty() ? "light" : light.task) + ": " + percent(light);
    if (light.held > 0) return "the light waits for you: press U to update it";
    return light.solution == SolutionState::exact ? "light complete"
                                                  : "light good, last details to come";
}

} // namespace

std::string lightWords(const RadiosityState& light) {
    using Phase = RadiosityState::Phase;
    switch (light.phase) {
    case Phase::off:
        return "the light is not computed";
    case Phase::connecting:
        return "starting to compute light";
    case Phase::meshing:
        return "dividing surfaces into small pieces: " + percent(light);
    case Phase::solving:
        return solutionWords(light);
    case Phase::failed:
        break;
    }
    return "the light could not be computed";
}

std::string errorWords(const RadiosityState& light) {
    if (!(light.litIlluminance > 0)) return {};
    const double share = certificateOfLit(light.certificate, light.litIlluminance);
    if (share >= 1) return "may still be wrong by as much as there is light";
    char text[80];
    std::snprintf(text, sizeof text, "may still be wrong by %.2g %% of the light on lit surfaces",
                  100 * share);
    return text;
}

} // namespace penumbra
