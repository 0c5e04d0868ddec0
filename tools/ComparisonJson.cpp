#include "tools/ComparisonJson.h"

#include <nlohmann/json.hpp>

namespace penumbra {

namespace {

using Json = nlohmann::ordered_json;

Json sampleJson(const ErrorSample& sample) {
    return {{"work", sample.work},
            {"seconds", sample.seconds},
            {"rays", sample.rays},
            {"shots", sample.shots},
            {"mean_jnd", sample.error.mean},
            {"cubic_mean_jnd", sample.error.cubicMean},
            {"p99_jnd", sample.error.p99},
            {"most_jnd", sample.error.most},
            {"visible_share", sample.error.visible}};
}

/// Null for what never came, or is not known.
Json orNull(double value) {
    return value < 0 ? Json() : Json(value);
}

Json policyJson(const PolicyResult& policy, const PolicyFigures& figures,
                const std::vector<double>& frames) {
    Json edits = Json::array();
    for (std::size_t i = 0; i < policy.frames.size(); ++i) {
        Json samples = Json::array();
        for (const ErrorSample& sample : policy.frames[i]) samples.push_back(sampleJson(sample));
        edits.push_back({{"frame", frames[i]},
                         {"work", policy.work[i]},
                         {"seconds", policy.seconds[i]},
                         {"samples", std::move(samples)}});
    }
    return {{"order", policy.name},
            {"area", orNull(figures.area)},
            {"work_to_10_percent", orNull(figures.work10)},
            {"work_to_1_percent", orNull(figures.work1)},
            {"seconds_to_10_percent", orNull(figures.seconds10)},
            {"seconds_to_1_percent", orNull(figures.seconds1)},
            {"work", figures.work},
            {"seconds", figures.seconds},
            {"differs_from_truth_jnd", figures.differsFromTruth},
            {"edits", std::move(edits)}};
}

Json factsJson(const Facts& facts) {
    Json json = Json::object();
    for (const auto& [name, value] : facts) json[name] = value;
    return json;
}

} // namespace

std::string comparisonJson(const ComparisonResult& result, const ReportOptions& report) {
    Json json;
    json["title"] = report.title;
    json["settings"] = factsJson(report.settings);
    json["machine"] = factsJson(report.machine);
    json["elements"] = result.elements;
    json["patches"] = result.patches;
    json["lamps"] = result.lights;
    json["pixels_per_degree"] = result.pixelsPerDegree;
    const std::vector<PolicyFigures> figures = figuresOf(result);
    json["orders"] = Json::array();
    for (std::size_t i = 0; i < result.policies.size(); ++i)
        json["orders"].push_back(policyJson(result.policies[i], figures[i], result.frames));
    return json.dump(1) + "\n";
}

} // namespace penumbra
