// The radiosity solution: direct light onto elements, indirect light between patches.
#pragma once

#include "radiosity/PatchSet.h"
#include "radiosity/RayScene.h"
#include "radiosity/Row.h"
#include "radiosity/RowBuilder.h"
#include "scenegraph/Rgb.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <functional>
#include <vector>

namespace penumbra {

struct SolverOptions {
    int samples = 16; ///< visibility samples of an emitter and a receiver that agree
    /// Relax until the certificate is below this share of the brightest emitter's exitance; 0:
    /// until it is below 1 % of the mean radiosity of the surfaces, which is what the eye compares
    /// with.
    double residual = 0;
    bool directOnly = false;
    /// 0: no limit if `residual` is given, else what keeps a scene of very many patches to minutes.
    std::uint64_t mostShots = 0;
    std::size_t rowMemory =
        1'000'000'000; ///< for rows of patches [bytes]; beyond it they are not kept
};

/// Called now and then with the phase's name and the share done in [0, 1].
using Progress = std::function<void(const char* phase, double done)>;

struct SolveStatistics {
    std::uint64_t shots = 0;
    bool settled = false; ///< whether the limit was met, or relaxation stopped before
    std::uint64_t directRays = 0, indirectRays = 0;
    double residual = 0;      ///< max |R| over patches and channels [lm/m^2]
    double certificate = 0;   ///< bound of |B_exact - B| for the meshed scene [lm/m^2]
    double brightest = 0;     ///< largest exitance of an emitter [lm/m^2]
    double meanRadiosity = 0; ///< area-weighted, of reflecting surfaces [lm/m^2]
    std::size_t rows = 0, entries = 0, bytes = 0; ///< of the SFFL
    double directSeconds = 0, indirectSeconds = 0;
};

/// Illuminance at every vertex of a PatchSet [lux].
struct Lighting {
    std::vector<Rgb> direct;
    std::vector<Rgb> indirect;
};

/// Mean illuminance of an element's corners [lux].
Rgb elementMean(const Element& element, const Lighting& lighting);

/// Southwell relaxation over the shadow-form-factor-list ([Cohen1988] in residual form):
///
///     R = E + rho F S - S      residual: what is received but not yet sent
///
/// always holds; each shot sends the largest |R| * area and adds it to S. Emitters light the
/// elements directly, through rows of their own; what patches reflect travels between patches'
/// nodes. The result is the same for any number of threads.
class Solver {
public:
    /// All three must outlive the solver.
    Solver(const PatchSet& patches, const RayScene& rays, const SolverOptions& options);

    void solveDirect(const Progress& progress = {});
    /// Relaxes until the options' limit is met. \pre solveDirect() was called
    void solveIndirect(const Progress& progress = {});

    /// What the vertices receive. What is still owed is added as an ambient term (Cohen et al.
    /// 1988).
    Lighting lighting() const;
    /// Indirect illuminance at the nodes, the ambient term included [lux].
    std::vector<glm::dvec3> nodeIlluminance() const;
    /// Radiosity of every patch, own emission left out: rho * H [lm/m^2].
    std::vector<Rgb> radiosity() const;
    SolveStatistics statistics() const;

    const std::vector<Row>& emitterRows() const { return emitterRows_; }
    const std::vector<Row>& patchRows() const { return patchRows_; }

private:
    glm::dvec3 received(std::uint32_t patch) const;
    void updateResiduals();
    bool settled() const;
    bool spent() const;
    std::vector<std::uint32_t> chooseSenders() const;
    void shoot(const std::vector<std::uint32_t>& senders);
    void averageDirect();
    void findReached();
    glm::dvec3 nodeIndirect(std::uint32_t node) const;
    glm::dvec3 ambient() const;
    double target() const;

    const PatchSet& set_;
    const RayScene& rays_;
    SolverOptions options_;
    std::vector<EmitterSender> emitters_;
    std::vector<Receiver> receivers_;     ///< of the vertices
    std::vector<glm::vec3> patchSamples_; ///< kPatchSamples a patch

    std::vector<Rgb> vertexDirect_;          ///< [lux]
    std::vector<glm::dvec3> patchDirect_;    ///< mean over the patch [lux]
    std::vector<glm::dvec3> nodeIndirect_;   ///< [lux]
    std::vector<double> nodeRowSum_;         ///< sum of F V over the senders whose rows are known
    std::vector<std::uint64_t> nodeReached_; ///< bits: nodes from which anything lit can be seen
    std::vector<glm::dvec3> shot_;           ///< S [lm/m^2]
    std::vector<glm::dvec3> residual_;       ///< R [lm/m^2]
    std::vector<Row> emitterRows_, patchRows_;
    std::vector<std::uint8_t> rowKnown_;
    std::size_t knownRows_ = 0, rowBytes_ = 0;
    SolveStatistics statistics_;
};

} // namespace penumbra
