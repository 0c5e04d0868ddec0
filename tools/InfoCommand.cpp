#include "io/UsdScene.h"
#include "radiosity/LightShapes.h"
#include "scenegraph/Camera.h"
#include "scenegraph/Error.h"
#include "scenegraph/Light.h"
#include "scenegraph/Mesh.h"
#include "scenegraph/Objects.h"
#include "tools/Commands.h"
#include "tools/SceneSolution.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>
#include <numbers>

namespace penumbra {

namespace {

struct InfoCommand {
    std::string scene;
    std::optional<double> frame;
    bool verbose = false;
};

/// One line a lamp, in the units people compare: nits, lumens, and lux one metre in front.
void printLamp(const std::string& path, const char* kind, Rgb nits, double area) {
    const double y = luminance(nits);
    fmt::print("  {:<40} {:<6} {:>10.4g} nit {:>10.4g} lm {:>10.4g} lux at 1 m\n", path, kind, y,
               std::numbers::pi * y * area, y * area);
}

void printLamps(const PlacedScene& placed) {
    for (const auto& light : placed.lights) {
        static constexpr const char* kKinds[] = {"rect", "disk", "sphere"};
        const Emitter emitter = lightEmitter(*light.node, light.toWorld);
        const bool sphere = emitter.kind == Emitter::Kind::sphere;
        printLamp(light.path, kKinds[light.node->shape().index()], light.node->luminance(),
                  emitter.area / (sphere ? 4 : 1)); // a sphere shows pi r^2, a quarter of its area
    }
}

void run(const InfoCommand& command) {
    LoadOptions options;
    options.time = command.frame;
    const LoadedScene loaded = loadUsdScene(command.scene, options);
    const PlacedScene placed = placeScene(*loaded.scene);
    std::size_t faces = 0, points = 0, emissive = 0, cages = 0;
    for (const auto& mesh : placed.meshes) {
        faces += mesh.node->faceCount();
        points += mesh.node->data().points.size();
        cages += mesh.node->data().scheme != SubdivisionScheme::none;
        bool emits = false;
        for (const auto& material : mesh.node->data().materials) emits |= material->emissive();
        emissive += emits;
    }
    const glm::vec3 size = placed.bounds.size();
    fmt::print("{}\n", command.scene);
    fmt::print("  up axis {}, {} m a unit, {:.4g} x {:.4g} x {:.4g} m\n",
               loaded.scene->upAxis == UpAxis::y ? "Y" : "Z", loaded.scene->metersPerUnit, size.x,
               size.y, size.z);
    fmt::print("  {} objects, {} meshes ({} subdivision cages, {} emissive), {} faces, {} points\n",
               placed.objects.size(), placed.meshes.size(), cages, emissive, faces, points);
    fmt::print("  {} lamps\n", placed.lights.size());
    printLamps(placed);
    fmt::print("  {} cameras\n", placed.cameras.size());
    for (const auto& camera : placed.cameras) fmt::print("  {}\n", camera.path);
    if (command.verbose)
        for (std::size_t i = 0; i < placed.objects.size(); ++i)
            fmt::print("  object {:>4} {}{}\n", i, placed.objects[i].path,
                       placed.objects[i].movable ? " (movable)" : "");
    if (std::fflush(stdout) != 0 || std::ferror(stdout))
        throw Error("standard output: error: can't be written");
    reportDiagnostics(loaded.diagnostics, command.verbose);
}

} // namespace

void addInfoCommand(CLI::App& app) {
    auto command = std::make_shared<InfoCommand>();
    CLI::App* const info =
        app.add_subcommand("info", "What is in a scene, and what of it was not understood.");
    info->add_option("SCENE", command->scene, "USD text file (.usda)")->required();
    info->add_option("--frame", command->frame, "Time code to look at (default: its start)");
    info->add_flag("--verbose", command->verbose, "List objects and everything that was skipped");
    info->callback([command] { run(*command); });
}

} // namespace penumbra
