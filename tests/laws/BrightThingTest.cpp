// What is small, but so near to a light that it lights a room alone, lights it evenly.
#include "radiosity/rows/FormFactor.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>
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

/// Of the light of a bulb that a square of `size` around the origin, across x, sends to a far
/// point: how much a screen at x = 1, which ends at height `height` + y / 2, lets pass.
double shareSeen(glm::vec3 from, float size, float height, glm::vec3 bulb) {
    constexpr int kSide = 40;
    double seen = 0, all = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
        const auto along = [&](int k) { return size * ((float(k) + 0.5f) / kSide - 0.5f); };
        const glm::vec3 to(0, along(i / kSide), along(i % kSide));
        const glm::vec3 met = glm::mix(from, to, (from.x - 1) / from.x);
        const double sent = 1 / std::pow(double(glm::distance(bulb, to)), 3);
        seen += met.z > height + met.y / 2 ? sent : 0;
        all += sent;
    }
    return seen / all;
}

TEST(BrightThing, HalfHiddenStillLightsEvenly) {
    // A card beside a bulb, and a screen that hides more of it the lower one is on the wall.
    constexpr float kSize = 0.3f, kHeight = 0.1f;
    constexpr glm::vec3 kBulb(0.15f, 0, 0.3f);
    const std::vector<glm::vec3> front{{0, -kSize / 2, -kSize / 2},
                                       {0, kSize / 2, -kSize / 2},
                                       {0, kSize / 2, kSize / 2},
                                       {0, -kSize / 2, kSize / 2}};
    const auto bulb = std::make_shared<Light>("bulb", SphereShape{0.02f}, Rgb(1e5f));
    const std::shared_ptr<Material> black = paint(Rgb(0.0f));
    Solution solution(sceneOf({object("room", boxData({-3, -3, -3}, {3, 3, 3}, true, black)),
                               object("card", polygonData(front, paint(Rgb(0.85f)))),
                               object("screen", polygonData({{1, -2.5f, -2.9f},
                                                             {1, 2.5f, -2.9f},
                                                             {1, 2.5f, kHeight + 1.25f},
                                                             {1, -2.5f, kHeight - 1.25f}},
                                                            black)),
                               placed("bulb", moved(kBulb.x, kBulb.y, kBulb.z), {bulb})}),
                      {.patchSize = 0.5f, .elementSize = 0.05f}, {.residual = 1e-6});
    const PatchSet& set = solution.patches();
    const std::vector<glm::dvec3> light = solution.solver.indirect().nodes();
    const Range nodes = set.objects[0].nodes;
    double whole = 0, wholeCount = 0;
    std::vector<std::pair<double, double>> partly; // share expected, and sent
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const Receiver& node = set.nodes[n];
        if (isPadding(node) || node.normal.x > -0.5f || std::abs(node.position.y) > 2) continue;
        const double share = shareSeen(node.position, kSize, kHeight, kBulb);
        const double sent =
            light[n].x / double(pointToPolygonFormFactor(node.position, node.normal, front));
        if (share == 1) whole += sent, ++wholeCount;
        if (share > 0 && share < 1) partly.emplace_back(share, sent);
    }
    ASSERT_GT(wholeCount, 20);
    ASSERT_GT(partly.size(), 20u);
    double squares = 0;
    for (const auto& [share, sent] : partly)
        squares += std::pow(sent * wholeCount / whole - share, 2) / double(partly.size());
    EXPECT_LT(std::sqrt(squares), 0.05) << "four samples are .38 off";
}

TEST(BrightThing, LightsWhatIsUnderACeilingEvenly) {
    // A table under a downlight lights the room: a small spot, which few of a point's rays find.
    constexpr float kElement = 0.05f;
    const auto spot = std::make_shared<Light>("spot", DiskShape{0.05f}, Rgb(1e5f));
    Solution solution(sceneOf({object("room", boxData({-2, -2, 0}, {2, 2, 2}, true)),
                               object("table", floorData(-0.4f, 0.4f, -0.4f, 0.4f, 0.5f)),
                               placed("spot", moved(0, 0, 0.8), {spot})}),
                      {.patchSize = 0.4f, .elementSize = kElement});
    const PatchSet& set = solution.patches();
    std::map<std::pair<int, int>, double> wall; // by column and row
    const Range vertices = set.objects[0].vertices;
    for (std::uint32_t v = vertices.first; v < vertices.end(); ++v) {
        const Receiver& receiver = set.vertices[v].receiver;
        const bool onWall = receiver.normal.y < -0.5f && std::abs(receiver.position.x) < 1.6f;
        if (isPadding(receiver) || !onWall || receiver.position.z < 1.5f) continue;
        const glm::ivec2 at(
            glm::round(glm::vec2(receiver.position.x, receiver.position.z) / kElement));
        wall[{at.x, at.y}] = double(solution.at(v).g);
    }
    double squares = 0, count = 0;
    for (const auto& [at, light] : wall) {
        const auto left = wall.find({at.first - 1, at.second});
        const auto right = wall.find({at.first + 1, at.second});
        if (left == wall.end() || right == wall.end()) continue;
        squares += std::pow(2 * light / (left->second + right->second) - 1, 2);
        ++count;
    }
    ASSERT_GT(count, 400);
    EXPECT_LT(std::sqrt(squares / count), 0.005);
}

} // namespace

} // namespace penumbra
