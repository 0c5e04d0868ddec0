#include "viewer/gl/ScreenPass.h"

#include <epoxy/gl.h>

namespace penumbra {

namespace {

/// One triangle that reaches beyond all four edges, without vertex buffers.
const char* const kVertexShader = R"(#version 330 core
out vec2 place;
void main() {
    place = vec2(2 * (gl_VertexID & 1), gl_VertexID & 2);
    gl_Position = vec4(2.0 * place - 1.0, 0.0, 1.0);
}
)";

} // namespace

ScreenPass::ScreenPass(const char* fragmentSource)
    : program_(kVertexShader, fragmentSource), vertexArray_(makeVertexArray()) {}

void ScreenPass::draw() const {
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
    glBindVertexArray(vertexArray_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
}

} // namespace penumbra
