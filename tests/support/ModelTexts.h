// Small models of other formats, as text.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra {

/// RFC 4648, section 4.
inline std::string base64(std::string_view bytes) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 3; ++k)
            word =
                word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? kDigits[word >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

/// The points and corners of the square of gltfText(). \param index of its last corner
inline std::string squareBytes(std::uint16_t index) {
    const float points[] = {0, 0, 0, 0, 0, 1, 1, 0, 1, 1, 0, 0};
    const std::uint16_t corners[] = {0, 1, 2, 0, 2, index};
    std::string bytes(sizeof points + sizeof corners, '\0');
    std::memcpy(bytes.data(), points, sizeof points);
    std::memcpy(bytes.data() + sizeof points, corners, sizeof corners);
    return bytes;
}

/// The JSON of gltfText(). \param uri member of the buffer that says where its bytes are
inline std::string gltfJson(const std::string& nodes, const std::string& more,
                            const std::string& uri) {
    const std::string paint =
        more.find("\"materials\"") == std::string::npos ? "" : ", \"material\": 0";
    return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": )" +
           nodes + R"(, "meshes": [{"name": "Square", "primitives": [{"attributes": )" +
           R"({"POSITION": 0}, "indices": 1)" + paint + R"(}]}], "buffers": [{"byteLength": 60)" +
           uri + R"(}], "bufferViews": [{"buffer": 0, "byteLength": 48}, )" +
           R"({"buffer": 0, "byteOffset": 48, "byteLength": 12}], "accessors": [)" +
           R"({"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", )" +
           R"("min": [0, 0, 0], "max": [1, 0, 1]}, )" +
           R"({"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}])" + more +
           "}";
}

/// A glTF file whose mesh 0, "Square", is the unit square in the plane y = 0, seen from above: two
/// triangles. It has material 0 if there are materials.
/// \param nodes JSON array; its first node is the scene
/// \param more  further members of the file, each with a comma before it
/// \param index of the last corner: 3, unless it is to be wrong
inline std::string gltfText(const std::string& nodes, const std::string& more = "",
                            std::uint16_t index = 3) {
    return gltfJson(nodes, more,
                    R"(, "uri": "data:application/octet-stream;base64,)" +
                        base64(squareBytes(index)) + "\"");
}

/// The same as a GLB: a header, a chunk of JSON and one of bytes (glTF 2.0, section 4.4).
inline std::string glbBytes(const std::string& nodes, const std::string& more = "") {
    std::string json = gltfJson(nodes, more, "");
    while (json.size() % 4 != 0) json += ' ';
    const std::string bytes = squareBytes(3);
    std::string glb;
    const auto add = [&](std::uint32_t word) {
        for (int shift = 0; shift < 32; shift += 8) glb += char(word >> shift & 255);
    };
    add(0x46546c67); // "glTF"
    add(2);
    add(std::uint32_t(12 + 8 + json.size() + 8 + bytes.size()));
    add(std::uint32_t(json.size()));
    add(0x4e4f534a); // "JSON"
    glb += json;
    add(std::uint32_t(bytes.size()));
    add(0x004e4942); // "BIN"
    return glb + bytes;
}

/// The lights of a glTF file, for `more`. \param lights JSON array
inline std::string gltfLights(const std::string& lights) {
    return R"(, "extensionsUsed": ["KHR_lights_punctual"], "extensions": )" +
           (R"({"KHR_lights_punctual": {"lights": )" + lights + "}}");
}

/// A node's member that puts a light on it.
inline std::string gltfLight(int light) {
    return R"("extensions": {"KHR_lights_punctual": {"light": )" + std::to_string(light) + "}}";
}

/// A Collada file with one square, as `Mesh "Square"` on a node, one unit wide, in the plane z = 0.
/// \param asset elements of <asset>: unit and axis
inline std::string colladaText(const std::string& asset) {
    return R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset>)" + asset +
           R"(</asset>
<library_geometries><geometry id="square" name="Square"><mesh>
<source id="points"><float_array id="numbers" count="12">0 0 0 1 0 0 1 1 0 0 1 0</float_array>
<technique_common><accessor source="#numbers" count="4" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="vertices"><input semantic="POSITION" source="#points"/></vertices>
<polylist count="1"><input semantic="VERTEX" source="#vertices" offset="0"/>
<vcount>4</vcount><p>0 1 2 3</p></polylist></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="scene"><node id="Table"><translate>2 0 0</translate>
<instance_geometry url="#square"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#scene"/></scene></COLLADA>
)";
}

} // namespace penumbra
