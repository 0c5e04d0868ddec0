#include "radiosity/rows/ClusterParts.h"

#include "radiosity/rays/Margins.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace penumbra {

namespace {

/// An element of a cluster, and where it lies in the run of all of their areas.
struct Piece {
    std::array<glm::vec3, 4> corners;
    glm::vec3 vector{}; ///< area times normal [m^2]
    glm::vec3 middle{};
    double from = 0, area = 0; ///< [m^2]

    double end() const { return from + area; }
    /// A point at a share of the way through it, from its first corner to the far side.
    glm::vec3 at(double share) const {
        const bool isTriangle = corners[2] == corners[3];
        const auto root = float(isTriangle ? std::sqrt(share) : share);
        const glm::vec3 far =
            0.5f * (isTriangle ? corners[1] + corners[2] : corners[2] + corners[3]);
        const glm::vec3 near = isTriangle ? corners[0] : 0.5f * (corners[0] + corners[1]);
        return glm::mix(near, far, root);
    }
};

std::vector<Piece> piecesOf(const PatchSet& set, const Patch& patch) {
    std::vector<std::uint32_t> elements(set.patchElements.begin() + patch.firstElement,
                                        set.patchElements.begin() + patch.firstElement +
                                            patch.elementCount);
    std::sort(elements.begin(), elements.end()); // what is covered comes last in the patch
    std::vector<Piece> pieces;
    double area = 0;
    for (const std::uint32_t e : elements) {
        Piece piece;
        const Element& element = set.elements[e];
        const std::size_t count = element.isTriangle() ? 3 : 4;
        for (std::size_t k = 0; k < 4; ++k) {
            // What is drawn may be pulled in where something touches; what sends is the whole.
            const std::uint32_t v = set.uncoveredElements[e].vertices[k];
            piece.corners[k] = set.vertices[v].position;
            if (k < count) piece.middle += piece.corners[k] / float(count);
        }
        piece.vector = 0.5f * glm::cross(piece.corners[2] - piece.corners[0],
                                         piece.corners[3] - piece.corners[1]);
        piece.from = area;
        piece.area = double(glm::length(piece.vector));
        area += piece.area;
        pieces.push_back(piece);
    }
    return pieces;
}

/// The part of a run of pieces between two places in it.
SenderPart partBetween(std::span<const Piece> pieces, double from, double end) {
    glm::dvec3 vector(0), centre(0);
    double area = 0;
    for (const Piece& piece : pieces) {
        const double low = std::max(from, piece.from), high = std::min(end, piece.end());
        if (!(high > low)) continue;
        const bool all = low == piece.from && high == piece.end();
        const glm::vec3 at =
            all ? piece.middle : piece.at((0.5 * (low + high) - piece.from) / piece.area);
        vector += (high - low) / piece.area * glm::dvec3(piece.vector);
        centre += (high - low) * glm::dvec3(at);
        area += high - low;
    }
    const double seen = glm::length(vector);
    return {area > 0 ? glm::vec3(centre / area) : glm::vec3(0),
            seen > 0 ? glm::vec3(vector / seen) : glm::vec3(0), float(seen)};
}

} // namespace

ClusterParts partsOf(const PatchSet& set, const Patch& patch) {
    const std::vector<Piece> pieces = piecesOf(set, patch);
    const double area = pieces.back().end();
    ClusterParts out;
    auto piece = pieces.begin(); // the one that the next sample is on
    auto first = pieces.begin(); // of the next part
    for (std::size_t k = 0; k < kPatchSamples; ++k) {
        const double from = area * double(k) / kPatchSamples;
        const double end = area * double(k + 1) / kPatchSamples, middle = 0.5 * (from + end);
        while (first + 1 != pieces.end() && first->end() <= from) ++first;
        const auto last =
            std::find_if(first, pieces.end(), [&](const Piece& p) { return p.from >= end; });
        out.parts[k] = partBetween({first, last}, from, end);
        while (piece + 1 != pieces.end() && piece->end() <= middle) ++piece;
        const glm::vec3 at = piece->at(std::clamp((middle - piece->from) / piece->area, 0.0, 1.0));
        out.samples[k] = at + roundingAt(magnitude(at)) * glm::normalize(piece->vector);
    }
    return out;
}

float partFormFactor(const Receiver& receiver, const SenderPart& part) {
    const glm::vec3 d = part.centre - receiver.position;
    const float d2 = glm::dot(d, d);
    const float cosines = facing(glm::dot(receiver.normal, d), -glm::dot(part.normal, d), d2);
    return cosines > 0 ? diskKernel(part.area, cosines, d2) : 0.0f;
}

} // namespace penumbra
