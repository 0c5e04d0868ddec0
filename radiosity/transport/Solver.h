// The radiosity solution: direct light onto elements, indirect light between patches.
#pragma once

#include "base/LightRequest.h"
#include "base/Progress.h"
#include "base/Rgb.h"
#include "base/SolutionState.h"
#include "radiosity/mesh/PatchSet.h"
#include "radiosity/rays/RayScene.h"
#include "radiosity/schedule/Pace.h"
#include "radiosity/transport/DetailGather.h"
#include "radiosity/transport/DirectLight.h"
#include "radiosity/transport/IndirectLight.h"
#include "radiosity/transport/Lighting.h"
#include "radiosity/transport/NodeHits.h"
#include "radiosity/transport/SceneChange.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace penumbra {

class ViewPriority;

struct SolverOptions {
    int samples = 16; ///< visibility samples of an emitter and a receiver that agree
    /// Relax until the certificate is below this share of the brightest emitter's exitance; 0:
    /// until it is below 1 % of the mean radiosity of the surfaces, which is what the eye compares
    /// with.
    double residual = 0;
    bool directOnly = false;
    PolicyKind policy = PolicyKind::importance;
    bool detail = true; ///< shadows of indirect light finer than patches, see DetailGather
    /// 0: no limit if `residual` is given, else one by which each row is served some 50 times.
    std::uint64_t mostShots = 0;
    /// What the process may take [bytes]; 0: half of the machine's memory. Rows of patches are kept
    /// in what the rest leaves of it (RowRoom.h), others are traced again when they are needed.
    std::size_t memory = 0;
    /// False: indirect light goes from each patch alone, however far, to compare with. Rows grow
    /// with the square of the number of patches then.
    bool clusters = true;
};

/// What was done so far for one kind of light; the difference of two says what an edit cost.
struct WorkCount {
    RayCount rays;
    std::uint64_t blocksVisited = 0;  ///< by updates
    std::uint64_t entriesChanged = 0; ///< by updates
    double seconds = 0;

    friend WorkCount operator-(const WorkCount& a, const WorkCount& b) {
        return {a.rays - b.rays, a.blocksVisited - b.blocksVisited,
                a.entriesChanged - b.entriesChanged, a.seconds - b.seconds};
    }
    WorkCount& operator+=(const WorkCount& more) {
        rays += more.rays;
        blocksVisited += more.blocksVisited;
        entriesChanged += more.entriesChanged;
        seconds += more.seconds;
        return *this;
    }
};

struct SolveStatistics {
    std::uint64_t shots = 0;
    SolutionState state = SolutionState::working;
    WorkCount direct, indirect, detail;
    double residual = 0;           ///< max |R| over patches and channels [lm/m^2]
    double certificate = 0;        ///< bound of |B_exact - B| for the meshed scene [lm/m^2]
    std::uint64_t dirtyBlocks = 0; ///< of rows that edits concern, not yet worked on
    double dirtyBound = 0; ///< what these may change in what any patch reflects; in the certificate
    double brightest = 0;  ///< largest exitance of an emitter [lm/m^2]
    double meanRadiosity = 0;  ///< area-weighted, of reflecting surfaces [lm/m^2]
    double litIlluminance = 0; ///< H_lit, see LitLevel [lux]; 0: nothing is lit
    std::size_t rows = 0, entries = 0, bytes = 0; ///< of the SFFL
    std::size_t rowsNotKept = 0;                  ///< of patches: beyond the memory that rows have
};

/// What a solver has done since it was made, in counts that are the same on every machine.
struct WorkDone {
    std::uint64_t rays = 0;
    std::uint64_t blocks = 0; ///< of 64 entries, read by updates
    std::uint64_t shots = 0;  ///< of patches, each onto all nodes
    std::size_t nodes = 0;

    /// About [rays]: reading 64 entries, or sending light through them, takes as long as a ray.
    double inRays() const { return double(rays + blocks) + double(shots) * double(nodes) / 64; }
};

/// Lights a PatchSet, and keeps it lit while it is edited: emitters light the elements directly,
/// what patches reflect travels between patches' nodes. The result is the same for any number of
/// threads.
///
/// After an edit the rows of the shadow-form-factor-list are brought up to date entry by entry,
/// what changes in them is sent again or taken back, and relaxation goes on. What comes out is what
/// a new solver would find: visibility bit for bit, radiosity within the certificates.
class Solver {
public:
    /// Both must outlive the solver, and change only just before apply() says so.
    Solver(const PatchSet& patches, const RayScene& rays, const SolverOptions& options);
    ~Solver();

    /// Takes over what another solver found out about a scene that has parts in common with this
    /// one, and leaves it without. What differs is worked on like an edit. Fine shadows are found
    /// from the start. \pre nothing was done here as yet; the ray scene can trace what changed
    /// alone
    void takeOver(Solver& before, const PatchMatch& match);

    /// Takes note of objects that came to the patch set and the ray scene, which hide them as yet.
    /// \pre something was lit before, unless it is for direct light only
    void add(std::span<const ObjectId> objects);
    /// Takes note of an edit that has been made to the patch set and the ray scene. Traces nothing.
    void apply(const SceneChange& change);
    /// Takes note that light which ends in a box or crosses it [m, world] is to be evaluated anew.
    void invalidate(const Bounds& region);

    /// What the viewer sees now, and the object being moved: with the policy `importance`, dirty
    /// blocks of direct light are updated by what the viewer gains, from now on. Without an
    /// adaptation, that is found from what is in view.
    void attend(const Attention& attention);
    /// Another policy for what is dirty and for what comes.
    void setPolicy(PolicyKind policy);
    /// Another policy for direct light alone, as for measurements.
    void setDirectPolicy(std::shared_ptr<SchedulingPolicy> policy);

    /// Of dirty blocks of direct light only these receivers are done, as if others were not
    /// concerned: for measurements, by someone who knows that these do not change. An entry
    /// that was left out may name the wrong blocker until the last edit is applied again.
    /// \param which bits: receivers of a block, by emitter and block
    /// \pre direct().dirtyKnown()
    void narrowDirect(const std::function<std::uint64_t(std::uint32_t, std::uint32_t)>& which) {
        direct_.narrow(which);
    }

    /// Of what is lit so far. It goes back with edits alone.
    SolutionState state() const { return state_; }
    /// Relaxation was stopped by its limit, with the certificate above what was asked for, and all
    /// else is done: the state stays `working`, though nobody works any more.
    bool stopped() const { return stopped_; }
    /// Works for `budget` seconds, or until nothing is left to be done, and returns whether that is
    /// so. What it leaves undone it goes on with at the next call.
    bool step(double budget, const Progress& progress = {});
    /// The same, but for `certified` only until all is done that was not deferred. It is not
    /// reached then if relaxation was stopped, or if bounds of what was deferred have grown since.
    bool stepUntil(SolutionState wanted, double budget, const Progress& progress = {});
    /// Works until the state is reached, or nothing is left to be done for it.
    void settle(SolutionState wanted, const Progress& progress = {});
    /// Works until nothing is left to be done.
    void settle(const Progress& progress = {}) { settle(SolutionState::exact, progress); }
    /// Does one piece of work of about `effort` rays; false: there is none left. What is computed
    /// does not depend on how large the pieces are.
    bool work(std::size_t effort, const Progress& progress = {});
    /// Direct light is summed when all its rows are up to date; this sums what is to be summed now,
    /// so that lighting() shows all that is known.
    /// \param effort about [rays]
    void sumUp(std::size_t effort = ~std::size_t(0)) { direct_.sumUp(effort); }

    /// What the vertices receive. What is still owed is added as an ambient term (Cohen et al.
    /// 1988); fine shadows are as far as they have been brought.
    Lighting lighting() const;
    /// The same for some blocks of PatchSet::kBlock vertices. Costs as much as the nodes and what
    /// is asked for. \param lighting is made as long as there are vertices; others keep their
    /// values
    void light(std::span<const std::uint32_t> blocks, Lighting& lighting) const;
    /// Indirect illuminance at the nodes, the ambient term included [lux].
    std::vector<glm::dvec3> nodeIlluminance() const;
    /// Radiosity of every patch, own emission left out: rho * H [lm/m^2].
    std::vector<Rgb> radiosity() const;
    SolveStatistics statistics() const;
    double detailSeconds() const { return detailSeconds_; } ///< of statistics(), at no cost
    WorkDone done() const;                                  ///< cheap, unlike statistics()

    /// Blocks of vertices whose direct light may differ from what it was at the last call.
    std::vector<std::uint32_t> takeSummedBlocks() { return direct_.takeSummedBlocks(); }
    /// Dirty blocks of direct light are deferred if they change less [lm/m^2], see
    /// DirtySet::next().
    double directTolerance() const;
    bool directOnly() const { return !indirect_; }
    std::size_t memory() const; ///< that the process may take [bytes]
    double certificate() const { return indirect_ ? indirect_->certificate() : 0; }
    double meanRadiosity() const { return indirect_ ? indirect_->meanRadiosity() : 0; }
    /// H_lit, see LitLevel [lux]; 0: nothing is lit. Visits all patches.
    double litIlluminance() const;

    const DirectLight& direct() const { return direct_; }
    const IndirectLight& indirect() const { return *indirect_; }
    const NodeHits* nodeHits() const { return nodeHits_.get(); } ///< null: direct light only
    const DetailGather* detail() const { return detail_.get(); } ///< null: not asked for
    std::span<const Row> emitterRows() const { return direct_.rows().rows(); }
    std::span<const Row> patchRows() const { // empty ones were never needed, or not kept
        return indirect_ ? std::span(indirect_->rows().rows()) : std::span<const Row>();
    }

private:
    void begin();
    bool work(Pace& pace, const Progress& progress);
    void handOver();
    bool workOnIndirect(Pace& pace, const Progress& progress);
    void reportIndirect(const Progress& progress);
    bool workOnce(Pace& pace, const Progress& progress);
    SolutionState reached(bool deferred) const;
    double tolerance(double share) const;
    double mayStayDirty(double share) const { return idle_ ? 0 : tolerance(share); }
    bool workOnDetail(Pace& pace, const Progress& progress);
    bool certificateMet() const;
    bool isFinished() const;
    bool spent() const;
    double target() const;

    const PatchSet& set_;
    const RayScene& rays_;
    SolverOptions options_;
    DirectLight direct_;
    std::optional<Attention> attention_;      ///< of the viewer, if there is one
    std::shared_ptr<ViewPriority> seen_;      ///< what they see, once there was a viewer
    std::uint64_t raysBefore_ = 0;            ///< of such before this one
    bool inViewOrder_ = false;                ///< direct light is updated by its priorities
    std::unique_ptr<NodeHits> nodeHits_;      ///< null: direct light only
    std::unique_ptr<IndirectLight> indirect_; ///< likewise
    std::unique_ptr<DetailGather> detail_;
    bool handedOver_ = false; ///< whether the indirect light knows of the direct light as it is
    bool completing_ = false, completed_ = false; ///< see IndirectLight::complete()
    bool finished_ = false;                       ///< see isFinished()
    SolutionState state_ = SolutionState::working;
    bool idle_ = false;    ///< all is done but for what was deferred; nothing is any more
    bool stopped_ = false; ///< see stopped()
    std::uint64_t shotsBefore_ = 0, servedBefore_ = 0; ///< before the last edit
    /// Since the last edit: the largest certificate, the least knownShare() and the progress so
    /// far, see reportIndirect().
    double firstCertificate_ = 0, firstKnown_ = 1, relaxed_ = 0;
    Pace pace_; ///< of pieces within a time
    double directSeconds_ = 0, indirectSeconds_ = 0, detailSeconds_ = 0;
};

} // namespace penumbra
