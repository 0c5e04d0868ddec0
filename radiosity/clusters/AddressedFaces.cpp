#include "radiosity/clusters/AddressedFaces.h"

#include "radiosity/clusters/FaceMoments.h"
#include "radiosity/clusters/Slabs.h"
#include "radiosity/surface/WeldedPoints.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

namespace {

constexpr double kLeastArea = 1e-12; // [m^2]

/// Spreads the lowest 21 bits three apart.
std::uint64_t spread(std::uint64_t bits) {
    bits &= 0x1fffff;
    bits = (bits | bits << 32) & 0x1f00000000ffff;
    bits = (bits | bits << 16) & 0x1f0000ff0000ff;
    bits = (bits | bits << 8) & 0x100f00f00f00f00f;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
    return (bits | bits << 2) & 0x1249249249249249;
}

constexpr double kReach = 1 << 20; // cells on either side of the origin

/// Cell number along an axis, 0 ... 2^21 - 1; what lies farther out is counted to the last.
std::uint64_t cellAlong(double x, double cell) {
    return std::uint64_t(std::clamp(std::floor(x / cell) + kReach, 0.0, 2 * kReach - 1));
}

bool withinReach(glm::dvec3 p, double cell) {
    return glm::all(glm::lessThan(glm::abs(p), glm::dvec3((kReach - 1) * cell)));
}

std::uint64_t cellOf(glm::dvec3 p, double cell) {
    return spread(cellAlong(p.x, cell)) | spread(cellAlong(p.y, cell)) << 1 |
           spread(cellAlong(p.z, cell)) << 2;
}

/// Bin of a unit normal on the octahedral map (Cigolle et al. 2014). The normal is turned first:
/// walls along the axes would lie on borders of bins, where noise tears them apart.
std::uint32_t binOf(glm::dvec3 n, std::uint32_t bins) {
    const glm::dvec3 t = glm::dvec3(2 * n.x - n.y + 2 * n.z, 2 * n.x + 2 * n.y - n.z,
                                    2 * n.y + 2 * n.z - n.x) /
                             3.0 +
                         0.0; // never -0
    const double scale = 1 / (std::abs(t.x) + std::abs(t.y) + std::abs(t.z));
    glm::dvec2 map(t.x * scale, t.y * scale);
    if (t.z < 0)
        map = {std::copysign(1 - std::abs(t.y) * scale, t.x),
               std::copysign(1 - std::abs(t.x) * scale, t.y)};
    const auto along = [&](double x) {
        return std::uint32_t(std::clamp((x + 1) * 0.5 * bins, 0.0, double(bins - 1)));
    };
    return along(map.y) * bins + along(map.x);
}

int comparePositions(glm::vec3 a, glm::vec3 b) {
    for (int axis = 0; axis < 3; ++axis)
        if (a[axis] != b[axis]) return a[axis] < b[axis] ? -1 : 1;
    return 0;
}

/// Names the faces of one soup.
class Addressing {
public:
    Addressing(const PolygonSoup& soup, const FaceGrid& grid)
        : soup_(soup), grid_(grid), weld_(weldPoints(soup.points)) {}

    AddressedFaces run() {
        faces_.points = soup_.points;
        corners_.reserve(soup_.corners.size());
        for (std::size_t face = 0; face < soup_.faceCount(); ++face) place(std::uint32_t(face));
        sortAndDrop(small_);
        sortAndDrop(large_);
        for (const Named& one : large_) faces_.large.push_back(one.source);
        gather();
        std::sort(faces_.dropped.begin(), faces_.dropped.end());
        return std::move(faces_);
    }

private:
    struct Named {
        FaceKey key;
        std::uint32_t firstCorner, cornerCount; // of corners_
        std::uint32_t source;
    };

    std::span<const std::uint32_t> cornersOf(const Named& one) const {
        return std::span(corners_).subspan(one.firstCorner, one.cornerCount);
    }

    /// The face's corners without repetitions, welded, appended from the canonical first one on.
    /// \return how many
    std::uint32_t appendCorners(std::uint32_t face) {
        face_.clear();
        for (std::uint32_t corner : soup_.cornersOf(face))
            if (face_.empty() || face_.back() != weld_[corner]) face_.push_back(weld_[corner]);
        while (face_.size() > 1 && face_.back() == face_.front()) face_.pop_back();
        std::size_t best = 0;
        for (std::size_t i = 1; i < face_.size(); ++i)
            if (startsBefore(i, best)) best = i;
        corners_.insert(corners_.end(), face_.begin() + std::ptrdiff_t(best), face_.end());
        corners_.insert(corners_.end(), face_.begin(), face_.begin() + std::ptrdiff_t(best));
        return std::uint32_t(face_.size());
    }

    /// Whether face_ read from corner a on comes before face_ read from corner b on.
    bool startsBefore(std::size_t a, std::size_t b) const {
        for (std::size_t i = 0; i < face_.size(); ++i) {
            const int order = comparePositions(soup_.points[face_[(a + i) % face_.size()]],
                                               soup_.points[face_[(b + i) % face_.size()]]);
            if (order != 0) return order < 0;
        }
        return false;
    }

    void place(std::uint32_t face) {
        Named one{{}, std::uint32_t(corners_.size()), 0, face};
        one.cornerCount = appendCorners(face);
        const FaceMoments moments = momentsOf(soup_.points, cornersOf(one));
        if (!(moments.area >= kLeastArea && std::isfinite(moments.area))) {
            faces_.dropped.push_back(face);
            corners_.resize(one.firstCorner);
            return;
        }
        Slabs slabs;
        for (std::uint32_t corner : cornersOf(one)) {
            slabs.add(soup_.points[corner]);
            one.key.address = mixHash(one.key.address, positionHash(soup_.points[corner]));
        }
        one.key.material = soup_.materialOf(face);
        one.key.cell = cellOf(moments.centroid(), grid_.cell);
        if (slabs.extent() <= grid_.cell && withinReach(moments.centroid(), grid_.cell))
            one.key.bin = binOf(moments.normal(), grid_.bins);
        (slabs.extent() > grid_.large ? large_ : small_).push_back(one);
    }

    /// Total order: equal only where material and positions of all corners, in order, are.
    int compare(const Named& a, const Named& b) const {
        if (a.key.cell != b.key.cell) return a.key.cell < b.key.cell ? -1 : 1;
        if (a.key.material != b.key.material) return a.key.material < b.key.material ? -1 : 1;
        if (a.key.bin != b.key.bin) return a.key.bin < b.key.bin ? -1 : 1;
        if (a.key.address != b.key.address) return a.key.address < b.key.address ? -1 : 1;
        if (a.cornerCount != b.cornerCount) return a.cornerCount < b.cornerCount ? -1 : 1;
        for (std::size_t i = 0; i < a.cornerCount; ++i) {
            const int order =
                comparePositions(soup_.points[cornersOf(a)[i]], soup_.points[cornersOf(b)[i]]);
            if (order != 0) return order;
        }
        return 0;
    }

    void sortAndDrop(std::vector<Named>& list) {
        std::sort(list.begin(), list.end(), [&](const Named& a, const Named& b) {
            const int order = compare(a, b);
            return order != 0 ? order < 0 : a.source < b.source;
        });
        std::size_t kept = 0;
        for (const Named& one : list) {
            if (kept > 0 && compare(list[kept - 1], one) == 0)
                faces_.dropped.push_back(one.source);
            else
                list[kept++] = one;
        }
        list.resize(kept);
    }

    void gather() {
        faces_.firstCorner.push_back(0);
        for (const Named& one : small_) {
            faces_.source.push_back(one.source);
            faces_.keys.push_back(one.key);
            const auto corners = cornersOf(one);
            faces_.corners.insert(faces_.corners.end(), corners.begin(), corners.end());
            faces_.firstCorner.push_back(std::uint32_t(faces_.corners.size()));
        }
    }

    const PolygonSoup& soup_;
    const FaceGrid& grid_;
    std::vector<std::uint32_t> weld_;
    std::vector<std::uint32_t> corners_; // of all faces, in the soup's order
    std::vector<std::uint32_t> face_;    // corners of the face at hand
    std::vector<Named> small_, large_;
    AddressedFaces faces_;
};

} // namespace

AddressedFaces addressFaces(const PolygonSoup& soup, const FaceGrid& grid) {
    return Addressing(soup, grid).run();
}

} // namespace penumbra
