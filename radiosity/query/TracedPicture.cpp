#include "radiosity/query/TracedPicture.h"

#include "base/Parallel.h"
#include "radiosity/query/LitSurface.h"
#include "radiosity/rays/Margins.h"
#include "radiosity/rows/EmitterSender.h"

#include <algorithm>
#include <atomic>
#include <numbers>

namespace penumbra {

namespace {

constexpr int kShadowSamples = 64; ///< an emitter and pixel

/// What one primary ray sees.
struct RaySample {
    bool met = false;
    Rgb emission, direct, indirect; ///< [nit]
    Rgb albedo, illuminance;
    glm::vec3 position{}, normal{};
    ObjectId object;
};

class FrameTracer {
public:
    FrameTracer(const PatchSet& patches, const RayScene& rays, const Lighting& lighting,
                const View& view, int width, int height)
        : patches_(patches), rays_(rays), surface_(patches, lighting), view_(view),
          clipToWorld_(glm::inverse(view.worldToClip())), width_(width), height_(height) {
        for (const Emitter& emitter : patches.emitters)
            if (patches.objects[emitter.object.value].present)
                emitters_.emplace_back(emitter, kShadowSamples, kShadowSamples);
    }

    /// \param x,y       position in the picture [pixel], top left is (0, 0)
    /// \param firstShadow which of the shadow samples to use, and how many
    RaySample trace(double x, double y, int firstShadow, int shadows) const {
        const glm::dvec2 ndc(2 * x / width_ - 1, 1 - 2 * y / height_);
        const glm::dvec4 a = clipToWorld_ * glm::dvec4(ndc, -1, 1);
        const glm::dvec4 b = clipToWorld_ * glm::dvec4(ndc, 1, 1);
        const glm::dvec3 origin = glm::dvec3(a) / a.w;
        const glm::vec3 direction(glm::normalize(glm::dvec3(b) / b.w - origin));
        RaySample out;
        const auto hit = surface_.trace(glm::vec3(origin), direction);
        if (!hit) return out;
        out.met = true;
        out.position = hit->position;
        out.normal = hit->normal;
        out.object = patches_.elementObject[hit->element];
        out.albedo = hit->reflectance;
        const float hover = hoverAt(patches_.skin, hit->position);
        const Receiver receiver{hit->position + hover * hit->normal, hit->normal};
        Rgb lux;
        if (maxChannel(hit->reflectance) > 0)
            for (const EmitterSender& sender : emitters_) {
                const float factor = sender.formFactor(receiver);
                if (!(factor > 0)) continue;
                lux += factor * sender.visibility(rays_, receiver, firstShadow, shadows) *
                       sender.emitter().exitance;
            }
        constexpr float kInversePi = std::numbers::inv_pi_v<float>;
        out.emission = hit->emission;
        out.direct = kInversePi * (hit->reflectance * lux);
        out.indirect = kInversePi * (hit->reflectance * hit->indirect);
        out.illuminance = lux + hit->indirect;
        return out;
    }

    void tracePixel(int x, int y, const FinalOptions& options, FrameLayers& frame) const {
        const std::size_t at = frame.index(x, y);
        const int side = options.raysPerSide, count = side * side;
        const int shadows = std::max(16, kShadowSamples / count / 16 * 16);
        float met = 0;
        Rgb emission;
        for (int i = 0; i < count; ++i) {
            const int column = i % side, row = i / side;
            const double dx = (column + 0.5) / side, dy = (row + 0.5) / side;
            const RaySample sample = trace(x + dx, y + dy, i * shadows % kShadowSamples, shadows);
            if (options.tone)
                frame.shown[at] += options.tone(sample.emission + sample.direct + sample.indirect) *
                                   (1.0f / float(count));
            if (!sample.met) continue;
            met += 1;
            emission += sample.emission;
            frame.direct[at] += sample.direct;
            frame.indirect[at] += sample.indirect;
        }
        const float share = 1.0f / float(count);
        frame.direct[at] *= share;
        frame.indirect[at] *= share;
        frame.alpha[at] = met * share;
        frame.beauty[at] = share * emission + frame.direct[at] + frame.indirect[at];
        const RaySample centre = trace(x + 0.5, y + 0.5, 0, 16);
        if (!centre.met) return;
        frame.albedo[at] = centre.albedo;
        frame.illuminance[at] = centre.illuminance;
        frame.normal[at] = centre.normal;
        frame.objectId[at] = centre.object;
        frame.depth[at] = float(-(view_.worldToCamera * glm::dvec4(centre.position, 1)).z);
    }

private:
    const PatchSet& patches_;
    const RayScene& rays_;
    LitSurface surface_;
    const View& view_;
    glm::dmat4 clipToWorld_;
    int width_, height_;
    std::vector<EmitterSender> emitters_;
};

} // namespace

FrameLayers traceFrame(const PatchSet& patches, const RayScene& rays, const Lighting& lighting,
                       const View& view, int width, int height, const FinalOptions& options) {
    FrameLayers frame(width, height);
    if (options.tone) frame.shown.resize(frame.pixelCount());
    const FrameTracer tracer(patches, rays, lighting, view, width, height);
    std::atomic<int> rows{0};
    parallelFor(std::size_t(height), 2, [&](std::size_t first, std::size_t last) {
        for (std::size_t y = first; y < last; ++y)
            for (int x = 0; x < width; ++x) tracer.tracePixel(x, int(y), options, frame);
        rows += int(last - first);
        if (options.progress) options.progress(double(rows) / height);
    });
    return frame;
}

} // namespace penumbra
