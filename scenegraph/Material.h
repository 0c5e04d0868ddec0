// What a surface is to a radiosity system: Lambertian reflectance and emission.
#pragma once

#include "base/Rgb.h"

#include <cstdint>
#include <string>
#include <utility>

namespace penumbra {

/// A Lambertian surface. Shared between meshes; an edit bumps its revision.
class Material {
public:
    explicit Material(std::string name) : name_(std::move(name)) {}
    const std::string& name() const { return name_; }

    /// Diffuse reflectance rho, each channel in [0, kMaxReflectance].
    Rgb reflectance() const { return reflectance_; }
    /// Clamps to [0, kMaxReflectance]: a surface that loses no light at all never settles.
    void setReflectance(Rgb reflectance) {
        const auto clamped = [](float c) { return std::clamp(c, 0.0f, kMaxReflectance); };
        reflectance_ = {clamped(reflectance.r), clamped(reflectance.g), clamped(reflectance.b)};
        ++revision_;
    }

    /// Luminance L sent from the front of the surface, alike in all directions [nit = cd/m^2].
    Rgb emission() const { return emission_; }
    void setEmission(Rgb luminance) {
        emission_ = luminance;
        ++revision_;
    }
    bool emissive() const { return maxChannel(emission_) > 0; }

    std::uint64_t revision() const { return revision_; }

    static constexpr float kMaxReflectance = 0.98f;

private:
    std::string name_;
    Rgb reflectance_{0.5f};
    Rgb emission_{};
    std::uint64_t revision_ = 1;
};

} // namespace penumbra
