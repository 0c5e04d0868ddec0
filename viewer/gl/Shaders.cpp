#include "viewer/gl/Shaders.h"

namespace penumbra {

namespace {

// Factors, and textures that they are factors of. A picture's texels are linear when they get here.
const char* const kSurfaceColours = R"(#version 330 core
in vec2 surfaceUv;

uniform vec3 reflectance;
uniform vec3 emission;                   // nit
uniform int reflectanceTextured, emissionTextured;
uniform sampler2D reflectanceMap, emissionMap;
uniform vec3 reflectanceScale, reflectanceBias, emissionScale, emissionBias;
uniform mat3 reflectancePlace, emissionPlace;

vec3 reflectanceHere() {
    if (reflectanceTextured == 0) return reflectance;
    vec3 texel = texture(reflectanceMap, (reflectancePlace * vec3(surfaceUv, 1.0)).xy).rgb;
    return reflectance * max(texel * reflectanceScale + reflectanceBias, 0.0);
}

vec3 emissionHere() {
    if (emissionTextured == 0) return emission;
    vec3 texel = texture(emissionMap, (emissionPlace * vec3(surfaceUv, 1.0)).xy).rgb;
    return emission * max(texel * emissionScale + emissionBias, 0.0);
}
)";

const char* const kLightFragment = R"(
centroid in vec3 surfaceDirect;
centroid in vec3 surfaceIndirect;

layout(location = 0) out vec4 beauty;
layout(location = 1) out vec4 direct;
layout(location = 2) out vec4 indirect;

const float kInversePi = 0.31830988618;

void main() {
    vec3 rho = reflectanceHere();
    vec3 nits = emissionHere();
    vec3 lightDirect = rho * kInversePi * surfaceDirect;
    vec3 lightIndirect = rho * kInversePi * surfaceIndirect;
    beauty = vec4(nits + lightDirect + lightIndirect, 1.0);
    direct = vec4(lightDirect, 1.0);
    indirect = vec4(lightIndirect, 1.0);
}
)";

const char* const kSurfaceFragment = R"(
centroid in vec3 surfaceDirect;
centroid in vec3 surfaceIndirect;
in vec3 surfaceNormal;
in float surfaceDepth;

uniform uint objectId;

layout(location = 0) out vec4 normalAndDepth;
layout(location = 1) out vec4 albedo;
layout(location = 2) out vec4 illuminance;
layout(location = 3) out uint object;

void main() {
    float length2 = dot(surfaceNormal, surfaceNormal);
    vec3 unit = length2 > 0.0 ? surfaceNormal * inversesqrt(length2) : vec3(0.0);
    normalAndDepth = vec4(unit, surfaceDepth);
    albedo = vec4(reflectanceHere(), 1.0);
    illuminance = vec4(surfaceDirect + surfaceIndirect, 1.0);
    object = objectId;
}
)";

const char* const kScreenFragment = R"(
centroid in vec3 surfaceDirect;
centroid in vec3 surfaceIndirect;

layout(location = 0) out vec4 beauty;

const float kInversePi = 0.31830988618;
const float kMost = 65000.0;             // nit; 16-bit floats end at 65504

void main() {
    vec3 rho = reflectanceHere();
    vec3 nits = emissionHere();
    vec3 reflected = rho * kInversePi * (surfaceDirect + surfaceIndirect);
    float emitted = max(max(nits.r, nits.g), nits.b);
    beauty = vec4(min(reflected + nits, kMost), emitted > 0.0 ? 0.0 : 1.0);
}
)";

const char* const kPreviewFragment = R"(
in vec3 eyePosition;
in vec3 eyeNormal;                       // of the front, any length; 0: the file has none

uniform int lightCount;
uniform vec4 lightPositions[16];         // position [m], area [m^2]
uniform vec4 lightAxes[16];              // unit; zero: emits all round
uniform vec4 lightIntensities[16];       // cd
uniform vec3 ambient;                    // lux

layout(location = 0) out vec4 beauty;

const float kInversePi = 0.31830988618;
const float kMost = 65000.0;

// The file's, no more than 60 degrees off the surface's own, as LimitSurface has it.
vec3 shadingNormal(vec3 own) {
    float size = length(eyeNormal);
    if (!(size > 0.0)) return own;
    vec3 shading = (gl_FrontFacing ? eyeNormal : -eyeNormal) / size;
    float along = dot(shading, own);
    if (along >= 0.5) return shading;
    vec3 aside = shading - along * own;
    float off = length(aside);
    return off > 0.0 ? 0.5 * own + sqrt(0.75) / off * aside : own;
}

vec3 illuminance(vec3 normal) {
    float headOn = abs(dot(normal, normalize(eyePosition)));
    vec3 sum = ambient * (0.5 + 0.5 * headOn);
    for (int i = 0; i < lightCount; ++i) {
        vec3 way = lightPositions[i].xyz - eyePosition;
        float distance2 = max(dot(way, way), 1e-8);
        vec3 towards = way * inversesqrt(distance2);
        vec3 axis = lightAxes[i].xyz;
        float shape = dot(axis, axis) > 0.0 ? max(-dot(towards, axis), 0.0) : 1.0;
        float facing = max(dot(normal, towards), 0.0);
        sum += lightIntensities[i].rgb *
               (shape * facing / (distance2 + lightPositions[i].w * kInversePi));
    }
    return sum;
}

void main() {
    vec3 rho = reflectanceHere();
    vec3 nits = emissionHere();
    vec3 own = normalize(cross(dFdx(eyePosition), dFdy(eyePosition))); // towards the eye
    vec3 normal = shadingNormal(own);
    vec3 reflected = rho * kInversePi * illuminance(normal);
    float emitted = max(max(nits.r, nits.g), nits.b);
    beauty = vec4(min(reflected + nits, kMost), emitted > 0.0 ? 0.0 : 1.0);
}
)";

} // namespace

const char* const kLitVertexShader = R"(#version 330 core
layout(location = 0) in vec3 position;   // local frame
layout(location = 1) in vec3 normal;     // local frame, unit
layout(location = 2) in vec3 direct;     // lux
layout(location = 3) in vec3 indirect;   // lux
layout(location = 6) in vec2 uv;

uniform mat4 localToClip;
uniform vec4 localToDepth;               // depth = dot(localToDepth, (p, 1))
uniform mat3 normalToWorld;

// Centroid: in a pixel that an edge crosses, the light is taken where the surface is. At the pixel's
// centre, outside of the triangle, it would be extrapolated, even to less than nothing.
centroid out vec3 surfaceDirect;
centroid out vec3 surfaceIndirect;
out vec3 surfaceNormal;
out float surfaceDepth;
out vec2 surfaceUv;

void main() {
    gl_Position = localToClip * vec4(position, 1.0);
    surfaceDepth = dot(localToDepth, vec4(position, 1.0));
    surfaceNormal = normalToWorld * normal;
    surfaceDirect = direct;
    surfaceIndirect = indirect;
    surfaceUv = uv;
}
)";

const char* const kPreviewVertexShader = R"(#version 330 core
layout(location = 0) in vec3 position;   // local frame
layout(location = 1) in vec3 normal;     // local frame, of the front; 0: none
layout(location = 6) in vec2 uv;

uniform mat4 localToClip;
uniform mat4 localToEye;

out vec3 eyePosition;                    // the camera is at the origin and looks along -z [m]
out vec3 eyeNormal;
out vec2 surfaceUv;

void main() {
    gl_Position = localToClip * vec4(position, 1.0);
    eyePosition = vec3(localToEye * vec4(position, 1.0));
    eyeNormal = transpose(inverse(mat3(localToEye))) * normal;
    surfaceUv = uv;
}
)";

std::string lightFragmentShader() {
    return std::string(kSurfaceColours) + kLightFragment;
}

std::string surfaceFragmentShader() {
    return std::string(kSurfaceColours) + kSurfaceFragment;
}

std::string screenFragmentShader() {
    return std::string(kSurfaceColours) + kScreenFragment;
}

std::string previewFragmentShader() {
    return std::string(kSurfaceColours) + kPreviewFragment;
}

} // namespace penumbra
