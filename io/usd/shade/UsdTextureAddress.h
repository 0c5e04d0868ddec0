// Where in a stage a texture's scale comes from.
#pragma once

#include <string>

namespace penumbra {

/// Where a texture's scale is written, if it is nothing but a factor.
struct UsdTextureAddress {
    std::string shader; ///< path of the UsdUVTexture; empty: there is none
    float alpha = 1;    ///< the scale's fourth component
};

} // namespace penumbra
