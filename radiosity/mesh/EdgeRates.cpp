#include "radiosity/mesh/EdgeRates.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

namespace {

std::uint64_t edgeKey(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t(std::min(a, b)) << 32 | std::max(a, b);
}

int scaled(int rate, double factor) {
    return std::max(1, int(double(rate) * factor));
}

/// Pieces that a face makes of itself, about: a quadrilateral in rows and columns, any other face a
/// grid at each corner.
double pieces(const std::vector<int>& rates) {
    if (rates.size() == 4)
        return double(std::max(rates[0], rates[2])) * double(std::max(rates[1], rates[3]));
    const int half = (*std::max_element(rates.begin(), rates.end()) + 1) / 2;
    return double(rates.size()) * half * half;
}

/// How many pieces of `size` [m] a face of so many corners and `area` [m^2] may make.
/// \param some beyond what the area holds, so that small faces stay as they are
double mostPieces(std::size_t corners, double area, double size, double some) {
    constexpr double kTimes = 6; // a right triangle of 4 by 1 makes that many
    const auto n = double(corners);
    return kTimes * std::max(1.0, n / 4) * area / (size * size) + n + some;
}

/// Coarsens `rates` until they make `most` pieces, or nothing more can be had.
/// \param least what each must keep
void coarsen(std::vector<int>& rates, std::span<const int> least, double most) {
    const std::vector<int> full = rates;
    const int highest = *std::max_element(full.begin(), full.end());
    for (double factor = 1; pieces(rates) > most && factor * highest >= 1;) {
        factor *= 0.9;
        for (std::size_t i = 0; i < rates.size(); ++i)
            rates[i] = std::max(scaled(full[i], factor), std::min(least[i], full[i]));
    }
}

} // namespace

EdgeRates::EdgeRates(const SurfaceMesh& mesh, const LimitSurface& surface, float patchSize,
                     float elementSize)
    : subdivided_(mesh.subdivided()), patchSize_(patchSize), elementSize_(elementSize) {
    first_.push_back(0);
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        if (const auto face = surface.face(f)) addFace(*face, mesh.cornersOf(mesh.faces[f]));
        first_.push_back(rates_.size());
    }
}

std::span<const EdgeRate> EdgeRates::ofFace(std::uint32_t face) const {
    return std::span(rates_).subspan(first_[face], first_[face + 1] - first_[face]);
}

int EdgeRates::along(std::uint32_t a, std::uint32_t b) const {
    return elements_.at(edgeKey(a, b));
}

/// By length, and so that the normal turns by no more than kMostBend within an element.
EdgeRates::Wanted EdgeRates::cut(float length, float bend) const {
    constexpr float kMostBend = 0.2f; // [rad]
    const auto parts = [](float whole, float part) {
        return std::clamp(int(std::ceil(whole / part - 1e-3f)), 1, 4096);
    };
    constexpr int kMost = 32767; // OpenSubdiv's Bfr cuts no edge into more parts
    const int patches = parts(length, patchSize_);
    const int elements = std::max(parts(length / float(patches), elementSize_),
                                  parts(bend / float(patches), kMostBend));
    return {{patches, patches * std::min(elements, kMost / patches)}, parts(bend, kMostBend)};
}

void EdgeRates::addFace(const FaceSurface& face, std::span<const std::uint32_t> corners) {
    const std::size_t count = corners.size();
    std::vector<std::uint64_t> keys;
    std::vector<int> patches, elements, bent;
    for (std::size_t i = 0; i < count; ++i) {
        keys.push_back(edgeKey(corners[i], corners[(i + 1) % count]));
        const auto [found, fresh] = wanted_.try_emplace(keys.back());
        if (fresh)
            found->second = cut(face.edgeLength(int(i)), subdivided_ ? face.edgeBend(int(i)) : 0);
        patches.push_back(found->second.rate.patches);
        elements.push_back(found->second.rate.elements);
        bent.push_back(found->second.bent);
    }
    constexpr double kPatches = 16, kElements = 64;
    if (pieces(elements) > mostPieces(count, 0, elementSize_, kElements)) {
        const double area = face.area();
        coarsen(patches, std::vector<int>(count, 1), mostPieces(count, area, patchSize_, kPatches));
        coarsen(elements, bent, mostPieces(count, area, elementSize_, kElements));
    }
    for (std::size_t i = 0; i < count; ++i) {
        const int each = std::max(1, elements[i] / patches[i]);
        rates_.push_back({patches[i], each * patches[i]});
        int& most = elements_[keys[i]];
        most = std::max(most, rates_.back().elements);
    }
}

} // namespace penumbra
