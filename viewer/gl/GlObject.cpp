#include "viewer/gl/GlObject.h"

#include <epoxy/gl.h>

namespace penumbra {

GlObject makeBuffer() {
    unsigned name = 0;
    glGenBuffers(1, &name);
    return {name, [](unsigned n) { glDeleteBuffers(1, &n); }};
}

GlObject makeVertexArray() {
    unsigned name = 0;
    glGenVertexArrays(1, &name);
    return {name, [](unsigned n) { glDeleteVertexArrays(1, &n); }};
}

GlObject makeRenderbuffer() {
    unsigned name = 0;
    glGenRenderbuffers(1, &name);
    return {name, [](unsigned n) { glDeleteRenderbuffers(1, &n); }};
}

GlObject makeFramebuffer() {
    unsigned name = 0;
    glGenFramebuffers(1, &name);
    return {name, [](unsigned n) { glDeleteFramebuffers(1, &n); }};
}

GlObject makeTexture() {
    unsigned name = 0;
    glGenTextures(1, &name);
    return {name, [](unsigned n) { glDeleteTextures(1, &n); }};
}

GlObject makeShader(unsigned stage) {
    return {glCreateShader(stage), [](unsigned n) { glDeleteShader(n); }};
}

GlObject makeProgram() {
    return {glCreateProgram(), [](unsigned n) { glDeleteProgram(n); }};
}

} // namespace penumbra
