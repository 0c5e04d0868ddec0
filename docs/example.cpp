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
    shelf->setMovable(true);
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
    lit.add(shelf);
    for (double height : {0.38, 0.42, 0.46}) {
        shelf->setMatrix(glm::translate(glm::dmat4(1), glm::dvec3(0, 0, height))); // an edit
        do { // here a program would draw: lit.lit() has the light, lit.unlit() what has none yet
            lit.update();
            for (const std::string& message : lit.takeMessages()) std::puts(message.c_str());
            std::this_thread::sleep_for(std::chrono::milliseconds(16));
        } while (!lit.state().reached(SolutionState::certified));
        for (const LitObject& object : lit.objects())
            if (object.path == "/shelf")
                std::printf("shelf at %.2f m: %.1f lux\n", height,
                            double(object.geometry->data().direct[0].g));
    }
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
