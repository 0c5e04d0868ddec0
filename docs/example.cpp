// The least that a program needs to have a scene lit while it moves things: docs/processes.md.
#include "io/usd/scene/UsdScene.h"
#include "radiosity/process/ProcessLink.h"
#include "radiosity/process/RadiosityNode.h"
#include "scenegraph/Transform.h"

#include <glm/gtc/matrix_transform.hpp>

#include <chrono>
#include <cstdio>
#include <thread>

using namespace penumbra;

int main(int argc, char** argv) try {
    const LoadedScene loaded = loadUsdScene(argc > 1 ? argv[1] : "scenes/cornell.usda");
    auto shelf = std::make_shared<Transform>("shelf"); // something of our own that moves
    MeshData board;
    board.points = {{0.1, 0.1, 0}, {0.3, 0.1, 0}, {0.3, 0.3, 0}, {0.1, 0.3, 0}};
    board.faceVertexCounts = {4};
    board.faceVertexIndices = {0, 1, 2, 3};
    board.doubleSided = true;
    board.materials = {std::make_shared<Material>("wood")};
    shelf->add(std::make_shared<Mesh>("board", std::move(board)));

    RadiosityOptions options = optionsFor(loaded.asked); // what the file says of its light
    options.trigger = Trigger::continuous;
    RadiosityNode lit("lit", options, makeProcessLink());
    lit.add(loaded.scene->root); // whatever stands below the node is lit
    const auto settle = [&](const char* what) {
        do { // here a program would draw: lit.lit() has the light, lit.unlit() what has none yet
            lit.update();
            for (const std::string& message : lit.takeMessages()) std::puts(message.c_str());
            std::this_thread::sleep_for(std::chrono::milliseconds(16));
        } while (!lit.state().reached(SolutionState::certified));
        std::printf("%s:", what);
        for (const LitObject& object : lit.objects())
            if (object.path == "/shelf" && object.visible)
                std::printf(" %.1f lux", double(object.geometry->data().direct[0].g));
        std::puts("");
    };
    settle("empty");
    const auto at = [](double height) {
        return glm::translate(glm::dmat4(1), glm::dvec3(0, 0, height));
    };
    shelf->setMatrix(at(0.38)); // every edit of the graph is followed: something comes,
    lit.add(shelf);
    settle("with a shelf");
    shelf->setMatrix(at(0.46)); // moves,
    settle("moved");
    shelf->setMatrix(at(0.46) * glm::scale(glm::dmat4(1), glm::dvec3(1.5, 1.5, 1))); // grows,
    settle("resized");
    lit.remove(shelf); // and goes
    settle("without it");
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
