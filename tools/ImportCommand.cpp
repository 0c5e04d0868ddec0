#include "base/Error.h"
#include "io/image/AtomicFile.h"
#include "io/model/ModelImport.h"
#include "io/usd/text/UsdLayerWriter.h"
#include "tools/Commands.h"
#include "tools/OutputFiles.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <map>
#include <memory>

namespace penumbra {

namespace {

struct ImportCommand {
    std::string model, output, unit;
    std::optional<UpAxis> up;
    bool allowOutside = false;
    bool quiet = false;
};

/// Metres of a unit by its name, or of a number of metres.
std::optional<double> unitOf(const std::string& text) {
    if (text.empty()) return std::nullopt;
    const std::map<std::string, double> units{{"mm", 0.001},  {"cm", 0.01},   {"m", 1},
                                              {"km", 1000.0}, {"in", 0.0254}, {"ft", 0.3048}};
    const auto known = units.find(text);
    if (known != units.end()) return known->second;
    double metres = 0;
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, metres);
    if (read.ec != std::errc() || read.ptr != end || !(metres >= 1e-9 && metres <= 1e9))
        throw CLI::ValidationError(
            "--unit",
            fmt::format("'{}' is neither mm, cm, m, km, in, ft nor a number of metres", text));
    return metres;
}

std::string counted(std::size_t count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

void report(const ImportedModel& model, const ImportCommand& command) {
    for (const Diagnostic& diagnostic : model.layer.diagnostics)
        fmt::print(stderr, "{}\n", diagnostic.line());
    for (const ImportedImage& image : model.images)
        fmt::print(stderr, "wrote {}\n",
                   (std::filesystem::path(command.output).parent_path() / image.name).string());
    const UsdValue* unit = find(model.layer.metadata, "metersPerUnit");
    const UsdValue* up = find(model.layer.metadata, "upAxis");
    fmt::print(stderr, "wrote {}: {}, {}, {}, {}, {}; {:g} m a unit, {} up\n", command.output,
               fmt::format("{} mesh{}", model.meshes, model.meshes == 1 ? "" : "es"),
               counted(model.faces, "face"), counted(model.materials, "material"),
               counted(model.lights, "light"), counted(model.cameras, "camera"),
               unit->numbers().front(), *up->text());
}

void run(const ImportCommand& command) {
    ImportOptions options;
    options.metersPerUnit = unitOf(command.unit);
    options.up = command.up;
    options.layer = command.output;
    if (!command.allowOutside) options.folders = SceneFolders(command.model);
    if (std::filesystem::path(command.output).extension() != ".usda")
        throw CLI::ValidationError(
            "--output", fmt::format("'{}' would be USD text: name it .usda", command.output));
    checkOutputs({command.model}, {command.output});
    const ImportedModel model = importModel(command.model, options);
    const std::filesystem::path folder = std::filesystem::path(command.output).parent_path();
    std::vector<std::string> outputs{command.output};
    for (const ImportedImage& image : model.images)
        outputs.push_back((folder / image.name).string());
    checkOutputs(model.files, outputs);
    for (std::size_t i = 0; i < model.images.size(); ++i)
        writeFileAtomically(outputs[i + 1], model.images[i].bytes);
    writeFileAtomically(command.output, usdLayerText(model.layer));
    if (!command.quiet) report(model, command);
}

} // namespace

void addImportCommand(CLI::App& app) {
    auto command = std::make_shared<ImportCommand>();
    CLI::App* const added = app.add_subcommand(
        "import", "A model of another format as a USD scene. It names what it assumes and leaves\n"
                  "out, a line each. The other commands open models directly as well.\n"
                  "Example: penumbra import kitchen.glb -o kitchen.usda");
    added
        ->add_option("MODEL", command->model,
                     "glTF (.gltf, .glb), OBJ, FBX, Collada (.dae), PLY or STL")
        ->required();
    added->add_option("-o,--output", command->output, "USD text file (.usda) to write")->required();
    added->add_option("--unit", command->unit,
                      "What a unit of the model is: mm, cm, m, km, in, ft or a number of metres\n"
                      "(default: what the file says; metres for OBJ, PLY and STL)");
    const std::map<std::string, UpAxis> axes{{"y", UpAxis::y}, {"z", UpAxis::z}};
    added
        ->add_option("--up", command->up,
                     "Which axis points up (default: what the file says; Y for OBJ and PLY,\n"
                     "Z for STL)")
        ->transform(CLI::CheckedTransformer(axes, CLI::ignore_case).description("{y,z}"))
        ->type_name("AXIS");
    added->add_flag("--allow-outside", command->allowOutside,
                    "Open buffers and materials outside of the model's folder, too");
    added->add_flag("--quiet", command->quiet, "Say nothing of what was assumed or left out");
    added->callback([command] { run(*command); });
}

} // namespace penumbra
