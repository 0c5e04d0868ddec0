#include "viewer/OverlayPass.h"

#include "viewer/DrawState.h"
#include "viewer/Shaders.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <set>
#include <string>

namespace penumbra {

namespace {

const char* const kLineVertexShader = R"(#version 330 core
layout(location = 0) in vec3 position;
uniform mat4 localToClip;
void main() {
    gl_Position = localToClip * vec4(position, 1.0);
    gl_Position.z += nearer * gl_Position.w;
}
)";

const char* const kPlainFragmentShader = R"(#version 330 core
uniform vec4 colour;                     // nit, opacity
layout(location = 0) out vec4 beauty;
void main() { beauty = colour; }
)";

/// Light that has just arrived glows and cools down within seconds.
const char* const kAgeVertexShader = R"(#version 330 core
layout(location = 0) in vec3 position;
uniform mat4 localToClip;
uniform samplerBuffer times;             // of each block of 64 vertices [s]
uniform float now;
flat out float age;
void main() {
    gl_Position = localToClip * vec4(position, 1.0);
    gl_Position.z += nearer * gl_Position.w;
    age = now - texelFetch(times, gl_VertexID / 64).r;
}
)";

const char* const kAgeFragmentShader = R"(#version 330 core
flat in float age;
uniform vec4 colour;                     // middle grey [nit]
layout(location = 0) out vec4 beauty;
void main() {
    float fresh = exp2(-2.0 * max(age, 0.0)), recent = exp2(-0.5 * max(age, 0.0));
    vec3 heat = vec3(4.0 * recent, 2.5 * fresh, 0.6 * fresh * fresh);
    beauty = vec4(colour.rgb * heat, 0.15 + 0.6 * recent);
}
)";

/// A hair nearer to the eye than the surface itself, whichever way depth runs.
std::string withDepth(const char* source, bool reversed) {
    std::string text = source;
    const std::string line = "#version 330 core\n";
    return line + "const float nearer = " + (reversed ? "1e-6" : "-1e-5") + ";\n" +
           text.substr(line.size());
}

} // namespace

std::vector<std::uint32_t> elementEdges(const LitMeshData& mesh) {
    const std::size_t triangles = mesh.indices.size() / 3;
    const auto corner = [&](std::size_t triangle, std::size_t k) {
        return mesh.indices[3 * triangle + k % 3];
    };
    // a quadrilateral (a, b, c, d) is cut into (a, b, c), (a, c, d)
    const auto cutHere = [&](std::size_t triangle) {
        return triangle + 1 < triangles && corner(triangle, 0) == corner(triangle + 1, 0) &&
               corner(triangle, 2) == corner(triangle + 1, 1);
    };
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    const auto add = [&](std::uint32_t a, std::uint32_t b) { edges.insert(std::minmax(a, b)); };
    for (std::size_t t = 0; t < triangles; ++t) {
        const bool first = cutHere(t), second = !first && t > 0 && cutHere(t - 1);
        if (!second) add(corner(t, 0), corner(t, 1));
        add(corner(t, 1), corner(t, 2));
        if (!first) add(corner(t, 2), corner(t, 0));
    }
    std::vector<std::uint32_t> indices;
    for (const auto& [a, b] : edges) indices.insert(indices.end(), {a, b});
    return indices;
}

OverlayPass::OverlayPass()
    : lineProgram_(withDepth(kLineVertexShader, canReverseDepth()).c_str(), kPlainFragmentShader),
      ageProgram_(withDepth(kAgeVertexShader, canReverseDepth()).c_str(), kAgeFragmentShader),
      ageBuffer_(makeBuffer()), ageTexture_(makeTexture()) {}

void OverlayPass::dropDead() {
    std::erase_if(edges_, [](const auto& entry) { return entry.second.alive.expired(); });
}

const OverlayPass::Edges& OverlayPass::edgesOf(const LitItem& item) {
    Edges& edges = edges_[item.geometry];
    if (edges.topology == item.geometry->topologyRevision() && !edges.alive.expired()) return edges;
    const std::vector<std::uint32_t> indices = elementEdges(item.geometry->data());
    edges.alive = item.owner;
    edges.topology = item.geometry->topologyRevision();
    edges.count = indices.size();
    edges.vertexArray = makeVertexArray();
    edges.positions = makeBuffer();
    edges.indices = makeBuffer();
    const auto& positions = item.geometry->data().positions;
    glBindVertexArray(edges.vertexArray.name());
    glBindBuffer(GL_ARRAY_BUFFER, edges.positions.name());
    glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(positions.size() * sizeof(glm::vec3)),
                 positions.data(), GL_STATIC_DRAW);
    glVertexAttribPointer(kPosition, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    glEnableVertexAttribArray(kPosition);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, edges.indices.name());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(indices.size() * sizeof(std::uint32_t)),
                 indices.data(), GL_STATIC_DRAW);
    return edges;
}

void OverlayPass::drawElements(const std::vector<LitItem>& items, float middleGrey) {
    lineProgram_.use();
    lineProgram_.set("colour", glm::vec4(glm::vec3(0.1f, 0.5f, 1.0f) * (3 * middleGrey), 0.45f));
    for (const LitItem& item : items) {
        setPlace(lineProgram_, item.place);
        const Edges& edges = edgesOf(item);
        glBindVertexArray(edges.vertexArray.name());
        glDrawElements(GL_LINES, GLsizei(edges.count), GL_UNSIGNED_INT, nullptr);
    }
}

void OverlayPass::drawAge(const std::vector<LitItem>& items, float middleGrey, double now) {
    ageProgram_.use();
    ageProgram_.set("colour", glm::vec4(glm::vec3(middleGrey), 1));
    ageProgram_.set("now", float(now));
    ageProgram_.set("times", 0);
    glActiveTexture(GL_TEXTURE0);
    for (const LitItem& item : items) {
        setPlace(ageProgram_, item.place);
        const std::vector<float>& times = item.gpu->blockTimes();
        glBindBuffer(GL_TEXTURE_BUFFER, ageBuffer_.name());
        glBufferData(GL_TEXTURE_BUFFER, GLsizeiptr(times.size() * sizeof(float)), times.data(),
                     GL_STREAM_DRAW);
        glBindTexture(GL_TEXTURE_BUFFER, ageTexture_.name());
        glTexBuffer(GL_TEXTURE_BUFFER, GL_R32F, ageBuffer_.name());
        item.gpu->bind();
        for (const MaterialRange& range : item.gpu->ranges()) drawRange(range);
    }
    glBindTexture(GL_TEXTURE_BUFFER, 0);
    glBindBuffer(GL_TEXTURE_BUFFER, 0);
}

void OverlayPass::draw(Overlay overlay, const std::vector<LitItem>& items, float middleGrey,
                       double now, bool reversed) {
    if (overlay == Overlay::none) return;
    glDepthFunc(reversed ? GL_GEQUAL : GL_LEQUAL);
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE); // alpha: as it is
    if (overlay == Overlay::elements)
        drawElements(items, middleGrey);
    else
        drawAge(items, middleGrey, now);
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
}

} // namespace penumbra
