#include "radiosity/process/store/LitObjects.h"

#include "base/Clock.h"
#include "base/Error.h"
#include "radiosity/mesh/Emitters.h"
#include "radiosity/process/store/LitPatches.h"

#include <algorithm>
#include <utility>

namespace penumbra {

namespace {

constexpr std::size_t kBlock = LitGeometry::kBlock;
static_assert(kBlock == PatchSet::kBlock);
constexpr std::size_t kMostBlocks = 1024; ///< taken at once
constexpr double kMostTime = 0.002;       ///< for reading objects [s]

[[noreturn]] void senseless() {
    throw Error("the process wrote nonsense");
}

/// Two triangles an element, or one.
std::size_t indexCount(const std::array<std::uint32_t, 4>& base) {
    return base[2] == base[3] ? 3 : 6;
}

/// Emitters of one mesh follow each other. Meshes with several emitting materials, or with
/// textures that emit, are left out: one factor says nothing of two brightnesses.
std::vector<EmissiveMesh> emissiveOf(std::vector<LitMeshEmitter> emitters) {
    std::vector<EmissiveMesh> emissive;
    for (std::size_t first = 0, end = 0; first < emitters.size(); first = end) {
        bool alike = emitters[first].texture == Rgb(1);
        for (end = first + 1; end < emitters.size() && emitters[end].path == emitters[first].path;
             ++end)
            alike &= emitters[end].material == emitters[first].material &&
                     emitters[end].texture == Rgb(1);
        if (!alike) continue;
        EmissiveMesh& mesh = emissive.emplace_back();
        mesh.path = std::move(emitters[first].path);
        for (std::size_t e = first; e < end; ++e) {
            Emitter& emitter = mesh.emitters.emplace_back();
            emitter.path = mesh.path;
            emitter.polygons = std::move(emitters[e].polygons);
            for (const auto& polygon : emitter.polygons) emitter.area += polygonArea(polygon);
        }
    }
    return emissive;
}

} // namespace

LitObjects::LitObjects(std::shared_ptr<StoreReader> store, const Lights& lights)
    : store_(std::move(store)), mesh_(store_->meshes().front(), store_->shape().firstPrivate),
      lights_(lights), slots_(store_->shape().blocks) {
    if (!mesh_.ok()) senseless();
}

void LitObjects::setLights(const Lights& lights) {
    lights_ = lights;
    for (std::size_t o = 0; o < parts_.size(); ++o) {
        if (entries_[o].geometry)
            entries_[o].geometry->setLights(lights.count);
        else
            parts_[o].shares = unknownShares(lights.count, parts_[o].data.positions.size());
    }
}

void LitObjects::take(const Colour& colour) {
    const double start = steadySeconds();
    while (readMesh() && steadySeconds() - start < kMostTime) takeObject(colour);
    if (!mesh_.done()) return;
    got_.clear();
    store_->read(kMostBlocks, got_);
    for (const StoreReader::Got& got : got_) takeBlock(got);
    blocksTaken_ += got_.size();
    writeTriangles();
    for (std::uint32_t o = 0; o < parts_.size(); ++o)
        if (!entries_[o].geometry && parts_[o].missing == 0) finish(o);
}

/// \return whether there are objects to take
bool LitObjects::readMesh() {
    while (mesh_.done() && meshes_ < store_->meshes().size()) {
        mesh_.goOn(store_->meshes()[meshes_++]);
        if (!mesh_.ok()) senseless();
    }
    return !mesh_.done();
}

void LitObjects::takeDirty(std::uint32_t question) {
    work_.assign(parts_.size(), {});
    store_->readDirty(question, words_);
    if (words_.empty()) return;
    for (std::size_t o = 0; o < parts_.size(); ++o)
        work_[o].resize(parts_[o].standsFor.size() / kBlock);
    for (std::size_t b = 0; b < slots_.size(); ++b)
        if (slots_[b].object != Slot::kNone) work_[slots_[b].object][slots_[b].block] = words_[b];
}

void LitObjects::takeObject(const Colour& colour) {
    std::optional<LitMeshObject> object = mesh_.next();
    if (!object) senseless();
    const auto number = std::uint32_t(entries_.size());
    Part part;
    part.replaces = meshes_ > 1 && replace(object->path);
    const std::size_t vertices = object->positions.size();
    part.data.positions = std::move(object->positions);
    part.data.normals = std::move(object->normals);
    part.data.direct.resize(vertices);
    part.data.indirect.resize(vertices);
    for (const LitMeshMaterial& material : mesh_.head().materials)
        part.data.materials.push_back(colour(material));
    part.shares = unknownShares(lights_.count, vertices);
    part.base = std::move(object->elements);
    part.now = part.base;
    part.standsFor.assign(vertices, kNoCorner);
    for (std::uint32_t e = 0; e < part.base.size(); ++e) {
        part.firstIndex.push_back(std::uint32_t(part.data.indices.size()));
        part.data.indices.resize(part.data.indices.size() + indexCount(part.base[e]));
        part.data.triangleMaterial.resize(part.data.indices.size() / 3, object->elementMaterial[e]);
        part.data.trianglePatch.resize(part.data.indices.size() / 3, object->elementPatch[e]);
        part.changed.push_back(e);
    }
    if (!object->elementUvs.empty()) { // vertices are double where these differ
        part.data.uvs.resize(vertices);
        for (std::size_t e = 0; e < part.base.size(); ++e)
            for (std::size_t k = 0; k < 4; ++k)
                part.data.uvs[part.base[e][k]] = object->elementUvs[e][k];
    }
    part.missing = std::uint32_t(vertices / kBlock);
    for (std::uint32_t b = 0; b < part.missing; ++b)
        slots_[object->firstBlock + b] = {number, b, false};
    missing_ += part.missing;
    changedParts_.push_back(number);
    parts_.push_back(std::move(part));
    entries_.push_back({std::move(object->path), object->toObject, nullptr,
                        emissiveOf(std::move(object->emitters))});
}

/// Objects of this path get light no more. \return whether there are any
bool LitObjects::replace(const std::string& path) {
    bool any = false;
    for (std::size_t o = 0; o < entries_.size(); ++o) {
        if (entries_[o].path != path) continue;
        any = parts_[o].replaced = true;
        missing_ -= std::exchange(parts_[o].missing, 0);
    }
    return any;
}

void LitObjects::dropReplaced(const std::string& path) {
    for (std::size_t o = 0; o < entries_.size(); ++o)
        if (parts_[o].replaced && entries_[o].path == path) entries_[o] = {};
    ++revision_;
}

/// Changes an object's data, wherever it is, in a way that concerns its triangles.
void LitObjects::edit(std::uint32_t object, const std::function<void(LitMeshData&)>& change) {
    if (entries_[object].geometry)
        entries_[object].geometry->setTopology(change);
    else
        change(parts_[object].data);
}

void LitObjects::takePrivate(const StoreReader::Got& got, Slot& slot) {
    Part& part = parts_[got.light.object];
    slot = {got.light.object, std::uint32_t(part.standsFor.size() / kBlock), true};
    part.standsFor.resize(part.standsFor.size() + kBlock, kNoCorner);
    edit(slot.object, [&](LitMeshData& data) {
        for (auto* points : {&data.positions, &data.normals}) points->resize(part.standsFor.size());
        if (!data.uvs.empty()) data.uvs.resize(part.standsFor.size());
        for (auto* light : {&data.direct, &data.indirect}) light->resize(part.standsFor.size());
    });
    if (!entries_[slot.object].geometry) growShares(part.shares, part.standsFor.size());
}

void LitObjects::takeBlock(const StoreReader::Got& got) {
    if (got.light.object >= parts_.size()) {
        if (meshes_ == store_->meshesReady()) senseless();
        return store_->again(got.block); // its object is on its way
    }
    if (parts_[got.light.object].replaced) return;
    Slot& slot = slots_[got.block];
    const bool isPrivate = got.block >= store_->shape().firstPrivate;
    if (isPrivate && slot.object == Slot::kNone) takePrivate(got, slot);
    if (slot.object == Slot::kNone || slot.object != got.light.object) senseless();
    Part& part = parts_[slot.object];
    const std::size_t first = slot.block * kBlock;
    const auto write = [&](LitMeshData& data, LightShares& shares) {
        std::ranges::copy(got.light.direct, &data.direct[first]);
        std::ranges::copy(got.light.indirect, &data.indirect[first]);
        takeShares(got.light, slot.block, shares);
    };
    if (const auto& geometry = entries_[slot.object].geometry)
        geometry->setBlock(slot.block, write);
    else
        write(part.data, part.shares);
    if (isPrivate) {
        follow(part, std::uint32_t(first), got.light);
        changedParts_.push_back(slot.object);
    } else if (!std::exchange(slot.lit, true)) {
        --part.missing;
        --missing_;
    }
}

void LitObjects::takeShares(const LightBlock& light, std::size_t block, LightShares& shares) const {
    if (light.previewSet != lights_.set || light.lights != lights_.count) return; // of others
    for (std::size_t l = 0; l < lights_.count; ++l) {
        LightShare& share = shares[l];
        std::ranges::copy(light.factor[l], &share.factor[block * kBlock]);
        share.exitance[block] = light.exitance[l];
        share.known[block] =
            light.stale >> l & 1 ? LightShare::Known::stale : LightShare::Known::exact;
    }
}

/// Private vertices represent corners of elements; which ones may have changed.
void LitObjects::follow(Part& part, std::uint32_t firstVertex, const LightBlock& light) {
    for (std::uint32_t k = 0; k < kBlock; ++k) {
        const std::uint32_t before = std::exchange(part.standsFor[firstVertex + k], kNoCorner);
        if (before == kNoCorner || before == light.corners[k]) continue;
        std::uint32_t& corner = part.now[before / 4][before % 4];
        if (corner != firstVertex + k) continue; // someone else does already
        corner = part.base[before / 4][before % 4];
        part.changed.push_back(before / 4);
    }
    for (std::uint32_t k = 0; k < kBlock; ++k) {
        const std::uint32_t corner = light.corners[k];
        if (corner == kNoCorner) continue;
        if (corner / 4 >= part.base.size()) senseless();
        part.standsFor[firstVertex + k] = corner;
        if (std::exchange(part.now[corner / 4][corner % 4], firstVertex + k) == firstVertex + k)
            continue;
        part.changed.push_back(corner / 4);
    }
}

/// Brings the indices of elements whose corners have changed up to date.
void LitObjects::writeTriangles() {
    for (std::uint32_t object : changedParts_) {
        Part& part = parts_[object];
        if (part.changed.empty()) continue;
        edit(object, [&](LitMeshData& data) {
            for (std::uint32_t e : part.changed) {
                const Corners& base = part.base[e];
                const Corners& now = part.now[e];
                constexpr std::array<std::size_t, 6> kCorners{0, 1, 2, 0, 2, 3};
                for (std::size_t i = 0; i < indexCount(base); ++i)
                    data.indices[part.firstIndex[e] + i] = now[kCorners[i]];
                for (std::size_t k = 0; k < 4; ++k) {
                    if (now[k] == base[k]) continue;
                    data.positions[now[k]] = data.positions[base[k]];
                    data.normals[now[k]] = data.normals[base[k]];
                    if (!data.uvs.empty()) data.uvs[now[k]] = data.uvs[base[k]];
                }
            }
        });
        part.changed.clear();
    }
    changedParts_.clear();
}

std::optional<PatchSet> LitObjects::patches() const {
    return readPatches(store_->meshes(), store_->shape().firstPrivate);
}

void LitObjects::finish(std::uint32_t object) {
    Part& part = parts_[object];
    if (part.replaced) return;
    if (std::exchange(part.replaces, false)) dropReplaced(std::string(entries_[object].path));
    if (part.data.indices.empty()) return; // nothing to draw
    entries_[object].geometry = std::make_shared<PublishedGeometry>(
        entries_[object].path, ObjectId{object}, std::exchange(part.data, {}),
        std::exchange(part.shares, {}));
    ++revision_;
}

void LitObjects::recolour(const Colour& colour) {
    std::vector<LitMaterial> materials;
    for (const LitMeshMaterial& material : mesh_.head().materials)
        materials.push_back(colour(material));
    for (std::size_t o = 0; o < entries_.size(); ++o) {
        if (entries_[o].geometry)
            entries_[o].geometry->setMaterials(materials);
        else
            parts_[o].data.materials = materials;
    }
}

} // namespace penumbra
