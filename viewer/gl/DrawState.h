// The state of OpenGL that surfaces are drawn with.
#pragma once

#include <glm/glm.hpp>

namespace penumbra {

/// Whether depth can run from 1 near to 0 far: glClipControl exists (OpenGL 4.5).
bool canReverseDepth();

/// Clip space with z in [0, w], 1 near and 0 far, from OpenGL's z in [-w, w]: there floats, dense
/// around 0, and perspective, dense around the near plane, make up for each other.
/// (Lapidous & Jiao, Graphics Hardware 1999)
glm::dmat4 reversedDepth();

/// Sets up depth test and culling, and gives the state back, for others who draw in this context:
/// ImGui, a window.
class DrawState {
public:
    explicit DrawState(bool reversed);
    ~DrawState();
    DrawState(const DrawState&) = delete;
    DrawState& operator=(const DrawState&) = delete;

    float clearDepth() const { return reversed_ ? 0.0f : 1.0f; }

private:
    bool reversed_;
};

} // namespace penumbra
