// Which prims people would pick up as one thing.
#pragma once

#include "base/Bounds.h"
#include "io/usd/stage/UsdStage.h"
#include "scenegraph/Transform.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace penumbra {

/// Finds the objects of a stage that the file does not mark itself. From the root
/// downwards the first rule that fits decides; nothing below an object is looked at again.
///
/// 1. A model is an object, `kind` component or model, unless it is a place that things stand in:
///    one that holds all of the scene but lights; or that does not fit into a cube of kMostSize
///    and has a model in it, or all of some shape of others within its box, or room to stand in
///    (kRoom each way) and more than kMostParts parts.
/// 2. A shape that has a transform of its own is an object.
/// 3. An Xform that holds shapes is one object with all that is below it if that fits into a cube
///    of kMostSize, has at most kMostParts parts, all of which touch each other (their boxes, to
///    within kTouching), and does not hold all of the scene but lights.
/// 4. Otherwise its shapes without a transform are an object, if they are at most kMostShapes, and
///    what is below it is asked in turn. More of them are a pile: each is an object.
class UsdObjects {
public:
    static constexpr float kMostSize = 2.5f;  ///< [m]
    static constexpr float kRoom = 2.0f;      ///< [m]
    static constexpr float kTouching = 0.01f; ///< [m]
    static constexpr std::size_t kMostParts = 64;
    static constexpr std::size_t kMostShapes = 16;

    /// \param isShape whether a prim of that type is seen, or gives light
    UsdObjects(const UsdStage& stage, bool (*isShape)(std::string_view type));

    /// Whether a shape without a transform needs one, to be an object.
    bool needsTransform(const UsdPrim& prim) const;

    /// \param transform begins an object already if the file says so
    /// \param apart     the file says that it is not one with what is below it: rule 4
    void addTransform(std::size_t prim, const std::shared_ptr<Transform>& transform, bool apart);
    /// One of those that a PointInstancer makes, an object unless the instancer is within one.
    void addInstance(std::size_t instancer, const std::shared_ptr<Transform>& transform);
    /// \param box of the shape at a prim [m, world]
    void addShape(std::size_t prim, const Bounds& box);

    /// Marks the transforms that begin objects, when all have been added.
    /// \return those of them that are objects by rule 4
    std::unordered_set<const Transform*> mark();

private:
    struct Entry {
        std::shared_ptr<Transform> transform;
        std::uint32_t shapesHeld = 0; ///< children that are shapes
        bool shape = false;
        bool apart = false;          ///< by the file
        bool model = false;          ///< by its kind
        bool holdsModels = false;    ///< below it
        std::uint32_t order = 0;     ///< depth first: what is below it comes right after it
        std::uint32_t partCount = 0; ///< parts of it and of what is below it
    };
    struct Part {
        std::uint32_t order = 0; ///< of its prim
        Bounds box;              ///< [m, world]
        bool light = false;
    };

    void order();
    void findModels(const UsdStage& stage);
    bool isObject(const Entry& entry) const;
    std::span<const Part> partsOf(const Entry& entry) const;
    Bounds boxOf(const Entry& entry) const;
    static bool canBeCarried(const Bounds& box);
    bool holdsAll(const Entry& entry) const;
    bool isPlace(const Entry& entry) const;
    bool isThing(const Entry& entry) const;

    const UsdStage& stage_;
    struct Instance {
        std::size_t instancer = 0; ///< a prim
        std::shared_ptr<Transform> transform;
    };

    std::vector<Instance> instances_;
    std::vector<Entry> entries_; ///< one a prim
    std::vector<Part> parts_;    ///< in mark(): sorted by their order
};

} // namespace penumbra
