// Area lights, in UsdLux's local frames.
#pragma once

#include "base/Bounds.h"
#include "base/Rgb.h"
#include "scenegraph/Node.h"

#include <variant>

namespace penumbra {

/// width x height [local units] in the XY plane, centred; emits towards -Z only.
struct RectShape {
    float width = 1, height = 1;
};
/// Disk in the XY plane, centred; emits towards -Z only.
struct DiskShape {
    float radius = 0.5f;
};
/// Sphere around the origin; emits outwards.
struct SphereShape {
    float radius = 0.5f;
};
using LightShape = std::variant<RectShape, DiskShape, SphereShape>;

/// A Lambertian area light: opaque, black, emitting. Its exitance is pi times its luminance.
class Light : public Node {
public:
    Light(std::string name, LightShape shape, Rgb luminance)
        : Node(std::move(name)), shape_(shape), luminance_(luminance) {}
    void accept(Visitor& visitor) const override;

    const LightShape& shape() const { return shape_; }
    Bounds bounds() const; ///< [local frame]

    /// Luminance L [nit = cd/m^2], all of UsdLux's factors multiplied in.
    Rgb luminance() const { return luminance_; }
    void setLuminance(Rgb luminance) {
        luminance_ = luminance;
        touch();
    }

private:
    LightShape shape_;
    Rgb luminance_;
};

} // namespace penumbra
