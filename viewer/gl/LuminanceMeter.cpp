#include "viewer/gl/LuminanceMeter.h"

#include "base/ViewMeter.h"

#include <epoxy/gl.h>

namespace penumbra {

namespace {

constexpr int kWidth = MeterGrid::kColumns, kHeight = MeterGrid::kRows;
constexpr std::size_t kCells = std::size_t(kWidth) * std::size_t(kHeight);
static_assert(MeterGrid::kSide == 4, "the shader takes 4 x 4 points of a cell");
static_assert(sizeof(MeterCell) == 4 * sizeof(float), "a texel is a cell");

/// A MeterCell: of pixels that are partly an emitter or the background neither sum takes any.
const char* const kFragmentShader = R"(#version 330 core
in vec2 place;
uniform sampler2D luminances;
uniform vec4 grid;
out vec4 measured;                       // a MeterCell

void main() {
    measured = vec4(0.0);
    vec2 size = vec2(textureSize(luminances, 0));
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) {
            vec2 offset = (vec2(x, y) - 1.5) / 4.0;
            vec4 c = texelFetch(luminances, ivec2((place + offset / grid.xy) * size), 0);
            float y = dot(max(c.rgb, 0.0), vec3(0.2126, 0.7152, 0.0722));
            if (c.a > 0.99)
                measured.xy += vec2(y, 1.0);
            else if (c.a < 0.01 && y > 0.0)
                measured.zw += vec2(y, 1.0);
        }
}
)";

} // namespace

LuminanceMeter::LuminanceMeter()
    : pass_(kFragmentShader), texture_(makeTexture()), framebuffer_(makeFramebuffer()) {
    glBindTexture(GL_TEXTURE_2D, texture_.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, kWidth, kHeight, 0, GL_RGBA, GL_FLOAT, nullptr);
    glBindTexture(GL_TEXTURE_2D, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.name(), 0);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    for (Transfer& transfer : transfers_) {
        transfer.buffer = makeBuffer();
        glBindBuffer(GL_PIXEL_PACK_BUFFER, transfer.buffer.name());
        glBufferData(GL_PIXEL_PACK_BUFFER, GLsizeiptr(kCells * sizeof(MeterCell)), nullptr,
                     GL_STREAM_READ);
    }
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

LuminanceMeter::~LuminanceMeter() {
    for (Transfer& transfer : transfers_)
        if (transfer.fence) glDeleteSync(static_cast<GLsync>(transfer.fence));
}

void LuminanceMeter::measure(unsigned texture) {
    Transfer& transfer = transfers_[next_];
    if (transfer.fence) return;
    next_ = (next_ + 1) % transfers_.size();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glViewport(0, 0, kWidth, kHeight);
    glBindTexture(GL_TEXTURE_2D, texture);
    pass_.program().use();
    pass_.program().set("luminances", 0);
    pass_.program().set("grid", glm::vec4(kWidth, kHeight, 0, 0));
    pass_.draw();
    glBindTexture(GL_TEXTURE_2D, 0);
    glUseProgram(0);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, transfer.buffer.name());
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    glReadPixels(0, 0, kWidth, kHeight, GL_RGBA, GL_FLOAT, nullptr);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    transfer.fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

std::optional<std::vector<float>> LuminanceMeter::take(bool wait) {
    std::optional<std::vector<float>> latest;
    for (std::size_t i = 0; i < transfers_.size(); ++i) { // the oldest first
        auto values = finish(transfers_[(next_ + i) % transfers_.size()], wait);
        if (values) latest = std::move(values);
    }
    return latest;
}

std::optional<std::vector<float>> LuminanceMeter::finish(Transfer& transfer, bool wait) {
    if (!transfer.fence) return std::nullopt;
    const auto fence = static_cast<GLsync>(transfer.fence);
    constexpr GLuint64 kOneSecond = 1'000'000'000;
    const GLenum state = glClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, wait ? kOneSecond : 0);
    if (state != GL_ALREADY_SIGNALED && state != GL_CONDITION_SATISFIED) return std::nullopt;
    glDeleteSync(fence);
    transfer.fence = nullptr;
    std::vector<MeterCell> cells(kCells);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, transfer.buffer.name());
    glGetBufferSubData(GL_PIXEL_PACK_BUFFER, 0, GLsizeiptr(kCells * sizeof(MeterCell)),
                       cells.data());
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    return meteredLuminances(cells);
}

} // namespace penumbra
