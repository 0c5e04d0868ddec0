#include "base/Parallel.h"
#include "io/image/Exposure.h"
#include "io/image/ExrWriter.h"
#include "io/image/PngWriter.h"
#include "radiosity/query/DrawnView.h"
#include "radiosity/query/FallbackLight.h"
#include "radiosity/query/LitSurface.h"
#include "radiosity/query/TracedPicture.h"
#include "scenegraph/Camera.h"
#include "tools/CameraChoice.h"
#include "tools/Commands.h"
#include "tools/DisplayOptions.h"
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
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace penumbra {

namespace {

struct RenderCommand {
    SolveSettings solve;
    DisplaySettings display;
    std::string output, png; ///< patterns, with '#' and "{camera}"; empty: none
    std::vector<std::string> cameras;
    std::string quality = "drawn";
    std::string pixels = "half";
    std::string fallback = "ambient";
    int width = 1280;
    int height = 0; ///< 0: the camera's shape
};

/// The pictures of one camera: where they go, with '#' for the frame's number.
struct Shot {
    std::string camera; ///< its path; empty: the first one
    std::string output, png;
};

constexpr std::string_view kCameraPlace = "{camera}";

/// A pattern names one file for each camera.
void checkNamed(const std::string& pattern, const RenderCommand& command) {
    const bool named = pattern.find(kCameraPlace) != std::string::npos;
    if (named && command.cameras.empty())
        throw CLI::ValidationError(pattern, "{camera} is for those that --camera names");
    if (!pattern.empty() && !named && command.cameras.size() > 1)
        throw CLI::ValidationError(
            pattern, "every camera would overwrite the one before: put {camera} in the name");
}

std::vector<Shot> shotsOf(const RenderCommand& command) {
    for (const std::string& pattern : {command.output, command.png}) checkNamed(pattern, command);
    if (command.cameras.empty()) return {{"", command.output, command.png}};
    const std::vector<std::string> names = namesForFiles(command.cameras);
    std::vector<Shot> shots;
    for (std::size_t i = 0; i < names.size(); ++i)
        shots.push_back({command.cameras[i], withCamera(command.output, names[i]),
                         withCamera(command.png, names[i])});
    return shots;
}

/// Says what a camera can't be taken as it is for.
std::string whatIsAmissWith(const std::string& path, const RenderCommand& command,
                            const SceneSolution& solution) {
    const auto* const camera = chooseCamera(solution.placed(), path, command.solve.scene);
    if (!camera) return {};
    const std::string amiss = whatIsAmiss(camera->node->lens(), camera->toWorld);
    if (amiss.empty()) return {};
    return fmt::format("{}: warning: camera {}: {}", command.solve.scene, camera->path, amiss);
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

/// Writes the pictures of a solution, one camera after the other, and says what it wrote.
class FrameWriter {
public:
    FrameWriter(const RenderCommand& command, SceneSolution& solution)
        : command_(command), solution_(solution) {}

    void write(const Shot& shot, int number);

private:
    View chooseView(const Shot& shot);
    FrameLayers draw(const View& view, const Lighting& light, const ToneMap& tone);
    void writeExrFile(const std::string& path, const FrameLayers& frame, const View& view);
    float middleGrey(const View& view, const Lighting& light);
    /// The solution's, or what stands in for it where the scene has had no lights so far.
    Lighting lightFor(const View& view) const;
    void say(const std::string& line) const {
        if (!command_.solve.quiet) fmt::print(stderr, "{}\n", line);
    }

    const RenderCommand& command_;
    SceneSolution& solution_;
    bool lit_ = false;           ///< there is light, or was: what goes out leaves the dark
    int height_ = 0;             ///< of the picture [pixels]
    std::set<std::string> said_; ///< warnings are said once, also while frames are played
};

View FrameWriter::chooseView(const Shot& shot) {
    const PlacedScene& placed = solution_.placed();
    const std::string& file = command_.solve.scene;
    height_ = command_.height > 0 ? command_.height
                                  : heightFor(placed, shot.camera, file, command_.width);
    std::string warning = whatIsAmissWith(shot.camera, command_, solution_);
    if (placed.cameras.empty())
        warning = file + ": no camera in the file: the whole scene is framed from above";
    if (!warning.empty() && said_.insert(warning).second) say(warning);
    return viewOf(placed, solution_.scene().upAxis, shot.camera, file, command_.width, height_);
}

Lighting FrameWriter::lightFor(const View& view) const {
    return lit_ ? solution_.lighting() : fallbackLight(solution_.patches(), view);
}

float FrameWriter::middleGrey(const View& view, const Lighting& light) {
    if (command_.display.exposure) return middleGreyAt(*command_.display.exposure);
    const std::vector<float> metered =
        solution_.timed("meter", [&] { return meterView(solution_.patches(), view, light); });
    return middleGreyOf(metered).value_or(kUnmeasuredGrey);
}

FrameLayers FrameWriter::draw(const View& view, const Lighting& light, const ToneMap& tone) {
    if (command_.quality == "final") {
        FinalOptions options;
        options.tone = tone;
        options.progress = [&](double done) { solution_.progress().show("tracing", done); };
        return traceFrame(solution_.patches(), solution_.rays(), light, view, command_.width,
                          height_, options);
    }
    OffscreenContext context(std::size_t(command_.width) * std::size_t(height_));
    Renderer renderer;
    const LitBranch lit(solution_.patches(), light);
    return renderFrame(context, renderer, lit, view, command_.width, height_, tone);
}

void FrameWriter::writeExrFile(const std::string& path, const FrameLayers& frame,
                               const View& view) {
    ExrOptions options;
    options.half = command_.pixels == "half";
    const std::size_t clamped = solution_.timed("write", [&] {
        return writeExr(path, frame, view, metadata(command_, solution_), options);
    });
    if (clamped > 0)
        say(fmt::format("{}: {} values above 65504 were clamped: --pixels float keeps them", path,
                        clamped));
    say(fmt::format("wrote {}: {} x {} pixels in cd/m^2", path, frame.width, frame.height));
}

/// Objects are numbered as the scene has them: what was meshed anew on the way keeps its number.
void numberAsPlaced(FrameLayers& frame, const PatchSet& patches, const PlacedScene& placed) {
    std::unordered_map<std::string_view, ObjectId> places;
    for (std::uint32_t o = 0; o < placed.objects.size(); ++o)
        places.emplace(placed.objects[o].path, ObjectId{o});
    std::vector<ObjectId> numbers;
    for (std::uint32_t o = 0; o < patches.objects.size(); ++o) {
        const std::string& path = patches.objects[o].path;
        const bool same = o < placed.objects.size() && placed.objects[o].path == path;
        const auto found = places.find(path);
        numbers.push_back(same || found == places.end() ? ObjectId{o} : found->second);
    }
    for (ObjectId& object : frame.objectId)
        if (object.value < numbers.size()) object = numbers[object.value];
}

void FrameWriter::write(const Shot& shot, int number) {
    const View view = chooseView(shot);
    lit_ |= hasLights(solution_.placed());
    const std::string output = numberedPath(shot.output, number);
    const std::string png = numberedPath(shot.png, number);
    const ToneStyle style = command_.display.tone.value_or(ToneStyle::agx);
    const Lighting light = lightFor(view);
    const float grey = png.empty() ? 1 : middleGrey(view, light);
    FrameLayers frame = solution_.timed(
        "draw", [&] { return draw(view, light, png.empty() ? ToneMap() : toneMap(grey, style)); });
    numberAsPlaced(frame, solution_.patches(), solution_.placed());
    solution_.progress().clear();
    if (!output.empty()) writeExrFile(output, frame, view);
    if (png.empty()) return;
    solution_.timed("write", [&] { writePng(png, frame); });
    say(fmt::format("wrote {}: {} x {} pixels, exposure {:.2f} EV, tone {}", png, frame.width,
                    frame.height, exposureValueOf(grey), kToneStyleNames[std::size_t(style)]));
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
            fmt::format("'{}' would be OpenEXR: name it .exr; --png writes a PNG", command.output));
    for (const std::string& output : {command.output, command.png})
        if (output == "-")
            throw CLI::ValidationError("--output", "pictures are written to files, not to '-'");
    if (endsIn(command.png, {".exr", ".jpg", ".jpeg", ".tif", ".tiff", ".hdr", ".bmp"}))
        throw CLI::ValidationError("--png",
                                   fmt::format("'{}' would be PNG: name it .png", command.png));
}

/// A scene without lights is shown by a headlight, and that is said; or it is refused.
void checkLights(const RenderCommand& command, const SceneSolution& solution) {
    if (hasLights(solution.placed())) return;
    if (command.fallback == "none")
        throw SceneFileError({command.solve.scene}, std::string(kNoLights));
    if (!command.solve.quiet)
        fmt::print(stderr,
                   "{}: warning: {}: shown by a headlight and even light from all round "
                   "(--fallback-light none refuses)\n",
                   command.solve.scene, kNoLights);
}

void run(RenderCommand command) {
    const ThreadLimit limit(command.solve.threads);
    if (command.output.empty() && command.png.empty())
        throw CLI::ValidationError("render", "nothing to write: give --output, --png or both");
    checkFormats(command);
    checkNumbered(command.output, command.solve.frames);
    checkNumbered(command.png, command.solve.frames);
    const std::vector<Shot> shots = shotsOf(command);
    const std::string& frames = command.solve.frames;
    const FrameRange range = frames.empty() ? FrameRange{} : frameRange(frames);
    std::vector<std::string>& outputs = command.solve.outputs;
    outputs = {command.solve.stats};
    for (const Shot& shot : shots)
        for (const std::string& pattern : {shot.output, shot.png})
            for (std::string& name : everyName(pattern, range)) outputs.push_back(std::move(name));
    checkOutputs({command.solve.scene}, outputs);
    SceneSolution solution(command.solve);
    for (const Shot& shot : shots) // all names first, and then the pictures
        chooseCamera(solution.placed(), shot.camera, command.solve.scene);
    checkLights(command, solution);
    FrameWriter writer(command, solution);
    for (int frame = range.first; frame <= range.last; ++frame) {
        if (frame > range.first) solution.show(frame);
        for (const Shot& shot : shots) writer.write(shot, frame);
    }
    if (!command.solve.stats.empty()) writeStatistics(command.solve.stats, solution);
    solution.warn();
}

} // namespace

void addRenderCommand(CLI::App& app) {
    auto command = std::make_shared<RenderCommand>();
    CLI::App* const render = app.add_subcommand(
        "render", "A lit frame, without a display.\n"
                  "Example: penumbra render scenes/office.usda --png office.png");
    addSolveOptions(*render, command->solve);
    render->add_option("-o,--output", command->output,
                       "OpenEXR file to write: all layers, pixels in cd/m^2");
    render->add_option("--png", command->png,
                       "PNG file to write: the picture for people, as the window shows it");
    render
        ->add_option("--camera", command->cameras,
                     "Path of the camera (default: the first one). Given several times, all of\n"
                     "them are pictured in one run: a {camera} in the name of a picture\n"
                     "becomes the name of the camera")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("PATH ...");
    addDisplayOptions(*render, command->display, "agx");
    render
        ->add_option("--quality", command->quality,
                     "drawn: the patches as OpenGL draws them\n"
                     "final: traced, direct light evaluated in every pixel")
        ->capture_default_str()
        ->check(CLI::IsMember({"drawn", "final"}));
    render
        ->add_option(
            "--fallback-light", command->fallback,
            "What a scene without lights is shown by: ambient (a headlight with even light\n"
            "from all round, 100 lux together, no shadows), or none: it is refused")
        ->capture_default_str()
        ->check(CLI::IsMember({"ambient", "none"}));
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
