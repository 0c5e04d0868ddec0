#include "viewer/shadowmaps/ShadowMaps.h"

#include "base/Error.h"
#include "viewer/gl/GeometryCache.h"

#include <epoxy/gl.h>

#include <utility>

namespace penumbra {

namespace {

const char* const kVertexShader = R"(#version 330 core
layout(location = 0) in vec3 position;
uniform mat4 localToClip;
void main() { gl_Position = localToClip * vec4(position, 1.0); }
)";
const char* const kFragmentShader = R"(#version 330 core
void main() {}
)";

} // namespace

ShadowMaps::ShadowMaps() : program_(kVertexShader, kFragmentShader) {}

bool ShadowMaps::require(int layers, int size) {
    if (layers <= layers_ && size == size_) return false;
    layers_ = layers;
    size_ = size;
    if (framebuffer_.name() == 0) framebuffer_ = makeFramebuffer();
    texture_ = makeTexture();
    glBindTexture(GL_TEXTURE_2D_ARRAY, texture_.name());
    glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_DEPTH_COMPONENT32F, size, size, layers, 0,
                 GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glTexParameteri(GL_TEXTURE_2D_ARRAY, filter, GL_NEAREST);
    glBindTexture(GL_TEXTURE_2D_ARRAY, 0);
    if (glGetError() == GL_OUT_OF_MEMORY) throw Error("OpenGL: no memory for shadow maps");
    return true;
}

void ShadowMaps::begin(int layer, int tiles) {
    tiles_ = tiles;
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, texture_.name(), 0, layer);
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_TRUE);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
    const float farthest = 1;
    glClearBufferfv(GL_DEPTH, 0, &farthest);
    program_.use();
}

void ShadowMaps::drawTile(int tile, const glm::mat4& toClip,
                          const std::vector<ShadowCaster>& casters) {
    const int side = tileSize(tiles_);
    glViewport(tile % tiles_ * side, tile / tiles_ * side, side, side);
    for (const ShadowCaster& caster : casters) {
        program_.set("localToClip", toClip * caster.place);
        caster.gpu->bind();
        caster.runs.draw();
    }
}

void ShadowMaps::end() {
    glBindVertexArray(0);
    glUseProgram(0);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

} // namespace penumbra
