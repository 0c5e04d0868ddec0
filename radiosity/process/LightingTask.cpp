#include "radiosity/process/LightingTask.h"

#include <cmath>

namespace penumbra {

void write(ByteWriter& out, const LightingTask& task, const SceneSnapshot& scene) {
    // Named one by one: an option that is new does not compile before it is sent.
    const auto& [patchSize, elementSize, backdropArea] = task.meshing;
    const auto& [samples, residual, directOnly, policy, detail, mostShots, memory, clusters] =
        task.solving;
    out.put(patchSize);
    out.put(elementSize);
    out.put(backdropArea);
    out.put(std::int32_t(samples));
    out.put(residual);
    out.put(std::uint8_t(directOnly));
    out.put(std::uint8_t(policy));
    out.put(std::uint8_t(detail));
    out.put(mostShots);
    out.put(std::uint64_t(memory));
    out.put(std::uint8_t(clusters));
    write(out, scene);
}

std::optional<LightingTask> readLightingTask(ByteReader& in) {
    const auto size = [&] {
        const auto value = in.get<float>();
        if (!std::isfinite(value) || value < 0) in.fail();
        return value;
    };
    LightingTask task;
    task.meshing.patchSize = size();
    task.meshing.elementSize = size();
    task.meshing.backdropArea = in.get<double>(); // infinity: there are none
    task.solving.samples = in.get<std::int32_t>();
    task.solving.residual = in.get<double>();
    task.solving.directOnly = in.get<std::uint8_t>() != 0;
    const auto policy = in.get<std::uint8_t>();
    task.solving.policy = PolicyKind(policy);
    task.solving.detail = in.get<std::uint8_t>() != 0;
    task.solving.mostShots = in.get<std::uint64_t>();
    task.solving.memory = in.get<std::uint64_t>();
    task.solving.clusters = in.get<std::uint8_t>() != 0;
    if (!(task.meshing.backdropArea >= 0) || task.solving.samples < 1 ||
        task.solving.samples > 64 || !std::isfinite(task.solving.residual) ||
        task.solving.residual < 0 || policy > std::uint8_t(PolicyKind::random))
        return std::nullopt;
    auto scene = readSceneSnapshot(in);
    if (!scene) return std::nullopt;
    task.scene = std::move(*scene);
    return task;
}

} // namespace penumbra
