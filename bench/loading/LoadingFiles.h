// Large layers, as text and as crate files, for what measures how they are read.
#pragma once

#include <cstddef>
#include <string>

namespace penumbra {

/// A mesh of so many points, in a grid of quads: points, counts and indices are arrays.
std::string meshText(std::size_t points);
std::string meshCrate(std::size_t points);

/// Spheres of three attributes each, as rigs and scattered things have them: four specs a prim.
std::string primsText(std::size_t prims);
std::string primsCrate(std::size_t prims);

} // namespace penumbra
