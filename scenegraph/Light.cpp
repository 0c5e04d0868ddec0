#include "scenegraph/Light.h"

#include "scenegraph/Visitor.h"

namespace penumbra {

void Light::accept(Visitor& visitor) const {
    visitor.visit(*this);
}

Bounds Light::bounds() const {
    struct Half {
        glm::vec3 operator()(const RectShape& s) const { return {s.width / 2, s.height / 2, 0}; }
        glm::vec3 operator()(const DiskShape& s) const { return {s.radius, s.radius, 0}; }
        glm::vec3 operator()(const SphereShape& s) const { return glm::vec3(s.radius); }
    };
    const glm::vec3 half = std::visit(Half{}, shape_);
    return {-half, half};
}

} // namespace penumbra
