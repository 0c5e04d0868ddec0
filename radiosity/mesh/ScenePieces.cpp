#include "radiosity/mesh/ScenePieces.h"

#include "scenegraph/Light.h"
#include "scenegraph/Mesh.h"

#include <algorithm>
#include <iterator>

namespace penumbra {

void ScenePieces::note(const PlacedScene& scene) {
    for (const Object& object : scene.objects) {
        std::vector<Piece>& known = pieces_[object.path];
        std::ranges::move(known, std::back_inserter(before_));
        known.clear();
    }
    const auto add = [&](const auto& placed) {
        pieces_[scene.objects[placed.object.value].path].push_back(
            {placed.node, placed.node->weak_from_this().lock(), placed.path, placed.toObject});
    };
    for (const auto& mesh : scene.meshes) add(mesh);
    for (const auto& light : scene.lights) add(light);
}

std::vector<ObjectId> ScenePieces::others(const PlacedScene& now) const {
    struct Matched {
        const std::vector<Piece>* pieces = nullptr;
        std::size_t seen = 0;
        bool same = true;
    };
    std::vector<Matched> objects(now.objects.size());
    for (std::size_t o = 0; o < objects.size(); ++o) {
        const auto known = pieces_.find(now.objects[o].path);
        if (known != pieces_.end()) objects[o].pieces = &known->second;
    }
    const auto compare = [&](const auto& placed) {
        auto& [pieces, seen, same] = objects[placed.object.value];
        if (!pieces || seen == pieces->size()) {
            same = false;
            return;
        }
        const Piece& piece = (*pieces)[seen++];
        same &= piece.node == placed.node && piece.path == placed.path &&
                piece.frame == placed.toObject;
    };
    std::ranges::for_each(now.meshes, compare);
    std::ranges::for_each(now.lights, compare);
    std::vector<ObjectId> others;
    for (std::uint32_t o = 0; o < objects.size(); ++o) {
        const auto& [pieces, seen, same] = objects[o];
        if (!pieces || !same || seen != pieces->size()) others.push_back({o});
    }
    return others;
}

PlacedScene partOf(const PlacedScene& scene, std::span<const ObjectId> objects) {
    PlacedScene part;
    std::vector<ObjectId> now(scene.objects.size());
    for (const ObjectId object : objects) {
        now[object.value] = {std::uint32_t(part.objects.size())};
        part.objects.push_back(scene.objects[object.value]);
    }
    const auto take = [&](const auto& from, auto& to) {
        for (const auto& placed : from)
            if (now[placed.object.value].valid())
                to.push_back(placed), to.back().object = now[placed.object.value];
    };
    take(scene.meshes, part.meshes);
    take(scene.lights, part.lights);
    return part;
}

} // namespace penumbra
