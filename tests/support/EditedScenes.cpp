#include "tests/support/EditedScenes.h"

#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

namespace penumbra {

namespace {

glm::dmat4 turned(double angle, glm::dvec3 axis) {
    return glm::rotate(glm::dmat4(1.0), angle, axis);
}

std::shared_ptr<Mesh> block(glm::vec3 size, std::shared_ptr<Material> material) {
    return std::make_shared<Mesh>("mesh",
                                  boxData(-0.5f * size, 0.5f * size, false, std::move(material)));
}

std::shared_ptr<Mesh> plate(float width, float depth, std::shared_ptr<Material> material) {
    MeshData data = floorData(-width / 2, width / 2, -depth / 2, depth / 2, 0, std::move(material));
    data.doubleSided = true;
    return std::make_shared<Mesh>("mesh", std::move(data));
}

} // namespace

EditableRoom::EditableRoom(std::uint32_t seed) : random_(seed) {
    const auto paintOf = [&] {
        paints_.push_back(paint({float(uniform(0.1, 0.8)), float(uniform(0.1, 0.8)), 0.5f}));
        return paints_.back();
    };
    scene_.root->add(object("room", boxData({0, 0, 0}, {3, 2.4f, 2}, true, paintOf())));
    scene_.root->add(
        object("table", boxData({1.1f, 0.8f, 0}, {1.7f, 1.5f, 0.6f}, false, paintOf())));
    auto lamp = std::make_shared<Light>("light", RectShape{0.6f, 0.4f}, Rgb(10));
    lights_.push_back(lamp);
    scene_.root->add(placed("ceilingLamp", moved(1.5, 1.2, 1.95), {lamp}));

    addMovable("box", block({0.4f, 0.5f, 0.6f}, paintOf()));
    const auto shared = block({0.3f, 0.3f, 0.3f}, paintOf());
    addMovable("left", shared);
    addMovable("right", shared);
    addMovable("plate", plate(0.7f, 0.5f, paintOf()));
    const auto small = std::make_shared<Light>("light", RectShape{0.2f, 0.2f}, Rgb(30));
    lights_.push_back(small);
    const auto head = make<Group>("head", {small});
    head->add(placed("housing", moved(0, 0, 0.06), {block({0.26f, 0.26f, 0.1f}, paintOf())}));
    addMovable("lamp", head);
    // Below a frame that stretches: what is movable in it is rigid in the world all the same.
    const auto frame = placed("frame", scaled(0.5), {});
    const auto inside = movable("inside", {block({0.8f, 0.6f, 0.4f}, paintOf())});
    frame->add(inside);
    scene_.root->add(frame);
    things_.push_back(inside);
    for (const auto& thing : things_) {
        thing->setMatrix(anywhere());
        home_.push_back(thing->matrix());
    }
}

std::shared_ptr<Transform> EditableRoom::addMovable(const std::string& name, NodePtr content) {
    auto thing = movable(name, {std::move(content)});
    auto choice = make<Switch>(name + "Switch", {thing});
    scene_.root->add(choice);
    things_.push_back(thing);
    switches_.push_back(choice);
    return thing;
}

double EditableRoom::uniform(double low, double high) {
    return low + (high - low) * double(random_()) / double(0xffffffffu);
}

std::size_t EditableRoom::below(std::size_t count) {
    return random_() % count;
}

/// In the room, through its walls, on the floor or on the table.
glm::dmat4 EditableRoom::anywhere() {
    glm::dvec3 place(uniform(-0.2, 3.2), uniform(-0.2, 2.6), uniform(0.2, 1.7));
    const std::size_t how = below(4);
    if (how == 0) place.z = 0.15; // what is 0.3 high stands on the floor
    if (how == 1) place = {uniform(1.1, 1.7), uniform(0.8, 1.5), 0.75};
    glm::dmat4 pose = moved(place.x, place.y, place.z);
    if (below(2) == 0) pose = pose * turned(uniform(0, 6.28), {0, 0, 1});
    if (below(4) == 0) pose = pose * turned(uniform(0, 6.28), {1, 0, 0});
    return pose;
}

std::string EditableRoom::edit() {
    std::ostringstream said;
    for (std::size_t again = 0; again < 1 + (below(4) == 0 ? 2u : 0u); ++again) {
        const std::size_t i = below(things_.size());
        switch (below(9)) {
        case 0: {
            const std::size_t s = below(switches_.size());
            switches_[s]->setVisible(!switches_[s]->visible());
            said << "switch " << switches_[s]->name() << "; ";
            break;
        }
        case 1:
            lights_[below(lights_.size())]->setLuminance(
                below(3) == 0 ? Rgb() : Rgb(float(uniform(1, 40)), float(uniform(1, 40)), 5));
            said << "luminance; ";
            break;
        case 2:
            paints_[below(paints_.size())]->setReflectance(
                {float(uniform(0, 0.85)), float(uniform(0, 0.85)), float(uniform(0, 0.85))});
            said << "paint; ";
            break;
        case 3:
            things_[i]->setMatrix(home_[i]);
            said << things_[i]->name() << " home; ";
            break;
        case 4: // a nudge
            things_[i]->setMatrix(moved(uniform(-0.05, 0.05), uniform(-0.05, 0.05), 0) *
                                  things_[i]->matrix());
            said << things_[i]->name() << " nudged; ";
            break;
        default:
            things_[i]->setMatrix(anywhere());
            said << things_[i]->name() << " moved; ";
        }
    }
    return said.str();
}

namespace {

struct Comparison {
    const PatchSet& a;
    const PatchSet& b;
    std::ostringstream said;
    int differences = 0;

    template <class... Text>
    bool expect(bool same, const Text&... text) {
        if (same) return true;
        if (++differences <= 5) ((said << text), ..., (said << "\n"));
        return false;
    }
};

bool sameVisibility(const RowBlock::Entry& a, const RowBlock::Entry& b) {
    return a.present == b.present && a.formFactor == b.formFactor && a.visible == b.visible &&
           a.visibility == b.visibility;
}

RowBlock::Entry entryOf(const Row& row, std::uint32_t receiver) {
    return row[receiver / PatchSet::kBlock].entry(int(receiver % PatchSet::kBlock));
}

void compareDirect(Comparison& with, const Row& a, const Row& b, const ObjectPart& pa,
                   const ObjectPart& pb, const std::string& emitter) {
    for (std::uint32_t i = 0; i < pa.elements.count; ++i) {
        const std::uint32_t ea = pa.elements.first + i, eb = pb.elements.first + i;
        if (!with.expect(with.a.receives(ea) == with.b.receives(eb), pa.path, " element ", i,
                         " covered in one only"))
            continue;
        if (!with.a.receives(ea)) continue;
        for (std::size_t k = 0; k < 4; ++k) {
            const std::uint32_t va = with.a.elements[ea].vertices[k];
            const std::uint32_t vb = with.b.elements[eb].vertices[k];
            const glm::vec3 one = with.a.vertices[va].receiver.position,
                            other = with.b.vertices[vb].receiver.position;
            with.expect(one == other, pa.path, " element ", i, " corner ", k, " is lit at ", one.x,
                        " ", one.y, " ", one.z, " against ", other.x, " ", other.y, " ", other.z);
            const auto seenA = entryOf(a, va), seenB = entryOf(b, vb);
            with.expect(sameVisibility(seenA, seenB), emitter, " onto ", pa.path, " element ", i,
                        " corner ", k, ": ", seenA.formFactor, " ", std::hex, seenA.visible,
                        " against ", seenB.formFactor, " ", seenB.visible, std::dec);
        }
    }
}

} // namespace

std::string difference(const LitScene& one, const LitScene& other) {
    Comparison with{one.patches(), other.patches(), {}};
    std::map<std::string, const ObjectPart*> parts;
    for (const ObjectPart& part : with.b.objects) parts[part.path] = &part;
    const double allowed =
        one.solver().statistics().certificate + other.solver().statistics().certificate + 1e-4;
    const auto ra = one.solver().radiosity(), rb = other.solver().radiosity();
    const auto rowsA = one.solver().patchRows(), rowsB = other.solver().patchRows();
    for (const ObjectPart& pa : with.a.objects) {
        if (!with.expect(parts.count(pa.path) == 1, pa.path, " is missing")) continue;
        const ObjectPart& pb = *parts[pa.path];
        with.expect(pa.present == pb.present, pa.path, " is there in one only");
        if (!with.expect(
                pa.elements.count == pb.elements.count && pa.patches.count == pb.patches.count &&
                    pa.nodes.count == pb.nodes.count && pa.emitters.count == pb.emitters.count,
                pa.path, " is meshed in another way") ||
            !pa.present)
            continue;
        for (const ObjectPart& sa : with.a.objects) {
            const ObjectPart& sb = *parts[sa.path];
            if (!sa.present) continue;
            for (std::uint32_t i = 0; i < sa.emitters.count; ++i)
                compareDirect(with, one.solver().emitterRows()[sa.emitters.first + i],
                              other.solver().emitterRows()[sb.emitters.first + i], pa, pb, sa.path);
            for (std::uint32_t i = 0; i < sa.patches.count && !rowsA.empty(); ++i) {
                const Row& a = rowsA[sa.patches.first + i];
                const Row& b = rowsB[sb.patches.first + i];
                if (a.empty() || b.empty()) continue;
                for (std::uint32_t n = 0; n < pa.nodes.count; ++n) {
                    const auto ea = entryOf(a, pa.nodes.first + n);
                    const auto eb = entryOf(b, pb.nodes.first + n);
                    with.expect(sameVisibility(ea, eb), sa.path, " patch ", i, " onto ", pa.path,
                                " node ", n, ": ", ea.formFactor, " ", std::hex, ea.visible,
                                " against ", eb.formFactor, " ", eb.visible, std::dec);
                }
            }
        }
    }
    for (const ObjectPart& pa : with.a.objects) { // what follows from the rest comes last
        const ObjectPart& pb = *parts[pa.path];
        for (std::uint32_t p = 0; with.differences == 0 && p < pa.patches.count; ++p) {
            const Rgb a = ra[pa.patches.first + p], b = rb[pb.patches.first + p];
            with.expect(maxChannel(absolute(a - b)) <= allowed, pa.path, " patch ", p, " sends ",
                        a.g, " against ", b.g, " of +-", allowed);
        }
    }
    if (with.differences > 5) with.said << "and " << with.differences - 5 << " more\n";
    return with.said.str();
}

} // namespace penumbra
