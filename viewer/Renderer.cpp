#include "viewer/Renderer.h"

#include "scenegraph/Error.h"
#include "scenegraph/LitGeometry.h"
#include "viewer/DrawList.h"
#include "viewer/FrameTargets.h"
#include "viewer/GeometryCache.h"
#include "viewer/OffscreenContext.h"
#include "viewer/ShaderProgram.h"
#include "viewer/Shaders.h"

#include <epoxy/gl.h>

#include <glm/gtc/matrix_inverse.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <optional>
#include <string>
#include <vector>

namespace penumbra {

namespace {

bool canReverseDepth() {
    return epoxy_gl_version() >= 45 || epoxy_has_gl_extension("GL_ARB_clip_control");
}

/// Clip space with z in [0, w], 1 near and 0 far, from OpenGL's z in [-w, w]: there floats, dense
/// around 0, and perspective, dense around the near plane, make up for each other.
glm::dmat4 reversedDepth() {
    glm::dmat4 matrix(1.0);
    matrix[2][2] = -0.5;
    matrix[3][2] = 0.5;
    return matrix;
}

/// Gives the state back, for others who draw in this context: ImGui, a window.
class DrawState {
public:
    explicit DrawState(bool reversed) : reversed_(reversed) {
        glEnable(GL_DEPTH_TEST);
        glEnable(GL_CULL_FACE);
        glCullFace(GL_BACK);
        glDepthMask(GL_TRUE);
        glDisable(GL_BLEND);
        glDisable(GL_SCISSOR_TEST);
        glDisable(GL_FRAMEBUFFER_SRGB);
        glDepthFunc(reversed ? GL_GREATER : GL_LESS);
        if (reversed) glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    }
    ~DrawState() {
        if (reversed_) glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
        glDepthFunc(GL_LESS);
        glDisable(GL_DEPTH_TEST);
        glDisable(GL_CULL_FACE);
        glFrontFace(GL_CCW);
        glUseProgram(0);
        glBindVertexArray(0);
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
    }
    DrawState(const DrawState&) = delete;
    DrawState& operator=(const DrawState&) = delete;

    float clearDepth() const { return reversed_ ? 0.0f : 1.0f; }

private:
    bool reversed_;
};

/// A place of a geometry with what the shaders need of it. Matrices are multiplied in double, so
/// that a camera and an object that are both far from the origin keep their digits.
struct PreparedItem {
    const LitGeometry* geometry = nullptr;
    const GpuGeometry* gpu = nullptr;
    glm::mat4 localToClip{1.0f};
    glm::vec4 localToDepth{0.0f};
    glm::mat3 normalToWorld{1.0f};
    bool mirrored = false;
};

} // namespace

struct Renderer::Impl {
    explicit Impl(const RendererOptions& wanted) : options(wanted) {}

    std::vector<PreparedItem> prepare(const Group& root, const View& view);
    void drawPass(const ShaderProgram& program, const std::vector<PreparedItem>& items);
    void drawStrip(const std::vector<PreparedItem>& items, const Strip& strip, FrameLayers& frame);
    void requireTargets(int width, int height);

    RendererOptions options;
    bool reversed = canReverseDepth();
    ShaderProgram lightProgram{kLitVertexShader, kLightFragmentShader};
    ShaderProgram surfaceProgram{kLitVertexShader, kSurfaceFragmentShader};
    GeometryCache cache;
    std::optional<FrameTargets> targets;
    RenderStatistics statistics;
};

std::vector<PreparedItem> Renderer::Impl::prepare(const Group& root, const View& view) {
    const std::size_t uploads = cache.uploads(), lightUploads = cache.lightUploads();
    cache.dropDead();
    const DrawList list = listVisible(root, Frustum(view.worldToClip()));
    const glm::dmat4 worldToClip =
        (reversed ? reversedDepth() : glm::dmat4(1.0)) * view.worldToClip();
    std::vector<PreparedItem> items;
    items.reserve(list.items.size());
    for (const DrawItem& item : list.items) {
        PreparedItem& prepared = items.emplace_back();
        prepared.geometry = item.geometry;
        prepared.gpu = &cache.get(item); // an unordered_map never moves its elements
        prepared.localToClip = glm::mat4(worldToClip * item.toWorld);
        // the camera looks along -Z: depth is minus the third row
        prepared.localToDepth = -glm::vec4(glm::transpose(view.worldToCamera * item.toWorld)[2]);
        const glm::dmat3 linear(item.toWorld);
        prepared.normalToWorld = glm::mat3(glm::inverseTranspose(linear));
        prepared.mirrored = glm::determinant(linear) < 0;
    }
    statistics = {};
    statistics.drawn = list.items.size();
    statistics.culled = list.culled;
    statistics.uploads = cache.uploads() - uploads;
    statistics.lightUploads = cache.lightUploads() - lightUploads;
    return items;
}

void Renderer::Impl::drawPass(const ShaderProgram& program,
                              const std::vector<PreparedItem>& items) {
    program.use();
    for (const PreparedItem& item : items) {
        glFrontFace(item.mirrored ? GL_CW : GL_CCW);
        program.set("localToClip", item.localToClip);
        program.set("localToDepth", item.localToDepth);
        program.set("normalToWorld", item.normalToWorld);
        program.set("objectId", item.geometry->object().value);
        item.gpu->bind();
        for (const MaterialRange& range : item.gpu->ranges()) {
            const LitMaterial& material = item.geometry->data().materials[range.material];
            program.set("reflectance", material.reflectance);
            program.set("emission", material.emission);
            glDrawElements(GL_TRIANGLES, GLsizei(range.indexCount), GL_UNSIGNED_INT,
                           reinterpret_cast<const void*>(range.firstIndex * sizeof(std::uint32_t)));
            ++statistics.drawCalls;
        }
    }
}

void Renderer::Impl::drawStrip(const std::vector<PreparedItem>& items, const Strip& strip,
                               FrameLayers& frame) {
    const DrawState state(reversed);
    // The whole picture's viewport, moved so that the strip lies at the targets' lower edge.
    glViewport(0, -(frame.height - strip.top - strip.height), frame.width, frame.height);
    targets->beginLight(state.clearDepth());
    drawPass(lightProgram, items);
    targets->beginSurface(state.clearDepth());
    drawPass(surfaceProgram, items);
    targets->readInto(frame, strip);
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

FrameLayers Renderer::render(const Group& root, const View& view, int width, int height) {
    assert(width > 0 && height > 0);
    impl_->requireTargets(width, height);
    const std::vector<PreparedItem> items = impl_->prepare(root, view);
    impl_->statistics.samples = impl_->targets->samples();
    FrameLayers frame(width, height);
    const int rows = impl_->targets->height();
    for (int top = 0; top < height; top += rows)
        impl_->drawStrip(items, {top, std::min(rows, height - top)}, frame);
    if (glGetError() != GL_NO_ERROR)
        throw Error("OpenGL: drawing failed; the graphics memory may be too small");
    return frame;
}

const RenderStatistics& Renderer::statistics() const {
    return impl_->statistics;
}

FrameLayers renderFrame(OffscreenContext& context, Renderer& renderer, const Group& root,
                        const View& view, int width, int height) {
    context.makeCurrent();
    return renderer.render(root, view, width, height);
}

} // namespace penumbra
