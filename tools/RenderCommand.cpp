#include "base/Error.h"
#include "base/Parallel.h"
#include "io/image/ExrWriter.h"
#include "io/image/PngWriter.h"
#include "radiosity/query/LitSurface.h"
#include "radiosity/query/TracedPicture.h"
#include "scenegraph/Camera.h"
#include "tools/CameraChoice.h"
#include "tools/Commands.h"
#include "tools/OutputFiles.h"
#include "tools/SceneSolution.h"
#include "tools/Statistics.h"
#include "viewer/gl/OffscreenContext.h"
#include "viewer/gl/Renderer.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <string_view>
#include <utility>

namespace penumbra {

namespace {

struct RenderCommand {
    SolveSettings solve;
    std::string output, png, camera;
    std::string quality = "drawn";
    std::string pixels = "half";
    int width = 1280;
    int height = 0; ///< 0: the camera's shape
};

/// \param command its height is set from the camera's film if it was not given
View chooseView(RenderCommand& command, const SceneSolution& solution) {
    const PlacedScene& placed = solution.placed();
    const std::string& file = command.solve.scene;
    if (command.height == 0)
        command.height = heightFor(placed, command.camera, file, command.width);
    if (placed.cameras.empty() && !command.solve.quiet)
        fmt::print(stderr, "{}: no camera in the file: the whole scene is framed from above\n",
                   file);
    return viewOf(placed, solution.scene().upAxis, command.camera, file, command.width,
                  command.height);
}

/// Says once what the camera can't be taken as it is for, also while frames are played.
void sayWhatIsAmiss(const RenderCommand& command, const SceneSolution& solution,
                    std::string& said) {
    const auto* const camera = chooseCamera(solution.placed(), command.camera, command.solve.scene);
    if (!camera || command.solve.quiet) return;
    const std::string amiss = whatIsAmiss(camera->node->lens(), camera->toWorld);
    if (!amiss.empty() && amiss != said)
        fmt::print(stderr, "{}: warning: camera {}: {}\n", command.solve.scene, camera->path,
                   amiss);
    if (!amiss.empty()) said = amiss;
}

ExrMetadata metadata(const RenderCommand& command, const SceneSolution& solution) {
    const SolveStatistics s = solution.statistics();
    ExrMetadata data;
    data.texts["software"] = "Penumbra " PENUMBRA_VERSION;
    data.texts["scene"] = std::filesystem::path(command.solve.scene).filename().string();
    data.texts["units"] = "R, G, B, direct, indirect: cd/m^2; illuminance: lux; Z: m";
    data.texts["quality"] = command.quality;
    data.numbers["certificate"] = float(s.certificate); // bound of |B_exact - B| [lm/m^2]
    data.numbers["patchSize"] = solution.patches().patchSize;
    data.numbers["elementSize"] = solution.patches().elementSize;
    return data;
}

FrameLayers draw(const RenderCommand& command, SceneSolution& solution, const View& view) {
    if (command.quality == "final") {
        FinalOptions options;
        options.progress = [&](double done) { solution.progress().show("tracing", done); };
        return traceFrame(solution.patches(), solution.rays(), solution.lighting(), view,
                          command.width, command.height, options);
    }
    OffscreenContext context(std::size_t(command.width) * std::size_t(command.height));
    Renderer renderer;
    const LitBranch lit(solution.patches(), solution.lighting());
    return renderFrame(context, renderer, lit, view, command.width, command.height);
}

void writeFrame(const RenderCommand& from, SceneSolution& solution, int number) {
    RenderCommand command = from;
    command.output = numberedPath(from.output, number);
    command.png = numberedPath(from.png, number);
    const View view = chooseView(command, solution);
    const FrameLayers frame = solution.timed("draw", [&] { return draw(command, solution, view); });
    solution.progress().clear();
    ExrOptions options;
    options.half = command.pixels == "half";
    const std::size_t clamped = solution.timed("write", [&] {
        return writeExr(command.output, frame, view, metadata(command, solution), options);
    });
    if (clamped > 0 && !command.solve.quiet)
        fmt::print(stderr, "{}: {} values above 65504 were clamped: --pixels float keeps them\n",
                   command.output, clamped);
    if (!command.png.empty()) writePng(command.png, frame);
}

/// A name that promises another format than what is written.
void checkFormats(const RenderCommand& command) {
    const auto endsIn = [](const std::string& path, std::initializer_list<std::string_view> some) {
        std::string ending = std::filesystem::path(path).extension().string();
        for (char& c : ending) c = char(std::tolower(static_cast<unsigned char>(c)));
        return std::find(some.begin(), some.end(), ending) != some.end();
    };
    if (endsIn(command.output, {".png", ".jpg", ".jpeg", ".tif", ".tiff", ".hdr", ".bmp"}))
        throw CLI::ValidationError(
            "--output",
            fmt::format("'{}' would be OpenEXR: name it .exr; --png writes a PNG as well",
                        command.output));
    for (const std::string& output : {command.output, command.png})
        if (output == "-")
            throw CLI::ValidationError("--output", "pictures are written to files, not to '-'");
    if (endsIn(command.png, {".exr", ".jpg", ".jpeg", ".tif", ".tiff", ".hdr", ".bmp"}))
        throw CLI::ValidationError("--png",
                                   fmt::format("'{}' would be PNG: name it .png", command.png));
}

void run(RenderCommand command) {
    const ThreadLimit limit(command.solve.threads);
    checkFormats(command);
    checkNumbered(command.output, command.solve.frames);
    checkNumbered(command.png, command.solve.frames);
    const std::string& frames = command.solve.frames;
    const FrameRange range = frames.empty() ? FrameRange{} : frameRange(frames);
    std::vector<std::string>& outputs = command.solve.outputs;
    outputs = {command.solve.stats};
    for (const std::string& pattern : {command.output, command.png})
        for (std::string& name : everyName(pattern, range)) outputs.push_back(std::move(name));
    checkOutputs({command.solve.scene}, outputs);
    SceneSolution solution(command.solve);
    std::string said;
    for (int frame = range.first; frame <= range.last; ++frame) {
        if (frame > range.first) solution.show(frame);
        sayWhatIsAmiss(command, solution, said);
        writeFrame(command, solution, frame);
    }
    if (!command.solve.stats.empty()) writeStatistics(command.solve.stats, solution);
}

} // namespace

void addRenderCommand(CLI::App& app) {
    auto command = std::make_shared<RenderCommand>();
    CLI::App* const render = app.add_subcommand(
        "render", "A lit frame, without a display.\n"
                  "Example: penumbra render scenes/office.usda -o office.exr --png office.png");
    addSolveOptions(*render, command->solve);
    render->add_option("-o,--output", command->output, "OpenEXR file to write, pixels in cd/m^2")
        ->required();
    render->add_option("--png", command->png, "Also write a tone-mapped picture for people");
    render->add_option("--camera", command->camera, "Path of the camera (default: the first one)");
    render
        ->add_option("--quality", command->quality,
                     "drawn: the patches as OpenGL draws them\n"
                     "final: traced, direct light evaluated in every pixel")
        ->capture_default_str()
        ->check(CLI::IsMember({"drawn", "final"}));
    render->add_option("--pixels", command->pixels, "half (16 bit) or float (32 bit)")
        ->capture_default_str()
        ->check(CLI::IsMember({"half", "float"}));
    render->add_option("--width", command->width, "Of the picture [pixels]")
        ->capture_default_str()
        ->check(CLI::Range(1, 16384));
    render
        ->add_option("--height", command->height,
                     "Of the picture [pixels] (default: as the camera's film is shaped)")
        ->check(CLI::Range(1, 16384));
    render->callback([command] { run(*command); });
}

} // namespace penumbra
