// What is small, but so near to a light that it lights a room alone, lights it evenly.
#include "radiosity/rows/FormFactor.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace penumbra {

namespace {

TEST(BrightThing, BesideABulbLightsABlackRoomEvenly) {
    const std::vector<glm::vec3> top{
        {-0.03f, -0.03f, 1}, {0.03f, -0.03f, 1}, {0.03f, 0.03f, 1}, {-0.03f, 0.03f, 1}};
    const auto bulb = std::make_shared<Light>("bulb", DiskShape{0.02f}, Rgb(1e5f));
    Solution solution(
        sceneOf({object("room", boxData({-3, -3, 0}, {3, 3, 3}, true, paint(Rgb(0.0f)))),
                 object("card", boxData({-0.03f, -0.03f, 0.99f}, {0.03f, 0.03f, 1}, false,
                                        paint(Rgb(0.85f)))),
                 placed("bulb", moved(0, 0, 1.08), {bulb})}),
        {.patchSize = 0.5f, .elementSize = 0.25f}, {.residual = 1e-6});
    // Where nothing else reflects, each node receives F of what the card sends.
    const PatchSet& set = solution.patches();
    const std::vector<glm::dvec3> light = solution.solver.indirect().nodes();
    const Range nodes = set.objects[0].nodes;
    std::vector<double> sent;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const Receiver& node = set.nodes[n];
        const bool onWall = std::abs(node.normal.z) < 0.5f; // the bulb shades the ceiling
        if (isPadding(node) || !onWall || node.position.z < 1.2f) continue;
        const float factor = pointToPolygonFormFactor(node.position, node.normal, top);
        if (factor > 1e-5f) sent.push_back(light[n].x / double(factor));
    }
    ASSERT_GT(sent.size(), 200u);
    double mean = 0;
    for (const double radiosity : sent) mean += radiosity / double(sent.size());
    ASSERT_GT(mean, 0);
    for (const double radiosity : sent) EXPECT_NEAR(radiosity / mean, 1, 0.05);
}

} // namespace

} // namespace penumbra
