// What each overlay shows, as colours of blocks with a legend: no OpenGL, no ImGui.
#pragma once

#include "radiosity/process/store/DirtyStatus.h"
#include "radiosity/query/LightAccount.h"
#include "viewer/overlay/Legend.h"
#include "viewer/overlay/Overlay.h"

#include <span>
#include <string>
#include <vector>

namespace penumbra {

class BlockAges;
struct LitObject;
struct PlacedScene;

struct OverlayView {
    OverlayPicture picture;
    Legend legend;
};

/// Outlines of patches and elements.
OverlayView meshView();

constexpr LogScale kAgeScale{100, 0.1}; ///< [s]: what is new is bright
/// How long ago the light of each block was published. \param now as for BlockAges::advance() [s]
OverlayView ageView(std::span<const LitObject> objects, const BlockAges& ages, double now);

/// What RadiosityNode::dirtyBlocks() says of each object.
using WorkOfObjects = std::span<const std::vector<DirtyStatus>>;

/// The frontier of the work: which blocks are dirty, and why.
OverlayView dirtyView(std::span<const LitObject> objects, WorkOfObjects work);

/// The priorities of dirty blocks, as the solver ranks them: a heat map over four powers of ten.
/// \param most the highest priority so far, which the scale ends above; raised if there is a
///             higher one, so that colours keep their meaning as work is done
OverlayView importanceView(std::span<const LitObject> objects, WorkOfObjects work, double& most);
/// The same if the policy is not `importance`: a line that says so.
OverlayView noImportanceView();

/// Why it is as dark as it is at a point: who takes how much of what lights would give.
/// Each blocker is tinted by the share of all of that light which it takes, on a scale from 0 to 1,
/// and the account is in lux.
/// \param objects,below of the node, and its scene, whose paths these have
/// \param scene         that the account is about: the same objects, with paths for people
/// \param of            what the account is of, for people
OverlayView blockersView(std::span<const LitObject> objects, const PlacedScene& below,
                         const PlacedScene& scene, std::span<const EmitterAccount> lights,
                         const std::string& of);
/// The accounts of the lights of one object, and of others if it has none.
/// \param path of the object; empty: of all
std::vector<EmitterAccount> lightsOf(std::vector<EmitterAccount> lights, const std::string& path);

} // namespace penumbra
