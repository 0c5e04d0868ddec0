// A sender's parts evaluated all at once.
#include "radiosity/rows/PartKernels.h"

#include "radiosity/rows/SenderSamples.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

namespace penumbra {
namespace {

class Draw {
public:
    float number() { return std::uniform_real_distribution<float>(-1, 1)(engine_); }
    glm::vec3 point() { return {number(), number(), number()}; }
    glm::vec3 direction() { return glm::normalize(point() + glm::vec3(0, 0, 1e-3f)); }

private:
    std::mt19937 engine_{7};
};

std::vector<SenderPart> partsAround(Draw& draw, std::size_t count) {
    std::vector<SenderPart> parts(count);
    for (SenderPart& part : parts)
        part = {draw.point(), draw.direction(), 0.1f + 0.05f * draw.number()};
    return parts;
}

float pointFormFactor(const Receiver& receiver, const SenderPart& part) {
    const glm::vec3 d = part.centre - receiver.position;
    const float d2 = glm::dot(d, d);
    return part.area * (facing(glm::dot(receiver.normal, d), -glm::dot(part.normal, d), d2) /
                        (std::numbers::pi_v<float> * d2 * d2));
}

template <class OneByOne>
void expectTheSame(PartTable::Kernel kernel, OneByOne oneByOne) {
    Draw draw;
    for (int round = 0; round < 1000; ++round) {
        const std::vector<SenderPart> parts = partsAround(draw, 1 + std::size_t(round) % 16);
        PartTable table;
        table.load(parts, kernel);
        const Receiver receiver{1.5f * draw.point(), draw.direction()};
        const PartKernels found = table.kernels(receiver);
        float total = 0;
        for (std::size_t k = 0; k < parts.size(); ++k) {
            const float expected = oneByOne(receiver, parts[k]);
            total += expected;
            if (found.total > 0) EXPECT_EQ(found.part[k], expected);
        }
        EXPECT_EQ(found.total, total);
    }
}

// To the last bit: results must not depend on how many parts a processor takes at a time.

TEST(PartKernels, OfDisksAreThoseOfThePartsOneByOne) {
    expectTheSame(PartTable::Kernel::disk, partFormFactor);
}

TEST(PartKernels, OfPointsAreThoseOfThePartsOneByOne) {
    expectTheSame(PartTable::Kernel::point, pointFormFactor);
}

TEST(PartKernels, OfWhatAReceiverFacesAwayFromAddUpToNothing) {
    Draw draw;
    PartTable table;
    table.load(partsAround(draw, 16), PartTable::Kernel::disk);
    EXPECT_EQ(table.kernels({{0, 0, 2}, {0, 0, 1}}).total, 0);
}

} // namespace
} // namespace penumbra
