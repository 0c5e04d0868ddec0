#include "viewer/preview/ShownLight.h"

#include "scenegraph/LitGeometry.h"

namespace penumbra {

void ShownLight::touchCopies() {
    constexpr std::size_t kBlock = LitGeometry::kBlock;
    ++revision;
    blockRevisions.resize((direct.size() + kBlock - 1) / kBlock);
    for (std::size_t block = vertices() / kBlock; block < blockRevisions.size(); ++block)
        touch(block);
}

} // namespace penumbra
