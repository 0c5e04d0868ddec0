// Pictures for programs: OpenEXR with all layers.
#pragma once

#include "base/FrameLayers.h"
#include "scenegraph/Camera.h"

#include <cstddef>
#include <map>
#include <string>

namespace penumbra {

/// What a picture says about itself, as attributes of the file: name to value. The names of the
/// OpenEXR standard (software, owner, comments ...) may be used if the types agree.
struct ExrMetadata {
    std::map<std::string, std::string> texts;
    std::map<std::string, float> numbers;
};

struct ExrOptions {
    /// 16-bit colours and normals: half the size, a relative error up to 2^-11, nothing above
    /// 65504.
    bool half = true;
};

/// Writes one scan-line OpenEXR file, ZIP compressed, whole or not at all (see AtomicFile.h).
///
/// | channels                      | what                                   | type          |
/// | ----------------------------- | -------------------------------------- | ------------- |
/// | R, G, B                       | beauty: luminance [nit]                | half or float |
/// | A                             | alpha; R, G, B are premultiplied by it | half or float |
/// | direct.R/G/B, indirect.R/G/B  | parts of the luminance [nit]           | half or float |
/// | albedo.R/G/B                  | reflectance                            | half or float |
/// | illuminance.R/G/B             | [lux]                                  | half or float |
/// | N.X/Y/Z                       | unit normal, world frame               | half or float |
/// | Z                             | distance along the viewing axis [m]    | float         |
/// | objectId                      | index of the object                    | uint          |
///
/// A pixel without a surface has Z = infinity, objectId = 4294967295 and 0 elsewhere.
/// Attributes: `chromaticities` of Rec. ITU-R BT.709; `whiteLuminance` 1, that is, the colour
/// (1, 1, 1) has 1 cd/m^2; `worldToCamera` and `worldToNDC` as OpenEXR defines them (row vectors,
/// p' = p M; camera left-handed, looking along +Z; NDC (0, 0) upper left to (1, 1) lower right);
/// `screenWindowCenter` and `screenWindowWidth` of a perspective view.
///
/// \return how many values were beyond the range of half and were clamped to +-65504, so that they
/// do
///         not become infinite and spoil every filter after us; always 0 with `half` off
/// \throws Error if the file can't be written
///
/// OpenEXR 3.1, "Standard Attributes" and ImfStandardAttributes.h.
std::size_t writeExr(const std::string& path, const FrameLayers& frame, const View& view,
                     const ExrMetadata& metadata = {}, const ExrOptions& options = {});

} // namespace penumbra
