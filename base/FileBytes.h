// The bytes of a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <span>
#include <string>

namespace penumbra {

/// All bytes of a file: a copy, or, if it is large, the file itself, mapped, so that pages that
/// nobody touches are never read. What is mapped must not be shortened meanwhile, which would end
/// the program; a small file may be saved anew while it is read.
class FileBytes {
public:
    /// Throws SceneFileError `path: error: can't read: ...` for what is missing, no regular file,
    /// not permitted, shortened while it is read, or larger than `maxBytes`.
    explicit FileBytes(const std::string& path,
                       std::uintmax_t maxBytes = std::numeric_limits<std::uintmax_t>::max(),
                       std::uintmax_t mapFrom = kMapFrom);
    ~FileBytes();
    FileBytes(const FileBytes&) = delete;
    FileBytes& operator=(const FileBytes&) = delete;

    std::span<const std::byte> bytes() const { return bytes_; }

    static constexpr std::size_t kAlignment = 64;                        ///< of the first byte
    static constexpr std::uintmax_t kMapFrom = std::uintmax_t(64) << 20; ///< larger: mapped [bytes]

private:
    std::span<const std::byte> bytes_;
    struct Free {
        void operator()(std::byte* memory) const { std::free(memory); }
    };
    std::unique_ptr<std::byte[], Free> copy_; ///< null if mapped
};

} // namespace penumbra
