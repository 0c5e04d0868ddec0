// Four numbers in one register, for the few loops in which all of the time goes: an extension that
// GCC and Clang share.
#pragma once

namespace penumbra {

using Float4 [[gnu::vector_size(4 * sizeof(float))]] = float;
using Double4 [[gnu::vector_size(4 * sizeof(double))]] = double;

} // namespace penumbra
