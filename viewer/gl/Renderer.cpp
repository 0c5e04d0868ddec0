#include "viewer/gl/Renderer.h"

#include "base/Error.h"
#include "scenegraph/LitGeometry.h"
#include "viewer/gl/DrawState.h"
#include "viewer/gl/FrameTargets.h"
#include "viewer/gl/GeometryCache.h"
#include "viewer/gl/LitItem.h"
#include "viewer/gl/OffscreenContext.h"
#include "viewer/gl/ShaderProgram.h"
#include "viewer/gl/Shaders.h"
#include "viewer/gl/TextureCache.h"
#include "viewer/preview/DrawList.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <optional>
#include <string>
#include <vector>

namespace penumbra {

struct Renderer::Impl {
    explicit Impl(const RendererOptions& wanted) : options(wanted) {}

    std::vector<LitItem> prepare(const Group& root, const View& view);
    void drawPass(const ShaderProgram& program, const std::vector<LitItem>& items);
    void drawStrip(const std::vector<LitItem>& items, const Strip& strip, const ToneMap& tone,
                   FrameLayers& frame);
    void requireTargets(int width, int height);

    RendererOptions options;
    bool reversed = canReverseDepth();
    ShaderProgram lightProgram{kLitVertexShader, lightFragmentShader()};
    ShaderProgram surfaceProgram{kLitVertexShader, surfaceFragmentShader()};
    GeometryCache cache;
    TextureCache textures{{}};
    std::optional<FrameTargets> targets;
    RenderStatistics statistics;
};

std::vector<LitItem> Renderer::Impl::prepare(const Group& root, const View& view) {
    const std::size_t uploads = cache.uploads(), lightUploads = cache.lightUploads();
    cache.dropDead();
    textures.dropDead();
    const DrawList list = listVisible(root, Frustum(view.worldToClip()));
    std::vector<LitItem> items = prepareLit(list, view, reversed, cache);
    statistics = {};
    statistics.drawn = list.items.size();
    statistics.culled = list.culled;
    statistics.uploads = cache.uploads() - uploads;
    statistics.lightUploads = cache.lightUploads() - lightUploads;
    return items;
}

void Renderer::Impl::drawPass(const ShaderProgram& program, const std::vector<LitItem>& items) {
    program.use();
    for (const LitItem& item : items) {
        setPose(program, item.place);
        program.set("objectId", item.geometry->object().value);
        item.gpu->bind();
        for (const MaterialRange& range : item.gpu->ranges()) {
            const LitMaterial& material = item.geometry->data().materials[range.material];
            textures.setMaterial(program, material.reflectance, material.emission,
                                 material.textures);
            drawRange(range);
            ++statistics.drawCalls;
        }
    }
}

void Renderer::Impl::drawStrip(const std::vector<LitItem>& items, const Strip& strip,
                               const ToneMap& tone, FrameLayers& frame) {
    const DrawState state(reversed);
    // The whole picture's viewport, moved so that the strip lies at the targets' lower edge.
    glViewport(0, -(frame.height - strip.top - strip.height), frame.width, frame.height);
    targets->beginLight(state.clearDepth());
    drawPass(lightProgram, items);
    targets->beginSurface(state.clearDepth());
    drawPass(surfaceProgram, items);
    targets->readInto(frame, strip, tone);
}

void Renderer::Impl::requireTargets(int width, int height) {
    std::array<GLint, 2> most{};
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, most.data());
    if (width > most[0] || height > most[1])
        throw Error("a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                    " pixels is too large: this OpenGL draws at most " + std::to_string(most[0]) +
                    " x " + std::to_string(most[1]));
    const int rows = std::clamp(options.stripPixels / width, 1, height);
    if (targets && targets->width() == width && targets->height() == rows) return;
    targets.reset(); // first: two sets may be more than the card can hold
    targets.emplace(width, rows, options.samples);
}

Renderer::Renderer(const RendererOptions& options) : impl_(std::make_unique<Impl>(options)) {}

Renderer::~Renderer() = default;

FrameLayers Renderer::render(const Group& root, const View& view, int width, int height,
                             const ToneMap& tone) {
    assert(width > 0 && height > 0);
    impl_->requireTargets(width, height);
    const std::vector<LitItem> items = impl_->prepare(root, view);
    impl_->statistics.samples = impl_->targets->samples();
    FrameLayers frame(width, height);
    if (tone) frame.shown.resize(frame.pixelCount());
    const int rows = impl_->targets->height();
    for (int top = 0; top < height; top += rows)
        impl_->drawStrip(items, {top, std::min(rows, height - top)}, tone, frame);
    if (glGetError() != GL_NO_ERROR)
        throw Error("OpenGL: drawing failed; the graphics memory may be too small");
    return frame;
}

const RenderStatistics& Renderer::statistics() const {
    return impl_->statistics;
}

FrameLayers renderFrame(OffscreenContext& context, Renderer& renderer, const Group& root,
                        const View& view, int width, int height, const ToneMap& tone) {
    context.makeCurrent();
    return renderer.render(root, view, width, height, tone);
}

} // namespace penumbra
