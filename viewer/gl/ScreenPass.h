// Drawing that covers a whole framebuffer.
#pragma once

#include "viewer/gl/GlObject.h"
#include "viewer/gl/ShaderProgram.h"

namespace penumbra {

/// A fragment shader that is run for every pixel of the viewport. It reads
/// `in vec2 place`, (0, 0) lower left to (1, 1) upper right.
class ScreenPass {
public:
    explicit ScreenPass(const char* fragmentSource);

    const ShaderProgram& program() const { return program_; }
    /// Draws with program() in use, into what is bound; depth test and blending are off.
    void draw() const;

private:
    ShaderProgram program_;
    GlObject vertexArray_;
};

} // namespace penumbra
