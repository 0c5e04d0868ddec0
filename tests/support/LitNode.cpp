#include "tests/support/LitNode.h"

#include "radiosity/transport/LitScene.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <sstream>
#include <thread>
#include <vector>

namespace penumbra {

namespace {

/// A corner of a drawn triangle.
struct DrawnCorner {
    glm::vec3 position{};
    Rgb direct, indirect;
};
using Drawn = std::map<std::string, std::vector<DrawnCorner>>; ///< by object

Drawn drawnBy(const RadiosityNode& node) {
    Drawn drawn;
    for (const LitObject& object : node.objects()) {
        if (!object.visible || !object.geometry) continue;
        const LitMeshData& data = object.geometry->data();
        for (std::uint32_t v : data.indices)
            drawn[object.path].push_back(
                {glm::vec3(object.toNode * object.toObject * glm::dvec4(data.positions[v], 1)),
                 data.direct[v], data.indirect[v]});
    }
    return drawn;
}

Drawn drawnFromScratch(const PatchSet& set, const Lighting& light) {
    Drawn drawn;
    for (std::size_t e = 0; e < set.elements.size(); ++e) {
        const ObjectPart& part = set.objects[set.elementObject[e].value];
        if (!part.present) continue;
        const Element& element = set.elements[e];
        const std::vector<std::size_t> corners = element.isTriangle()
                                                     ? std::vector<std::size_t>{0, 1, 2}
                                                     : std::vector<std::size_t>{0, 1, 2, 0, 2, 3};
        for (std::size_t k : corners) {
            const std::uint32_t v = element.vertices[k];
            drawn[part.path].push_back(
                {set.vertices[v].position, light.direct[v], light.indirect[v]});
        }
    }
    return drawn;
}

} // namespace

bool updateUntil(RadiosityNode& node, const std::function<bool()>& until, double seconds) {
    using namespace std::chrono;
    const auto end = steady_clock::now() + duration<double>(seconds);
    for (;;) {
        node.update();
        if (until()) return true;
        if (steady_clock::now() > end) return false;
        std::this_thread::sleep_for(milliseconds(1));
    }
}

bool updateUntilSettled(RadiosityNode& node, double seconds) {
    return updateUntil(
        node, [&] { return node.state().reached(SolutionState::exact); }, seconds);
}

std::string describe(RadiosityNode& node) {
    const RadiosityState& state = node.state();
    std::ostringstream out;
    out << "phase " << int(state.phase) << " (" << state.task << " " << state.progress << "), held "
        << state.held << ", queued " << state.queued << ", open blocks " << state.dirtyBlocks
        << ", age " << state.age << ", restarts " << state.restarts << ", blocks taken "
        << state.blocksTaken;
    for (const std::string& message : node.takeMessages()) out << "\n" << message;
    return out.str();
}

std::string differenceFromScratch(const RadiosityNode& node, const RadiosityOptions& options) {
    LitScene lit(node.placed(), options.meshing, options.solving);
    lit.solver().settle();
    const Lighting light = lit.solver().lighting();
    const Drawn expected = drawnFromScratch(lit.patches(), light), drawn = drawnBy(node);
    const double slack = node.state().certificate + lit.solver().statistics().certificate;

    std::ostringstream out;
    for (const auto& [path, corners] : expected) {
        const auto found = drawn.find(path);
        if (found == drawn.end() || found->second.size() != corners.size()) {
            out << path << ": " << (found == drawn.end() ? 0 : found->second.size())
                << " corners for " << corners.size() << "\n";
            continue;
        }
        std::size_t wrong = 0;
        DrawnCorner is, shouldBe;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const DrawnCorner& a = found->second[i];
            const DrawnCorner& b = corners[i];
            const auto far = [&](Rgb x, Rgb y, double most) {
                const float largest = std::max(maxChannel(x), maxChannel(y));
                return maxChannel(absolute(x - y)) > most + 1e-5 * largest;
            };
            // reflectances are above 0.02 in tests, so |H - H'| < certificate / 0.02
            if (glm::length(a.position - b.position) < 1e-4f && !far(a.direct, b.direct, 1e-3) &&
                !far(a.indirect, b.indirect, 50 * slack + 1e-3))
                continue;
            if (wrong++ == 0) is = a, shouldBe = b;
        }
        if (wrong > 0)
            out << path << ": " << wrong << " of " << corners.size() << " corners, the first at ("
                << is.position.x << ", " << is.position.y << ", " << is.position.z << ") for ("
                << shouldBe.position.x << ", " << shouldBe.position.y << ", " << shouldBe.position.z
                << "), direct " << is.direct.r << " for " << shouldBe.direct.r << ", indirect "
                << is.indirect.r << " for " << shouldBe.indirect.r << "\n";
    }
    if (expected.size() != drawn.size())
        out << drawn.size() << " objects for " << expected.size() << "\n";
    return out.str();
}

RadiosityOptions LitRoom::smallRoomOptions() {
    RadiosityOptions options;
    options.meshing = {.patchSize = 0.8f, .elementSize = 0.4f};
    options.trigger = Trigger::continuous;
    return options;
}

LitRoom::LitRoom(std::unique_ptr<LightingLink> link, const RadiosityOptions& wanted,
                 const LightShape& source, double lightHeight)
    : options(wanted), light(std::make_shared<Light>("light", source, Rgb(100))),
      node(std::make_shared<RadiosityNode>("lit", wanted, std::move(link))) {
    node->add(
        object("room", boxData(glm::vec3(-2, -2, 0), glm::vec3(2, 2, 2.5f), true, wallPaint)));
    node->add(box);
    node->add(placed("lamp", moved(0, 0, lightHeight), {light}));
}

} // namespace penumbra
