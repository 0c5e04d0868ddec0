#include "scenegraph/Transform.h"

#include "scenegraph/Visitor.h"

namespace penumbra {

void Transform::accept(Visitor& visitor) const {
    visitor.visit(*this);
}

void Transform::setMatrix(const glm::dmat4& matrix) {
    matrix_ = matrix;
    touch();
}

void Transform::setBeginsObject(bool begins) {
    if (begins == beginsObject_) return;
    beginsObject_ = begins;
    touch();
}

} // namespace penumbra
