#include "io/usd/scene/UsdCamera.h"

#include "io/usd/layer/UsdNumber.h"

#include <array>
#include <cmath>

namespace penumbra {

Lens usdLens(const UsdAttributes& camera, Diagnostics& diagnostics) {
    Lens lens;
    const auto read = [&](float& value, std::string_view name) {
        const float number = roundToFloat(camera.number(name, double(value)));
        if (std::isfinite(number))
            value = number;
        else
            diagnostics.warn(camera.location(name), "a number of a lens ignored: not finite");
    };
    read(lens.focalLength, "focalLength");
    read(lens.horizontalAperture, "horizontalAperture");
    read(lens.verticalAperture, "verticalAperture");
    read(lens.horizontalApertureOffset, "horizontalApertureOffset");
    read(lens.verticalApertureOffset, "verticalApertureOffset");
    const auto range = camera.tuple("clippingRange", 2);
    if (!range.empty() && range[0] < range[1])
        lens.clippingRange = {roundToFloat(range[0]), roundToFloat(range[1])};
    else if (!range.empty())
        diagnostics.warn(camera.location("clippingRange"), "a clippingRange without depth ignored");
    lens.perspective = camera.text("projection", "perspective") != "orthographic";
    if (lens.focalLength > 0 && lens.horizontalAperture > 0 && lens.verticalAperture > 0)
        return lens;
    diagnostics.warn(camera.prim().location(),
                     "a camera without a usable lens gets the standard one");
    return {};
}

void checkUsdLens(const UsdPrim& camera, UsdSampleCheck& check) {
    constexpr std::array<std::string_view, 6> kNumbers{"focalLength",
                                                       "horizontalAperture",
                                                       "verticalAperture",
                                                       "horizontalApertureOffset",
                                                       "verticalApertureOffset",
                                                       "clippingRange"};
    check.each(camera, kNumbers, "lens",
               [](const UsdAttributes& at, Diagnostics& found) { usdLens(at, found); });
}

} // namespace penumbra
