// OpenGL's names, each owned by one C++ object.
#pragma once

#include <utility>

namespace penumbra {

/// Owns one OpenGL object and deletes it. The context it was made in must be current then.
class GlObject {
public:
    using Delete = void (*)(unsigned name);

    GlObject() = default;
    GlObject(unsigned name, Delete deleter) : name_(name), delete_(deleter) {}
    ~GlObject() {
        if (name_) delete_(name_);
    }
    GlObject(GlObject&& other) noexcept
        : name_(std::exchange(other.name_, 0)), delete_(other.delete_) {}
    GlObject& operator=(GlObject&& other) noexcept {
        std::swap(name_, other.name_);
        std::swap(delete_, other.delete_);
        return *this;
    }

    unsigned name() const { return name_; } ///< 0: none

private:
    unsigned name_ = 0;
    Delete delete_ = nullptr;
};

GlObject makeBuffer();
GlObject makeVertexArray();
GlObject makeRenderbuffer();
GlObject makeFramebuffer();
GlObject makeTexture();
GlObject makeShader(unsigned stage); ///< GL_VERTEX_SHADER or GL_FRAGMENT_SHADER
GlObject makeProgram();

} // namespace penumbra
