#include "base/Error.h"
#include "base/Parallel.h"
#include "io/image/AtomicFile.h"
#include "io/usd/scene/SceneFiles.h"
#include "io/usd/scene/UsdScene.h"
#include "io/usd/stage/UsdFlatten.h"
#include "io/usd/text/UsdLayerWriter.h"
#include "radiosity/mesh/Emitters.h"
#include "radiosity/query/LightAccount.h"
#include "radiosity/query/NearestDrawn.h"
#include "scenegraph/Camera.h"
#include "scenegraph/Light.h"
#include "scenegraph/Mesh.h"
#include "scenegraph/Objects.h"
#include "tools/Commands.h"
#include "tools/CompositionJson.h"
#include "tools/CostReport.h"
#include "tools/OutputFiles.h"
#include "tools/SceneSolution.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>

namespace penumbra {

namespace {

/// A point given by hand is this near to the surface that is meant [m], or as near as an element.
constexpr float kReach = 0.1f;

struct InfoCommand {
    SolveSettings solve;     ///< most of it counts with --at and --cost only
    bool cost = false;       ///< what lighting it will take
    std::string at;          ///< as it was given; empty: about the scene
    std::string text;        ///< where to write the file's own layer as text; empty: nowhere
    std::string flatten;     ///< where to write all that it is composed of; empty: nowhere
    std::string composition; ///< where to write what it is composed of
};

/// Reads "x,y,z" [m].
std::optional<glm::vec3> pointOf(const std::string& text) {
    glm::vec3 point;
    const char *at = text.data(), *const end = at + text.size();
    for (int axis = 0; axis < 3; ++axis) {
        const auto [next, error] = std::from_chars(at, end, point[axis]);
        const bool ends = axis < 2 ? next != end && *next == ',' : next == end;
        if (error != std::errc() || !std::isfinite(point[axis]) || !ends) return std::nullopt;
        at = next + 1;
    }
    return point;
}

/// One line a light, in the units people compare: nits, lumens, and lux one metre in front.
/// \param area that emits, and as it is seen from there [m^2]
void printLight(const std::string& path, const char* kind, Rgb nits, double area, double seen) {
    const double y = luminance(nits);
    fmt::print("  {:<40} {:<6} {:>10.4g} nit {:>10.4g} lm {:>10.4g} lux at 1 m\n", path, kind, y,
               std::numbers::pi * y * area, y * seen);
}

void printLights(const PlacedScene& placed) {
    for (const auto& light : placed.lights) {
        static constexpr const char* kKinds[] = {"rect", "disk", "sphere"};
        const Emitter emitter = lightEmitter(*light.node, light.toWorld);
        const bool sphere = emitter.kind == Emitter::Kind::sphere;
        printLight(light.path, kKinds[light.node->shape().index()], light.node->luminance(),
                   emitter.area, emitter.area / (sphere ? 4 : 1)); // a sphere shows pi r^2
    }
}

void printMeshes(const PlacedScene& placed) {
    std::size_t faces = 0, points = 0, emissive = 0, cages = 0;
    for (const auto& mesh : placed.meshes) {
        faces += mesh.node->faceCount();
        points += mesh.node->data().points.size();
        cages += mesh.node->data().scheme != SubdivisionScheme::none;
        bool emits = false;
        for (const auto& material : mesh.node->data().materials) emits |= material->emissive();
        emissive += emits;
    }
    fmt::print("  {} objects, {} meshes ({} subdivision cages, {} emissive), {} faces, {} points\n",
               placed.objects.size(), placed.meshes.size(), cages, emissive, faces, points);
}

/// The pictures on its surfaces, and what they take.
void printTextures(const PlacedScene& placed) {
    std::map<const TextureImage*, std::size_t> images; // by address only to count each once
    int width = 0, height = 0;
    for (const auto& mesh : placed.meshes)
        for (const auto& material : mesh.node->data().materials)
            for (const auto& texture :
                 {material->textures().reflectance, material->textures().emission})
                if (texture) images[texture->image.get()] = texture->image->bytes();
    std::size_t bytes = 0;
    for (const auto& [image, size] : images) {
        bytes += size;
        if (image->width() * image->height() > width * height)
            width = image->width(), height = image->height();
    }
    if (images.empty()) return;
    fmt::print("  {} texture{}, the largest {} x {}, {:.1f} MB with their means\n", images.size(),
               images.size() == 1 ? "" : "s", width, height, double(bytes) / 1e6);
}

/// What may be moved, hidden and shown, each as a whole.
void printObjects(const PlacedScene& placed) {
    constexpr std::size_t kMost = 8; // lines
    std::vector<std::string> paths;
    for (const Object& object : placed.objects)
        paths.push_back(object.path + (object.visible ? "" : " (hidden)"));
    for (std::size_t i = 0; i < std::min(paths.size(), kMost); ++i) fmt::print("  {}\n", paths[i]);
    if (paths.size() > kMost)
        fmt::print("  and {} more (--verbose lists all objects)\n", paths.size() - kMost);
}

void printFrames(const LoadedScene& loaded) {
    const Scene& scene = *loaded.scene;
    if (!loaded.animation)
        fmt::print("  no animation\n");
    else if (scene.endTimeCode > scene.startTimeCode)
        fmt::print("  animation from frame {:g} to {:g}, {:g} a second\n", scene.startTimeCode,
                   scene.endTimeCode, scene.timeCodesPerSecond);
    else
        fmt::print("  animation; the file does not say from which frame to which\n");
}

/// The sizes that the scene is meshed with unless others are asked for.
void printSizes(const SolveSettings& command, const LoadedScene& loaded,
                const PlacedScene& placed) {
    if (placed.meshes.empty() && placed.lights.empty()) return;
    const MeshingOptions sizes = resolvedOptions(command, loaded, command.frame).meshing;
    const float element = sizes.elementSize > 0 ? sizes.elementSize : sizes.patchSize / 8;
    fmt::print("  patches of {:.4g} m, elements of {:.4g} m ({})\n", sizes.patchSize, element,
               loaded.asked.patchSize ? "as the file asks" : "they follow the scene, at its start");
}

void describeScene(const SolveSettings& command, bool cost) {
    LoadOptions options;
    options.allowOutside = command.allowOutside;
    options.time = command.frame;
    const LoadedScene loaded = loadUsdScene(command.scene, options);
    const PlacedScene placed = placeScene(*loaded.scene);
    const glm::vec3 size = placed.bounds.size();
    fmt::print("{}\n", command.scene);
    fmt::print("  up axis {}, {} m a unit, {:.4g} x {:.4g} x {:.4g} m\n",
               loaded.scene->upAxis == UpAxis::y ? "Y" : "Z", loaded.scene->metersPerUnit, size.x,
               size.y, size.z);
    printFrames(loaded);
    printMeshes(placed);
    printTextures(placed);
    printObjects(placed);
    printSizes(command, loaded, placed);
    fmt::print("  {} lights\n", placed.lights.size());
    printLights(placed);
    fmt::print("  {} cameras\n", placed.cameras.size());
    for (const auto& camera : placed.cameras) fmt::print("  {}\n", camera.path);
    if (command.verbose)
        for (std::size_t i = 0; i < placed.objects.size(); ++i)
            fmt::print("  object {:>4} {}\n", i, placed.objects[i].path);
    if (cost) printCost(command, loaded, placed);
    finishStandardOutput();
    reportDiagnostics(loaded.diagnostics, command.verbose);
}

std::string text(glm::vec3 v) {
    const auto tidy = [](float x) { return std::abs(x) < 5e-5f ? 0.0f : x; }; // no 1e-9, no -0
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", tidy(v.x), tidy(v.y), tidy(v.z));
}

std::string nameOf(const PatchSet& patches, ObjectId object) {
    const std::string& path = patches.objects[object.value].path;
    return path == "/" ? "/ (what belongs to no object)" : path;
}

/// A line of the table; figures of light are luminance-weighted, as people compare them.
void printRow(const std::string& name, Rgb unoccluded, Rgb arrives) {
    const double all = luminance(unoccluded), lost = all - luminance(arrives);
    fmt::print("  {:<44} {:>10.4g} {:>10.4g} {:>10.4g} {:>5.1f} %\n", name, all, luminance(arrives),
               lost, all > 0 ? 100 * lost / all : 0.0);
}

/// What single objects take of a light. Those below 1 % of it share a line.
void printLosses(const PatchSet& patches, const EmitterAccount& light) {
    const double all = luminance(light.unoccluded);
    const auto print = [&](const std::string& name, double lux) {
        fmt::print("    {:<64} {:>10.4g} {:>5.1f} %\n", name, lux, 100 * lux / all);
    };
    double rest = 0;
    std::size_t others = 0;
    for (const LightLoss& loss : light.losses) {
        const double lux = luminance(loss.lux);
        if (lux >= 0.01 * all)
            print("to " + nameOf(patches, loss.object), lux);
        else if (lux > 0)
            rest += lux, ++others;
    }
    if (others > 0) print(fmt::format("to {} more", others), rest);
}

void printAccount(const SceneSolution& solution, const DrawnHit& at, bool directOnly) {
    const PatchSet& patches = solution.patches();
    fmt::print("\n  {:<44} {:>10} {:>10} {:>10}\n", "[lux]", "unoccluded", "arrives", "lost");
    Rgb unoccluded, arrives, indirect;
    std::vector<std::string> silent;
    for (const EmitterAccount& light : accountForLight(patches, solution.solver().direct(), at)) {
        unoccluded += light.unoccluded;
        arrives += light.arrives;
        if (luminance(light.unoccluded) > 0) {
            printRow(light.path, light.unoccluded, light.arrives);
            printLosses(patches, light);
        } else {
            silent.push_back(light.path);
        }
    }
    for (const std::string& path : silent)
        fmt::print("  {:<44} {:>10}   off, hidden, turned away or behind the surface\n", path, 0);
    printRow("direct light, all lights", unoccluded, arrives);
    if (directOnly) return;
    for (std::size_t k = 0; k < 3; ++k)
        indirect += at.weights[k] * solution.lighting().indirect[at.vertices[k]];
    fmt::print("  {:<44} {:>10} {:>10.4g}\n", "indirect light", "", luminance(indirect));
    fmt::print("  {:<44} {:>10} {:>10.4g}\n", "together", "", luminance(arrives + indirect));
}

/// Why it is as bright as it is at a point.
void explain(const SolveSettings& settings, glm::vec3 point) {
    const ThreadLimit limit(settings.threads);
    const SceneSolution solution(settings);
    const PatchSet& patches = solution.patches();
    const float reach = std::max(kReach, patches.elementSize);
    const DrawnHit at = nearestDrawn(patches, point, reach);
    if (!at.met())
        throw Error(fmt::format("{}: error: no surface within {:.2g} m of {}", settings.scene,
                                reach, text(point)));
    fmt::print("{} at {}\n", settings.scene, text(point));
    fmt::print("  on {}, {:.4g} mm away at {}, facing {}\n",
               nameOf(patches, patches.elementObject[at.element]),
               std::round(1e4 * double(at.distance)) / 10, text(positionOf(patches, at)),
               text(normalOf(patches, at)));
    if (!patches.receives(at.element))
        fmt::print("  something lies on it there: nobody sees it and no light gets there\n");
    printAccount(solution, at, settings.solver.directOnly);
    finishStandardOutput();
}

/// \param output a file, or `-` for standard output
void writeWhole(const std::string& output, const std::string& text) {
    if (output != "-") return writeFileAtomically(output, text);
    fmt::print("{}", text);
    finishStandardOutput();
}

/// The layer of the file alone, without what it refers to.
void writeText(const SolveSettings& settings, const std::string& output) {
    const SceneFiles files(settings.scene, settings.allowOutside);
    const UsdLayer layer = files.layer(settings.scene, {});
    checkOutputs(files.withParts({settings.scene}), {output});
    writeWhole(output, usdLayerText(layer));
    reportDiagnostics(layer.diagnostics, settings.verbose);
}

/// The composed scene as one layer.
void writeFlattened(const SolveSettings& settings, const std::string& output) {
    const SceneFiles files(settings.scene, settings.allowOutside);
    UsdStage stage = UsdStage::open(settings.scene, {}, files);
    checkOutputs(files.withParts(stage.files()), {output});
    const auto place = std::filesystem::path(output == "-" ? "standard output" : output);
    writeWhole(output, usdLayerText(flattenUsdStage(stage, files, place)));
    reportDiagnostics(stage.diagnostics().take(), settings.verbose);
}

/// Writes what the scene is composed of.
void writeComposition(const SolveSettings& settings, const std::string& output) {
    const CompositionJson json = compositionJson(settings.scene, settings.allowOutside);
    checkOutputs(json.files, {output});
    writeWhole(output, json.text);
    reportDiagnostics(json.diagnostics, settings.verbose);
    if (!json.fault.empty()) throw Error(json.fault);
}

void run(const InfoCommand& command) {
    if (!command.text.empty())
        writeText(command.solve, command.text);
    else if (!command.flatten.empty())
        writeFlattened(command.solve, command.flatten);
    else if (!command.composition.empty())
        writeComposition(command.solve, command.composition);
    else if (command.at.empty())
        describeScene(command.solve, command.cost);
    else
        explain(command.solve, *pointOf(command.at));
}

CLI::Option* addAtOption(CLI::App& info, std::string& point) {
    CLI::Option* const at = info.add_option(
        "--at", point,
        "x,y,z (metres, scene frame): light the scene and say for the nearest surface, within\n"
        "0.1 m or an element, what each light would give there, what arrives and which objects\n"
        "take the rest. Where several stand in line one of them is charged. Indirect light is\n"
        "one figure; without it (--direct-only) the answer comes sooner");
    at->check(CLI::Validator(
        [](std::string& text) {
            return pointOf(text) ? std::string()
                                 : fmt::format("'{}' is not x,y,z: three numbers, in metres", text);
        },
        ""));
    return at;
}

/// Options of the light say nothing where nothing is lit, nor is to be.
void checkLightOptions(const CLI::App& info, const InfoCommand& command) {
    for (const char* name : {"--patch-size", "--element-size", "--samples", "--residual",
                             "--direct-only", "--memory", "--threads", "--progress", "--quiet"})
        if (info.get_option(name)->count() > 0 && command.at.empty() && !command.cost)
            throw CLI::RequiresError(name, "--at or --cost");
}

} // namespace

void addInfoCommand(CLI::App& app) {
    auto command = std::make_shared<InfoCommand>();
    CLI::App* const info = app.add_subcommand(
        "info", "What is in a scene, and what of it was not understood; with --at, why it is as\n"
                "bright or dark as it is at a point; with --text, the file as USD text; with\n"
                "--flatten, all that it is composed of as one file; with --composition, what\n"
                "each prim is composed of, as JSON; with --cost, what lighting it will take.\n"
                "Example: penumbra info room.usda --at 1.5,1,0 --direct-only");
    addSolveOptions(*info, command->solve);
    for (const char* name : {"--frames", "--from-scratch", "--stats"})
        info->remove_option(info->get_option(name));
    CLI::Option* const at = addAtOption(*info, command->at);
    CLI::Option* const text = info->add_option(
        "--text", command->text,
        "FILE.usda: write the scene's file as USD text, whatever its kind (binary,\n"
        "package, model), and nothing else; - for standard output. One layer is written,\n"
        "without those it refers to");
    text->excludes(at);
    CLI::Option* const flatten = info->add_option(
        "--flatten", command->flatten,
        "OUT.usda: write the composed scene as USD text, one file without sublayers,\n"
        "references, payloads, variants and the like; - for standard output");
    flatten->excludes(at)->excludes(text);
    CLI::Option* const composition =
        info->add_option(
                "--composition", command->composition,
                "Write what each prim is composed of (layers, arcs, selections, targets) to\n"
                "this file, as JSON; - is standard output")
            ->type_name("OUT.json")
            ->excludes(at)
            ->excludes(text)
            ->excludes(flatten);
    info->add_flag("--cost", command->cost,
                   "What lighting the scene will take: time, rays, memory. It is meshed, and some\n"
                   "rays are traced to find that out, but nothing is lit; right within a factor\n"
                   "of two, mostly")
        ->excludes(at)
        ->excludes(text)
        ->excludes(flatten)
        ->excludes(composition);
    info->callback([command, info] {
        checkLightOptions(*info, *command);
        run(*command);
    });
}

} // namespace penumbra
