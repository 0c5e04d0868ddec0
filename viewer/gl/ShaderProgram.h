// A linked pair of shaders.
#pragma once

#include "base/Rgb.h"
#include "viewer/gl/GlObject.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <string>

namespace penumbra {

/// A vertex and a fragment shader, compiled and linked. The set() functions need the program in
/// use; a uniform that the shaders do not have is ignored, as OpenGL does.
class ShaderProgram {
public:
    /// \throws Error with the first line of the compiler's log
    ShaderProgram(const std::string& vertexSource, const std::string& fragmentSource);

    void use() const;
    void set(const char* uniform, const glm::mat4& value) const;
    void set(const char* uniform, const glm::mat3& value) const;
    void set(const char* uniform, glm::vec4 value) const;
    void set(const char* uniform, Rgb value) const;
    void set(const char* uniform, std::uint32_t value) const;
    void set(const char* uniform, int value) const;
    void set(const char* uniform, float value) const;
    void set(const char* uniform, std::span<const glm::vec4> values) const; ///< an array

private:
    int location(const char* uniform) const;

    GlObject program_;
};

} // namespace penumbra
