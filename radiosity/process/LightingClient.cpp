#include "radiosity/process/LightingClient.h"

#include "base/Clock.h"
#include "base/Error.h"
#include "radiosity/process/memory/Doorbell.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include <unistd.h>

namespace penumbra {

namespace {

constexpr double kFirstDelay = 0.1, kLongestDelay = 10; ///< before another worker is tried [s]

} // namespace

LightingClient::LightingClient(std::unique_ptr<LightingLink> link, const RadiosityOptions& options,
                               std::function<void(ByteWriter&)> writeTask)
    : link_(std::move(link)), options_(options), writeTask_(std::move(writeTask)),
      watch_(options.timeout) {}

LightingClient::~LightingClient() {
    link_->end();
}

void LightingClient::start() {
    running_ = true;
    hopeless_ = false;
    retryAt_ = retryDelay_ = 0;
    lastTurn_ = steadySeconds();
}

void LightingClient::stop() {
    running_ = false;
    link_->end();
    control_.reset();
    ring_.reset();
    queue_.clear();
    unlitSince_ = 0;
}

void LightingClient::say(const std::string& text) {
    toSay_.push_back(text);
}

std::vector<std::string> LightingClient::takeMessages() {
    return std::exchange(toSay_, {});
}

/// A worker that knows nothing yet, and all that is sent to it first.
void LightingClient::launch() {
    try {
        control_ = link_->regions().create(sizeof(ControlBlock));
        control_->reserve();
        ControlBlock& block = control();
        block.magic = kControlMagic;
        block.version = kProtocolVersion;
        block.bytes = sizeof(ControlBlock);
        block.viewer = getpid();
        ring_.emplace(block.ring, block.ringBytes);
        queue_.clear();
        granted_ = opened_ = storeNumber_ = 0;
        grantedRegion_.reset();
        status_ = {};
        ungranted_ = 0;
        watch_.begin();
        link_->start(control_, {options_.threads, options_.niceness});
        sendScene();
        if (hasCamera_) setCamera(camera_);
        if (!lights_.empty()) queue_.put(MessageQueue::kLights, lights_);
        if (question_ != 0) watchDirty(question_);
    } catch (const Error& error) {
        failed(error.what());
    } catch (const std::bad_alloc&) {
        failed("memory is short (allow more: ulimit -v)");
    }
}

void LightingClient::failed(const std::string& why) {
    link_->end();
    control_.reset();
    ring_.reset();
    grantedRegion_.reset();
    if (!std::exchange(reportedFailure_, true))
        say("radiosity: " + why + "; starting anew, with the light that there is until then");
    ++restarts_;
    retryAt_ = steadySeconds() + retryDelay_;
    retryDelay_ = std::clamp(2 * retryDelay_, kFirstDelay, kLongestDelay);
    if (unlitSince_ == 0) unlitSince_ = steadySeconds();
}

void LightingClient::distrust(const std::string& why) {
    store_.reset();
    failed(why);
}

/// The scene with all edits so far: what was sent before counts no more.
void LightingClient::sendScene() {
    hopeless_ = false;
    if (unlitSince_ == 0) unlitSince_ = steadySeconds();
    if (!control_) return;
    ByteWriter task;
    writeTask_(task);
    sendRegion(MessageKind::scene, task);
}

/// What is too long for the ring goes in a region of its own.
void LightingClient::sendRegion(MessageKind kind, const ByteWriter& content) {
    RegionPtr region = link_->regions().create(content.bytes().size());
    region->reserve();
    std::copy(content.bytes().begin(), content.bytes().end(), region->bytes().begin());
    ByteWriter body = messageOf(kind);
    body.text(region->name());
    if (kind == MessageKind::scene)
        queue_.putScene(body.take(), std::move(region));
    else
        queue_.putGrowth(body.take(), std::move(region));
}

void LightingClient::send(const SceneGrowth& growth) {
    hopeless_ = false;
    if (unlitSince_ == 0) unlitSince_ = steadySeconds();
    if (!control_) return; // the next worker gets it with the scene
    ByteWriter content;
    write(content, growth);
    sendRegion(MessageKind::growth, content);
}

void LightingClient::send(const GraphEdit& edit) {
    hopeless_ = false;
    if (unlitSince_ == 0) unlitSince_ = steadySeconds();
    if (!control_) return; // the next worker gets it with the scene
    ByteWriter body = messageOf(MessageKind::edit);
    write(body, edit);
    if (body.bytes().size() > RingSender::longest(kRingBytes)) return sendScene();
    queue_.put(keyOf(edit), body.take());
}

void LightingClient::invalidate(const Bounds& box) {
    ByteWriter body = messageOf(MessageKind::invalidate);
    body.put(box);
    if (control_) queue_.put(MessageQueue::kNoKey, body.take());
    if (unlitSince_ == 0) unlitSince_ = steadySeconds();
}

void LightingClient::setCamera(const View& view) {
    camera_ = view;
    hasCamera_ = true;
    ByteWriter body = messageOf(MessageKind::camera);
    body.put(view);
    if (control_) queue_.put(MessageQueue::kCamera, body.take());
}

void LightingClient::setPreviewLights(const std::vector<std::string>& paths, std::uint32_t serial) {
    ByteWriter body = messageOf(MessageKind::previewLights);
    body.put(serial);
    body.put(std::uint64_t(paths.size()));
    for (const std::string& path : paths) body.text(path);
    lights_ = body.bytes();
    if (control_) queue_.put(MessageQueue::kLights, body.take());
}

void LightingClient::watchDirty(std::uint32_t question) {
    question_ = question;
    sendValue(MessageQueue::kDirty, MessageKind::watchDirty, question);
}

void LightingClient::send(MessageKind kind, std::uint32_t value) {
    sendValue(MessageQueue::kNoKey, kind, value);
}

void LightingClient::sendValue(std::uint64_t key, MessageKind kind, std::uint32_t value) {
    ByteWriter body = messageOf(kind);
    body.put(value);
    if (control_) queue_.put(key, body.take());
}

void LightingClient::turn() {
    const double now = steadySeconds();
    const double passed = std::min(now - lastTurn_, 0.1); // not while this program was stopped
    lastTurn_ = now;
    if (!running_ || hopeless_) return;
    if (!control_ && now >= retryAt_) launch();
    if (!control_) return;
    if (queue_.send(*ring_)) ring(control().doorbell);
    if (!ring_->sound()) return failed("the process wrote nonsense");
    watch(passed);
    if (!control_) return;
    readStatus();
    try {
        grantStore();
        openStore();
    } catch (const Error& error) {
        failed(error.what());
    }
}

/// Ends a worker that has ended itself, or says nothing any more.
void LightingClient::watch(double passed) {
    if (const auto why = link_->ended()) return failed(*why);
    ungranted_ = grantedRegion_ ? ungranted_ + passed : 0;
    if (ungranted_ > WorkerWatch::kStandstill) return failed("the process takes no memory");
    if (!link_->apart()) return;
    const std::string why =
        watch_.listen(control(), passed, link_->byHand(), status_.phase == WorkerStatus::meshing);
    if (!why.empty()) failed(why);
}

void LightingClient::readStatus() {
    WorkerStatus status;
    if (!control().status.read(status) || control().status.version() == 0) return;
    control_->unlink(); // the worker has it
    status_ = status;
    queue_.taken(status_.taken);
    const bool rests =
        status_.solution != std::uint32_t(SolutionState::working) || status_.stopped != 0;
    const bool lit = status_.phase == WorkerStatus::solving && rests &&
                     queue_.knowsEdits(status_.lit) && opened_ == granted_;
    if (lit) {
        unlitSince_ = 0;
        reportedFailure_ = false;
    }
    const std::string trouble =
        status_.phase == WorkerStatus::failed ? status_.trouble.text() : std::string();
    if (std::exchange(reportedTrouble_, trouble) != trouble && !trouble.empty())
        say("radiosity: " + trouble);
}

void LightingClient::grantStore() {
    StoreRequest request;
    if (!control().request.read(request) || request.number <= granted_) return;
    openStore(); // what was granted before may be ready by now, and is not to be lost
    if (request.store != 0 && request.store != storeNumber_)
        throw Error("the process asks for memory for nothing");
    if (request.bytes > options_.mostMemory) {
        say("radiosity: the light of this scene takes " + std::to_string(request.bytes >> 20) +
            " MB, more than the " + std::to_string(options_.mostMemory >> 20) +
            " MB allowed (choose larger elements)");
        link_->end();
        control_.reset();
        hopeless_ = true;
        return;
    }
    grantedRegion_ = link_->regions().create(request.bytes);
    granted_ = request.number;
    grantedFor_ = request.store;
    StoreGrant grant;
    grant.number = granted_;
    grant.name.set(grantedRegion_->name());
    control().grant.write(grant);
    ring(control().doorbell);
}

void LightingClient::openStore() {
    if (!grantedRegion_ || !storeReady(*grantedRegion_, granted_)) return;
    auto store = std::make_shared<StoreReader>(grantedRegion_, granted_);
    grantedRegion_->unlink();
    if (grantedFor_ != 0) {
        store_->add(std::move(store));
    } else {
        store_ = std::move(store);
        storeNumber_ = granted_;
    }
    grantedRegion_.reset();
    opened_ = granted_;
    retryDelay_ = 0; // it works
}

/// What the worker says, once that is about all edits. It is not exact while there are messages,
/// of whatever kind, that the worker has not worked off.
SolutionState LightingClient::solution() const {
    if (!control_ || unlitSince_ != 0) return SolutionState::working;
    const std::uint32_t most = std::uint32_t(
        queue_.knowsEdits(status_.lit) ? SolutionState::exact : SolutionState::certified);
    return SolutionState(std::min(status_.solution, most));
}

RadiosityState LightingClient::state() const {
    using Phase = RadiosityState::Phase;
    RadiosityState state;
    state.task = status_.task.text();
    state.progress = std::isfinite(status_.progress) ? std::clamp(status_.progress, 0.0, 1.0) : 0;
    state.certificate = status_.certificate;
    state.litIlluminance = status_.litIlluminance;
    state.queued = queue_.waiting(status_.taken);
    state.dirtyBlocks = status_.dirtyBlocks;
    state.dirtyMarked = control_ && queue_.knowsEdits(status_.marked);
    state.solution = solution();
    state.rough = status_.rough != 0;
    state.stopped = control_ && unlitSince_ == 0 && status_.stopped != 0;
    state.age = unlitSince_ == 0 ? 0 : steadySeconds() - unlitSince_;
    state.restarts = restarts_;
    if (!running_)
        state.phase = Phase::off;
    else if (hopeless_ || status_.phase == WorkerStatus::failed)
        state.phase = Phase::failed;
    else if (!control_ || status_.phase == WorkerStatus::idle)
        state.phase = Phase::connecting;
    else if (status_.phase == WorkerStatus::meshing)
        state.phase = Phase::meshing;
    else
        state.phase = Phase::solving;
    return state;
}

} // namespace penumbra
