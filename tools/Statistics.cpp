#include "tools/Statistics.h"

#include "io/image/AtomicFile.h"
#include "radiosity/transport/LitLevel.h"
#include "tools/SceneSolution.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <sys/resource.h>

namespace penumbra {

std::string certificateSummary(const SolveStatistics& s) {
    if (!(s.litIlluminance > 0)) return "nothing is lit";
    const double share = certificateOfLit(s.certificate, s.litIlluminance);
    return fmt::format("relaxed to within {:.3g} lux, {:.2g} % of the light on lit surfaces "
                       "(median {:.3g} lux)",
                       s.certificate, 100 * share, s.litIlluminance);
}

std::string certificateWarning(const SolveStatistics& s) {
    if (certificateOfLit(s.certificate, s.litIlluminance) < 1) return {};
    return fmt::format(
        "the certificate, {:.3g} lux, says nothing: it is as large as the light itself, "
        "{:.3g} lux on lit surfaces (try a smaller --residual)",
        s.certificate, s.litIlluminance);
}

std::size_t peakMemory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return std::size_t(usage.ru_maxrss) * 1024;
}

namespace {

nlohmann::ordered_json workJson(const WorkCount& work) {
    return {{"rays", work.rays.total()},
            {"rays_full", work.rays.full},
            {"rays_single", work.rays.single},
            {"blocks_visited", work.blocksVisited},
            {"entries_changed", work.entriesChanged},
            {"seconds", work.seconds}};
}

nlohmann::ordered_json frameJson(const FrameCost& cost) {
    const RayCount rays = RayCount(cost.direct.rays) += cost.indirect.rays;
    return {{"frame", cost.frame},
            {"edits", cost.edits},
            {"rebuilt", cost.rebuilt},
            {"rays", rays.total()},
            {"rays_full", rays.full},
            {"rays_single", rays.single},
            {"entries_changed", cost.direct.entriesChanged + cost.indirect.entriesChanged},
            {"shots", cost.shots},
            {"certificate", cost.certificate},
            {"state", nameOf(cost.state)},
            {"seconds", cost.seconds},
            {"direct", workJson(cost.direct)},
            {"indirect", workJson(cost.indirect)},
            {"detail",
             {{"rays", cost.detail.rays.total()},
              {"groups_visited", cost.detail.blocksVisited},
              {"seconds", cost.detail.seconds}}}};
}

} // namespace

void writeStatistics(const std::string& path, const SceneSolution& solution) {
    const PatchSet& patches = solution.patches();
    const SolveStatistics s = solution.statistics();
    nlohmann::ordered_json json;
    json["scene"] = {{"objects", patches.objects.size()},   {"polygons", patches.polygons},
                     {"patches", patches.patchCount()},     {"elements", patches.elements.size()},
                     {"vertices", patches.vertices.size()}, {"emitters", patches.emitters.size()},
                     {"nodes", patches.nodes.size()},       {"area", patches.area},
                     {"patch_size", patches.patchSize},     {"element_size", patches.elementSize}};
    json["solve"] = {{"shots", s.shots},
                     {"residual", s.residual},
                     {"certificate", s.certificate},
                     {"state", nameOf(s.state)},
                     {"seconds", s.direct.seconds + s.indirect.seconds},
                     {"rays", s.direct.rays.total() + s.indirect.rays.total()},
                     {"direct_rays", s.direct.rays.total()},
                     {"indirect_rays", s.indirect.rays.total()},
                     {"direct_seconds", s.direct.seconds},
                     {"indirect_seconds", s.indirect.seconds},
                     {"detail_rays", s.detail.rays.total()},
                     {"detail_seconds", s.detail.seconds},
                     {"brightest_exitance", s.brightest},
                     {"mean_radiosity", s.meanRadiosity},
                     {"lit_illuminance", s.litIlluminance}};
    json["solve"]["certificate_of_lit"] =
        s.litIlluminance > 0
            ? nlohmann::ordered_json(certificateOfLit(s.certificate, s.litIlluminance))
            : nlohmann::ordered_json();
    json["sffl"] = {{"rows", s.rows},
                    {"entries", s.entries},
                    {"bytes", s.bytes},
                    {"rows_not_kept", s.rowsNotKept}};
    json["memory"] = {{"peak_bytes", peakMemory()}, {"budget_bytes", solution.solver().memory()}};
    json["phases"] = solution.phases();
    for (const FrameCost& cost : solution.frames()) json["frames"].push_back(frameJson(cost));
    writeFileAtomically(path, json.dump(2) + "\n");
}

} // namespace penumbra
