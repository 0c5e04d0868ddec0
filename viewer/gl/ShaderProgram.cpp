#include "viewer/gl/ShaderProgram.h"

#include "base/Error.h"

#include <epoxy/gl.h>

#include <glm/gtc/type_ptr.hpp>

#include <array>
#include <string>

namespace penumbra {

namespace {

[[noreturn]] void fail(const char* what, const char* log) {
    const std::string text = log;
    throw Error(std::string("OpenGL: can't ") + what + ": " + text.substr(0, text.find('\n')));
}

GlObject compiled(GLenum stage, const std::string& text) {
    GlObject shader = makeShader(stage);
    const char* const source = text.c_str();
    glShaderSource(shader.name(), 1, &source, nullptr);
    glCompileShader(shader.name());
    GLint good = GL_FALSE;
    glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &good);
    if (good) return shader;
    std::array<char, 1024> log{};
    glGetShaderInfoLog(shader.name(), GLsizei(log.size()), nullptr, log.data());
    fail("compile a shader", log.data());
}

} // namespace

ShaderProgram::ShaderProgram(const std::string& vertexSource, const std::string& fragmentSource)
    : program_(makeProgram()) {
    const GlObject vertex = compiled(GL_VERTEX_SHADER, vertexSource);
    const GlObject fragment = compiled(GL_FRAGMENT_SHADER, fragmentSource);
    glAttachShader(program_.name(), vertex.name());
    glAttachShader(program_.name(), fragment.name());
    glLinkProgram(program_.name());
    GLint good = GL_FALSE;
    glGetProgramiv(program_.name(), GL_LINK_STATUS, &good);
    if (good) return;
    std::array<char, 1024> log{};
    glGetProgramInfoLog(program_.name(), GLsizei(log.size()), nullptr, log.data());
    fail("link shaders", log.data());
}

void ShaderProgram::use() const {
    glUseProgram(program_.name());
}

int ShaderProgram::location(const char* uniform) const {
    return glGetUniformLocation(program_.name(), uniform);
}

void ShaderProgram::set(const char* uniform, const glm::mat4& value) const {
    glUniformMatrix4fv(location(uniform), 1, GL_FALSE, glm::value_ptr(value));
}

void ShaderProgram::set(const char* uniform, const glm::mat3& value) const {
    glUniformMatrix3fv(location(uniform), 1, GL_FALSE, glm::value_ptr(value));
}

void ShaderProgram::set(const char* uniform, glm::vec4 value) const {
    glUniform4fv(location(uniform), 1, glm::value_ptr(value));
}

void ShaderProgram::set(const char* uniform, Rgb value) const {
    glUniform3f(location(uniform), value.r, value.g, value.b);
}

void ShaderProgram::set(const char* uniform, std::uint32_t value) const {
    glUniform1ui(location(uniform), value);
}

void ShaderProgram::set(const char* uniform, int value) const {
    glUniform1i(location(uniform), value);
}

void ShaderProgram::set(const char* uniform, float value) const {
    glUniform1f(location(uniform), value);
}

void ShaderProgram::set(const char* uniform, std::span<const glm::vec4> values) const {
    if (values.empty()) return;
    glUniform4fv(location(uniform), GLsizei(values.size()), glm::value_ptr(values.front()));
}

} // namespace penumbra
