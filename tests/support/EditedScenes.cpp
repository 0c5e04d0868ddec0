#include "tests/support/EditedScenes.h"

#include <algorithm>

namespace penumbra {

namespace {

// Lengths are sums of powers of two where things are to touch to the last bit.
constexpr glm::dvec3 kRoom(3, 2.5, 2);
constexpr glm::dvec3 kTableLower(1.125, 0.75, 0), kTableUpper(1.75, 1.5, 0.625);

std::shared_ptr<Mesh> meshOf(MeshData data) {
    return std::make_shared<Mesh>("mesh", std::move(data));
}

std::shared_ptr<Mesh> block(glm::vec3 size, std::shared_ptr<Material> material) {
    return meshOf(boxData(-0.5f * size, 0.5f * size, false, std::move(material)));
}

std::shared_ptr<Mesh> plate(float width, float depth, std::shared_ptr<Material> material) {
    MeshData data = floorData(-width / 2, width / 2, -depth / 2, depth / 2, 0, std::move(material));
    data.doubleSided = true;
    return meshOf(std::move(data));
}

std::shared_ptr<Mesh> pebble(glm::vec3 cage, std::shared_ptr<Material> material) {
    MeshData data = boxData(-0.5f * cage, 0.5f * cage, false, std::move(material));
    data.scheme = SubdivisionScheme::catmullClark;
    return meshOf(std::move(data));
}

glm::dmat4 stretched(double x, double y, double z) {
    return glm::scale(glm::dmat4(1.0), glm::dvec3(x, y, z));
}

/// Quarter turns about z, exact.
glm::dmat4 quarterTurned(std::size_t quarters) {
    constexpr double kCosine[] = {1, 0, -1, 0};
    const double c = kCosine[quarters % 4], s = kCosine[(quarters + 3) % 4];
    glm::dmat4 turn(1.0);
    turn[0] = {c, s, 0, 0};
    turn[1] = {-s, c, 0, 0};
    return turn;
}

glm::dmat4 turned(double angle, glm::dvec3 axis) {
    return glm::rotate(glm::dmat4(1.0), angle, axis);
}

} // namespace

EditableRoom::EditableRoom(std::uint32_t seed) : random_(seed) {
    addFixed();
    addThings();
    for (Thing& thing : things_) {
        place(thing, anywhere(thing));
        thing.home = thing.place;
        if (below(6) == 0) thing.choice->setVisible(false);
    }
}

void EditableRoom::addFixed() {
    scene_.root->add(object("room", boxData({0, 0, 0}, glm::vec3(kRoom), true, newPaint())));
    table_ = placed(
        "table", glm::dmat4(1.0),
        {meshOf(boxData(glm::vec3(kTableLower), glm::vec3(kTableUpper), false, newPaint()))});
    scene_.root->add(table_);
    scene_.root->add(
        placed("ceilingLamp", moved(1.5, 1.25, 1.95), {newLight(RectShape{0.6f, 0.4f}, 10)}));
    scene_.root->add(placed("wallLamp", moved(0.05, 1, 1) * turned(-1.5707963267948966, {0, 1, 0}),
                            {newLight(DiskShape{0.2f}, 8)}));
}

void EditableRoom::addThings() {
    addThing("box", {block({0.375f, 0.5f, 0.625f}, newPaint())}, {0.1875, 0.25, 0.3125});
    const auto shared = block(glm::vec3(0.25f), newPaint());
    addThing("left", {shared}, glm::dvec3(0.125));
    addThing("right", {shared}, glm::dvec3(0.125));
    addThing("plate", {plate(0.75f, 0.5f, newPaint())}, {0.375, 0.25, 0});
    addThing("pebble", {pebble(glm::vec3(0.5f), newPaint())}, glm::dvec3(0.17));
    const auto head = make<Group>("head", {newLight(RectShape{0.2f, 0.2f}, 30)});
    head->add(placed("housing", moved(0, 0, 0.06), {block({0.26f, 0.26f, 0.1f}, newPaint())}));
    addThing("lamp", {head}, {0.13, 0.13, 0.11});
    addThing("bulb", {newLight(SphereShape{0.06f}, 60)}, glm::dvec3(0.06));
    emissive_.push_back(paint(Rgb(0.3f), {6, 4, 2}));
    addThing("glow", {block({0.3f, 0.2f, 0.1f}, emissive_.back())}, {0.15, 0.1, 0.05});
    // Below frames that stretch: an object in them is rigid in the world all the same.
    addThing("halved", {block({0.75f, 0.5f, 0.5f}, newPaint())}, {0.1875, 0.125, 0.125},
             stretched(0.5, 0.5, 0.5));
    addThing("mirrored", {block({0.5f, 0.25f, 0.25f}, newPaint())}, {0.125, 0.125, 0.25},
             stretched(-0.5, 1, 2));
}

void EditableRoom::addThing(const std::string& name, std::initializer_list<NodePtr> content,
                            glm::dvec3 half, const glm::dmat4& frame) {
    const auto thing = objectOf(name, content);
    const auto choice = make<Switch>(name + "Switch", {thing});
    things_.push_back({thing, choice, frame, half, {}, {}});
    if (frame == glm::dmat4(1.0))
        scene_.root->add(choice);
    else
        scene_.root->add(placed(name + "Frame", frame, {choice}));
}

std::shared_ptr<Material> EditableRoom::newPaint() {
    paints_.push_back(paint({float(uniform(0.1, 0.8)), float(uniform(0.1, 0.8)), 0.5f}));
    return paints_.back();
}

std::shared_ptr<Light> EditableRoom::newLight(LightShape shape, float nits) {
    lights_.push_back(std::make_shared<Light>("light", shape, Rgb(nits)));
    return lights_.back();
}

double EditableRoom::uniform(double low, double high) {
    return low + (high - low) * double(random_()) / double(0xffffffffu);
}

std::size_t EditableRoom::below(std::size_t count) {
    return random_() % count;
}

void EditableRoom::place(Thing& thing, const glm::dmat4& where) {
    thing.place = where;
    thing.node->setMatrix(glm::inverse(thing.frame) * where * thing.frame);
}

/// In the room, through its walls, or in contact with something.
glm::dmat4 EditableRoom::anywhere(const Thing& thing) {
    const Thing& other = things_[below(things_.size())];
    const std::size_t quarters = below(4);
    glm::dvec3 half = thing.half;
    if (quarters % 2 == 1) std::swap(half.x, half.y);
    glm::dvec3 at(uniform(-0.2, 3.2), uniform(-0.2, 2.7), uniform(0.2, 1.7));
    const glm::dvec3 there(other.place[3]);
    switch (below(12)) {
    case 0: // on the floor
        at.z = half.z;
        break;
    case 1: // on the table, over its edge perhaps
        at = {uniform(1.1, 1.8), uniform(0.7, 1.5), kTableUpper.z + half.z};
        break;
    case 2: // against a wall
        at.x = below(2) == 0 ? half.x : kRoom.x - half.x;
        break;
    case 3: // in a corner, on the floor or under the ceiling
        at = {half.x, kRoom.y - half.y, below(2) == 0 ? half.z : kRoom.z - half.z};
        break;
    case 4: // on something, or under it
        at = there + glm::dvec3(0, 0, (below(3) == 0 ? -1 : 1) * (other.half.z + half.z));
        if (below(2) == 0) at += glm::dvec3(uniform(-0.1, 0.1), uniform(-0.1, 0.1), 0);
        break;
    case 5: // beside something
        at = there + glm::dvec3(other.half.x + half.x, uniform(-0.1, 0.1), 0);
        break;
    case 6: // exactly where something is: equal faces if the two are alike
        return other.place;
    case 7: // let into the table, its top in the table's top
        at = {uniform(1.1, 1.8), uniform(0.7, 1.5), kTableUpper.z - half.z};
        break;
    case 8: // half in the floor or in the wall
        (below(2) == 0 ? at.z : at.y) = 0;
        break;
    default: // free, at any angle
        return moved(at.x, at.y, at.z) * turned(uniform(0, 6.28), {0, 0, 1}) *
               turned(below(2) == 0 ? uniform(0, 6.28) : 0, {1, 0, 0});
    }
    return moved(at.x, at.y, at.z) * quarterTurned(quarters);
}

std::string EditableRoom::edit() {
    std::string said;
    for (std::size_t left = below(4) == 0 ? 1 + below(5) : 1; left > 0; --left) {
        Thing& thing = things_[below(things_.size())];
        const std::size_t what = below(10);
        said += what < 6 ? editThing(thing) : what < 8 ? editColour() : editGraph(thing);
    }
    return said;
}

std::string EditableRoom::editThing(Thing& thing) {
    const std::size_t how = below(6);
    if (how == 0) {
        place(thing, thing.home);
        return thing.node->name() + " home; ";
    }
    if (how == 1) {
        place(thing, moved(uniform(-0.05, 0.05), uniform(-0.05, 0.05), 0) * thing.place);
        return thing.node->name() + " nudged; ";
    }
    place(thing, anywhere(thing));
    return thing.node->name() + " moved; ";
}

std::string EditableRoom::editColour() {
    const auto any = [&](double low, double high) {
        return Rgb(float(uniform(low, high)), float(uniform(low, high)), float(uniform(low, high)));
    };
    switch (below(3)) {
    case 0:
        lights_[below(lights_.size())]->setLuminance(below(3) == 0 ? Rgb() : any(1, 40));
        return "luminance; ";
    case 1: // never dark: from scratch it would be no emitter at all
        emissive_[below(emissive_.size())]->setEmission(any(0.1, 20));
        return "emission; ";
    default:
        paints_[below(paints_.size())]->setReflectance(below(6) == 0 ? Rgb() : any(0, 0.85));
        return "paint; ";
    }
}

std::string EditableRoom::editGraph(Thing& thing) {
    if (below(16) == 0) { // rare: it takes as long as from scratch
        table_->setMatrix(moved(uniform(-0.1, 0.1), 0, 0));
        return "table moved; ";
    }
    if (below(3) == 0) {
        if (!thing.choice->remove(thing.node)) thing.choice->add(thing.node);
        return thing.node->name() + (thing.choice->children().empty() ? " removed; " : " added; ");
    }
    thing.choice->setVisible(!thing.choice->visible());
    return thing.node->name() + (thing.choice->visible() ? " shown; " : " hidden; ");
}

} // namespace penumbra
