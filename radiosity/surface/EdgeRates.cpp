#include "radiosity/surface/EdgeRates.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace penumbra {

namespace {

std::uint64_t edgeKey(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t(std::min(a, b)) << 32 | std::max(a, b);
}

float edgeLength(const SurfaceMesh& mesh, std::span<const std::uint32_t> corners,
                 std::size_t edge) {
    return glm::distance(mesh.points[corners[edge]],
                         mesh.points[corners[(edge + 1) % corners.size()]]);
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

/// How many pieces a face may make.
struct Bound {
    double times; ///< as many as its area holds
    double some;  ///< beyond that and one a corner, so that small faces stay as they are
};

/// \param area [m^2] \param size of a piece [m]
double mostPieces(std::size_t corners, double area, double size, Bound bound) {
    const auto n = double(corners);
    return bound.times * std::max(1.0, n / 4) * area / (size * size) + n + bound.some;
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
    : mesh_(mesh), subdivided_(mesh.subdivided() && surface.understood()), patchSize_(patchSize),
      elementSize_(elementSize), atCut_(mesh.points.size()) {
    first_.push_back(0);
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        const auto corners = mesh.cornersOf(mesh.faces[f]);
        if (subdivided_ || !addSmall(corners))
            if (const auto face = surface.face(f)) addFace(*face, corners);
        first_.push_back(rates_.size());
    }
}

/// Adds a polygon of which no edge is to be cut. \return whether it is one
bool EdgeRates::addSmall(std::span<const std::uint32_t> corners) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const EdgeRate rate = cut(edgeLength(mesh_, corners, i), 0).rate;
        if (rate.patches > 1 || rate.elements > 1) return false;
    }
    corners_.insert(corners_.end(), corners.begin(), corners.end());
    rates_.insert(rates_.end(), corners.size(), EdgeRate());
    return true;
}

std::span<const EdgeRate> EdgeRates::ofFace(std::uint32_t face) const {
    return std::span(rates_).subspan(first_[face], first_[face + 1] - first_[face]);
}

std::span<const std::uint32_t> EdgeRates::cornersOf(std::uint32_t face) const {
    return std::span(corners_).subspan(first_[face], first_[face + 1] - first_[face]);
}

int EdgeRates::along(std::uint32_t a, std::uint32_t b) const {
    const auto cut = elements_.find(edgeKey(a, b));
    return cut == elements_.end() ? 1 : cut->second;
}

bool EdgeRates::isWhole(std::uint32_t face) const {
    const auto corners = cornersOf(face);
    const auto isOne = [](const EdgeRate& rate) { return rate.patches == 1 && rate.elements == 1; };
    if (!std::ranges::all_of(ofFace(face), isOne)) return false;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::uint32_t a = corners[i], b = corners[(i + 1) % corners.size()];
        if (atCut_[a] != 0 && atCut_[b] != 0 && along(a, b) > 1) return false;
    }
    return true;
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

EdgeRates::Wanted EdgeRates::wantedOf(const FaceSurface& face,
                                      std::span<const std::uint32_t> corners, std::size_t edge) {
    if (!subdivided_) return cut(edgeLength(mesh_, corners, edge), 0);
    const auto [found, fresh] =
        wanted_.try_emplace(edgeKey(corners[edge], corners[(edge + 1) % corners.size()]));
    if (fresh) found->second = cut(face.edgeLength(int(edge)), face.edgeBend(int(edge)));
    return found->second;
}

EdgeRates::FaceRates EdgeRates::wantedBy(const FaceSurface& face,
                                         std::span<const std::uint32_t> corners) {
    FaceRates rates;
    const std::size_t count = corners.size();
    for (std::size_t i = 0; i < count; ++i) {
        const Wanted wanted = wantedOf(face, corners, i);
        rates.corners.push_back(corners[i]);
        rates.patches.push_back(wanted.rate.patches);
        rates.elements.push_back(wanted.rate.elements);
        rates.bent.push_back(wanted.bent);
    }
    return rates;
}

/// Makes a strip of a triangle with one short edge, see the class. \return whether it is one
bool EdgeRates::makeStrip(FaceRates& rates) const {
    if (subdivided_ || rates.corners.size() != 3) return false;
    const auto shortest = std::min_element(rates.elements.begin(), rates.elements.end());
    const auto tip = (std::size_t(shortest - rates.elements.begin()) + 2) % 3; // opposite to it
    const auto strip = [&](const auto& of, auto first) {
        return std::vector{first, of[tip], of[(tip + 1) % 3], of[(tip + 2) % 3]};
    };
    FaceRates made{strip(rates.corners, rates.corners[tip]), strip(rates.patches, 1),
                   strip(rates.elements, 1), strip(rates.bent, 1)};
    if (2 * pieces(made.elements) > pieces(rates.elements)) return false;
    rates = std::move(made);
    return true;
}

void EdgeRates::addFace(const FaceSurface& face, std::span<const std::uint32_t> corners) {
    constexpr Bound kPatches{6, 16}, kElements{6, 64}; // a right triangle of 4 by 1 makes 6 times
    constexpr Bound kStripPatches{1, 4}, kStripElements{1, 64};
    constexpr Bound kSlim{6, 8};
    FaceRates rates = wantedBy(face, corners);
    const auto exceeds = [&](double area, Bound bound) {
        return pieces(rates.elements) > mostPieces(corners.size(), area, elementSize_, bound);
    };
    if (exceeds(0, kSlim)) {
        const double area = face.area();
        const bool many = exceeds(0, kElements);
        const bool strip = exceeds(area, kSlim) && makeStrip(rates);
        if (strip || many) {
            const std::size_t count = rates.corners.size();
            coarsen(rates.patches, std::vector<int>(count, 1),
                    mostPieces(count, area, patchSize_, strip ? kStripPatches : kPatches));
            coarsen(rates.elements, rates.bent,
                    mostPieces(count, area, elementSize_, strip ? kStripElements : kElements));
        }
    }
    const std::size_t count = rates.corners.size();
    for (std::size_t i = 0; i < count; ++i) {
        const int each = std::max(1, rates.elements[i] / rates.patches[i]);
        corners_.push_back(rates.corners[i]);
        rates_.push_back({rates.patches[i], each * rates.patches[i]});
        if (rates_.back().elements == 1) continue;
        const std::uint32_t a = rates.corners[i], b = rates.corners[(i + 1) % count];
        int& most = elements_[edgeKey(a, b)];
        most = std::max(most, rates_.back().elements);
        atCut_[a] = atCut_[b] = 1;
    }
}

} // namespace penumbra
