#include "radiosity/process/LightingTask.h"

#include <cmath>

namespace penumbra {

void write(ByteWriter& out, const LightingTask& task, const GraphImage& scene) {
    out.put(task.meshing.patchSize);
    out.put(task.meshing.elementSize);
    out.put(task.meshing.extent);
    out.put(std::int32_t(task.solving.samples));
    out.put(task.solving.residual);
    out.put(std::uint8_t(task.solving.directOnly));
    out.put(std::uint8_t(task.solving.detail));
    out.put(task.solving.mostShots);
    out.put(std::uint64_t(task.solving.rowMemory));
    out.put(std::uint8_t(task.order));
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
    task.meshing.extent = size();
    task.solving.samples = in.get<std::int32_t>();
    task.solving.residual = in.get<double>();
    task.solving.directOnly = in.get<std::uint8_t>() != 0;
    task.solving.detail = in.get<std::uint8_t>() != 0;
    task.solving.mostShots = in.get<std::uint64_t>();
    task.solving.rowMemory = in.get<std::uint64_t>();
    const auto order = in.get<std::uint8_t>();
    task.order = WorkPlan(order);
    if (task.solving.samples < 1 || task.solving.samples > 64 ||
        !std::isfinite(task.solving.residual) || task.solving.residual < 0 ||
        order > std::uint8_t(WorkPlan::plain))
        return std::nullopt;
    auto scene = readGraphImage(in);
    if (!scene) return std::nullopt;
    task.scene = std::move(*scene);
    return task;
}

} // namespace penumbra
