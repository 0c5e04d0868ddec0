// Numbers of 16 bits (IEEE 754 binary16).
#pragma once

#include <cstddef>
#include <cstdint>

#ifdef __F16C__
#include <immintrin.h>
#else
#include <glm/gtc/packing.hpp>
#endif

namespace penumbra {

/// Rounds to the nearest. Beyond 65504 becomes infinite.
inline std::uint16_t toHalf(float value) {
#ifdef __F16C__
    return std::uint16_t(_cvtss_sh(value, _MM_FROUND_TO_NEAREST_INT));
#else
    return glm::packHalf1x16(value);
#endif
}

/// \param count a multiple of 8
inline void fromHalves(const std::uint16_t* halves, float* values, std::size_t count) {
#ifdef __F16C__
    for (std::size_t i = 0; i < count; i += 8)
        _mm256_storeu_ps(values + i, _mm256_cvtph_ps(_mm_loadu_si128(
                                         reinterpret_cast<const __m128i*>(halves + i))));
#else
    for (std::size_t i = 0; i < count; ++i) values[i] = glm::unpackHalf1x16(halves[i]);
#endif
}

} // namespace penumbra
