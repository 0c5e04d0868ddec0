#include "viewer/input/Furnishing.h"

#include "io/usd/layer/UsdPath.h"
#include "scenegraph/Copy.h"
#include "scenegraph/Find.h"

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

namespace penumbra {

namespace {

/// A node and where it is.
struct Thing {
    NodePtr node;
    std::string path; ///< in the scene
    ChildPlace at;
};

std::optional<Thing> thingOf(const Scene& scene, const Selection& selection) {
    Thing thing{selection.node, selection.objectPath, {}};
    if (!thing.node) {
        thing.path = selection.path;
        const auto nodes = nodesAt(*scene.root, thing.path);
        if (nodes.empty()) return std::nullopt;
        thing.node = nodes.back(); // the leaf of those that share the path
    }
    const auto place = placeOf(scene.root, thing.path, *thing.node);
    if (!place) return std::nullopt;
    thing.at = *place;
    return thing;
}

/// The prim of a node; empty: none is known.
std::string primOf(const UsdAddresses& addresses, const NodePtr& node) {
    const auto of = [&](const auto& list, auto pointer) {
        const auto found = std::find_if(list.begin(), list.end(), [&](const auto& address) {
            return std::invoke(pointer, address) == node;
        });
        return found != list.end() ? found->prim : std::string();
    };
    std::string prim = of(addresses.transforms, &UsdAddresses::TransformAddress::node);
    if (prim.empty()) prim = of(addresses.lights, &UsdAddresses::LightAddress::light);
    return prim;
}

/// Seat: Seat_copy, Seat_copy2, ...; of Seat_copy likewise.
std::string freeName(const UsdAddresses& addresses, const Group& parent, const std::string& name) {
    const std::string suffix = "_copy";
    const std::size_t end = name.rfind(suffix);
    const bool copied =
        end != std::string::npos &&
        name.find_first_not_of("0123456789", end + suffix.size()) == std::string::npos;
    const std::string stem = (copied ? name.substr(0, end) : name) + suffix;
    const auto taken = [&](const std::string& wanted) {
        const auto has = [&](const auto& list) {
            return std::any_of(list.begin(), list.end(),
                               [&](const auto& one) { return one.prim.ends_with("/" + wanted); });
        };
        return has(addresses.transforms) || has(addresses.lights) || has(addresses.presences) ||
               std::any_of(parent.children().begin(), parent.children().end(),
                           [&](const NodePtr& child) { return child->name() == wanted; });
    };
    std::string free = stem;
    for (int number = 2; taken(free); ++number) free = stem + std::to_string(number);
    return free;
}

void note(UsdAddresses& addresses, UsdAddresses::Presence presence) {
    const auto same = [&](const auto& known) { return known.node == presence.node; };
    if (std::none_of(addresses.presences.begin(), addresses.presences.end(), same))
        addresses.presences.push_back(std::move(presence));
}

/// Gives a copied node the prim that stands for it in the copy.
void noteCopied(UsdAddresses& addresses, const NodePtr& node, const NodePtr& copy,
                const std::string& from, const std::string& to) {
    const std::string prim = primOf(addresses, node);
    if (prim.empty() || !isUsdPathWithin(prim, from)) return;
    const std::string place = movedUsdPath(prim, from, to);
    if (const auto transform = std::dynamic_pointer_cast<Transform>(copy)) {
        const auto original =
            std::ranges::find(addresses.transforms, node, &UsdAddresses::TransformAddress::node);
        addresses.transforms.push_back({transform, place, false, original->apart});
    }
    if (const auto light = std::dynamic_pointer_cast<Light>(copy))
        addresses.lights.push_back({light, nullptr, place});
}

} // namespace

std::optional<PresenceEdit> removalOf(LoadedScene& loaded, const Selection& selection, bool hides) {
    const auto thing = thingOf(*loaded.scene, selection);
    if (!thing) return std::nullopt;
    const auto& [parent, index] = thing->at;
    note(loaded.addresses, {parent, thing->node, primOf(loaded.addresses, thing->node), {}});
    return PresenceEdit{parent, thing->node, index, true, false, hides};
}

std::optional<Duplicate> duplicateOf(LoadedScene& loaded, const Selection& selection,
                                     const glm::dmat4& place) {
    auto thing = thingOf(*loaded.scene, selection);
    if (!thing) return std::nullopt;
    // What comes and goes by itself is below a Switch of its name; another one stays.
    std::shared_ptr<Group> parent = thing->at.parent;
    if (std::dynamic_pointer_cast<Switch>(parent) && thing->node->name().empty())
        if (const auto outer = placeOf(loaded.scene->root, thing->path, *parent))
            parent = outer->parent;
    UsdAddresses& addresses = loaded.addresses;
    const std::string last = thing->path.substr(thing->path.rfind('/') + 1);
    const std::string name = freeName(addresses, *parent, last);
    const std::string prim = primOf(addresses, thing->node);
    const std::string copyPrim =
        prim.empty() ? std::string() : usdChildPath(usdParentPath(prim), name);

    std::shared_ptr<Transform> copy;
    std::vector<std::pair<NodePtr, NodePtr>> copied;
    const auto made = [&](const NodePtr& one, const NodePtr& other) {
        copied.emplace_back(one, other);
    };
    if (selection.node) {
        copy = std::static_pointer_cast<Transform>(copyOf(thing->node, name, made));
    } else {
        NodePtr leaf = copyOf(thing->node, "", made);
        if (!leaf) return std::nullopt;
        copy = std::make_shared<Transform>(name);
        copy->add(std::move(leaf));
        if (!prim.empty()) addresses.transforms.push_back({copy, copyPrim, false, false});
    }
    copy->setMatrix(place * copy->matrix());
    copy->setBeginsObject(true);
    if (!prim.empty())
        for (const auto& [one, other] : copied) noteCopied(addresses, one, other, prim, copyPrim);
    note(addresses, {parent, copy, copyPrim, prim});
    return Duplicate{{parent, copy, parent->children().size(), false, true, false},
                     usdChildPath(usdParentPath(thing->path), name)};
}

} // namespace penumbra
