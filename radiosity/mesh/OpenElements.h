// Elements that nothing touches, all at once.
#pragma once

#include "radiosity/mesh/Contact.h"

#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// Finds elements that ContactResolver would call free with no corner moved, in a fraction of its
/// rays' time: short ones in packets. Whether they are buried is asked once for all that hang
/// together: where a way from one to the next is free, both are inside of the same solids. What is
/// left out has something near, and has to be examined by itself.
/// \param all, fans the elements and the corners at their vertices
/// \param which of them, rising; their objects are present
/// \return one a listed element, 1: open
std::vector<std::uint8_t> findOpen(const RayScene& rays, std::span<const RayMesh> meshes,
                                   const ContactResolver& resolver, const std::vector<Element>& all,
                                   const Fans& fans, std::span<const std::uint32_t> which);

} // namespace penumbra
