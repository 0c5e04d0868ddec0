#include "radiosity/process/LightingWorker.h"

#include "base/Clock.h"
#include "base/Error.h"
#include "radiosity/process/memory/Doorbell.h"
#include "radiosity/query/MemoryWarning.h"
#include "scenegraph/Objects.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <unordered_set>
#include <utility>

namespace penumbra {

namespace {

constexpr double kTurn = 0.008;            ///< while there is news of the viewer all the time [s]
constexpr double kLongTurn = 0.05;         ///< small pieces have threads wait for each other [s]
constexpr double kQuiet = 0.02;            ///< a turn, as a share of the time without news
constexpr double kPromptTurn = 0.001;      ///< until something of an edit is published [s]
constexpr double kBetweenScans = 0.1;      ///< at the indirect light while it is relaxed [s]
constexpr double kBetweenWork = 0.03;      ///< that the dirty set is published [s]
constexpr std::size_t kMostBlocks = 1024;  ///< published in one turn
constexpr std::size_t kMostSums = 1 << 16; ///< of direct light in one turn [rays]

[[noreturn]] void senseless(const char* what) {
    throw Error(std::string("radiosity: ") + what +
                " makes no sense (is the viewer another version of the program?)");
}

/// Whether nothing of what was lit is left.
bool isAnother(const PatchSet& set, const PlacedScene& now) {
    std::unordered_set<std::string_view> paths;
    for (const Object& object : now.objects) paths.insert(object.path);
    return !paths.empty() && std::ranges::none_of(set.objects, [&](const ObjectPart& object) {
        return paths.contains(object.path);
    });
}

} // namespace

ControlBlock& LightingWorker::controlOf(Region& region) {
    if (region.bytes().size() < sizeof(ControlBlock)) senseless("the size of the shared memory");
    auto& control = *reinterpret_cast<ControlBlock*>(region.bytes().data());
    if (control.magic != kControlMagic || control.version != kProtocolVersion ||
        control.bytes != sizeof(ControlBlock))
        senseless("the shared memory");
    return control;
}

LightingWorker::LightingWorker(Regions& regions, RegionPtr control, std::size_t memory)
    : regions_(regions), region_(std::move(control)), control_(controlOf(*region_)),
      messages_(control_.ring, control_.ringBytes), memory_(memory) {}

LightingWorker::~LightingWorker() = default;

void LightingWorker::run() {
    for (;;) {
        const double quiet = steadySeconds() - newsAt_;
        const Turn last = turn(std::clamp(kQuiet * quiet, kTurn, kLongTurn));
        if (last == Turn::stopped) return;
        if (last == Turn::idle) wait(0.05);
    }
}

void LightingWorker::wait(double seconds) {
    waitForRing(control_.doorbell, heard_, seconds);
}

LightingWorker::Turn LightingWorker::turn(double budget) {
    control_.turns.fetch_add(1, std::memory_order_relaxed);
    receive();
    if (stopped_ || control_.stop.load(std::memory_order_relaxed) != 0) return Turn::stopped;
    bool worked = false;
    try {
        if (edited_ && mayFollow()) followScene(), worked = true;
        if (lit_) worked |= work(budget);
        if (question_ != 0 && publisher_) showWork();
    } catch (const Error& error) {
        fail(error.what());
    }
    report();
    return worked ? Turn::worked : Turn::idle;
}

void LightingWorker::receive() {
    heard_ = control_.doorbell.load(std::memory_order_acquire);
    for (;;) {
        const RingReceiver::Got got = messages_.receive(message_);
        if (got == RingReceiver::Got::nothing) return;
        if (got == RingReceiver::Got::nonsense) senseless("the queue of messages");
        ByteReader reader(message_);
        const auto kind = reader.get<MessageKind>();
        const auto serial = reader.get<std::uint64_t>();
        take(kind, reader);
        if (!reader.ok()) senseless("a message");
        newsAt_ = steadySeconds();
        status_.taken = serial;
    }
}

void LightingWorker::take(MessageKind kind, ByteReader& message) {
    switch (kind) {
    case MessageKind::scene:
        takeScene(message.text());
        break;
    case MessageKind::growth:
        takeGrowth(message.text());
        break;
    case MessageKind::edit:
        takeEdit(message);
        break;
    case MessageKind::invalidate:
        invalid_.push_back(message.get<Bounds>());
        edited_ = true;
        break;
    case MessageKind::stop:
        stopped_ = true;
        break;
    case MessageKind::camera:
        viewer_.setCamera(message.get<View>());
        break;
    case MessageKind::policy:
        takePolicy(message);
        break;
    case MessageKind::grab: // what is in a hand is known by its moving
    case MessageKind::release:
    case MessageKind::trigger: // what is held back is held by the node
    case MessageKind::update:
        message.get<std::uint32_t>();
        break;
    case MessageKind::watchDirty:
        question_ = message.get<std::uint32_t>();
        nextWork_ = 0;
        break;
    case MessageKind::previewLights:
        takeLights(message);
        break;
    default:
        message.fail();
    }
}

void LightingWorker::takeEdit(ByteReader& message) {
    const auto edit = readGraphEdit(message);
    if (!edit || !graph_ || !graph_->apply(*edit)) senseless("an edit");
    edited_ = true;
}

void LightingWorker::takePolicy(ByteReader& message) {
    const auto policy = message.get<std::uint32_t>();
    if (policy > std::uint32_t(PolicyKind::random)) senseless("a scheduling policy");
    viewer_.setPolicy(PolicyKind(policy));
}

RegionPtr LightingWorker::opened(const std::string& region) {
    RegionPtr opened = regions_.open(region);
    if (!opened) senseless("the name of a scene");
    opened->unlink();
    return opened;
}

void LightingWorker::takeGrowth(const std::string& region) {
    const RegionPtr content = opened(region);
    ByteReader reader(content->bytes());
    const auto growth = readSceneGrowth(reader);
    if (!growth || !graph_ || !graph_->apply(*growth)) senseless("what comes to the scene");
    edited_ = true;
}

void LightingWorker::takeScene(const std::string& region) {
    const RegionPtr content = opened(region);
    ByteReader reader(content->bytes());
    task_ = readLightingTask(reader);
    if (!task_) senseless("a scene");
    if (memory_ > 0) task_->solving.memory = memory_;
    viewer_.setPolicy(task_->solving.policy);
    graph_ = std::make_unique<SceneReplica>(std::move(task_->scene));
    publisher_.reset();
    lit_.reset();
    edited_ = true;
}

void LightingWorker::takeLights(ByteReader& message) {
    previewSet_ = message.get<std::uint32_t>();
    lights_.resize(std::min(message.count(sizeof(std::uint64_t)), kMostPreviewLights));
    for (std::string& path : lights_) path = message.text();
    viewer_.setWhole(!lights_.empty());
    if (publisher_) publisher_->setPreviewLights(previewSet_, lights_);
    marked_ = false;
}

/// Whether edits may be followed now, or are to wait for the light of those before.
bool LightingWorker::mayFollow() const {
    return !lit_ || !workLeft_ || pace_.mayTake(steadySeconds());
}

/// The last message that what is worked on takes in.
std::uint64_t LightingWorker::followed() const {
    return edited_ ? followed_ : status_.taken;
}

void LightingWorker::followScene() {
    edited_ = false;
    followed_ = status_.taken;
    pace_.taken(steadySeconds());
    marked_ = shown_ = false;
    aim_ = SolutionState::certified;
    workLeft_ = true;
    status_.solution = std::uint32_t(SolutionState::working);
    status_.stopped = 0;
    nextScan_ = steadySeconds() + kTurn; // its direct light comes first
    nextWork_ = 0;
    if (!graph_) return;
    if (!lit_) return build();
    const PlacedScene placed = placeScene(graph_->scene());
    if (isAnother(lit_->patches(), placed)) {
        publisher_.reset();
        lit_.reset();
        return build();
    }
    const LitScene::Followed followed = lit_->follow(placed);
    for (const Bounds& box : std::exchange(invalid_, {})) lit_->invalidate(box);
    if (followed.rebuilt) return build();
    std::optional<Bounds> moved;
    for (ObjectId object : followed.change.objects) {
        if (!moved) moved.emplace();
        moved->add(boundsOf(lit_->patches(), object));
    }
    viewer_.setMoved(moved);
    show(followed);
}

/// Has what an edit changed published.
void LightingWorker::show(const LitScene::Followed& followed) {
    if (followed.added) publisher_->grow();
    publisher_->follow(followed.change);
    if (publisher_->outgrown() || (followed.added && !publisher_->hasStore()))
        requestStore();
    else if (followed.added)
        requestAddition();
}

/// Meshes the scene, if that was not done, and asks for a store to publish it in.
void LightingWorker::build() {
    status_.phase = WorkerStatus::meshing;
    status_.task.set("meshing");
    status_.progress = 0;
    report();
    const PlacedScene placed = placeScene(graph_->scene());
    publisher_.reset();
    invalid_.clear();
    const auto progress = [this](const char* phase, double done) {
        status_.task.set(phase);
        status_.progress = done;
        report();
    };
    if (!lit_)
        lit_ = std::make_unique<LitScene>(placed, task_->meshing, task_->solving, true, progress);
    viewer_.solverIsNew();
    publisher_ = std::make_unique<LightPublisher>(*lit_);
    if (!lights_.empty()) publisher_->setPreviewLights(previewSet_, lights_);
    directDone_ = false;
    requestStore();
    publisher_->showRough(roughLight(lit_->patches(), lit_->rays()));
}

void LightingWorker::requestStore() {
    constexpr std::uint32_t kLeastSpare = 64;
    mesh_ = describeMesh(*lit_, *graph_);
    const std::uint32_t blocks = publisher_->blockCount();
    shape_.meshBytes = mesh_.size();
    shape_.blocks = blocks + std::max(kLeastSpare, blocks / 4);
    shape_.firstPrivate = lit_->patches().firstPrivate / PatchSet::kBlock;
    request(shape_.bytes(), 0);
}

/// Asks for memory for the mesh of the objects that have come.
void LightingWorker::requestAddition() {
    mesh_ = describeMesh(*lit_, *graph_, described_);
    request(additionShape(mesh_).bytes(), store_);
}

/// \param store see StoreRequest
void LightingWorker::request(std::uint64_t bytes, std::uint64_t store) {
    ++request_.number;
    request_.bytes = bytes;
    request_.store = store;
    control_.request.write(request_);
}

void LightingWorker::openStore() {
    StoreGrant grant;
    if (!control_.grant.read(grant) || grant.number != request_.number) return;
    const RegionPtr region = regions_.open(grant.name.text());
    if (!region || region->bytes().size() < request_.bytes) senseless("the memory for results");
    region->reserve();
    region->unlink();
    control_.opened.store(request_.number, std::memory_order_release);
    if (request_.store != 0) {
        publisher_->addMesh(region, request_.number, mesh_);
    } else {
        publisher_->setStore(std::make_unique<StoreWriter>(region, request_.number, shape_, mesh_));
        store_ = request_.number;
    }
    described_ = std::uint32_t(lit_->patches().objects.size());
    mesh_ = {};
}

/// \return whether there was anything to do
bool LightingWorker::work(double budget) {
    if (!mesh_.empty()) openStore();
    bool worked = false;
    if (workLeft_) {
        worked = true;
        solve(shown_ || !directDone_ ? budget : std::min(budget, kPromptTurn));
    }
    if (!marked_ || worked) marked_ = publisher_->findStale();
    if (publisher_->hasLight() && mesh_.empty()) {
        const bool published = publisher_->publish(kMostBlocks);
        worked |= published;
        shown_ |= published;
    }
    if (marked_ && publisher_->staleShown()) status_.marked = followed();
    if (publisher_->hasStore() && mesh_.empty() && publisher_->left() == 0) stateSolution();
    return worked;
}

/// Reports on the light as it is published. \pre all of it is
void LightingWorker::stateSolution() {
    const Solver& solver = lit_->solver();
    status_.solution = std::uint32_t(solver.state());
    status_.stopped = !workLeft_ && solver.stopped();
    if (solver.state() != SolutionState::working || status_.stopped != 0) status_.lit = followed();
}

/// For those who watch: what is dirty now.
void LightingWorker::showWork() {
    if (steadySeconds() < nextWork_ || !publisher_->hasStore() || !mesh_.empty()) return;
    publisher_->publishDirty(question_);
    nextWork_ = steadySeconds() + kBetweenWork;
}

/// Until the light is certified; then goes on with what was deferred.
void LightingWorker::solve(double budget) {
    const auto progress = [&](const char* phase, double done) {
        status_.task.set(phase);
        status_.progress = done;
        if (std::strcmp(phase, "direct light") != 0) directIsDone();
    };
    Solver& solver = lit_->solver();
    if (directDone_) viewer_.update(solver, steadySeconds()); // the first light comes all at once
    const bool done = solver.stepUntil(aim_, budget, progress);
    warnOfMemory();
    if (done) workLeft_ = std::exchange(aim_, SolutionState::exact) != SolutionState::exact;
    pace_.worked(steadySeconds(), solver.direct().dirtyKnown());
    if (done) directIsDone();
    status_.phase = WorkerStatus::solving;
    if (directDone_) solver.sumUp(kMostSums);
    if (done || steadySeconds() >= nextScan_) {
        publisher_->solverWorked(done);
        nextScan_ = steadySeconds() + kBetweenScans;
    } else {
        publisher_->directWorked();
    }
}

void LightingWorker::warnOfMemory() {
    if (memoryWarned_) return;
    const std::string warning = memoryWarning(lit_->solver(), lit_->patches());
    memoryWarned_ = !warning.empty();
    if (memoryWarned_) std::fprintf(stderr, "radiosity: warning: %s\n", warning.c_str());
}

void LightingWorker::directIsDone() {
    directDone_ = true;
    publisher_->directIsDone();
}

/// This scene can't be lit; the next one, or an edit, may change that.
void LightingWorker::fail(const std::string& why) {
    status_.phase = WorkerStatus::failed;
    status_.trouble.set(why);
    status_.solution = std::uint32_t(SolutionState::working);
    status_.stopped = 0;
    publisher_.reset();
    lit_.reset();
    mesh_ = {};
}

void LightingWorker::report() {
    if (lit_) {
        const double certificate = lit_->solver().certificate();
        if (certificate != status_.certificate) // or the light is what it was
            status_.litIlluminance = lit_->solver().litIlluminance();
        status_.certificate = certificate;
    }
    status_.rough = publisher_ && publisher_->isRough() ? 1 : 0;
    status_.dirtyBlocks = publisher_ ? std::uint32_t(publisher_->left()) : 0;
    control_.status.write(status_);
}

} // namespace penumbra
