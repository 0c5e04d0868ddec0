#include "viewer/overlay/OverlayTarget.h"

#include "base/Error.h"
#include "viewer/gl/HdrTarget.h"

#include <epoxy/gl.h>

namespace penumbra {

OverlayTarget::OverlayTarget(const HdrTarget& under)
    : width_(under.width()), height_(under.height()), resolved_(makeFramebuffer()),
      colour_(makeTexture()) {
    glBindTexture(GL_TEXTURE_2D, colour_.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width_, height_, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 nullptr);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
    glBindTexture(GL_TEXTURE_2D, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, resolved_.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_.name(), 0);
    if (under.samples() > 1) {
        drawn_ = makeFramebuffer();
        glBindFramebuffer(GL_FRAMEBUFFER, drawn_.name());
        sampledColour_ = makeRenderbuffer();
        glBindRenderbuffer(GL_RENDERBUFFER, sampledColour_.name());
        glRenderbufferStorageMultisample(GL_RENDERBUFFER, under.samples(), GL_RGBA8, width_,
                                         height_);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                  sampledColour_.name());
    }
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, under.depth());
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw Error("OpenGL: can't make a framebuffer for overlays");
}

void OverlayTarget::begin() const {
    const float nothing[4] = {0, 0, 0, 0};
    glBindFramebuffer(GL_FRAMEBUFFER, drawn_.name() != 0 ? drawn_.name() : resolved_.name());
    glViewport(0, 0, width_, height_);
    glClearBufferfv(GL_COLOR, 0, nothing);
}

void OverlayTarget::resolve() const {
    if (drawn_.name() == 0) return;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn_.name());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.name());
    glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT,
                      GL_NEAREST);
}

} // namespace penumbra
