#include "radiosity/mesh/BuildPatches.h"

#include "base/Error.h"
#include "base/Parallel.h"
#include "radiosity/mesh/Contact.h"
#include "radiosity/mesh/Emitters.h"
#include "radiosity/mesh/PatchAssembly.h"
#include "radiosity/rays/Margins.h"
#include "radiosity/surface/SurfaceMesh.h"
#include "radiosity/surface/Tessellation.h"
#include "scenegraph/Backdrops.h"
#include "scenegraph/Light.h"
#include "scenegraph/Mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>
#include <tuple>

namespace penumbra {

namespace {

/// A mesh of the scene, or the shape of a light, in the stretched frame of its object.
struct Surface {
    SurfaceMesh mesh;
    ObjectId object;
    std::string path;
    const Light* light = nullptr;
    glm::dmat4 toShape{1.0};
    double area = 0;       ///< of all faces [m^2]
    bool backdrop = false; ///< see Backdrops.h
};

std::uint64_t keyOf(const std::string& path) { // FNV-1a, 64 bits
    std::uint64_t key = 0xcbf29ce484222325ull;
    for (const char c : path) key = (key ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
    return key;
}

void listObjects(const PlacedScene& scene, PatchSet& out) {
    for (const Object& object : scene.objects) {
        ObjectPart part;
        part.path = object.path;
        part.key = keyOf(object.path);
        part.present = object.visible;
        const Placement placement = placementOf(object.toWorld);
        part.pose = placement.pose;
        part.stretch = placement.stretch;
        out.objects.push_back(std::move(part));
    }
    for (const ObjectPart& part : out.objects) out.rayMeshes.emplace_back().key = part.key;
}

double areaOf(const SurfaceMesh& mesh) {
    double area = 0;
    for (const SurfaceFace& face : mesh.faces)
        area += 0.5 * glm::length(newellNormal(mesh.points, mesh.cornersOf(face)));
    return area;
}

/// Finds how large a surface is a backdrop: as the scene stands now. No other time asks for that
/// again, so that what comes or moves later does not change how all else is meshed.
double findBackdropArea(const std::vector<Surface>& surfaces, const PatchSet& set) {
    std::vector<PieceSize> pieces(surfaces.size());
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const ObjectPart& part = set.objects[surfaces[i].object.value];
        if (!part.present) continue;
        pieces[i].area = surfaces[i].area;
        for (glm::vec3 point : surfaces[i].mesh.points)
            pieces[i].bounds.add(part.pose.point(point));
    }
    const std::vector<std::uint8_t> backdrops = backdropsAmong(pieces);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < surfaces.size(); ++i)
        if (backdrops[i]) least = std::min(least, surfaces[i].area);
    return least;
}

/// The surfaces, object by object.
std::vector<Surface> placeSurfaces(const PlacedScene& scene, const PatchSet& set,
                                   std::vector<MeshData>& lightMeshes) {
    const auto toShape = [&](const auto& placed) {
        const ObjectPart& part = set.objects[placed.object.value];
        return glm::dmat4(part.stretch) * placed.toObject;
    };
    std::vector<Surface> surfaces;
    for (const Placed<Mesh>& mesh : scene.meshes)
        surfaces.push_back(
            {placeSurface(mesh.node->data(), toShape(mesh)), mesh.object, mesh.path, nullptr, {}});
    lightMeshes.reserve(scene.lights.size()); // the surfaces point into it
    for (const Placed<Light>& light : scene.lights) {
        lightMeshes.push_back(lightShapeMesh(*light.node));
        surfaces.push_back({placeSurface(lightMeshes.back(), toShape(light)), light.object,
                            light.path, light.node, toShape(light)});
    }
    std::stable_sort(surfaces.begin(), surfaces.end(),
                     [](const Surface& a, const Surface& b) { return a.object < b.object; });
    for (Surface& surface : surfaces) surface.area = areaOf(surface.mesh);
    return surfaces;
}

bool emits(const Surface& surface, const SurfaceFace& face) {
    return surface.light || surface.mesh.materialOf(face).emissive();
}

/// Which of a surface's emitting faces tell whether it has light inside of something: one in each
/// cell of a grid, so that they are as many as their area asks for.
class LightPlaces {
public:
    /// Whether no face of that material was there yet.
    bool add(glm::vec3 point, const Material* material) {
        constexpr float kCell = 0.02f; // [m]
        const glm::vec3 cell = glm::floor(point / kCell);
        return seen_.emplace(cell.x, cell.y, cell.z, material).second;
    }

private:
    std::set<std::tuple<float, float, float, const Material*>> seen_;
};

/// Decides which sides there are. Lights count even when they are dark, meshes when they shine.
/// \param others lights that these surfaces do not have [m, world]
void chooseAllSides(std::vector<Surface>& surfaces, std::span<const glm::vec3> others,
                    BuiltPatches& built) {
    const PatchSet& set = built.patches;
    // Points a hair in front of emitting faces [world].
    std::vector<glm::vec3> lights(others.begin(), others.end());
    std::vector<std::vector<const SurfaceMesh*>> siblings(set.objects.size());
    for (const Surface& surface : surfaces) siblings[surface.object.value].push_back(&surface.mesh);
    for (const Surface& surface : surfaces) {
        built.enclosures.addSurface(surface.mesh, siblings[surface.object.value], surface.object);
        LightPlaces places;
        for (const SurfaceFace& face : surface.mesh.faces) {
            if (!emits(surface, face)) continue;
            glm::vec3 middle(0);
            const auto corners = surface.mesh.cornersOf(face);
            for (std::uint32_t corner : corners)
                middle += surface.mesh.points[corner] / float(corners.size());
            const glm::dvec3 normal = newellNormal(surface.mesh.points, corners);
            const double size = std::sqrt(glm::length(normal));
            const glm::vec3 point = middle + glm::vec3(1e-3 * size * glm::normalize(normal));
            if (!places.add(point, &surface.mesh.materialOf(face))) continue;
            built.enclosures.addLight(point, surface.object,
                                      surface.light ? nullptr
                                                    : surface.mesh.data->materialOf(face.source));
            lights.push_back(set.objects[surface.object.value].pose.point(point));
        }
    }
    for (Surface& surface : surfaces) {
        const Pose& pose = set.objects[surface.object.value].pose;
        std::vector<glm::vec3> inFrame;
        for (glm::vec3 light : lights) inFrame.push_back(pose.inverse(light));
        chooseSides(surface.mesh, inFrame, siblings[surface.object.value]);
    }
    built.enclosures.decide(set, others);
}

/// Area of all surfaces [m^2], and without backdrops.
struct SceneArea {
    double all = 0, within = 0;
};

SceneArea areaOf(const std::vector<Surface>& surfaces) {
    SceneArea area;
    for (const Surface& surface : surfaces) {
        area.all += surface.area;
        if (!surface.backdrop) area.within += surface.area;
    }
    return area;
}

/// How much larger than elsewhere the patches and elements of a surface are: 1, but a backdrop
/// makes no more than some kMostPatches.
float coarseness(const Surface& surface, float patchSize) {
    constexpr double kMostPatches = 6000;
    if (!surface.backdrop) return 1;
    return std::max(1.0f, float(std::sqrt(surface.area / kMostPatches)) / patchSize);
}

void addEmitters(const Surface& surface, const Tessellation& tessellation, BuiltPatches& built) {
    const auto add = [&](Emitter emitter, LightSource source) {
        emitter.object = surface.object;
        emitter.path = surface.path;
        built.patches.emitters.push_back(std::move(emitter));
        built.emitterSources.push_back(source);
    };
    if (surface.light) {
        Emitter emitter = lightEmitter(*surface.light, surface.toShape);
        if (emitter.area > 0 && !surface.mesh.faces.empty())
            add(std::move(emitter), {nullptr, surface.light});
        return;
    }
    for (FaceEmitter& faces : faceEmitters(surface.mesh, tessellation, built.patches.patchSize))
        add(std::move(faces.emitter), {faces.material, nullptr});
}

/// Notes the faces that may hide a room from the next, in the frame of their object.
/// \pre surfaces come object by object
void addWalls(const Surface& surface, PatchSet& set) {
    if (surface.mesh.subdivided()) return;
    ObjectPart& part = set.objects[surface.object.value];
    if (part.walls.count == 0) part.walls.first = std::uint32_t(set.walls.size());
    const double least = 4.0 * set.patchSize * set.patchSize; // [m^2]
    for (const SurfaceFace& face : surface.mesh.faces) {
        const auto corners = surface.mesh.cornersOf(face);
        const glm::dvec3 normal = newellNormal(surface.mesh.points, corners);
        if (0.5 * glm::length(normal) < least) continue;
        Wall wall;
        wall.object = surface.object;
        wall.normal = glm::vec3(glm::normalize(normal));
        for (std::uint32_t corner : corners) wall.outline.push_back(surface.mesh.points[corner]);
        const bool flat =
            std::all_of(wall.outline.begin(), wall.outline.end(), [&](glm::vec3 corner) {
                const float reach = std::max(magnitude(corner), magnitude(wall.outline[0]));
                const float height = glm::dot(wall.normal, corner - wall.outline[0]);
                return std::abs(height) <= roundingAt(reach);
            });
        if (!flat) continue;
        part.shape.walls.push_back(wall);
        set.walls.push_back(std::move(wall));
        ++part.walls.count;
    }
}

/// What can't be meshed, in a line for people.
class LeftOut {
public:
    /// Notes faces of a surface; of a light only if nothing is left of it.
    void add(const Surface& surface, std::size_t faces) {
        if (faces == 0 || (surface.light && !surface.mesh.faces.empty())) return;
        (surface.light ? lights_ : faces_) += surface.light ? 1 : faces;
        if (paths_++ == 0) first_ = surface.path;
    }
    void say(std::vector<std::string>& warnings) const {
        if (paths_ == 0) return;
        std::string what;
        if (faces_ > 0)
            what = counted(faces_, "face") + " without area, folded over or with too many corners";
        if (lights_ > 0)
            what +=
                (faces_ > 0 ? " and " : "") + counted(lights_, "light") + " too small to be traced";
        warnings.push_back(what + " left out (" + first_ +
                           (paths_ > 1 ? " and " + std::to_string(paths_ - 1) + " more)" : ")"));
    }

private:
    static std::string counted(std::size_t count, const std::string& what) {
        return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
    }

    std::size_t faces_ = 0, lights_ = 0, paths_ = 0;
    std::string first_;
};

/// Stops before a slip of a digit fills the memory or overflows the ray tracer's single precision.
void refuseTooMuch(const PatchSet& set, const std::vector<Surface>& surfaces) {
    constexpr double kWidest = 1e7; // [m]
    constexpr double kMostElements = 5e7;
    if (!(set.bounds.diagonal() < kWidest))
        throw Error("the scene is more than 10,000 km wide (check its points and metersPerUnit)");
    double elements = 0;
    for (const Surface& surface : surfaces) {
        const double size = double(set.elementSize) * coarseness(surface, set.patchSize);
        elements += surface.area / (size * size);
    }
    if (elements > kMostElements)
        throw Error("this would make some " + std::to_string(std::int64_t(elements / 1e6)) +
                    " million elements (choose a larger --element-size)");
}

/// In a larger building people stand as near to things as in a room [m].
constexpr float kRoomPatch = 0.5f;

/// Fills in what follows from the scene, and marks its backdrops.
MeshingOptions resolved(MeshingOptions sizes, const PatchSet& set, std::vector<Surface>& surfaces) {
    if (!(sizes.backdropArea > 0)) sizes.backdropArea = findBackdropArea(surfaces, set);
    for (Surface& surface : surfaces) surface.backdrop = surface.area >= sizes.backdropArea;
    const SceneArea area = areaOf(surfaces);
    if (!(sizes.patchSize > 0)) {
        sizes.patchSize = defaultPatchSize(area.all);
        if (sizes.patchSize > kRoomPatch) sizes.patchSize = defaultPatchSize(area.within);
    }
    if (!(sizes.elementSize > 0)) sizes.elementSize = sizes.patchSize / 8;
    sizes.patchSize = std::max(sizes.patchSize, sizes.elementSize);
    return sizes;
}

/// Sizes, and what follows from them and from how far things reach.
void setSizes(std::vector<Surface>& surfaces, const MeshingOptions& options, PatchSet& out) {
    for (const Surface& surface : surfaces) {
        const Pose& pose = out.objects[surface.object.value].pose;
        for (glm::vec3 point : surface.mesh.points) out.bounds.add(pose.point(point));
        if (!surface.light) out.polygons += surface.mesh.used;
    }
    const MeshingOptions sizes = resolved(options, out, surfaces);
    out.patchSize = sizes.patchSize;
    out.elementSize = sizes.elementSize;
    out.backdropArea = sizes.backdropArea;
    refuseTooMuch(out, surfaces);
    out.skin = skinOf(out.patchSize);
    out.farthest = magnitude(out.bounds);
}

/// A surface cut up, and whether OpenSubdiv took its cage.
struct CutSurface {
    Tessellation tessellation;
    bool understood = true;
};

/// Calls visit(surface, how it is cut) for each, in order.
template <class Visit>
void cutSurfaces(std::span<const Surface> surfaces, const PatchSet& set, const Progress& progress,
                 const Visit& visit) {
    constexpr std::size_t kFaces = 1 << 17; // cut on all cores before they are looked at
    for (std::size_t first = 0, last = 0; first < surfaces.size(); first = last) {
        if (progress) progress("cutting surfaces", double(first) / double(surfaces.size()));
        for (std::size_t faces = 0; last < surfaces.size() && faces < kFaces; ++last)
            faces += surfaces[last].mesh.faces.size();
        std::vector<CutSurface> cut(last - first);
        parallelFor(cut.size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const Surface& surface = surfaces[first + i];
                const float coarser = coarseness(surface, set.patchSize);
                cut[i].tessellation = tessellate(surface.mesh, coarser * set.patchSize,
                                                 coarser * set.elementSize, cut[i].understood);
            }
        });
        for (std::size_t i = 0; i < cut.size(); ++i) visit(surfaces[first + i], cut[i]);
    }
}

void addSurface(const Surface& surface, const CutSurface& cut, PatchAssembly& assembly,
                LeftOut& leftOut, BuiltPatches& built) {
    PatchSet& out = built.patches;
    const Tessellation& tessellation = cut.tessellation;
    if (!cut.understood)
        built.warnings.push_back(
            surface.path + ": OpenSubdiv refuses this cage; its polygons are used as they are");
    leftOut.add(surface, surface.mesh.skipped + tessellation.leftOut);
    assembly.add(surface.mesh, tessellation, surface.object,
                 coarseness(surface, out.patchSize) > 1);
    Range& emitters = out.objects[surface.object.value].emitters;
    if (emitters.count == 0) emitters.first = std::uint32_t(out.emitters.size());
    addEmitters(surface, tessellation, built);
    emitters.count = std::uint32_t(out.emitters.size()) - emitters.first;
}

/// Notes where the colours of the materials come from: from a light, if that made them.
void noteMaterialSources(const std::vector<Surface>& surfaces, const PatchAssembly& assembly,
                         BuiltPatches& built) {
    for (const auto& [material, emits] : assembly.materialSources()) {
        built.materialSources.push_back({material, nullptr});
        built.materialEmits.push_back(emits);
        for (const Surface& surface : surfaces)
            if (surface.light && surface.mesh.data->materials[0].get() == material)
                built.materialSources.back() = {nullptr, surface.light};
    }
}

} // namespace

MeshingOptions resolvedSizes(const PlacedScene& scene, MeshingOptions sizes) {
    PatchSet set;
    listObjects(scene, set);
    std::vector<MeshData> lightMeshes;
    std::vector<Surface> surfaces = placeSurfaces(scene, set, lightMeshes);
    return resolved(sizes, set, surfaces);
}

float defaultPatchSize(double area) {
    const double size = std::sqrt(std::max(area, 1e-12) / 1650.0);
    return float(size <= kRoomPatch ? size
                                    : std::max<double>(kRoomPatch, std::sqrt(area / 6000.0)));
}

BuiltPatches buildObjects(const PlacedScene& scene, const MeshingOptions& sizes,
                          std::span<const glm::vec3> lights, const Progress& progress) {
    constexpr double kCut = 0.4; // of the time
    BuiltPatches built;
    PatchSet& out = built.patches;
    listObjects(scene, out);
    std::vector<MeshData> lightMeshes;
    std::vector<Surface> surfaces = placeSurfaces(scene, out, lightMeshes);
    chooseAllSides(surfaces, lights, built);
    setSizes(surfaces, sizes, out);

    LeftOut leftOut;
    PatchAssembly assembly(out);
    for (const Surface& surface : surfaces) addWalls(surface, out);
    cutSurfaces(surfaces, out, shareOf(progress, 0, kCut),
                [&](const Surface& surface, const CutSurface& cut) {
                    addSurface(surface, cut, assembly, leftOut, built);
                });
    assembly.finish(shareOf(progress, kCut, 1));
    noteMaterialSources(surfaces, assembly, built);
    leftOut.say(built.warnings);
    return built;
}

BuiltPatches buildPatches(const PlacedScene& scene, const MeshingOptions& options,
                          const Progress& progress) {
    BuiltPatches built = buildObjects(scene, options, {}, progress);
    const PatchSet& out = built.patches;
    const bool dark = std::all_of(out.emitters.begin(), out.emitters.end(),
                                  [](const Emitter& e) { return maxChannel(e.exitance) <= 0; });
    if (dark && hasLights(scene))
        built.warnings.push_back("no light of the scene shines: everything is black");
    return built;
}

} // namespace penumbra
