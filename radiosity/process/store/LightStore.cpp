#include "radiosity/process/store/LightStore.h"

#include "base/Error.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <limits>

namespace penumbra {

namespace {

constexpr std::uint64_t kMagic = 0x3345524f54535550; // "PUSTORE3"
constexpr std::size_t kBlockWords = sizeof(LightBlock) / 8;
constexpr std::size_t kBaseWords = offsetof(LightBlock, corners) / 8;
constexpr std::size_t kCornerWords = offsetof(LightBlock, lights) / 8 - kBaseWords;
constexpr std::size_t kLightsAt = kBaseWords + kCornerWords;
constexpr std::size_t kLightHead =
    (offsetof(LightBlock, factor) - offsetof(LightBlock, lights)) / 8;
constexpr std::size_t kLightWords = LightBlock::kSize * sizeof(float) / 8; ///< of each light
static_assert(sizeof(LightBlock) % 8 == 0 && offsetof(LightBlock, corners) % 8 == 0 &&
              offsetof(LightBlock, lights) % 8 == 0 && offsetof(LightBlock, factor) % 8 == 0);
static_assert(kLightsAt + kLightHead + kMostPreviewLights * kLightWords == kBlockWords);

std::size_t aligned(std::size_t size) {
    return (size + 63) / 64 * 64;
}
std::size_t meshAt() {
    return aligned(sizeof(StoreHeader));
}
std::size_t sequencesAt(const StoreShape& shape) {
    return meshAt() + aligned(shape.meshBytes);
}
std::size_t blocksAt(const StoreShape& shape) {
    return sequencesAt(shape) + aligned(shape.blocks * sizeof(SharedCount));
}

std::size_t workAt(const StoreShape& shape) {
    return aligned(blocksAt(shape) + shape.blocks * sizeof(LightBlock));
}

template <class T>
T* at(Region& region, std::size_t offset) {
    return reinterpret_cast<T*>(region.bytes().data() + offset);
}

/// Runs of words of a block that matter: of a private one, and with so many previewed lights.
template <class Visit>
void forEachRun(bool isPrivate, std::uint32_t lights, Visit visit) {
    visit(std::size_t(0), kBaseWords);
    if (isPrivate) visit(kBaseWords, kCornerWords);
    if (lights > 0)
        visit(kLightsAt,
              kLightHead + std::min<std::size_t>(lights, kMostPreviewLights) * kLightWords);
}

/// What is not finite or negative becomes 0.
void mend(float& x) {
    x = x >= 0 && x <= std::numeric_limits<float>::max() ? x : 0;
}
void mend(Rgb& colour) {
    mend(colour.r), mend(colour.g), mend(colour.b);
}
template <class Range>
void mendAll(Range& values) {
    for (auto& value : values) mend(value);
}

void mend(LightBlock& light) {
    mendAll(light.direct);
    mendAll(light.indirect);
    if (light.previewSet == 0) return;
    mendAll(light.exitance);
    for (auto& factors : light.factor) mendAll(factors);
}

} // namespace

std::size_t StoreShape::bytes() const {
    return workAt(*this) + blocks * sizeof(SharedWord);
}

StoreWriter::StoreWriter(RegionPtr region, std::uint64_t number, const StoreShape& shape,
                         std::span<const std::byte> mesh)
    : region_(std::move(region)), shape_(shape), header_(*at<StoreHeader>(*region_, 0)),
      sequences_(at<SharedCount>(*region_, sequencesAt(shape))),
      blocks_(at<SharedWord>(*region_, blocksAt(shape))),
      work_(at<SharedWord>(*region_, workAt(shape))) {
    assert(region_->bytes().size() >= shape.bytes() && mesh.size() == shape.meshBytes);
    header_.magic = kMagic;
    header_.number = number;
    header_.shape = shape;
    std::memcpy(region_->bytes().data() + meshAt(), mesh.data(), mesh.size());
    header_.used.store(shape.firstPrivate, std::memory_order_relaxed);
    header_.ready.store(1, std::memory_order_release);
}

StoreShape additionShape(std::span<const std::byte> mesh) {
    return {mesh.size(), 0, 0};
}

void StoreWriter::add(RegionPtr region, std::uint64_t number, std::span<const std::byte> mesh) {
    const StoreWriter addition(std::move(region), number, additionShape(mesh), mesh);
    header_.additions.fetch_add(1, std::memory_order_release);
}

void StoreWriter::setUsed(std::uint32_t blocks) {
    assert(blocks <= shape_.blocks);
    header_.used.store(blocks, std::memory_order_release);
}

void StoreWriter::write(std::uint32_t block, const LightBlock& light) {
    assert(block < shape_.blocks);
    SharedCount& sequence = sequences_[block];
    SharedWord* const to = blocks_ + block * kBlockWords;
    const auto* const from = reinterpret_cast<const char*>(&light);
    const bool isPrivate = block >= shape_.firstPrivate;
    if (sequence.load(std::memory_order_relaxed) != 0) {
        bool same = true;
        forEachRun(isPrivate, light.previewSet != 0 ? light.lights : 0,
                   [&](std::size_t first, std::size_t count) {
                       for (std::size_t w = first; same && w < first + count; ++w) {
                           std::uint64_t word;
                           std::memcpy(&word, from + 8 * w, 8);
                           same = to[w].load(std::memory_order_relaxed) == word;
                       }
                   });
        if (same) return;
    }
    beginWrite(sequence);
    forEachRun(isPrivate, light.previewSet != 0 ? light.lights : 0,
               [&](std::size_t first, std::size_t count) {
                   writeWords(to + first, from + 8 * first, count);
               });
    endWrite(sequence);
    header_.published.fetch_add(1, std::memory_order_release);
}

void StoreWriter::writeDirty(std::uint32_t question, std::span<const DirtyStatus> work) {
    const std::size_t count = std::min<std::size_t>(work.size(), shape_.blocks);
    for (std::size_t b = 0; b < count; ++b)
        work_[b].store(work[b].packed(), std::memory_order_relaxed);
    header_.dirtyFor.store(question, std::memory_order_release);
}

bool storeReady(Region& region, std::uint64_t number) {
    if (region.bytes().size() < meshAt()) return false;
    const StoreHeader& header = *at<StoreHeader>(region, 0);
    return header.ready.load(std::memory_order_acquire) == 1 && header.number == number;
}

StoreReader::StoreReader(RegionPtr region, std::uint64_t number)
    : region_(std::move(region)), header_(*at<StoreHeader>(*region_, 0)) {
    const std::size_t size = region_->bytes().size();
    const auto refuse = [](const char* what) {
        throw Error(std::string("published light: ") + what + " (is the program of two versions?)");
    };
    if (size < meshAt() || header_.magic != kMagic || header_.number != number)
        refuse("not what was asked for");
    shape_ = header_.shape;
    if (shape_.meshBytes > size || shape_.blocks > size / sizeof(LightBlock) ||
        shape_.firstPrivate > shape_.blocks || shape_.bytes() > size)
        refuse("its sizes can't be");
    meshes_.push_back(region_->bytes().subspan(meshAt(), shape_.meshBytes));
    sequences_ = at<SharedCount>(*region_, sequencesAt(shape_));
    blocks_ = at<SharedWord>(*region_, blocksAt(shape_));
    work_ = at<SharedWord>(*region_, workAt(shape_));
    known_.resize(shape_.blocks);
}

void StoreReader::add(std::shared_ptr<StoreReader> addition) {
    meshes_.push_back(addition->meshes_.front());
    additions_.push_back(std::move(addition));
}

std::size_t StoreReader::meshesReady() const {
    return 1 + std::size_t(header_.additions.load(std::memory_order_acquire));
}

void StoreReader::again(std::uint32_t block) {
    known_[block] = 0;
    publishedKnown_ = ~std::uint64_t(0);
    current_ = false;
}

bool StoreReader::readBlock(std::uint32_t block, LightBlock& light, std::uint32_t& sequence) const {
    sequence = sequences_[block].load(std::memory_order_acquire);
    if (sequence % 2 != 0) return false;
    const SharedWord* const from = blocks_ + block * kBlockWords;
    auto* const to = reinterpret_cast<char*>(&light);
    const auto take = [&](std::size_t first, std::size_t count) {
        readWords(from + first, to + 8 * first, count);
    };
    take(0, kBaseWords);
    if (block >= shape_.firstPrivate) take(kBaseWords, kCornerWords);
    if (light.previewSet != 0) {
        take(kLightsAt, kLightHead);
        take(kLightsAt + kLightHead,
             std::min<std::size_t>(light.lights, kMostPreviewLights) * kLightWords);
    }
    if (sequences_[block].load(std::memory_order_relaxed) != sequence) return false;
    mend(light);
    return true;
}

void StoreReader::read(std::size_t most, std::vector<Got>& got) {
    const std::uint64_t published = header_.published.load(std::memory_order_acquire);
    current_ = published == publishedKnown_;
    if (current_) return;
    const std::uint32_t used =
        std::min(header_.used.load(std::memory_order_acquire), shape_.blocks);
    if (next_ >= used) next_ = 0;
    bool missed = false;
    for (std::uint32_t visited = 0; visited < used; ++visited) {
        const std::uint32_t block = next_;
        const std::uint32_t sequence = sequences_[block].load(std::memory_order_relaxed);
        if (sequence != known_[block]) {
            if (got.size() >= most) return; // publishedKnown_ stays: there is more
            got.push_back({block, {}});
            std::uint32_t version = 0;
            if (readBlock(block, got.back().light, version)) {
                known_[block] = version;
            } else {
                got.pop_back();
                missed = true;
            }
        }
        next_ = next_ + 1 == used ? 0 : next_ + 1;
    }
    current_ = !missed;
    if (current_) publishedKnown_ = published;
}

void StoreReader::readDirty(std::uint32_t question, std::vector<DirtyStatus>& work) const {
    work.clear();
    if (header_.dirtyFor.load(std::memory_order_acquire) != question) return;
    for (std::uint32_t b = 0; b < shape_.blocks; ++b)
        work.push_back(DirtyStatus::unpacked(work_[b].load(std::memory_order_relaxed)));
}

} // namespace penumbra
