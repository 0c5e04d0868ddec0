// Sensor lists and their values, as CSV.
#pragma once

#include "base/Rgb.h"
#include "radiosity/mesh/PatchSet.h"

#include <span>
#include <string>
#include <vector>

namespace penumbra {

/// Reads a table with the columns x, y, z, nx, ny, nz (metres, scene frame, unit normal), in any
/// order and among others. Normals are made unit. \throws Error `file:line: error: ...`
std::vector<Receiver> readSensors(const std::string& path);

/// Writes the sensors and what they read: x,y,z,nx,ny,nz,r,g,b with r, g, b in lux. The file
/// appears whole or not at all; "-" is standard output.
void writeValues(const std::string& path, std::span<const Receiver> sensors,
                 std::span<const Rgb> values);

} // namespace penumbra
