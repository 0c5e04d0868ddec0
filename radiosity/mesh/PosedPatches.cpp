#include "radiosity/mesh/PosedPatches.h"

namespace penumbra {

RayScene raysThrough(const PatchSet& set) {
    RayScene rays(set.rayMeshes, set.skin);
    for (std::uint32_t o = 0; o < set.objects.size(); ++o)
        if (!set.objects[o].present) rays.show({o}, false);
    rays.commit();
    return rays;
}

PosedPatches::PosedPatches(PatchSet& set, const Progress& progress)
    : set_(set), rays_(raysThrough(set)), coverage_(set, rays_, progress) {}

void PosedPatches::setAlone(std::span<const ObjectId> objects) {
    for (const ObjectId object : objects) rays_.setAlone(object);
    rays_.commit();
}

void PosedPatches::add(std::span<const ObjectId> objects) {
    for (const ObjectId object : objects) {
        rays_.add(set_.rayMeshes[object.value]);
        rays_.show(object, false);
    }
    coverage_.add(objects);
}

PosedPatches::Change PosedPatches::pose(std::span<const ObjectPose> wanted) {
    Change change;
    std::vector<Bounds> before;
    for (const ObjectPose& stand : wanted) {
        ObjectPart& part = set_.objects[stand.object.value];
        if (stand.present == part.present && stand.pose == part.pose) continue;
        change.objects.push_back(stand.object);
        before.push_back(part.present ? boundsOf(set_, stand.object) : Bounds());
        if (stand.present != part.present) rays_.show(stand.object, stand.present);
        part.present = stand.present;
        if (stand.pose == part.pose) continue;
        placeObject(set_, stand.object, stand.pose);
        rays_.move(stand.object, set_.rayMeshes[stand.object.value].vertices);
    }
    if (change.objects.empty()) return change;
    rays_.commit();
    change.covered = coverage_.update(change.objects, before);
    return change;
}

} // namespace penumbra
