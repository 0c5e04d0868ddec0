#include "viewer/gl/TonePass.h"

#include <epoxy/gl.h>

#include <cstdint>
#include <string>
#include <vector>

namespace penumbra {

namespace {

const char* const kOneSample = R"(#version 330 core
uniform sampler2D luminances;            // nit
const int sampleCount = 1;
vec3 luminance(ivec2 pixel, int number) { return texelFetch(luminances, pixel, 0).rgb; }
)";

const char* const kManySamples = R"(#version 330 core
uniform sampler2DMS luminances;          // nit
uniform int sampleCount;
vec3 luminance(ivec2 pixel, int number) { return texelFetch(luminances, pixel, number).rgb; }
)";

const char* const kFragmentShader = R"(
uniform sampler2D table;                 // the tone curve over the logarithm
uniform sampler2D overlay;               // sRGB, premultiplied
uniform mat3 inset, outset;
uniform float scale;                     // nit to the curve's unit
uniform vec4 range;                      // log2 of the table's first and last entry, its size
out vec4 signal;

float curve(float value) {
    float at = (log2(max(value, 1e-30)) - range.x) / (range.y - range.x);
    return texture(table, vec2((clamp(at, 0.0, 1.0) * (range.z - 1.0) + 0.5) / range.z, 0.5)).r;
}

float encoded(float linear) {            // IEC 61966-2-1
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
}

float noise(vec2 pixel) {                // interleaved gradient noise, Jimenez 2014
    return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))));
}

vec3 shown(vec3 nits) {
    vec3 colour = inset * (max(nits, 0.0) * scale);
    return clamp(outset * vec3(curve(colour.r), curve(colour.g), curve(colour.b)), 0.0, 1.0);
}

void main() {
    // By whole pixels: what is interpolated would differ by a step between window and file.
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 colour = vec3(0.0);
    for (int i = 0; i < sampleCount; ++i) colour += shown(luminance(pixel, i));
    colour /= float(sampleCount);
    float dither = 0.0005 + 0.999 * noise(floor(gl_FragCoord.xy));
    vec4 over = texelFetch(overlay, min(pixel, textureSize(overlay, 0) - 1), 0);
    vec3 under = vec3(encoded(colour.r), encoded(colour.g), encoded(colour.b));
    vec3 level = 255.0 * (over.rgb + (1.0 - over.a) * under);
    signal = vec4(floor(level + dither) / 255.0, 1.0);
}
)";

} // namespace

TonePass::TonePass()
    : pass_((std::string(kOneSample) + kFragmentShader).c_str()), table_(makeTexture()),
      nothing_(makeTexture()) {
    const std::uint8_t clear[4] = {0, 0, 0, 0};
    glBindTexture(GL_TEXTURE_2D, nothing_.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, clear);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
    glBindTexture(GL_TEXTURE_2D, 0);
}

void TonePass::load(ToneStyle style) {
    glBindTexture(GL_TEXTURE_2D, table_.name());
    if (loaded_ == style) return;
    loaded_ = style;
    curve_ = ToneCurve(style);
    const std::vector<float> values = curve_.table();
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R32F, GLsizei(values.size()), 1, 0, GL_RED, GL_FLOAT,
                 values.data());
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glTexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
}

const ScreenPass& TonePass::passFor(const Picture& picture) {
    if (picture.samples == 0) return pass_;
    if (!samplesPass_) samplesPass_.emplace((std::string(kManySamples) + kFragmentShader).c_str());
    return *samplesPass_;
}

void TonePass::draw(const Picture& picture, float middleGrey, ToneStyle style) {
    const ScreenPass& pass = passFor(picture);
    const GLenum kind = picture.samples != 0 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
    glActiveTexture(GL_TEXTURE2);
    glBindTexture(GL_TEXTURE_2D, picture.overlay != 0 ? picture.overlay : nothing_.name());
    glActiveTexture(GL_TEXTURE1);
    load(style);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(kind, picture.samples != 0 ? picture.samples : picture.luminances);
    const ShaderProgram& program = pass.program();
    program.use();
    program.set("sampleCount", picture.sampleCount);
    program.set("luminances", 0);
    program.set("table", 1);
    program.set("overlay", 2);
    program.set("inset", curve_.inset());
    program.set("outset", curve_.outset());
    program.set("scale", kMiddleGrey / middleGrey);
    program.set("range", glm::vec4(ToneCurve::kTableFirst, ToneCurve::kTableLast,
                                   float(ToneCurve::kTableSize), 0));
    glDisable(GL_FRAMEBUFFER_SRGB);
    pass.draw();
    glBindTexture(kind, 0);
    for (const GLenum unit : {GL_TEXTURE2, GL_TEXTURE1}) {
        glActiveTexture(unit);
        glBindTexture(GL_TEXTURE_2D, 0);
    }
    glActiveTexture(GL_TEXTURE0);
    glUseProgram(0);
}

} // namespace penumbra
