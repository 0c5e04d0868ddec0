#include "viewer/Shaders.h"

namespace penumbra {

const char* const kLitVertexShader = R"(#version 330 core
layout(location = 0) in vec3 position;   // local frame
layout(location = 1) in vec3 normal;     // local frame, unit
layout(location = 2) in vec3 direct;     // lux
layout(location = 3) in vec3 indirect;   // lux

uniform mat4 localToClip;
uniform vec4 localToDepth;               // depth = dot(localToDepth, (p, 1))
uniform mat3 normalToWorld;

// Centroid: in a pixel that an edge crosses, the light is taken where the surface is. At the pixel's
// centre, outside of the triangle, it would be extrapolated, even to less than nothing.
centroid out vec3 surfaceDirect;
centroid out vec3 surfaceIndirect;
out vec3 surfaceNormal;
out float surfaceDepth;

void main() {
    gl_Position = localToClip * vec4(position, 1.0);
    surfaceDepth = dot(localToDepth, vec4(position, 1.0));
    surfaceNormal = normalToWorld * normal;
    surfaceDirect = direct;
    surfaceIndirect = indirect;
}
)";

const char* const kLightFragmentShader = R"(#version 330 core
centroid in vec3 surfaceDirect;
centroid in vec3 surfaceIndirect;

uniform vec3 reflectance;
uniform vec3 emission;                   // nit

layout(location = 0) out vec4 beauty;
layout(location = 1) out vec4 direct;
layout(location = 2) out vec4 indirect;

const float kInversePi = 0.31830988618;

void main() {
    vec3 lightDirect = reflectance * kInversePi * surfaceDirect;
    vec3 lightIndirect = reflectance * kInversePi * surfaceIndirect;
    beauty = vec4(emission + lightDirect + lightIndirect, 1.0);
    direct = vec4(lightDirect, 1.0);
    indirect = vec4(lightIndirect, 1.0);
}
)";

const char* const kSurfaceFragmentShader = R"(#version 330 core
centroid in vec3 surfaceDirect;
centroid in vec3 surfaceIndirect;
in vec3 surfaceNormal;
in float surfaceDepth;

uniform vec3 reflectance;
uniform uint objectId;

layout(location = 0) out vec4 normalAndDepth;
layout(location = 1) out vec4 albedo;
layout(location = 2) out vec4 illuminance;
layout(location = 3) out uint object;

void main() {
    float length2 = dot(surfaceNormal, surfaceNormal);
    vec3 unit = length2 > 0.0 ? surfaceNormal * inversesqrt(length2) : vec3(0.0);
    normalAndDepth = vec4(unit, surfaceDepth);
    albedo = vec4(reflectance, 1.0);
    illuminance = vec4(surfaceDirect + surfaceIndirect, 1.0);
    object = objectId;
}
)";

} // namespace penumbra
