// A group with a frame of its own.
#pragma once

#include "scenegraph/Group.h"

#include <glm/glm.hpp>

namespace penumbra {

/// A group whose children live in a frame of their own.
class Transform : public Group {
public:
    using Group::Group;
    void accept(Visitor& visitor) const override;

    /// Local to parent frame, column vectors (p' = M p), affine, lengths in the parent's unit.
    const glm::dmat4& matrix() const { return matrix_; }
    void setMatrix(const glm::dmat4& matrix);

    /// Whether it begins an object: what people would pick up as one thing.
    bool beginsObject() const { return beginsObject_; }
    void setBeginsObject(bool begins);

private:
    glm::dmat4 matrix_{1.0};
    bool beginsObject_ = false;
};

} // namespace penumbra
