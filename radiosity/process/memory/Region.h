// Memory that program and worker share.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace penumbra {

/// A run of zeroed bytes with a name, which each side maps at an address of its own. It lives as
/// long as one of them holds it.
class Region {
public:
    virtual ~Region() = default;
    virtual std::span<std::byte> bytes() = 0; ///< aligned to 64
    virtual const std::string& name() const = 0;
    /// Makes sure that all of it is there. May take a while. \pre not unlinked
    /// \throws Error if there is not so much
    virtual void reserve() = 0;
    /// Nobody can open it any more. Both sides may do this, at any time.
    virtual void unlink() = 0;
};
using RegionPtr = std::shared_ptr<Region>;

/// Where regions come from.
class Regions {
public:
    virtual ~Regions() = default;
    /// Takes next to no time; memory is there when it is reserved, or when it is written to.
    /// \throws Error
    virtual RegionPtr create(std::size_t bytes) = 0;
    /// \return null: there is none of that name
    virtual RegionPtr open(const std::string& name) = 0;
};

/// Regions within one process.
std::unique_ptr<Regions> makeHeapRegions();

constexpr std::size_t kMostRegionName = 63; ///< letters

} // namespace penumbra
