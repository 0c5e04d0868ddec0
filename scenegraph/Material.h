// What a surface is to a radiosity system: Lambertian reflectance and emission.
#pragma once

#include "base/Rgb.h"
#include "scenegraph/Texture.h"

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

namespace penumbra {

/// Pictures that a surface wears, times its colours; null: none.
struct MaterialTextures {
    std::shared_ptr<const Texture> reflectance, emission;

    bool any() const { return reflectance || emission; }
    friend bool operator==(const MaterialTextures&, const MaterialTextures&) = default;
};

/// A Lambertian surface. Shared between meshes; an edit bumps its revision.
///
/// With a texture, reflectance and emission are factors of what that says at a point of the
/// surface: reflectance = min(factor * texture, kMaxReflectance). Textures are never exchanged.
class Material {
public:
    explicit Material(std::string name, MaterialTextures textures = {})
        : name_(std::move(name)), textures_(std::move(textures)) {}
    const std::string& name() const { return name_; }
    const MaterialTextures& textures() const { return textures_; }

    /// Diffuse reflectance rho, each channel in [0, kMaxReflectance]; a factor in [0, 1] if there
    /// is a texture.
    Rgb reflectance() const { return reflectance_; }
    /// Clamps to [0, mostReflectance()]: a surface that loses no light at all never settles.
    void setReflectance(Rgb reflectance) {
        const auto clamped = [&](float c) { return std::clamp(c, 0.0f, mostReflectance()); };
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
    /// The same as a mean over all of its texture [nit].
    Rgb meanEmission() const {
        return textures_.emission ? emission_ * textures_.emission->mean() : emission_;
    }

    float mostReflectance() const { return textures_.reflectance ? 1.0f : kMaxReflectance; }

    std::uint64_t revision() const { return revision_; }

    static constexpr float kMaxReflectance = 0.98f;

private:
    std::string name_;
    MaterialTextures textures_;
    Rgb reflectance_{0.5f};
    Rgb emission_{};
    std::uint64_t revision_ = 1;
};

} // namespace penumbra
