#include "tools/Statistics.h"

#include "io/AtomicFile.h"
#include "tools/SceneSolution.h"

#include <nlohmann/json.hpp>

#include <sys/resource.h>

namespace penumbra {

std::size_t peakMemory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return std::size_t(usage.ru_maxrss) * 1024;
}

void writeStatistics(const std::string& path, const SceneSolution& solution) {
    const PatchSet& patches = solution.patches();
    const SolveStatistics s = solution.solver().statistics();
    nlohmann::ordered_json json;
    json["scene"] = {
        {"objects", patches.objectPaths.size()}, {"polygons", patches.polygons},
        {"patches", patches.patches.size()},     {"elements", patches.elements.size()},
        {"vertices", patches.vertices.size()},   {"emitters", patches.emitters.size()},
        {"nodes", patches.nodes.size()},         {"area", patches.area},
        {"patch_size", patches.patchSize},       {"element_size", patches.elementSize}};
    json["solve"] = {{"shots", s.shots},
                     {"residual", s.residual},
                     {"certificate", s.certificate},
                     {"seconds", s.directSeconds + s.indirectSeconds},
                     {"rays", s.directRays + s.indirectRays},
                     {"direct_rays", s.directRays},
                     {"indirect_rays", s.indirectRays},
                     {"direct_seconds", s.directSeconds},
                     {"indirect_seconds", s.indirectSeconds},
                     {"brightest_exitance", s.brightest},
                     {"mean_radiosity", s.meanRadiosity}};
    json["sffl"] = {{"rows", s.rows}, {"entries", s.entries}, {"bytes", s.bytes}};
    json["memory"] = {{"peak_bytes", peakMemory()}};
    json["phases"] = solution.phases();
    writeFileAtomically(path, json.dump(2) + "\n");
}

} // namespace penumbra
