#include "viewer/FrameTargets.h"

#include "scenegraph/Error.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstdint>
#include <string>

namespace penumbra {

namespace {

bool bindIfComplete(const GlObject& framebuffer) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

int supportedSamples(int wanted) {
    GLint most = 1;
    glGetIntegerv(GL_MAX_SAMPLES, &most);
    return std::clamp(wanted, 1, std::max(1, int(most)));
}

/// Calls copy(frame index, tile index) for every pixel of the tile, whose bottom row OpenGL has
/// first.
template <class Copy>
void forEachPixel(const FrameLayers& frame, const Tile& tile, Copy copy) {
    for (int y = 0; y < tile.height; ++y) {
        const std::size_t row = std::size_t(tile.height - 1 - y) * std::size_t(tile.width);
        for (int x = 0; x < tile.width; ++x)
            copy(frame.index(tile.x + x, tile.y + y), row + std::size_t(x));
    }
}

std::vector<glm::vec4> readColours(int attachment, const Tile& tile) {
    std::vector<glm::vec4> pixels(std::size_t(tile.width) * std::size_t(tile.height));
    glReadBuffer(GL_COLOR_ATTACHMENT0 + GLenum(attachment));
    glReadPixels(0, 0, tile.width, tile.height, GL_RGBA, GL_FLOAT, pixels.data());
    return pixels;
}

Rgb toRgb(const glm::vec4& pixel) {
    return {pixel.r, pixel.g, pixel.b};
}

} // namespace

FrameTargets::FrameTargets(int width, int height, int samples)
    : width_(width), height_(height), samples_(supportedSamples(samples)) {
    light_ = makeTarget({GL_RGBA32F, GL_RGBA32F, GL_RGBA32F}, true, samples_);
    while (!bindIfComplete(light_.framebuffer) && samples_ > 1) {
        samples_ /= 2;
        light_ = makeTarget({GL_RGBA32F, GL_RGBA32F, GL_RGBA32F}, true, samples_);
    }
    surface_ = makeTarget({GL_RGBA32F, GL_RGBA32F, GL_RGBA32F, GL_R32UI}, true, 1);
    resolved_ = makeTarget({GL_RGBA32F}, false, 1);
    for (const Target* target : {&light_, &surface_, &resolved_})
        if (!bindIfComplete(target->framebuffer))
            throw Error("OpenGL: can't make a float framebuffer of " + std::to_string(width) +
                        " x " + std::to_string(height) + " pixels");
}

FrameTargets::Target FrameTargets::makeTarget(const std::vector<unsigned>& colourFormats,
                                              bool depth, int samples) const {
    Target target;
    target.framebuffer = makeFramebuffer();
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer.name());
    const auto attach = [&](GLenum attachment, GLenum format) {
        const GlObject& buffer = target.buffers.emplace_back(makeRenderbuffer());
        glBindRenderbuffer(GL_RENDERBUFFER, buffer.name());
        glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples > 1 ? samples : 0, format, width_,
                                         height_);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer.name());
    };
    std::vector<GLenum> outputs;
    for (unsigned format : colourFormats) {
        outputs.push_back(GL_COLOR_ATTACHMENT0 + GLenum(outputs.size()));
        attach(outputs.back(), format);
    }
    if (depth) attach(GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT32F);
    glDrawBuffers(GLsizei(outputs.size()), outputs.data());
    return target;
}

void FrameTargets::beginLight(float clearDepth) const {
    const float black[4] = {0, 0, 0, 0};
    glBindFramebuffer(GL_FRAMEBUFFER, light_.framebuffer.name());
    for (int layer = 0; layer < 3; ++layer) glClearBufferfv(GL_COLOR, layer, black);
    glClearBufferfv(GL_DEPTH, 0, &clearDepth);
}

void FrameTargets::beginSurface(float clearDepth) const {
    const float nothing[4] = {0, 0, 0, FrameLayers::kNoDepth};
    const std::uint32_t noObject[4] = {ObjectId::kNone, 0, 0, 0};
    glBindFramebuffer(GL_FRAMEBUFFER, surface_.framebuffer.name());
    glClearBufferfv(GL_COLOR, 0, nothing);
    for (int layer = 1; layer < 3; ++layer) glClearBufferfv(GL_COLOR, layer, nothing);
    glClearBufferuiv(GL_COLOR, 3, noObject);
    glClearBufferfv(GL_DEPTH, 0, &clearDepth);
}

void FrameTargets::readInto(FrameLayers& frame, const Tile& tile) const {
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    readLight(frame, tile);
    readSurface(frame, tile);
}

void FrameTargets::readLight(FrameLayers& frame, const Tile& tile) const {
    std::vector<Rgb>* const layers[] = {&frame.beauty, &frame.direct, &frame.indirect};
    for (int layer = 0; layer < 3; ++layer) {
        glBindFramebuffer(GL_READ_FRAMEBUFFER, light_.framebuffer.name());
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.framebuffer.name());
        glReadBuffer(GL_COLOR_ATTACHMENT0 + GLenum(layer));
        glBlitFramebuffer(0, 0, tile.width, tile.height, 0, 0, tile.width, tile.height,
                          GL_COLOR_BUFFER_BIT, GL_NEAREST);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.framebuffer.name());
        const std::vector<glm::vec4> pixels = readColours(0, tile);
        forEachPixel(frame, tile, [&](std::size_t to, std::size_t from) {
            (*layers[layer])[to] = toRgb(pixels[from]);
            if (layer == 0) frame.alpha[to] = pixels[from].a;
        });
    }
}

void FrameTargets::readSurface(FrameLayers& frame, const Tile& tile) const {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, surface_.framebuffer.name());
    const std::vector<glm::vec4> normalAndDepth = readColours(0, tile);
    const std::vector<glm::vec4> albedo = readColours(1, tile);
    const std::vector<glm::vec4> illuminance = readColours(2, tile);
    std::vector<std::uint32_t> ids(std::size_t(tile.width) * std::size_t(tile.height));
    glReadBuffer(GL_COLOR_ATTACHMENT3);
    glReadPixels(0, 0, tile.width, tile.height, GL_RED_INTEGER, GL_UNSIGNED_INT, ids.data());
    forEachPixel(frame, tile, [&](std::size_t to, std::size_t from) {
        frame.normal[to] = glm::vec3(normalAndDepth[from]);
        frame.depth[to] = normalAndDepth[from].w;
        frame.albedo[to] = toRgb(albedo[from]);
        frame.illuminance[to] = toRgb(illuminance[from]);
        frame.objectId[to] = ObjectId{ids[from]};
    });
}

} // namespace penumbra
