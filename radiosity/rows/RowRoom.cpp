#include "radiosity/rows/RowRoom.h"

#include "base/MachineMemory.h"

namespace penumbra {

namespace {

constexpr double kVertexLater = 200; ///< what the fine shadows take; measured [bytes]

} // namespace

std::size_t roomForRows(std::size_t budget, std::size_t rows, const PatchSet& set) {
    const double left = double(budget) + kRowOverhead * double(rows) - double(residentMemory()) -
                        kVertexLater * double(set.vertices.size());
    return left > 0 ? std::size_t(left / kRowOverhead) : 0;
}

} // namespace penumbra
