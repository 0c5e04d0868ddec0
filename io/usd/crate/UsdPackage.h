// Packages (`.usdz`): several files in one, read where they lie.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace penumbra {

/// Whether the bytes begin as a package does.
bool isUsdPackage(std::string_view begin);

/// The contents of a zip file whose entries are stored as they are: neither compressed nor
/// encrypted. The directory at its end is checked against the entries' own headers; no two entries
/// may share bytes, and none may have a name that leads out of the package.
class UsdPackage {
public:
    /// \param bytes of the whole package; kept, not copied
    /// \param name  that errors carry. Throws SceneFileError
    UsdPackage(std::span<const std::byte> bytes, const std::string& name);

    struct Entry {
        std::string name;
        std::uint64_t start = 0, size = 0; ///< of its data, from the start of the package [bytes]
    };
    /// In the order of their data; the first one is the root layer.
    const std::vector<Entry>& entries() const { return entries_; }
    /// Null if there is no entry of that name.
    const Entry* find(const std::string& name) const;
    std::span<const std::byte> bytes(const Entry& entry) const {
        return bytes_.subspan(entry.start, entry.size);
    }

private:
    std::span<const std::byte> bytes_;
    std::vector<Entry> entries_;
    std::unordered_map<std::string, std::size_t> indexOf_;
};

} // namespace penumbra
