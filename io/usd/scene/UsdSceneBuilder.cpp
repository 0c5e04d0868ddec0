#include "io/usd/scene/UsdSceneBuilder.h"

#include "io/usd/scene/UsdCamera.h"
#include "io/usd/scene/UsdFrame.h"
#include "io/usd/scene/UsdGprims.h"
#include "io/usd/scene/UsdInstances.h"
#include "io/usd/scene/UsdLight.h"
#include "io/usd/scene/UsdMesh.h"
#include "io/usd/scene/UsdObjects.h"
#include "io/usd/scene/UsdSharedContents.h"
#include "io/usd/scene/UsdXform.h"
#include "io/usd/shade/UsdMaterial.h"
#include "scenegraph/Camera.h"
#include "scenegraph/Mesh.h"
#include "scenegraph/Transform.h"

#include <algorithm>
#include <array>
#include <map>
#include <unordered_map>
#include <utility>

namespace penumbra {

namespace {

template <std::size_t N>
bool isOneOf(std::string_view word, const std::array<std::string_view, N>& words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

// Prims that are no part of the picture, nor is anything below them.
bool isData(std::string_view type) {
    constexpr std::array<std::string_view, 10> kTypes{
        "Material",      "Shader",    "NodeGraph",   "GeomSubset", "RenderSettings",
        "RenderProduct", "RenderVar", "LightFilter", "Backdrop",   "SkelAnimation"};
    return isOneOf(type, kTypes);
}

// Things with a shape that we can't show.
bool isUnsupportedShape(std::string_view type) {
    constexpr std::array<std::string_view, 9> kTypes{"BasisCurves", "NurbsCurves", "HermiteCurves",
                                                     "NurbsPatch",  "Points",      "TetMesh",
                                                     "Volume",      "SkelRoot",    "Skeleton"};
    return isOneOf(type, kTypes);
}

bool isXformable(std::string_view type) {
    return type == "Xform" || type == "Mesh" || type == "Camera" || type == "PointInstancer" ||
           isUsdGprim(type) || isUsdAreaLight(type) || isUsdLightWithoutArea(type) ||
           isUnsupportedShape(type);
}

bool isShape(std::string_view type) {
    return type == "Mesh" || isUsdGprim(type) || isUsdAreaLight(type);
}

// What a prim hands down to those below it.
struct Place {
    std::shared_ptr<Group> container; // takes the children's nodes; null: nothing below is loaded
    UsdFrame frame;
    UsdInherited inherited;
    bool drawn = true; // purpose
    // The outermost instance whose contents another one, `original`, had before; 0: none.
    std::uint32_t copy = 0, original = 0;
};

// What a PointInstancer repeats: nodes below an instance, and their transform in it.
struct Prototype {
    glm::dmat4 toInstance{1.0};
    std::vector<NodePtr> nodes;
    std::size_t size = 0; // nodes that an instance adds, of all generations
    bool open = true;     // is being made
};

class SceneBuilder {
public:
    SceneBuilder(UsdStage& stage, const UsdBuildOptions& options, UsdTextures& textures,
                 UsdTracks& tracks, UsdAddresses& addresses)
        : stage_(stage), tracks_(tracks), addresses_(addresses), time_(options.time),
          mostInstanced_(options.mostInstanced), warnings_(stage.diagnostics()),
          materials_(stage, time_, warnings_, &textures), objects_(stage, isShape),
          metersPerUnit_(options.metersPerUnit), shared_(stage) {}

    void build(std::shared_ptr<Group> root) {
        places_[0].container = std::move(root);
        for (std::uint32_t i = 1; i < stage_.prims().size(); ++i) add(i);
        tracks_.addMaterials(materials_);
        notePaints();
        const auto apart = objects_.mark();
        for (auto& address : addresses_.transforms)
            address.apart = apart.contains(address.node.get());
    }

private:
    void add(std::uint32_t index) {
        const UsdPrim& prim = stage_.prims()[index];
        const auto above = places_.find(prim.parent);
        if (above == places_.end() || isData(prim.typeName)) return;
        const Place& parent = above->second;
        // Prototypes may stand below an `over` or a class, where nothing else is drawn.
        if (prototypesOpen_ > 0 ? prim.specifier != UsdSpecifier::def && index != prototypeRoot_
                                : !prim.defined || prim.abstract)
            return;
        const UsdAttributes attributes(prim, time_);
        if (usdHidden(attributes) && !comesAndGoes(prim)) return;
        size_ += prototypesOpen_ > 0;
        Place place = handedDownTo(attributes, parent);
        if (prim.instance && parent.copy == 0) noteOriginal(index, place);
        const auto transform = makeTransform(attributes, parent, place);
        if (transform && prototypesOpen_ == 0)
            objects_.addTransform(index, transform, !attributes.flag("penumbra:movable", true));
        const bool shares = transform || hasChildren(prim); // its path, with what holds it
        const NodePtr leaf =
            place.drawn ? makeLeaf(shares ? std::string() : prim.name, attributes, place) : nullptr;
        if (leaf && isUsdAreaLight(prim.typeName)) tracks_.addLight(leaf, attributes, place.frame);
        if (const auto camera = std::dynamic_pointer_cast<Camera>(leaf))
            tracks_.addCamera(camera, prim);
        if (leaf) noteLeaf(leaf, prim);
        if (prototypesOpen_ == 0) noteShape(index, leaf, place);
        attach(prim, parent, place, transform, leaf);
        if (prim.typeName == "PointInstancer")
            addInstances(index, attributes, place); // what is below it is not drawn in place
        else if (place.container)
            places_[index] = std::move(place);
    }

    void noteOriginal(std::uint32_t index, Place& place) {
        const std::uint32_t original = shared_.originalOf(index);
        if (original == index) return;
        place.copy = index;
        place.original = original;
    }

    void addInstances(std::uint32_t index, const UsdAttributes& instancer, const Place& place) {
        const UsdPrim& prim = instancer.prim();
        if (!place.container || !place.drawn) return;
        std::vector<const Prototype*> prototypes;
        for (const std::string& path : UsdStage::targets(prim, "prototypes"))
            prototypes.push_back(&prototypeAt(path, instancer, place.frame));
        std::size_t leftOut = 0;
        for (const UsdInstance& one : readUsdInstances(instancer, prototypes.size(), warnings_)) {
            const Prototype& prototype = *prototypes[one.prototype];
            if (prototype.nodes.empty()) continue;
            if (size_ + prototype.size > mostInstanced_) {
                ++leftOut;
                continue;
            }
            size_ += prototype.size;
            auto instance = std::make_shared<Transform>("instance_" + std::to_string(one.number));
            instance->setMatrix(one.toInstancer * prototype.toInstance);
            for (const NodePtr& node : prototype.nodes) instance->add(node);
            if (prototypesOpen_ == 0) objects_.addInstance(index, instance);
            place.container->add(instance);
        }
        if (leftOut > 0)
            warnings_.warn(prim.location(),
                           "instances left out: those of a scene may not make more than " +
                               std::to_string(mostInstanced_) + " nodes",
                           leftOut);
    }

    // Made once for all that repeat it, in the frame above it: there it inherits, too.
    const Prototype& prototypeAt(const std::string& path, const UsdAttributes& instancer,
                                 const UsdFrame& frame) {
        constexpr int kMostOpen = 16; // instancers within prototypes within instancers
        const auto [found, fresh] = prototypes_.try_emplace(path);
        Prototype& prototype = found->second;
        if (!fresh && prototype.open)
            warnings_.warn(instancer.prim().location(),
                           "a PointInstancer repeats itself: left out");
        if (!fresh) return prototype;
        const UsdPrim* const prim = stage_.find(path);
        const bool deep = prototypesOpen_ >= kMostOpen;
        if (prim && !deep)
            makePrototype(prototype, std::uint32_t(prim - stage_.prims().data()), frame);
        else
            warnings_.warn(instancer.location("prototypes"),
                           deep ? "PointInstancers nested too deeply: left out"
                                : "prototype <" + path + "> is not there");
        prototype.open = false;
        return prototype;
    }

    void makePrototype(Prototype& prototype, std::uint32_t root, const UsdFrame& frame) {
        Place above = inheritedAt(stage_.prims()[root].parent);
        const auto holder = std::make_shared<Group>("");
        above.container = holder;
        above.frame = frame;
        auto outerPlaces = std::exchange(places_, {{stage_.prims()[root].parent, above}});
        const std::size_t outerSize = std::exchange(size_, 0);
        const std::uint32_t outerRoot = std::exchange(prototypeRoot_, root);
        ++prototypesOpen_;
        std::vector<std::uint32_t> open{root};
        for (std::size_t i = 0; i < open.size(); ++i) {
            add(open[i]);
            if (!places_.contains(open[i])) continue;
            const auto& children = stage_.prims()[open[i]].children;
            open.insert(open.end(), children.begin(), children.end());
        }
        --prototypesOpen_;
        prototypeRoot_ = outerRoot;
        prototype.size = std::exchange(size_, outerSize) + 1;
        places_ = std::move(outerPlaces);
        takeRoot(prototype, *holder);
    }

    // A prototype's own transform becomes the instance's, so that this is one object, unless the
    // file says that one begins there.
    static void takeRoot(Prototype& prototype, const Group& holder) {
        prototype.nodes = holder.children();
        if (prototype.nodes.size() != 1) return;
        const auto transform = std::dynamic_pointer_cast<Transform>(prototype.nodes[0]);
        if (!transform || transform->beginsObject()) return;
        prototype.toInstance = transform->matrix();
        prototype.nodes = transform->children();
    }

    // What a prim hands down, as far as it does not depend on where it is drawn.
    Place inheritedAt(std::uint32_t index) {
        std::vector<std::uint32_t> chain;
        for (; index != 0; index = stage_.prims()[index].parent) chain.push_back(index);
        Place place;
        for (std::size_t i = chain.size(); i-- > 0;)
            place = handedDownTo(UsdAttributes(stage_.prims()[chain[i]], time_), place);
        return place;
    }

    Place handedDownTo(const UsdAttributes& attributes, const Place& parent) {
        Place place;
        place.frame = parent.frame;
        place.inherited = parent.inherited;
        place.drawn = parent.drawn;
        place.copy = parent.copy;
        place.original = parent.original;
        const std::string purpose = attributes.text("purpose", "");
        if (!purpose.empty()) place.drawn = purpose == "default" || purpose == "render";
        if (!purpose.empty() && !place.drawn && purpose != "proxy" && purpose != "guide")
            warnings_.warn(attributes.location("purpose"), "prim of unknown purpose left out");
        const UsdBinding binding = usdMaterialBinding(attributes.prim(), warnings_);
        if (!binding.path.empty() && !parent.inherited.materialIsStronger) {
            place.inherited.material = binding.path;
            place.inherited.materialIsStronger = binding.strongerThanDescendants;
        }
        if (const auto colour = usdConstantColour(attributes))
            place.inherited.displayColour = colour;
        return place;
    }

    // Whether the animation hides it and shows it: it becomes a Switch.
    static bool comesAndGoes(const UsdPrim& prim) { return UsdStage::animated(prim, "visibility"); }

    // A Transform if the prim has, or may get, a transform of its own; else null. What the
    // animation moves, hides or shows is an object: it does so as a whole.
    std::shared_ptr<Transform> makeTransform(const UsdAttributes& attributes, const Place& parent,
                                             Place& place) {
        const UsdPrim& prim = attributes.prim();
        UsdLocalTransform local;
        if (isXformable(prim.typeName)) local = usdLocalTransform(attributes, warnings_);
        // What leaves a moving parent behind stands still, but moves in the parent's frame.
        const bool resized = isResized(prim);
        const bool moves = local.animated || resized || (local.resetsStack && parent.frame.moves());
        const bool object =
            moves || comesAndGoes(prim) || attributes.flag("penumbra:movable", false);
        const bool structure = prim.typeName == "Xform";
        if (!structure && !local.authored && !object &&
            !(prototypesOpen_ == 0 && isShape(prim.typeName) && objects_.needsTransform(prim)))
            return nullptr;
        if (local.resetsStack) local.matrix = relativeToParent(local, parent.frame.toWorld());
        auto transform = std::make_shared<Transform>(comesAndGoes(prim) ? "" : prim.name);
        transform->setMatrix(local.matrix);
        transform->setBeginsObject(object);
        place.frame = parent.frame.below(transform, moves);
        if (moves)
            tracks_.addTransform(transform, prim, parent.frame,
                                 resized ? std::optional(usdLightSize(attributes)) : std::nullopt);
        addresses_.transforms.push_back({transform, prim.path, local.animated || resized, false});
        return transform;
    }

    // Whether its transform takes in how large it is: a light's does, unless others are below it.
    bool isResized(const UsdPrim& prim) const {
        return isUsdAreaLight(prim.typeName) && !animatedUsdLightSizes(prim).empty() &&
               !hasChildren(prim);
    }

    void warnOfHeldSizes(const UsdAttributes& attributes) {
        constexpr std::array kSizes{"size", "radius", "height", "width", "length"};
        const UsdPrim& prim = attributes.prim();
        if (!isShape(prim.typeName) || isResized(prim)) return;
        const auto warn = [&](std::string_view size) {
            warnings_.warn(attributes.location(size), "an animated size is held");
        };
        for (const char* const size : kSizes)
            if (UsdStage::animated(prim, size)) warn(size);
        std::ranges::for_each(animatedUsdLightSizes(prim), warn);
    }

    NodePtr makeLeaf(const std::string& name, const UsdAttributes& attributes, const Place& place) {
        const UsdPrim& prim = attributes.prim();
        const std::string& type = prim.typeName;
        warnOfHeldSizes(attributes);
        if (type == "Mesh" || isUsdGprim(type)) return makeShape(name, attributes, place);
        if (isUsdAreaLight(type))
            return makeUsdLight(name, attributes, place.frame.toWorld(), warnings_);
        if (type == "Camera") return std::make_shared<Camera>(name, usdLens(attributes, warnings_));
        if (isUsdLightWithoutArea(type) || isUnsupportedShape(type))
            warnings_.warn(prim.location(), type + " not supported yet: left out");
        else if (!type.empty() && type != "Scope" && type != "Xform" && type != "PointInstancer")
            warnings_.warn(prim.location(), "unknown type '" + type + "' taken as a group");
        return nullptr;
    }

    // Instances share the meshes below them if these are painted alike. A light's may not be: what
    // it sends may depend on its size in the world.
    NodePtr makeShape(const std::string& name, const UsdAttributes& attributes,
                      const Place& place) {
        const UsdPrim& prim = attributes.prim();
        UsdInherited inherited = place.inherited;
        inherited.material = shared_.inOriginal(inherited.material, place.copy, place.original);
        const std::string path = shared_.inOriginal(prim.path, place.copy, place.original);
        const bool light = UsdStage::hasApi(prim, "MeshLightAPI");
        const auto known = meshes_.find(path);
        if (known != meshes_.end() && known->second.inherited == inherited && !light)
            return known->second.mesh;
        NodePtr mesh = prim.typeName == "Mesh" ? makeMesh(name, attributes, place)
                                               : makeGprim(name, attributes, place);
        if (mesh && place.copy == 0) meshes_[path] = {mesh, std::move(inherited)};
        return mesh;
    }

    // Nameless gprims of the same sizes and material are one node: a scattered hundred thousand of
    // them would take gigabytes. Those with a paint of their own are not, for it may be edited.
    NodePtr makeGprim(const std::string& name, const UsdAttributes& attributes,
                      const Place& place) {
        const UsdPrim& prim = attributes.prim();
        if (UsdStage::hasApi(prim, "MeshLightAPI"))
            warnings_.warn(prim.location(), "MeshLightAPI of a " + prim.typeName +
                                                " left out: a Mesh or an emissive material shines");
        const auto make = [&] {
            return makeUsdMesh(name, stage_, attributes, makeUsdGprim(attributes, warnings_),
                               place.inherited, materials_, nullptr, warnings_);
        };
        const std::string key = usdGprimKey(attributes);
        if (!name.empty() || !prim.children.empty() || key.empty() || place.inherited.displayColour)
            return make();
        NodePtr& node = gprims_[key + place.inherited.material];
        if (!node) node = make();
        return node;
    }

    NodePtr makeMesh(const std::string& name, const UsdAttributes& attributes, const Place& place) {
        const UsdPrim& prim = attributes.prim();
        if (UsdStage::animated(prim, "points"))
            warnings_.warn(attributes.location("points"), "animated points are held");
        UsdPolygons polygons = readUsdPolygons(attributes, warnings_);
        if (!UsdStage::hasApi(prim, "MeshLightAPI"))
            return makeUsdMesh(name, stage_, attributes, std::move(polygons), place.inherited,
                               materials_, nullptr, warnings_);
        const double area = areaOf(polygons, glm::dmat3(place.frame.toWorld()));
        UsdMeshLight light;
        NodePtr mesh = makeUsdMesh(name, stage_, attributes, polygons, place.inherited, materials_,
                                   &light, warnings_);
        light.set(usdLightLuminance(attributes, area, warnings_));
        if (mesh) tracks_.addMeshLight(std::move(light), prim, place.frame, std::move(polygons));
        return mesh;
    }

    bool hasChildren(const UsdPrim& prim) const {
        return std::any_of(prim.children.begin(), prim.children.end(), [&](std::uint32_t child) {
            return !isData(stage_.prims()[child].typeName);
        });
    }

    void attach(const UsdPrim& prim, const Place& parent, Place& place,
                const std::shared_ptr<Transform>& transform, const NodePtr& leaf) {
        const bool below = hasChildren(prim);
        if (leaf && !transform && !below) {
            parent.container->add(leaf);
            return;
        }
        const bool structure = prim.typeName == "Xform" || prim.typeName == "PointInstancer" ||
                               !isXformable(prim.typeName);
        if (!leaf && !below && !structure) return; // left out
        place.container = transform;
        if (!transform) place.container = std::make_shared<Group>(prim.name);
        if (leaf) place.container->add(leaf);
        parent.container->add(comesAndGoes(prim) ? makeSwitch(prim, place) : place.container);
    }

    NodePtr makeSwitch(const UsdPrim& prim, const Place& place) {
        auto choice = std::make_shared<Switch>(prim.name);
        choice->add(place.container);
        choice->setVisible(!usdHidden(UsdAttributes(prim, time_)));
        tracks_.addSwitch(choice, prim);
        addresses_.choices.push_back({choice, prim.path});
        return choice;
    }

    void noteShape(std::size_t index, const NodePtr& leaf, const Place& place) {
        Bounds box;
        if (const auto mesh = std::dynamic_pointer_cast<Mesh>(leaf)) box = mesh->bounds();
        if (const auto light = std::dynamic_pointer_cast<Light>(leaf)) box = light->bounds();
        if (box.empty()) return;
        glm::dmat4 toMetres(metersPerUnit_);
        toMetres[3][3] = 1;
        objects_.addShape(index, transformed(box, toMetres * place.frame.toWorld()));
    }

    // Where a leaf comes from; its paint is noted when all materials are known.
    void noteLeaf(const NodePtr& leaf, const UsdPrim& prim) {
        if (const auto camera = std::dynamic_pointer_cast<Camera>(leaf))
            addresses_.eyes.push_back({camera, prim.path});
        if (const auto light = std::dynamic_pointer_cast<Light>(leaf))
            addresses_.lights.push_back({light, nullptr, prim.path});
        const auto mesh = std::dynamic_pointer_cast<Mesh>(leaf);
        if (!mesh) return;
        if (isUsdAreaLight(prim.typeName))
            addresses_.lights.push_back({nullptr, mesh->materialOf(0), prim.path});
        else
            painted_.push_back({mesh, prim.path, UsdStage::hasApi(prim, "MeshLightAPI")});
    }

    void notePaints() {
        std::unordered_map<const Material*, std::size_t> known;
        std::unordered_map<std::string, int> readers; // of textures
        for (const auto& [path, surface] : materials_.made())
            for (const UsdTextureAddress& texture : {surface.reflectance, surface.emission})
                ++readers[texture.shader];
        const auto own = [&](const UsdTextureAddress& texture) {
            return readers[texture.shader] == 1 ? texture : UsdTextureAddress();
        };
        for (const auto& [path, surface] : materials_.made()) {
            if (!surface.material) continue;
            known[surface.material.get()] = addresses_.paints.size();
            addresses_.paints.push_back({surface.material,
                                         surface.shader,
                                         {},
                                         own(surface.reflectance),
                                         own(surface.emission),
                                         surface.covering});
        }
        const std::size_t shaders = addresses_.paints.size();
        for (const auto& [mesh, path, isLight] : painted_)
            for (const auto& material : mesh->data().materials) {
                const auto [entry, isNew] =
                    known.try_emplace(material.get(), addresses_.paints.size());
                if (isNew) addresses_.paints.push_back({material, {}, {}});
                const bool alone = mesh->data().materials.size() == 1 && !isLight;
                if (entry->second >= shaders && alone)
                    addresses_.paints[entry->second].meshes.push_back(path);
            }
    }

    UsdStage& stage_;
    UsdTracks& tracks_;
    UsdAddresses& addresses_;
    UsdTime time_;
    std::size_t mostInstanced_;
    Diagnostics& warnings_;
    UsdMaterials materials_;
    UsdObjects objects_;
    double metersPerUnit_;                            // of a unit of the stage [m]
    std::unordered_map<std::uint32_t, Place> places_; // of prims with a container

    std::map<std::string, Prototype> prototypes_; // by path
    int prototypesOpen_ = 0;                      // that are being made, one within the other
    std::uint32_t prototypeRoot_ = 0;             // of the innermost
    std::size_t size_ = 0;                        // nodes that instances make of what is being made

    struct SharedMesh {
        NodePtr mesh;
        UsdInherited inherited;
    };
    UsdSharedContents shared_;
    std::unordered_map<std::string, SharedMesh> meshes_; // by path
    std::unordered_map<std::string, NodePtr> gprims_;    // by sizes and material

    struct Painted {
        std::shared_ptr<Mesh> mesh;
        std::string path;
        bool isLight;
    };
    std::vector<Painted> painted_;
};

} // namespace

void buildUsdScene(UsdStage& stage, const UsdBuildOptions& options, UsdTextures& textures,
                   UsdTracks& tracks, UsdAddresses& addresses, std::shared_ptr<Group> root) {
    SceneBuilder(stage, options, textures, tracks, addresses).build(std::move(root));
}

} // namespace penumbra
