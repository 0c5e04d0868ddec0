// penumbra_popping [office|gallery]: what can be seen of fast shadows turning into soft ones.
//
//   --rays            fast shadows by rays, as where the processor draws; else by shadow maps
//   --element-size M  of the mesh; else the scene's
//   --direct-only     no indirect light: shadows are black, steps in them count for more
//   --motion          what should be seen in the middle of the drag is worked out, too
//   --variant N       0: a fade of 0.25 s and maps from 16 points of a light, 1: from one point
//   (not
//                     with --rays), 2: no fade; else all
//   --name N          names what the N worst pixels of the first frames and of the hand-over show
//   --hd              1280 x 720 pixels; else 640 x 360
//   --consistency     instead: how equal preview lighting and radiosity are where no shadow falls
//   --keep FOLDER     writes what was shown, what should have been, and the error, as PNG
//
// Columns: largest steps from grabbing, and of the first frames in motion; in motion, and from the
// release on: 99.9th percentile of pixels and most (see PopFigures.h), share of pixels above 1;
// excess variation; milliseconds of the clock until no vertex waits, until all has settled, and how
// much time the lighting thread had in percent of that of the script; frames until the error of
// 99.9 % and of all pixels can't be seen any more. Below: more of the first frames in motion; what
// frames took, by the clock (mean and longest) and of processors; light copied to the graphics
// card; the picture at rest in the end against that of a solution from scratch, as displayed in 8
// bits.
#include "Consistency.h"
#include "DragRun.h"

#include "base/Error.h"
#include "io/image/PngWriter.h"
#include "io/image/ToneCurve.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

namespace penumbra {

namespace {

const std::vector<DragScript> kScripts{
    {"office", "", "/World/Seat", {-0.5, -0.35, 0}},
    {"gallery", "", "/World/TwistedColumn", {0.7, 0.4, 0}},
};

constexpr int kAfterIndirect = 120; ///< frames after the release: its light takes longer

struct Variant {
    const char *byMaps, *byRays; ///< null: rays have no points to choose, it would be the first
    BlendOptions blend;
};
const std::vector<Variant> kVariants{
    {"16 maps, 0.25 s", "rays, 0.25 s", {.seconds = 0.25, .points = 16}},
    {"1 map, 0.25 s", nullptr, {.seconds = 0.25, .points = 1}},
    {"16 maps, no blend", "rays, no blend", {.seconds = 0, .points = 16}},
};

/// Writes frames as PNG: shown, exact, and the error around grey.
void keepFrames(const DragResult& r, glm::ivec2 size, const std::string& stem, std::size_t every) {
    const auto write = [&](const std::string& name, const auto& value) {
        std::vector<Rgb> pixels;
        for (int y = size.y - 1; y >= 0; --y)
            for (int x = 0; x < size.x; ++x) {
                const Rgb grey(float(value(std::size_t(y * size.x + x))));
                pixels.push_back(Rgb(std::clamp(grey.r, 0.0f, 1.0f)));
            }
        writePngBytes(name, size.x, size.y, displayBytes(pixels, size.x));
    };
    const double gain = r.toDisplay / 100; // 0.18 over middle grey
    const ToneMap tone = toneMap(float(kMiddleGrey / gain), ToneStyle::agx);
    const auto toned = [&](float nits) { return tone(Rgb(nits)).g; };
    for (std::size_t t = r.grabbed; t < r.frames.size(); t += every) {
        const FramePair& f = r.frames[t];
        if (f.exact.empty()) continue;
        const std::string name = stem + "-" + std::to_string(t);
        write(name + "-shown.png", [&](std::size_t i) { return toned(f.shown[i]); });
        write(name + "-exact.png", [&](std::size_t i) { return toned(f.exact[i]); });
        write(name + "-error.png",
              [&](std::size_t i) { return 0.2 + 2 * gain * (f.shown[i] - f.exact[i]); });
    }
}

PopFigures figures(const DragResult& result, std::size_t first, std::size_t end) {
    return popFigures(std::span(result.frames).subspan(first, end - first), result.toDisplay);
}

/// Frames after the release until the error can't be seen any more.
std::size_t framesToExact(const DragResult& result, double p) {
    std::size_t last = result.released;
    for (std::size_t t = result.released; t < result.frames.size(); ++t)
        if (visibleError(result.frames[t], result.toDisplay, p) > 1) last = t + 1;
    return last - result.released;
}

void report(const DragScript& script, const char* variant, const DragResult& r) {
    const std::size_t end = r.frames.size();
    const PopFigures grab = figures(r, r.grabbed - 1, r.moved);
    const PopFigures start = figures(r, r.moved - 1, r.moved + 2);
    const bool known = !r.frames[r.moved + 2].exact.empty();
    const PopFigures motion = known ? figures(r, r.moved, r.released) : PopFigures{};
    const PopFigures over = figures(r, r.released - 1, end);
    std::printf("%-8s %-20s | %5.2f %5.2f | %6.2f %6.2f | %6.2f %6.2f %6.2f %% | %6.3f | ",
                script.scene.c_str(), variant, grab.most, start.most, motion.p999, motion.most,
                over.p999, over.most, 100 * over.share, over.flicker);
    std::printf("%4.0f %5.0f %5.0f | %3zu %3zu\n", 1000 * r.readySeconds, 1000 * r.settledSeconds,
                100 * r.realSeconds / (double(end - r.released) / 60), framesToExact(r, 0.999),
                framesToExact(r, 1));
    std::printf(
        "         first frames: 99.9 %% %.2f, above 1 %.2f %%; copied to the card: %.0f kB a "
        "frame in motion, %.0f kB from the release on; from scratch: at most %d of 255, "
        "beyond 1 %.3f %%\n",
        start.p999, 100 * start.share, 1e-3 * r.dragBytes, 1e-3 * r.bytesAfter, r.fromScratchMost,
        100 * r.fromScratchBeyond);
    std::printf("         ms a frame, mean, longest and of processors:");
    const auto frames = [](const char* when, const FrameTimes& times) {
        std::printf(" %s %.1f, %.1f, %.1f;", when, 1000 * times.mean(), 1000 * times.longest,
                    1000 * times.meanWork());
    };
    frames("idle", r.idle);
    frames("turning", r.turning);
    frames("in motion", r.motion);
    std::printf("\n");
    const auto name = [&](const char* when, const std::vector<NamedStep>& worst) {
        for (const NamedStep& w : worst) {
            const FramePair &before = r.frames[w.step.frame - 1], &after = r.frames[w.step.frame];
            const std::size_t p = w.step.pixel;
            std::printf("         %s: %6.2f at pixel %zu, frame %zu: shown %.4g -> %.4g, should be "
                        "%.4g -> %.4g nit, %s at (%.3f, %.3f, %.3f)\n",
                        when, w.step.size, p, w.step.frame - r.grabbed, double(before.shown[p]),
                        double(after.shown[p]), double(before.exact[p]), double(after.exact[p]),
                        w.object.c_str(), w.position.x, w.position.y, w.position.z);
        }
    };
    name("first frames", r.worstAtStart);
    name("in motion   ", r.worstInMotion);
    name("hand-over   ", r.worstAtHandOver);
    std::fflush(stdout);
}

void reportConsistency(const std::string& scene, PreviewMethod by, float elementSize,
                       glm::ivec2 size) {
    const Consistency found = consistency(scene, by, elementSize, size);
    std::printf("%-8s %s: %zu lights, %zu pixels in no shadow: mean %.3f %%, median %.3f %%, 99 %% "
                "of them %.3f %%, "
                "most %.2f %%, above 1 %%: %.2f %%\n",
                scene.c_str(), by == PreviewMethod::rays ? "rays" : "maps", found.lights,
                found.pixels, 100 * found.mean, 100 * found.median, 100 * found.p99,
                100 * found.most, 100 * found.beyond);
}

/// What the command line asks for.
struct Asked {
    std::string only; ///< scene; empty: all
    PreviewMethod by = PreviewMethod::maps;
    glm::ivec2 size{640, 360};
    float elementSize = 0;
    bool indirect = true, motion = false, consistent = false;
    std::string keep; ///< folder for frames; empty: none are kept
    int variant = -1; ///< -1: all
    std::size_t named = 0;
};

Asked asked(int argc, char** argv) {
    Asked asked;
    for (int i = 1; i < argc; ++i) {
        const std::string argument = argv[i];
        if (argument == "--rays")
            asked.by = PreviewMethod::rays;
        else if (argument == "--direct-only")
            asked.indirect = false;
        else if (argument == "--motion")
            asked.motion = true;
        else if (argument == "--consistency")
            asked.consistent = true;
        else if (argument == "--variant" && i + 1 < argc)
            asked.variant = std::stoi(argv[++i]);
        else if (argument == "--name" && i + 1 < argc)
            asked.named = std::stoul(argv[++i]);
        else if (argument == "--keep" && i + 1 < argc)
            asked.keep = argv[++i];
        else if (argument == "--hd")
            asked.size = {1280, 720};
        else if (argument == "--element-size" && i + 1 < argc)
            asked.elementSize = std::stof(argv[++i]);
        else
            asked.only = argument;
    }
    return asked;
}

void play(const DragScript& script, int number, const Asked& asked) {
    const Variant& variant = kVariants[std::size_t(number)];
    const char* const name = asked.by == PreviewMethod::rays ? variant.byRays : variant.byMaps;
    if (!name || (asked.variant >= 0 && asked.variant != number)) return;
    DragOptions options;
    options.motion = asked.motion;
    options.named = asked.named;
    options.blend = variant.blend;
    options.blend.by = asked.by;
    options.size = asked.size;
    options.elementSize = asked.elementSize;
    options.indirect = asked.indirect;
    const DragResult result = runDrag(script, options);
    std::printf("%s: %zu elements, %zu lights previewed, by %s\n", script.scene.c_str(),
                result.elements, result.lights, result.card.c_str());
    report(script, name, result);
    if (!asked.keep.empty())
        keepFrames(result, options.size, asked.keep + "/" + script.scene + std::to_string(number),
                   4);
}

int run(int argc, char** argv) {
    const Asked what = asked(argc, argv);
    const auto isAsked = [&](const DragScript& script) { return script.scene == what.only; };
    if (!what.only.empty() && std::ranges::none_of(kScripts, isAsked))
        throw Error(what.only + ": no such drag (there are office and gallery)");
    if (!what.consistent)
        std::printf("                              |   start     |    motion     |       "
                    "hand-over        | flick |  ready settled real%% | frames\n");
    for (DragScript script : kScripts) {
        if (!what.only.empty() && what.only != script.scene) continue;
        if (what.indirect) script.after = kAfterIndirect;
        if (what.consistent)
            reportConsistency(script.scene, what.by, what.elementSize, what.size);
        else
            for (int number = 0; number < int(kVariants.size()); ++number)
                play(script, number, what);
    }
    return 0;
}

} // namespace

} // namespace penumbra

int main(int argc, char** argv) {
    try {
        return penumbra::run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "penumbra_popping: %s\n", error.what());
        return 1;
    }
}
