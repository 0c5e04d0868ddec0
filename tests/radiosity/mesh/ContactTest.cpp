// Where things stand on each other: neither darkness nor light may creep out from under them.
#include "radiosity/mesh/OpenElements.h"
#include "radiosity/mesh/PosedPatches.h"
#include "radiosity/query/PointGather.h"
#include "tests/support/Scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace penumbra {

namespace {

const SolverOptions kDirect{.samples = 64, .directOnly = true};

/// Elements of the horizontal surface at height 0, identified by their middles.
template <class Visit>
void forFloor(const Solution& solution, Visit visit) {
    for (const Element& element : solution.patches().elements) {
        const std::size_t count = element.isTriangle() ? 3 : 4;
        glm::vec3 middle(0);
        bool floor = true;
        for (std::size_t k = 0; k < count; ++k) {
            const Vertex& vertex = solution.patches().vertices[element.vertices[k]];
            middle += vertex.position / float(count);
            floor &= vertex.position.z == 0 && vertex.receiver.normal.z > 0.9f;
        }
        if (floor) visit(element, middle);
    }
}

bool inside(glm::vec3 p, glm::vec2 low, glm::vec2 high) {
    return p.x > low.x && p.x < high.x && p.y > low.y && p.y < high.y;
}

NodePtr floorOf(float size) {
    return object("floor", floorData(-size, size, -size, size, 0, paint(Rgb(0.5f))));
}

/// A room with a box on its floor, one that is half sunk into the floor's slab and one that is
/// inside of the slab.
TEST(FindOpen, CallsOpenWhatExaminingCallsFreeAndNothingElse) {
    const Scene scene =
        sceneOf({object("slab", boxData({-1, -1, -0.4f}, {1, 1, 0}, false)),
                 object("on", boxData({-0.7f, -0.7f, 0}, {-0.3f, -0.2f, 0.3f}, false)),
                 object("sunk", boxData({0.2f, 0.1f, -0.2f}, {0.6f, 0.5f, 0.2f}, false)),
                 object("in", boxData({0, -0.5f, -0.3f}, {0.2f, -0.2f, -0.1f}, false))});
    const BuiltPatches built = meshed(scene, {.patchSize = 0.4f, .elementSize = 0.05f});
    const PatchSet& set = built.patches;
    const RayScene rays = raysThrough(set);
    const ContactResolver resolver(rays, set.rayMeshes, set.skin, set.vertices);
    const Fans fans = fansOf(set.uncoveredElements, set.vertices.size());
    std::vector<std::uint32_t> all;
    for (std::uint32_t e = 0; e < set.uncoveredElements.size(); ++e) all.push_back(e);
    const auto open = findOpen(rays, set.rayMeshes, resolver, set.uncoveredElements, fans, all);
    std::size_t free = 0, found = 0;
    for (const std::uint32_t e : all) {
        const ContactResolver::Result result = resolver.examine(set.uncoveredElements[e]);
        const bool isFree = result == ContactResolver::Result{true, {}, {}};
        if (open[e] != 0) EXPECT_TRUE(isFree) << e;
        free += isFree ? 1 : 0;
        found += open[e];
        if (set.objects[set.elementObject[e].value].path == "/in") EXPECT_EQ(open[e], 0) << e;
    }
    EXPECT_LT(free, all.size() - 100);
    EXPECT_GT(found, free * 9 / 10); // nearly all: others have something near
}

class BoxOnFloor : public testing::Test {
protected:
    /// A low box whose footprint lies askew to the floor's elements of 5 cm.
    BoxOnFloor()
        : solution(
              sceneOf({floorOf(1), ceilingLight({0, 0, 2}, 3, 3),
                       object("box", boxData({low.x, low.y, 0}, {high.x, high.y, 0.1f}, false))}),
              {.patchSize = 0.4f, .elementSize = 0.05f}, kDirect) {}

    static constexpr glm::vec2 low{-0.23f, -0.31f}, high{0.37f, 0.17f};
    Solution solution;
};

TEST_F(BoxOnFloor, SmearsNoDarknessOutwards) {
    // A floor element whose middle is free shows the light that falls on its free part: no corner
    // is darker or brighter than the free floor around it.
    const PointGather gather(solution.patches(), solution.rays, solution.lighting);
    int checked = 0;
    forFloor(solution, [&](const Element& element, glm::vec3 middle) {
        if (inside(middle, low - 0.002f, high + 0.002f)) return;
        EXPECT_NE(element.patch, Element::kNone);
        float least = 1e30f, most = 0;
        for (std::uint32_t v : element.vertices)
            for (float t : {0.0f, 0.25f, 0.5f, 0.75f, 0.95f}) {
                const glm::vec3 p = glm::mix(middle, solution.patches().vertices[v].position, t);
                if (inside(p, low, high)) continue;
                const float light = gather.direct({p + glm::vec3(0, 0, 1e-4f), {0, 0, 1}}).r;
                least = std::min(least, light), most = std::max(most, light);
            }
        for (std::uint32_t v : element.vertices) {
            EXPECT_GT(solution.lighting.direct[v].r, 0.75f * least) << middle.x << " " << middle.y;
            EXPECT_LT(solution.lighting.direct[v].r, 1.15f * most) << middle.x << " " << middle.y;
        }
        ++checked;
    });
    EXPECT_GT(checked, 1400);
}

TEST_F(BoxOnFloor, CoversWhatIsUnderIt) {
    int covered = 0;
    forFloor(solution, [&](const Element& element, glm::vec3 middle) {
        if (!inside(middle, low + 0.05f, high - 0.05f)) return;
        const auto index = std::size_t(&element - solution.patches().elements.data());
        EXPECT_FALSE(solution.patches().receives(std::uint32_t(index)));
        ++covered;
    });
    EXPECT_GT(covered, 50);
}

TEST_F(BoxOnFloor, HasNoLightOnItsBottom) {
    for (const Element& element : solution.patches().elements) {
        const Vertex& vertex = solution.patches().vertices[element.vertices[0]];
        if (vertex.receiver.normal.z > -0.9f || vertex.position.z > 0.05f) continue;
        for (std::uint32_t v : element.vertices) EXPECT_EQ(solution.lighting.direct[v], Rgb());
    }
}

/// A closed room of 2 x 2 x 1 m in two halves, parted by a sheet without thickness at x; the light
/// is in the half x < 0.
class PartedRoom : public testing::TestWithParam<float> {
protected:
    PartedRoom()
        : solution(sceneOf({object("room", boxData({-1, -1, 0}, {1, 1, 1}, true)),
                            ceilingLight({-0.5f, 0, 0.95f}, 0.5f, 1), object("sheet", sheet())}),
                   {.patchSize = 0.4f, .elementSize = 0.05f}) {}

    static MeshData sheet() {
        const float x = GetParam();
        MeshData data = polygonData({{x, -1, 0}, {x, 1, 0}, {x, 1, 1}, {x, -1, 1}});
        data.doubleSided = true;
        return data;
    }

    Solution solution;
};

TEST_P(PartedRoom, LeaksNoLightToTheDarkSide) {
    // Elements that lie behind the sheet with all their corners; those that the sheet cuts belong
    // to the side of their middle. Indirect light may be what an estimate of what is still owed
    // puts everywhere, and what is seen of the elements that are cut.
    double dark = 0, bright = 0;
    int behind = 0, before = 0;
    for (const Element& element : solution.patches().elements) {
        bool back = true;
        for (std::uint32_t v : element.vertices) {
            const Vertex& vertex = solution.patches().vertices[v];
            const bool sheet = vertex.receiver.normal.x > 0.9f; // its dark side
            back &= vertex.position.x > GetParam() || (vertex.position.x == GetParam() && sheet);
        }
        (back ? behind : before) += 1;
        for (std::uint32_t v : element.vertices) {
            (back ? dark : bright) += solution.lighting.indirect[v].r;
            if (back) {
                EXPECT_EQ(solution.lighting.direct[v], Rgb());
            }
        }
    }
    EXPECT_GT(behind, 1000);
    EXPECT_LT(dark / behind, 0.02 * bright / before);
}

TEST_P(PartedRoom, LosesNoLightOnTheBrightSide) {
    const PointGather gather(solution.patches(), solution.rays, solution.lighting);
    forFloor(solution, [&](const Element& element, glm::vec3 middle) {
        if (middle.x > GetParam() - 0.005f || middle.x < GetParam() - 0.12f) return;
        const float free = gather.direct({middle + glm::vec3(0, 0, 1e-4f), {0, 0, 1}}).r;
        for (std::uint32_t v : element.vertices)
            EXPECT_GT(solution.lighting.direct[v].r, 0.8f * free) << middle.x << " " << middle.y;
    });
}

// On a border of elements, between two, and off the middle of one.
INSTANTIATE_TEST_SUITE_P(Places, PartedRoom, testing::Values(0.0f, 0.013f, 0.031f));

/// The gallery's twisted column (scenes/scenegen/sculptures.py): 2.2 m, four semi-sharp ridges.
MeshData twistedColumn() {
    constexpr int kLayers = 14;
    MeshData cage;
    cage.scheme = SubdivisionScheme::catmullClark;
    cage.materials = {paint(Rgb(0.5f))};
    const auto addFace = [&](std::initializer_list<int> corners) {
        cage.faceVertexCounts.push_back(std::int32_t(corners.size()));
        cage.faceVertexIndices.insert(cage.faceVertexIndices.end(), corners);
    };
    for (int k = 0; k <= kLayers; ++k) {
        const double t = double(k) / kLayers;
        const double swell = 1 - 0.28 * std::sin(std::numbers::pi * t) + 0.1 * (1 - t);
        for (int i = 0; i < 8; ++i) {
            const double a = (45 * i + 240 * t) * std::numbers::pi / 180;
            const double r = 0.3 * swell * (i % 2 == 0 ? 1 : 0.5);
            cage.points.emplace_back(r * std::cos(a), r * std::sin(a), 2.2 * t);
            const int j = (i + 1) % 8;
            if (k > 0) addFace({8 * k - 8 + i, 8 * k - 8 + j, 8 * k + j, 8 * k + i});
        }
    }
    const int top = 8 * kLayers;
    addFace({7, 6, 5, 4, 3, 2, 1, 0});
    addFace({top, top + 1, top + 2, top + 3, top + 4, top + 5, top + 6, top + 7});
    for (int i = 0; i < 8; i += 2) {
        Crease ridge{{}, 3.5f};
        for (int k = 0; k <= kLayers; ++k) ridge.vertices.push_back(8 * k + i);
        cage.creases.push_back(ridge);
    }
    for (int end : {0, top}) {
        Crease ring{{}, 10};
        for (int i = 0; i <= 8; ++i) ring.vertices.push_back(end + i % 8);
        cage.creases.push_back(ring);
    }
    return cage;
}

TEST(Contact, KeepsReceiversOutOfTheirOwnObjectAlongItsRidges) {
    // Pulled towards the middles of its elements, a receiver on a ridge sank by up to 0.2 mm, more
    // than it hovers: 220 vertices and nodes saw nothing but the inside.
    const BuiltPatches built =
        meshed(sceneOf({objectOf("column", {std::make_shared<Mesh>("mesh", twistedColumn())})}),
               {.patchSize = 0.568f});
    const PatchSet& set = built.patches;
    const RayScene rays(set.rayMeshes, set.skin);
    int checked = 0, inside = 0;
    const auto check = [&](const Receiver& receiver) {
        if (isPadding(receiver) || receiver.position.z < 0.01f) return; // not what it stands on
        ++checked;
        const glm::vec3 aside(0.3f, 0.2f, 0.1f); // not through the vertex itself
        inside += rays.nearest(receiver.position, receiver.normal + aside, 10 * set.skin).met();
    };
    for (const Vertex& vertex : set.vertices) check(vertex.receiver);
    for (const Receiver& node : set.nodes) check(node);
    EXPECT_GT(checked, 3000);
    EXPECT_EQ(inside, 0);
}

TEST(Contact, LeavesAFreeFloorAsItIs) {
    const BuiltPatches built =
        meshed(sceneOf({floorOf(1)}), {.patchSize = 0.5f, .elementSize = 0.125f});
    EXPECT_EQ(built.patches.objects[0].vertices.count, 17u * 17);
    for (const Vertex& vertex : built.patches.vertices) {
        if (isPadding(vertex.receiver)) continue;
        EXPECT_NEAR(vertex.receiver.position.z, built.patches.skin, 1e-7f);
        EXPECT_LT(glm::distance(vertex.receiver.position, vertex.position), 0.0125f);
    }
    for (const Element& element : built.patches.elements) EXPECT_NE(element.patch, Element::kNone);
}

} // namespace

} // namespace penumbra
