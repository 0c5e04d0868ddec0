#include "io/usd/crate/UsdPackage.h"

#include "base/Error.h"
#include "io/usd/crate/CrateBytes.h"
#include "io/usd/layer/UsdText.h"

#include <algorithm>

namespace penumbra {

namespace {

// After PKWARE's APPNOTE.TXT, sections 4.3.7, 4.3.12 and 4.3.16.
constexpr std::uint32_t kLocalHeader = 0x04034b50;
constexpr std::uint32_t kCentralHeader = 0x02014b50;
constexpr std::uint32_t kEndOfDirectory = 0x06054b50;
constexpr std::uint64_t kEndBytes = 22, kMaxComment = 65535;
constexpr std::uint64_t kCentralBytes = 46;

/// What both headers of an entry say.
struct Header {
    std::uint16_t flags = 0, method = 0;
    std::uint32_t packed = 0, size = 0;
    std::uint16_t nameBytes = 0, extraBytes = 0;
};

/// \param in at the flags
Header takeHeader(CrateBytes& in) {
    Header header;
    header.flags = in.take<std::uint16_t>();
    header.method = in.take<std::uint16_t>();
    in.take(8); // time, date, checksum
    header.packed = in.take<std::uint32_t>();
    header.size = in.take<std::uint32_t>();
    header.nameBytes = in.take<std::uint16_t>();
    header.extraBytes = in.take<std::uint16_t>();
    return header;
}

std::string takeName(CrateBytes& in, std::uint16_t bytes) {
    const auto name = in.take(bytes);
    return {reinterpret_cast<const char*>(name.data()), name.size()};
}

// A relative path that stays inside, without what an address `a.usdz[b]` can't have.
bool isGoodName(const std::string& name) {
    if (name.empty() || name.front() == '/' || firstBadUtf8(name) != std::string::npos)
        return false;
    for (const char c : name)
        if (static_cast<unsigned char>(c) < 0x20 || c == '\\' || c == '[' || c == ']') return false;
    for (std::size_t from = 0; from <= name.size();) {
        const std::size_t to = std::min(name.find('/', from), name.size());
        const std::string_view part(name.data() + from, to - from);
        if (part == ".." || part == "." || (part.empty() && to != name.size())) return false;
        from = to + 1;
    }
    return true;
}

/// The end of the directory's place: behind it there is a comment at most.
CrateBytes findEnd(std::span<const std::byte> file) {
    CrateBytes in(file);
    if (file.size() < kEndBytes) in.fail("it is too short");
    const std::uint64_t last = file.size() - kEndBytes;
    for (std::uint64_t back = 0; back <= std::min(last, kMaxComment); ++back) {
        in.moveTo(last - back);
        if (in.take<std::uint32_t>() == kEndOfDirectory) return in;
    }
    in.fail("its directory is missing");
}

struct Placed {
    UsdPackage::Entry entry;
    std::uint64_t header = 0; ///< where the local header begins
};

/// An entry of the directory, checked against its own header; `in` goes on behind it.
Placed takeEntry(CrateBytes& in, std::span<const std::byte> file) {
    if (in.take<std::uint32_t>() != kCentralHeader) in.fail("a damaged entry of its directory");
    in.take(4); // versions
    const Header central = takeHeader(in);
    const auto commentBytes = in.take<std::uint16_t>();
    in.take(8); // disk, attributes
    const auto place = in.take<std::uint32_t>();
    const std::string name = takeName(in, central.nameBytes);
    in.take(std::uint64_t(central.extraBytes) + commentBytes);
    if (!isGoodName(name)) in.fail("'" + printable(name) + "' is no name for a file in it");
    if (central.method != 0) in.fail("'" + name + "' is compressed, which a package must not be");
    if (central.flags & 1) in.fail("'" + name + "' is encrypted");
    if (place == 0xffff'ffff || central.size == 0xffff'ffff) in.fail("zip64 is not supported");

    CrateBytes local(file);
    local.moveTo(place);
    if (local.take<std::uint32_t>() != kLocalHeader) local.fail("'" + name + "' has no header");
    local.take(2); // version
    const Header own = takeHeader(local);
    if (own.method != 0 || (own.flags & 1) || own.packed != central.packed ||
        own.size != central.size || own.packed != own.size ||
        takeName(local, own.nameBytes) != name)
        local.fail("the header of '" + name + "' contradicts the directory");
    local.take(own.extraBytes);
    const std::uint64_t start = local.at();
    local.take(own.size);
    return {{name, start, own.size}, place};
}

std::vector<Placed> readDirectory(std::span<const std::byte> file) {
    CrateBytes end = findEnd(file);
    end.take(6); // disks, entries on this one
    const auto count = end.take<std::uint16_t>();
    end.take(4); // the directory's size
    const auto place = end.take<std::uint32_t>();
    if (count == 0xffff || place == 0xffff'ffff) end.fail("zip64 is not supported");
    CrateBytes in(file);
    in.moveTo(place);
    if (count > in.left() / kCentralBytes) in.fail("its directory is cut off");
    std::vector<Placed> entries;
    for (unsigned i = 0; i < count; ++i) entries.push_back(takeEntry(in, file));
    std::sort(entries.begin(), entries.end(),
              [](const Placed& a, const Placed& b) { return a.header < b.header; });
    for (std::size_t i = 1; i < entries.size(); ++i)
        if (entries[i].header < entries[i - 1].entry.start + entries[i - 1].entry.size)
            in.fail("'" + entries[i].entry.name + "' overlaps another file");
    return entries;
}

} // namespace

bool isUsdPackage(std::string_view begin) {
    return begin.starts_with("PK\x03\x04");
}

UsdPackage::UsdPackage(std::span<const std::byte> bytes, const std::string& name) : bytes_(bytes) {
    const auto refuse = [&](const std::string& why) {
        throw SceneFileError({name, 0, 0}, "damaged package: " + why);
    };
    try {
        for (Placed& placed : readDirectory(bytes)) {
            if (placed.entry.name.back() == '/') continue; // a folder
            if (!indexOf_.try_emplace(placed.entry.name, entries_.size()).second)
                refuse("'" + placed.entry.name + "' is in it twice");
            entries_.push_back(std::move(placed.entry));
        }
    } catch (const CrateFault& fault) {
        refuse(fault.what());
    }
    if (entries_.empty()) refuse("there is no file in it");
}

const UsdPackage::Entry* UsdPackage::find(const std::string& name) const {
    const auto found = indexOf_.find(name);
    return found == indexOf_.end() ? nullptr : &entries_[found->second];
}

} // namespace penumbra
