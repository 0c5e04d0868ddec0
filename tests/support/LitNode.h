// What tests ask of a RadiosityNode: that it gets somewhere, and that its light is right.
#pragma once

#include "radiosity/process/LightingLink.h"
#include "radiosity/process/RadiosityNode.h"
#include "tests/support/Scenes.h"

#include <functional>
#include <memory>
#include <string>

namespace penumbra {

/// Calls update() until `until` holds; false: it did not within some time.
bool updateUntil(RadiosityNode& node, const std::function<bool()>& until, double seconds = 60);
/// Until the light is that of the graph, nothing of it deferred, and all of it has arrived.
bool updateUntilSettled(RadiosityNode& node, double seconds = 20);

/// Its state and messages, for people.
std::string describe(RadiosityNode& node);

/// What differs between the light below a node and that of a solution from scratch of the graph as
/// it is now, for people; empty: nothing, within the certificates of both and rounding.
std::string differenceFromScratch(const RadiosityNode& node, const RadiosityOptions& options);

/// A room with a light and a box that can be moved, as an application would build it.
struct LitRoom {
    explicit LitRoom(std::unique_ptr<LightingLink> link = makeThreadLink(),
                     const RadiosityOptions& wanted = smallRoomOptions(),
                     const LightShape& source = RectShape{0.5f, 0.5f}, double lightHeight = 2.4);
    static RadiosityOptions smallRoomOptions();
    std::string difference() const { return differenceFromScratch(*node, options); }

    RadiosityOptions options;
    std::shared_ptr<Material> wallPaint = paint(Rgb(0.6f, 0.5f, 0.4f));
    std::shared_ptr<Transform> box = objectOf(
        "box",
        {std::make_shared<Mesh>("mesh", boxData({-0.3f, -0.3f, 0}, {0.3f, 0.3f, 0.6f}, false))});
    std::shared_ptr<Light> light; ///< of 100 nit
    std::shared_ptr<RadiosityNode> node;
};

} // namespace penumbra
