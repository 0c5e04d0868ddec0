#include "viewer/overlay/OverlayPass.h"

#include "viewer/gl/DrawState.h"
#include "viewer/gl/Shaders.h"
#include "viewer/overlay/ColourMap.h"
#include "viewer/overlay/MeshLines.h"

#include <epoxy/gl.h>

#include <string>

namespace penumbra {

namespace {

const char* const kLineVertexShader = R"(#version 330 core
layout(location = 0) in vec3 position;
uniform mat4 localToClip;
void main() {
    gl_Position = localToClip * vec4(position, 1.0);
    gl_Position = nearer(gl_Position, 2e-3); // more than a surface is deep from pixel to pixel
}
)";

const char* const kLineFragmentShader = R"(#version 330 core
uniform vec4 colour;
layout(location = 0) out vec4 shown;
void main() { shown = vec4(colour.rgb * colour.a, colour.a); }
)";

const char* const kBlockVertexShader = R"(#version 330 core
layout(location = 0) in vec3 position;
uniform mat4 localToClip;
uniform samplerBuffer colours;           // of each block of 64 vertices
flat out vec4 colour;
void main() {
    gl_Position = localToClip * vec4(position, 1.0);
    gl_Position = nearer(gl_Position, 1e-5);
    colour = texelFetch(colours, gl_VertexID / 64);
}
)";

const char* const kBlockFragmentShader = R"(#version 330 core
flat in vec4 colour;
layout(location = 0) out vec4 shown;
void main() {
    if (colour.a == 0.0) discard;
    shown = vec4(colour.rgb * colour.a, colour.a);
}
)";
static_assert(LitGeometry::kBlock == 64);

/// With a function that brings a point nearer to the eye by some share of its distance, whichever
/// way depth runs: it is as 1 / distance from what lies at infinity.
std::string withDepth(const char* source, bool reversed) {
    const std::string version = "#version 330 core\n";
    std::string text = source;
    text.insert(version.size(),
                reversed ? "    return vec4(p.xy, p.z * (1.0 + share), p.w);\n}\n"
                         : "    return vec4(p.xy, p.w - (p.w - p.z) * (1.0 + share), p.w);\n}\n");
    text.insert(version.size(), "vec4 nearer(vec4 p, float share) {\n");
    return text;
}

} // namespace

OverlayPass::OverlayPass()
    : lineProgram_(withDepth(kLineVertexShader, canReverseDepth()), kLineFragmentShader),
      blockProgram_(withDepth(kBlockVertexShader, canReverseDepth()), kBlockFragmentShader),
      blockBuffer_(makeBuffer()), blockTexture_(makeTexture()) {}

void OverlayPass::dropDead() {
    std::erase_if(lines_, [](const auto& entry) { return entry.second.alive.expired(); });
}

const OverlayPass::Lines& OverlayPass::linesOf(const LitItem& item) {
    Lines& lines = lines_[item.geometry];
    const LitMeshData& mesh = item.geometry->data();
    if (lines.triangles == mesh.triangleMaterial.size() && !lines.alive.expired()) return lines;
    const MeshLines found = meshLines(mesh);
    std::vector<std::uint32_t> indices = found.patches;
    indices.insert(indices.end(), found.elements.begin(), found.elements.end());
    lines.alive = item.owner;
    lines.triangles = mesh.triangleMaterial.size();
    lines.patches = found.patches.size();
    lines.elements = found.elements.size();
    lines.vertexArray = makeVertexArray();
    lines.positions = makeBuffer();
    lines.indices = makeBuffer();
    glBindVertexArray(lines.vertexArray.name());
    glBindBuffer(GL_ARRAY_BUFFER, lines.positions.name());
    glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(mesh.positions.size() * sizeof(glm::vec3)),
                 mesh.positions.data(), GL_STATIC_DRAW);
    glVertexAttribPointer(kPosition, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    glEnableVertexAttribArray(kPosition);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, lines.indices.name());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(indices.size() * sizeof(std::uint32_t)),
                 indices.data(), GL_STATIC_DRAW);
    return lines;
}

void OverlayPass::drawLines(const std::vector<LitItem>& items) {
    lineProgram_.use();
    for (const LitItem& item : items) {
        setPose(lineProgram_, item.place);
        const Lines& lines = linesOf(item);
        glBindVertexArray(lines.vertexArray.name());
        lineProgram_.set("colour", glm::vec4(kindColour(kElementKind), 0.3f));
        glDrawElements(GL_LINES, GLsizei(lines.elements), GL_UNSIGNED_INT,
                       reinterpret_cast<const void*>(lines.patches * sizeof(std::uint32_t)));
        lineProgram_.set("colour", glm::vec4(kindColour(kPatchKind), 0.9f));
        glDrawElements(GL_LINES, GLsizei(lines.patches), GL_UNSIGNED_INT, nullptr);
    }
}

void OverlayPass::drawBlocks(const BlockColours& colours, const std::vector<LitItem>& items) {
    blockProgram_.use();
    blockProgram_.set("colours", 0);
    glActiveTexture(GL_TEXTURE0);
    for (const LitItem& item : items) {
        const auto found = colours.find(item.geometry);
        if (found == colours.end() ||
            found->second.size() != item.geometry->blockRevisions().size())
            continue;
        setPose(blockProgram_, item.place);
        glBindBuffer(GL_TEXTURE_BUFFER, blockBuffer_.name());
        glBufferData(GL_TEXTURE_BUFFER, GLsizeiptr(found->second.size() * sizeof(glm::u8vec4)),
                     found->second.data(), GL_STREAM_DRAW);
        glBindTexture(GL_TEXTURE_BUFFER, blockTexture_.name());
        glTexBuffer(GL_TEXTURE_BUFFER, GL_RGBA8, blockBuffer_.name());
        item.gpu->bind();
        for (const MaterialRange& range : item.gpu->ranges()) drawRange(range);
    }
    glBindTexture(GL_TEXTURE_BUFFER, 0);
    glBindBuffer(GL_TEXTURE_BUFFER, 0);
}

void OverlayPass::draw(const OverlayPicture& picture, const std::vector<LitItem>& items,
                       bool reversed) {
    glDepthFunc(reversed ? GL_GEQUAL : GL_LEQUAL);
    glDepthMask(GL_FALSE);
    if (!picture.blocks.empty()) drawBlocks(picture.blocks, items);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA); // premultiplied
    if (picture.mesh) drawLines(items);
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
}

} // namespace penumbra
