#include "viewer/app/InteractiveRenderer.h"

#include "base/Error.h"
#include "scenegraph/Light.h"
#include "scenegraph/LitGeometry.h"
#include "scenegraph/Mesh.h"
#include "viewer/gl/DrawState.h"
#include "viewer/gl/LitItem.h"
#include "viewer/gl/LuminanceMeter.h"
#include "viewer/gl/Shaders.h"
#include "viewer/gl/TextureCache.h"
#include "viewer/gl/TonePass.h"
#include "viewer/gl/UnlitGeometry.h"
#include "viewer/overlay/OverlayPass.h"
#include "viewer/overlay/OverlayTarget.h"
#include "viewer/preview/DrawList.h"
#include "viewer/shadowmaps/MapPreview.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cassert>
#include <map>
#include <utility>

namespace penumbra {

namespace {

/// Texels that are uploaded after a picture: some ten milliseconds where they are compressed.
constexpr std::size_t kTexelsAPicture = 1 << 18;

/// The lights as the preview shader wants them, in the frame of the camera.
void setPreviewLighting(const ShaderProgram& program, const UnlitLighting& lighting,
                        const View& view) {
    std::vector<glm::vec4> places, axes, intensities;
    for (const UnlitLight& source : lighting.lights) {
        const glm::dvec3 place(view.worldToCamera * glm::dvec4(source.position, 1));
        const glm::dvec3 axis = glm::dmat3(view.worldToCamera) * source.axis;
        places.emplace_back(glm::vec3(place), source.area);
        axes.emplace_back(glm::vec3(axis), 0);
        intensities.emplace_back(source.intensity.r, source.intensity.g, source.intensity.b, 0);
    }
    program.set("lightCount", int(lighting.lights.size()));
    program.set("lightPositions", places);
    program.set("lightAxes", axes);
    program.set("lightIntensities", intensities);
    program.set("ambient", lighting.ambient);
}

} // namespace

struct InteractiveRenderer::Impl {
    explicit Impl(const InteractiveOptions& wanted) : options(wanted) {}

    void requireTarget(int width, int height);
    void drawLit(const std::vector<LitItem>& items);
    void drawPreviewed(const std::vector<LitItem>& items, MapPreview& maps);
    void setMaterial(const LitItem& item, const MaterialRange& range);
    void drawUnlit(const std::vector<UnlitItem>& items, const View& view,
                   const UnlitLighting& lighting);
    void drawUnlitItem(const UnlitItem& item, const View& view);
    void drawOverlay(const std::vector<LitItem>& items);

    InteractiveOptions options;
    bool reversed = canReverseDepth();
    ShaderProgram litProgram{kLitVertexShader, screenFragmentShader()};
    ShaderProgram previewProgram{kPreviewVertexShader, previewFragmentShader()};
    GeometryCache litCache;
    UnlitCache previewCache;
    TextureCache textures{{.compressed = options.compressed, .gradual = options.gradual}};
    std::optional<HdrTarget> target;
    LuminanceMeter meter;
    TonePass tonePass;
    OverlayPass overlayPass;
    OverlayPicture overlay;
    std::optional<OverlayTarget> overlayTarget; ///< while there is an overlay
    InteractiveStatistics statistics;
};

void InteractiveRenderer::Impl::requireTarget(int width, int height) {
    if (target && target->width() == width && target->height() == height) return;
    overlayTarget.reset();
    target.reset(); // first: two may be more than the card can hold
    target.emplace(width, height, options.samples, options.precision);
}

void InteractiveRenderer::Impl::setMaterial(const LitItem& item, const MaterialRange& range) {
    const LitMaterial& material = item.geometry->data().materials[range.material];
    textures.setMaterial(litProgram, material.reflectance, material.emission, material.textures);
}

void InteractiveRenderer::Impl::drawLit(const std::vector<LitItem>& items) {
    litProgram.use();
    for (const LitItem& item : items) {
        setPose(litProgram, item.place);
        item.gpu->bind();
        for (const MaterialRange& range : item.gpu->ranges()) {
            setMaterial(item, range);
            drawRange(range);
        }
    }
}

/// The same, but triangles that a previewed change may reach are drawn by the preview pass.
void InteractiveRenderer::Impl::drawPreviewed(const std::vector<LitItem>& items, MapPreview& maps) {
    std::vector<MapPreview::Runs> preview;
    litProgram.use();
    for (std::size_t i = 0; i < items.size(); ++i) {
        const LitItem& item = items[i];
        std::vector<IndexRuns> plain(item.gpu->ranges().size());
        std::map<std::pair<std::size_t, unsigned>, IndexRuns> reached; // by range and lights
        for (const TriangleChunk& chunk : item.gpu->chunks()) {
            const unsigned lights = maps.reaching(item, chunk);
            IndexRuns& runs = lights == 0 ? plain[chunk.range] : reached[{chunk.range, lights}];
            runs.add(chunk.firstIndex, chunk.indexCount);
        }
        for (auto& [by, runs] : reached)
            preview.push_back({i, by.first, by.second, std::move(runs)});
        setPose(litProgram, item.place);
        item.gpu->bind();
        for (std::size_t r = 0; r < plain.size(); ++r) {
            if (plain[r].empty()) continue;
            setMaterial(item, item.gpu->ranges()[r]);
            plain[r].draw();
        }
    }
    maps.draw(items, preview, textures);
}

void InteractiveRenderer::Impl::drawUnlit(const std::vector<UnlitItem>& items, const View& view,
                                          const UnlitLighting& lighting) {
    if (items.empty()) return;
    previewProgram.use();
    setPreviewLighting(previewProgram, lighting, view);
    for (const UnlitItem& item : items) drawUnlitItem(item, view);
}

void InteractiveRenderer::Impl::drawUnlitItem(const UnlitItem& item, const View& view) {
    const UnlitGeometry& geometry = previewCache.get(item);
    setPose(previewProgram, DrawPose(item.toWorld, view, reversed));
    const bool doubleSided = item.mesh && item.mesh->data().doubleSided;
    (doubleSided ? glDisable : glEnable)(GL_CULL_FACE);
    geometry.bind();
    for (const MaterialRange& range : geometry.ranges()) {
        const Material* const material =
            item.mesh ? item.mesh->data().materials[range.material].get() : nullptr;
        if (material)
            textures.setMaterial(previewProgram, material->reflectance(), material->emission(),
                                 material->textures());
        else
            textures.setMaterial(previewProgram, Rgb(), item.light->luminance(), {});
        drawRange(range);
    }
    if (doubleSided) glEnable(GL_CULL_FACE);
}

void InteractiveRenderer::Impl::drawOverlay(const std::vector<LitItem>& items) {
    if (overlay.empty()) {
        overlayTarget.reset();
        return;
    }
    if (!overlayTarget) overlayTarget.emplace(*target);
    overlayTarget->begin();
    overlayPass.draw(overlay, items, reversed);
    overlayTarget->resolve();
}

InteractiveRenderer::InteractiveRenderer(const InteractiveOptions& options)
    : impl_(std::make_unique<Impl>(options)) {}

InteractiveRenderer::~InteractiveRenderer() = default;

void InteractiveRenderer::drawScene(const DrawList& list, const View& view,
                                    const UnlitLighting& unlit, int width, int height,
                                    MapPreview* maps) {
    assert(width > 0 && height > 0);
    Impl& impl = *impl_;
    impl.requireTarget(width, height);
    impl.litCache.dropDead();
    impl.overlayPass.dropDead();
    const std::size_t lightBytes = impl.litCache.lightBytes();
    impl.previewCache.dropDead();
    impl.textures.dropDead();
    const std::size_t uploads = impl.litCache.uploads();
    const std::size_t lightUploads = impl.litCache.lightUploads();
    impl.litCache.needFactors(maps != nullptr);
    const std::vector<LitItem> lit = prepareLit(list, view, impl.reversed, impl.litCache);
    if (maps && !maps->active()) maps = nullptr;
    const std::size_t mapsDrawn = maps ? maps->prepare(impl.litCache) : 0;
    {
        const DrawState state(impl.reversed);
        impl.target->begin(state.clearDepth());
        if (maps)
            impl.drawPreviewed(lit, *maps);
        else
            impl.drawLit(lit);
        impl.drawUnlit(list.unlit, view, unlit);
        impl.drawOverlay(lit);
    }
    impl.target->resolve();
    impl.meter.measure(impl.target->texture());
    impl.statistics = {lit.size(),
                       list.unlit.size(),
                       list.culled,
                       impl.litCache.uploads() - uploads,
                       impl.litCache.lightUploads() - lightUploads,
                       impl.litCache.lightBytes() - lightBytes,
                       mapsDrawn,
                       impl.textures.refine(kTexelsAPicture)};
}

bool InteractiveRenderer::sharpenTextures() {
    return impl_->statistics.blurred = impl_->textures.refine(kTexelsAPicture);
}

void InteractiveRenderer::finishTextures() {
    while (sharpenTextures()) {
    }
}

void InteractiveRenderer::setOverlay(OverlayPicture overlay) {
    impl_->overlay = std::move(overlay);
}

void InteractiveRenderer::show(unsigned framebuffer, float middleGrey, ToneStyle style) {
    assert(impl_->target);
    const HdrTarget& target = *impl_->target;
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, target.width(), target.height());
    impl_->tonePass.draw({.luminances = target.texture(),
                          .samples = target.samplesTexture(),
                          .sampleCount = target.samples(),
                          .overlay = impl_->overlayTarget ? impl_->overlayTarget->texture() : 0},
                         middleGrey, style);
}

DisplayedPicture InteractiveRenderer::displayed(float middleGrey, ToneStyle style) {
    DisplayedPicture picture{impl_->target->width(), impl_->target->height(), {}};
    const GlObject framebuffer = makeFramebuffer(), buffer = makeRenderbuffer();
    glBindRenderbuffer(GL_RENDERBUFFER, buffer.name());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, picture.width, picture.height);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffer.name());
    show(framebuffer.name(), middleGrey, style);
    const std::size_t row = 3 * std::size_t(picture.width);
    picture.bytes.resize(row * std::size_t(picture.height));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    for (int y = 0; y < picture.height; ++y) // OpenGL has the lowest row first
        glReadPixels(0, picture.height - 1 - y, picture.width, 1, GL_RGB, GL_UNSIGNED_BYTE,
                     picture.bytes.data() + std::size_t(y) * row);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return picture;
}

std::optional<std::vector<float>> InteractiveRenderer::luminances(bool wait) {
    return impl_->meter.take(wait);
}

std::vector<Rgb> InteractiveRenderer::readLuminances() const {
    assert(impl_->target);
    return impl_->target->read();
}

const InteractiveStatistics& InteractiveRenderer::statistics() const {
    return impl_->statistics;
}

} // namespace penumbra
