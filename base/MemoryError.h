// When memory is short.
#pragma once

#include "base/Error.h"

#include <cstddef>
#include <string>

namespace penumbra {

/// Memory, or the address space that `ulimit -v` leaves, is not enough. what(): `memory is short:
/// for what (what to do)`.
class MemoryError : public Error {
public:
    explicit MemoryError(const std::string& forWhat);
};

/// Asks the system whether so much more address space could be had, for libraries that crash where
/// they get none. Takes nothing. \param bytes about \throws MemoryError it could not
void requireAddressSpace(std::size_t bytes, const std::string& forWhat);

/// The same for what drawing by OpenGL takes without a graphics card: Mesa crashes where it does
/// not get it. \param pixels of the picture
void requireMemoryToDraw(std::size_t pixels);

/// To be called before any thread is started. Where `ulimit -v` limits the process, its threads
/// share one heap: usually each sets aside 64 MB of its own, whatever it needs.
void spareAddressSpaceIfLimited();

} // namespace penumbra
