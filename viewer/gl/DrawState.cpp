#include "viewer/gl/DrawState.h"

#include <epoxy/gl.h>

namespace penumbra {

bool canReverseDepth() {
    return epoxy_gl_version() >= 45 || epoxy_has_gl_extension("GL_ARB_clip_control");
}

glm::dmat4 reversedDepth() {
    glm::dmat4 matrix(1.0);
    matrix[2][2] = -0.5;
    matrix[3][2] = 0.5;
    return matrix;
}

DrawState::DrawState(bool reversed) : reversed_(reversed) {
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

DrawState::~DrawState() {
    if (reversed_) glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    glDepthFunc(GL_LESS);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glFrontFace(GL_CCW);
    glUseProgram(0);
    glBindVertexArray(0);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

} // namespace penumbra
