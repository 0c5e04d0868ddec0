#include "viewer/gl/FrameTargets.h"

#include "base/Error.h"
#include "base/Parallel.h"

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
    GLint most = 1, mostOfTextures = 1;
    glGetIntegerv(GL_MAX_SAMPLES, &most);
    glGetIntegerv(GL_MAX_COLOR_TEXTURE_SAMPLES, &mostOfTextures);
    return std::clamp(wanted, 1, std::max(1, int(std::min(most, mostOfTextures))));
}

const char* const kOneSampleShader = R"(#version 330 core
uniform sampler2DMS samples;
uniform int number;
out vec4 colour;
void main() {
    colour = texelFetch(samples, ivec2(gl_FragCoord.xy), number);
}
)";

/// Calls copy(frame index, strip index) for every pixel; OpenGL has the bottom row first.
template <class Copy>
void forEachPixel(const FrameLayers& frame, const Strip& strip, Copy copy) {
    for (int y = 0; y < strip.height; ++y) {
        const std::size_t to = frame.index(0, strip.top + y);
        const std::size_t from = frame.index(0, strip.height - 1 - y);
        for (std::size_t x = 0; x < std::size_t(frame.width); ++x) copy(to + x, from + x);
    }
}

/// Calls act(row), rows side by side.
template <class Act>
void forEachRow(const Strip& strip, Act act) {
    parallelFor(std::size_t(strip.height), 8, [&](std::size_t first, std::size_t last) {
        for (std::size_t y = first; y < last; ++y) act(int(y));
    });
}

std::vector<glm::vec4> readColours(int attachment, int width, int height) {
    std::vector<glm::vec4> pixels(std::size_t(width) * std::size_t(height));
    glReadBuffer(GL_COLOR_ATTACHMENT0 + GLenum(attachment));
    glReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, pixels.data());
    return pixels;
}

Rgb toRgb(const glm::vec4& pixel) {
    return {pixel.r, pixel.g, pixel.b};
}

} // namespace

FrameTargets::FrameTargets(int width, int height, int samples)
    : width_(width), height_(height), samples_(supportedSamples(samples)) {
    makeLight();
    while (!bindIfComplete(light_.framebuffer) && samples_ > 1) {
        samples_ /= 2;
        makeLight();
    }
    surface_ = makeTarget({GL_RGBA32F, GL_RGBA32F, GL_RGBA32F, GL_R32UI}, true, 1);
    resolved_ = makeTarget({GL_RGBA32F}, false, 1);
    for (const Target* target : {&light_, &surface_, &resolved_})
        if (!bindIfComplete(target->framebuffer))
            throw Error("OpenGL: can't make a float framebuffer of " + std::to_string(width) +
                        " x " + std::to_string(height) + " pixels");
}

void FrameTargets::makeLight() {
    light_ = makeTarget({GL_RGBA32F, GL_RGBA32F, GL_RGBA32F}, true, samples_);
}

FrameTargets::Target FrameTargets::makeTarget(const std::vector<unsigned>& colourFormats,
                                              bool depth, int samples) const {
    Target target;
    target.framebuffer = makeFramebuffer();
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer.name());
    const auto attachTexture = [&](GLenum attachment, GLenum format) {
        const GlObject& texture = target.textures.emplace_back(makeTexture());
        glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, texture.name());
        glTexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, samples, format, width_, height_,
                                GL_TRUE);
        glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, 0);
        glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D_MULTISAMPLE,
                               texture.name(), 0);
    };
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
        if (samples > 1 && outputs.size() == 1)
            attachTexture(outputs.back(), format);
        else
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

void FrameTargets::readInto(FrameLayers& frame, const Strip& strip, const ToneMap& tone) {
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    readLight(frame, strip);
    readSurface(frame, strip);
    if (tone) readShown(frame, strip, tone);
}

void FrameTargets::readShown(FrameLayers& frame, const Strip& strip, const ToneMap& tone) {
    if (!oneSample_) oneSample_.emplace(kOneSampleShader);
    const float share = 1.0f / float(samples_);
    for (int sample = 0; sample < samples_; ++sample) {
        std::vector<glm::vec4> pixels;
        if (samples_ > 1) {
            glBindFramebuffer(GL_FRAMEBUFFER, resolved_.framebuffer.name());
            glViewport(0, 0, width_, strip.height);
            glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, light_.textures.front().name());
            oneSample_->program().use();
            oneSample_->program().set("samples", 0);
            oneSample_->program().set("number", sample);
            oneSample_->draw();
            glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, 0);
            pixels = readColours(0, width_, strip.height);
        }
        forEachRow(strip, [&](int y) {
            for (int x = 0; x < frame.width; ++x) {
                const std::size_t to = frame.index(x, strip.top + y);
                const std::size_t from = frame.index(x, strip.height - 1 - y);
                const Rgb colour = pixels.empty() ? frame.beauty[to] : toRgb(pixels[from]);
                frame.shown[to] += tone(colour) * share;
            }
        });
    }
}

void FrameTargets::readLight(FrameLayers& frame, const Strip& strip) const {
    std::vector<Rgb>* const layers[] = {&frame.beauty, &frame.direct, &frame.indirect};
    for (int layer = 0; layer < 3; ++layer) {
        glBindFramebuffer(GL_READ_FRAMEBUFFER, light_.framebuffer.name());
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.framebuffer.name());
        glReadBuffer(GL_COLOR_ATTACHMENT0 + GLenum(layer));
        glBlitFramebuffer(0, 0, width_, strip.height, 0, 0, width_, strip.height,
                          GL_COLOR_BUFFER_BIT, GL_NEAREST);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.framebuffer.name());
        const std::vector<glm::vec4> pixels = readColours(0, width_, strip.height);
        forEachPixel(frame, strip, [&](std::size_t to, std::size_t from) {
            (*layers[layer])[to] = toRgb(pixels[from]);
            if (layer == 0) frame.alpha[to] = pixels[from].a;
        });
    }
}

void FrameTargets::readSurface(FrameLayers& frame, const Strip& strip) const {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, surface_.framebuffer.name());
    const std::vector<glm::vec4> normalAndDepth = readColours(0, width_, strip.height);
    const std::vector<glm::vec4> albedo = readColours(1, width_, strip.height);
    const std::vector<glm::vec4> illuminance = readColours(2, width_, strip.height);
    std::vector<std::uint32_t> ids(std::size_t(width_) * std::size_t(strip.height));
    glReadBuffer(GL_COLOR_ATTACHMENT3);
    glReadPixels(0, 0, width_, strip.height, GL_RED_INTEGER, GL_UNSIGNED_INT, ids.data());
    forEachPixel(frame, strip, [&](std::size_t to, std::size_t from) {
        frame.normal[to] = glm::vec3(normalAndDepth[from]);
        frame.depth[to] = normalAndDepth[from].w;
        frame.albedo[to] = toRgb(albedo[from]);
        frame.illuminance[to] = toRgb(illuminance[from]);
        frame.objectId[to] = ObjectId{ids[from]};
    });
}

} // namespace penumbra
