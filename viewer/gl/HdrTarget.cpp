#include "viewer/gl/HdrTarget.h"

#include "base/Error.h"

#include <epoxy/gl.h>

#include <glm/glm.hpp>

#include <algorithm>
#include <string>

namespace penumbra {

namespace {

GlObject colourTexture(GLenum format, int width, int height) {
    GlObject texture = makeTexture();
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GLint(format), width, height, 0, GL_RGBA, GL_FLOAT, nullptr);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glTexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
    glBindTexture(GL_TEXTURE_2D, 0);
    return texture;
}

GlObject renderbuffer(GLenum attachment, GLenum format, int samples, int width, int height) {
    GlObject buffer = makeRenderbuffer();
    glBindRenderbuffer(GL_RENDERBUFFER, buffer.name());
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples > 1 ? samples : 0, format, width,
                                     height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer.name());
    return buffer;
}

GlObject sampledTexture(GLenum format, int samples, int width, int height) {
    GlObject texture = makeTexture();
    glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, texture.name());
    glTexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, samples, format, width, height, GL_TRUE);
    glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, 0);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D_MULTISAMPLE,
                           texture.name(), 0);
    return texture;
}

bool complete() {
    return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

} // namespace

HdrTarget::HdrTarget(int width, int height, int samples, Precision precision)
    : width_(width), height_(height), samples_(samples) {
    const GLenum format = precision == Precision::half ? GL_RGBA16F : GL_RGBA32F;
    colour_ = colourTexture(format, width, height);
    resolved_ = makeFramebuffer();
    glBindFramebuffer(GL_FRAMEBUFFER, resolved_.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_.name(), 0);
    GLint most = 1, mostOfTextures = 1;
    glGetIntegerv(GL_MAX_SAMPLES, &most);
    glGetIntegerv(GL_MAX_COLOR_TEXTURE_SAMPLES, &mostOfTextures);
    samples_ = std::clamp(samples, 1, std::max(1, int(std::min(most, mostOfTextures))));
    while (!makeSamples(format, samples_)) {
        if (samples_ == 1)
            throw Error("OpenGL: can't make a float framebuffer of " + std::to_string(width) +
                        " x " + std::to_string(height) + " pixels");
        samples_ /= 2;
    }
}

bool HdrTarget::makeSamples(unsigned format, int samples) {
    if (samples > 1) {
        drawn_ = makeFramebuffer();
        glBindFramebuffer(GL_FRAMEBUFFER, drawn_.name());
        sampledColour_ = sampledTexture(format, samples, width_, height_);
    } else {
        drawn_ = GlObject();
        sampledColour_ = GlObject();
        glBindFramebuffer(GL_FRAMEBUFFER, resolved_.name());
    }
    depth_ = renderbuffer(GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT32F, samples, width_, height_);
    return complete();
}

void HdrTarget::begin(float clearDepth) const {
    const float nothing[4] = {0, 0, 0, 0};
    glBindFramebuffer(GL_FRAMEBUFFER, samples_ > 1 ? drawn_.name() : resolved_.name());
    glViewport(0, 0, width_, height_);
    glClearBufferfv(GL_COLOR, 0, nothing);
    glClearBufferfv(GL_DEPTH, 0, &clearDepth);
}

void HdrTarget::resolve() const {
    if (samples_ == 1) return;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn_.name());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.name());
    glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT,
                      GL_NEAREST);
}

std::vector<Rgb> HdrTarget::read() const {
    std::vector<Rgb> pixels(std::size_t(width_) * std::size_t(height_));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.name());
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadPixels(0, 0, width_, height_, GL_RGB, GL_FLOAT, pixels.data());
    return pixels;
}

} // namespace penumbra
