// What lights give to vertices while things move, by rays.
#pragma once

#include "radiosity/rows/EmitterSender.h"
#include "scenegraph/Camera.h"
#include "viewer/preview/PreviewLighting.h"
#include "viewer/preview/PreviewScene.h"
#include "viewer/preview/PreviewSurface.h"
#include "viewer/preview/ShownLight.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace penumbra {

class Frustum;
class EmitterRowBuilder;

/// Rows of the shadow-form-factor-list for the previewed lights, of those vertices alone that a
/// change may reach: the same closed forms, samples and rays as radiosity takes
/// (EmitterRowBuilder), at the same points (PreviewScene), so that both come to the same light.
/// They are kept for each scene state, for as long as that is asked for: what does not move is
/// traced once, and what moves matters only where it is in the way of a light.
///
/// Each vertex remembers the point at which radiosity evaluated it in a scene state; the preview
/// evaluates it at the same point. For a vertex that represents a corner this is the point that
/// was found for the corner then. Corners that something touches now are in a list of their own.
/// Vertices that take their light from receivers around them do so here.
/// Where what moves touches so much that finding it takes longer than rays may, such as a wall
/// does, nothing is touched: radiosity's light has it when it comes.
class PreviewRows {
public:
    static constexpr std::size_t kBlock = LitGeometry::kBlock;

    /// What surfaces are made of, see RadiosityNode::patches(); asked when there are others.
    using PatchesOf = std::function<std::optional<PatchSet>()>;
    using ShownOf = std::function<const ShownLight*(const LitGeometry&)>;

    /// How what surfaces are made of is indexed for rays, with all that they touch: which takes as
    /// long as some frames do, or some dozen of them.
    enum class Indexing {
        aside, ///< in a thread of its own; until it is done nothing is reached
        atOnce
    };

    /// \param samples as SolverOptions::samples
    PreviewRows(int samples, PatchesOf patches, Indexing indexing)
        : samples_(samples), patches_(std::move(patches)), indexing_(indexing) {}

    /// Indexes the geometries of these objects for rays, unless they are.
    void require(const PreviewLighting& light);
    /// Whether what is known is of this scene state, now.
    bool knows(const PreviewLighting& light) const;

    /// A block that a previewed change may reach, by which lights, and which of its vertices: a bit
    /// each.
    struct Reached {
        std::uint32_t object = 0, block = 0;
        unsigned lights = 0;
        std::uint64_t vertices = ~std::uint64_t(0);
    };
    /// Traces what is missing, in the order in which it matters: what is near to what moves, and
    /// what has waited for long.
    /// \param light of some lights; without anchors: what it is like now, so that little is missing
    /// when something begins to move
    /// \param shown what vertices carry
    /// \param view from where it is seen: what can't be seen is left out; null: nothing is
    /// \param seconds that rays are begun for; something is always traced
    void prepare(const PreviewLighting& light, const ShownOf& shown, const View* view,
                 double seconds);
    /// Whether something is missing still: the same call goes on.
    bool unfinished() const { return unfinished_ || making_.valid(); }
    /// Drops what is known.
    void forget();
    std::span<const Reached> reached() const { return reached_; }
    /// What is known of a light at the vertices of a block.
    struct Known {
        std::array<float, kBlock> factors{}; ///< F V
        std::uint64_t vertices = 0;          ///< bits: of which it is known
        std::uint32_t frame = 0;             ///< when it was traced
        std::uint32_t shown = 0;             ///< the last frame in which it was asked for

        bool of(std::size_t vertex) const { return vertices >> vertex % kBlock & 1; }
    };
    /// Of a light that reaches the block. Where only some vertices have had their turn, now is
    /// guessed of the others; where none has, it is as it was in the last frame that had it. Of
    /// anchors, what has had no turn is not known.
    /// \param slot 0: now; 1 ...: the anchors \param at an index of reached()
    const Known& known(std::size_t slot, std::size_t at, std::size_t source) const {
        return *slots_[slot].found[at * kMostPreviewed + source];
    }
    /// What a light gives to a vertex now when nothing is in its way.
    float unoccluded(const Reached& at, std::size_t source, std::size_t vertex) const;

    /// A corner that something touches now, but is drawn with a vertex that it shares.
    struct Touched {
        std::uint32_t object = 0, corner = 0; ///< see TouchedCorner
        std::uint32_t vertex = 0;             ///< that is drawn there
        std::size_t reached = 0;              ///< the vertex's block in reached()
        std::array<float, kMostPreviewed> factors{}, unoccluded{}; ///< now
    };
    std::span<const Touched> touched() const { return touched_; }
    const PreviewSurface& surface(std::uint32_t object) const { return surfaces_[object]; }

private:
    using Key = std::uint64_t;
    using Table = std::unordered_map<Key, Known>;
    struct Slot {
        SceneStatePtr of;
        std::vector<std::vector<EmitterSender>> senders; ///< by light; none: hidden
        std::vector<Bounds> things; ///< boxes around what moves, one a thing [m, world]
        std::unordered_map<std::uint32_t, Pose> poses; ///< of objects that move
        std::vector<TouchedCorner> touched;
        std::vector<std::uint32_t> aside;          ///< see PreviewScene::receiversAside()
        bool contacts = false;                     ///< touched has them all
        std::unordered_map<Key, Receiver> instead; ///< of vertices that are lit somewhere else
        Table table;
        /// What is known of what is reached, by index of reached() and light; null: not reached.
        std::vector<const Known*> found;
    };
    class SeenShares;
    struct Task {
        const Slot* slot;
        const Reached* at;
        std::size_t source;
        Known* known;
        Known* clear; ///< of vertices that nothing that moves is before; null: not to be asked
        std::uint64_t missing;
        float urgency;
        std::uint64_t cleared = 0; ///< vertices that `clear` has from now on
    };
    static Key keyOf(std::uint32_t object, std::uint64_t piece) {
        return Key(object) << 32 | piece;
    }
    static Key keyOf(const Reached& at, std::size_t source) {
        return keyOf(at.object, at.block * std::uint64_t(kMostPreviewed) + source);
    }
    static float unoccluded(std::span<const EmitterSender> source, const Receiver& receiver);

    void takeStage();
    void catchUp(const SceneStatePtr& now);
    void findContacts(Slot& slot, double seconds);
    bool sameMoves(const PreviewLighting& light);
    void followTriangles(const ShownOf& shown);
    void carryOver(std::uint32_t object, const std::vector<AdoptedVertex>& adopted);
    void dropStandIns(std::uint32_t object);
    void chooseSlots(const PreviewLighting& light, double seconds);
    Slot makeSlot(const PreviewLighting& light, const SceneStatePtr& of, double seconds);
    unsigned lightsThrough(const PreviewLighting& light, const Slot& slot, const Bounds& box) const;
    unsigned lightsReaching(const PreviewLighting& light, std::uint32_t object,
                            const Bounds& box) const;
    void findReached(const PreviewLighting& light, const View* view);
    std::vector<Reached> reachedOf(const PreviewLighting& light, std::uint32_t object,
                                   const View* view, const Frustum* frustum) const;
    void addReachedStandIns(const PreviewLighting& light, std::uint32_t object,
                            std::vector<Reached>& reached) const;
    void findTouched(const PreviewLighting& light);
    void addReached(std::vector<Reached> more);
    void addSources();
    std::size_t indexOf(std::uint32_t object, std::size_t vertex) const;
    std::vector<unsigned> lightsInDoubt(const PreviewLighting& light, const Slot& slot) const;
    const RayScene& raysOf(const Slot& slot);
    std::vector<Task> tasksOf(const PreviewLighting& light, Slot& slot);
    std::uint64_t chosenIn(const Reached& at) const;
    float nearness(const PreviewLighting& light, const Slot& slot, const Reached& at) const;
    void trace(const PreviewLighting& light, Slot& slot, double until);
    void guess(Slot& now);
    void remember(Slot& now);
    void blend(Slot& slot);
    void blend(const Slot& slot, const Reached& at, std::size_t source, Known& known) const;
    void traceTouched();
    bool isClear(const Task& task, std::size_t vertex, const Receiver& receiver) const;
    void run(Task& task, EmitterRowBuilder& builder) const;
    Receiver receiver(const Slot& slot, std::uint32_t object, std::size_t vertex) const;
    Receiver ownReceiver(const Slot& slot, std::uint32_t object, std::size_t vertex) const;

    int samples_;
    PatchesOf patches_;
    Indexing indexing_;
    std::vector<std::shared_ptr<const LitGeometry>> geometries_; ///< that were required
    std::unique_ptr<PreviewScene> stage_;                        ///< null: they are not indexed
    std::future<std::unique_ptr<PreviewScene>> making_;          ///< of geometries_
    std::vector<PreviewSurface> surfaces_;                       ///< by object
    std::vector<Slot> slots_;
    std::optional<Slot> awaited_; ///< of PreviewLighting::awaited, as far as it is known
    Table clear_;                 ///< where nothing that moves is in the way
    Table last_;                  ///< of earlier frames
    Table guessed_;               ///< of now, from what is known of other vertices
    std::uint32_t frame_ = 0;     ///< since forget()
    bool unfinished_ = false;
    bool contacts_ = true; ///< are found, of what moves now; else they are left to radiosity
    int slow_ = 0;         ///< times in a row that finding them took too long
    bool behind_ = false;  ///< stage_ is not posed as things are: see catchUp()
    std::vector<bool> moves_, lightMoves_;
    std::vector<std::vector<Emitter>> lights_; ///< that clear_ is of
    std::vector<Reached> reached_;
    std::vector<Touched> touched_;
};

} // namespace penumbra
