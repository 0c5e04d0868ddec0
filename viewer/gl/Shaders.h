// The text of the shaders, GLSL 3.30.
#pragma once

#include <string>

namespace penumbra {

/// Vertex attributes of a lit surface.
enum LitAttribute : unsigned {
    kPosition = 0,
    kNormal = 1,
    kDirect = 2,
    kIndirect = 3,
    kFactors = 4, ///< of previewed lights, see ShownLight
    kBehind = 5,
    kUv = 6 ///< texture coordinates
};

// Fragment shaders take the colours of surfaces, with their textures, from TextureCache.

/// Places a lit vertex; for both fragment shaders below.
extern const char* const kLitVertexShader;

/// What the eye receives [nit]. Outputs 0 beauty with alpha, 1 direct, 2 indirect; these may be
/// averaged.
std::string lightFragmentShader();

/// What the surface is. Outputs 0 normal (world) and depth [m], 1 albedo, 2 illuminance [lux],
/// 3 object id; these may not be averaged.
std::string surfaceFragmentShader();

/// What the eye receives of a lit surface [nit], up to the range of 16-bit floats; alpha says how
/// much it counts for exposure: what reflects does, what emits does not.
std::string screenFragmentShader();

/// Surfaces before radiosity, lit as UnlitLighting says, flat shaded; the same output.
extern const char* const kPreviewVertexShader;
std::string previewFragmentShader();

} // namespace penumbra
