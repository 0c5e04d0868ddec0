// Two rooms with a door between them.
#pragma once

#include "tests/support/Scenes.h"

#include <memory>

namespace penumbra {

/// Two rooms of 2 m side by side, along x; a light in the first, and in the second a box, a closed
/// cupboard and no light. The wall between them is a decimetre thick, and the door in it slides up.
struct RoomsWithDoor {
    std::shared_ptr<Transform> door, box, cupboard;
    std::shared_ptr<Light> light;
    Scene scene;

    RoomsWithDoor() {
        MeshData first, second, wall;
        addBox(first, {0, 0, 0}, {2, 2, 2}, true, {0, 2, 3, 4, 5});
        addBox(second, {2.1f, 0, 0}, {4.1f, 2, 2}, true, {1, 2, 3, 4, 5});
        addBox(wall, {2, 0, 0}, {2.1f, 0.7f, 2}, false);
        addBox(wall, {2, 1.3f, 0}, {2.1f, 2, 2}, false);
        addBox(wall, {2, 0.7f, 1.2f}, {2.1f, 1.3f, 2}, false);
        for (MeshData* mesh : {&first, &second, &wall}) mesh->materials = {paint(Rgb(0.5f))};
        door = thing("door", moved(0, 0, 0), boxData({2, 0.7f, 0}, {2.1f, 1.3f, 1.2f}, false));
        box = thing("box", moved(3, 1, 0), boxData({-0.2f, -0.2f, 0}, {0.2f, 0.2f, 0.4f}, false));
        MeshData hollow = boxData({-0.3f, -0.3f, 0}, {0.3f, 0.3f, 0.6f}, false);
        addBox(hollow, {-0.25f, -0.25f, 0.05f}, {0.25f, 0.25f, 0.55f}, true);
        cupboard = thing("cupboard", moved(3.5, 1.5, 0), std::move(hollow));
        light = std::make_shared<Light>("light", RectShape{0.5f, 0.5f}, Rgb(1.0f));
        scene = sceneOf({object("first", first), object("second", second), object("wall", wall),
                         object("sill", floorData(2, 2.1f, 0.7f, 1.3f, 0)), door, box, cupboard,
                         placed("light", moved(1, 1, 1.99), {light})});
    }
    void open() { door->setMatrix(moved(0, 0, 3)); }
    void shut() { door->setMatrix(moved(0, 0, 0)); }

private:
    static std::shared_ptr<Transform> thing(const std::string& name, const glm::dmat4& where,
                                            MeshData data) {
        auto node = placed(name, where, {std::make_shared<Mesh>("mesh", std::move(data))});
        node->setMovable(true);
        return node;
    }
};

} // namespace penumbra
