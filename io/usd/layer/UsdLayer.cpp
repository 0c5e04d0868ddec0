// Getting the text of a layer from the disk.
#include "io/usd/layer/UsdLayer.h"

#include "base/FileBytes.h"

namespace penumbra {

const UsdProperty* UsdPrimSpec::property(std::string_view propertyName) const {
    for (const UsdProperty& p : properties)
        if (p.name == propertyName) return &p;
    return nullptr;
}

UsdLayer readUsdLayer(const std::filesystem::path& file, const UsdLayerLimits& limits) {
    const std::string name = file.string();
    const FileBytes mapped(name, limits.fileBytes);
    const auto bytes = mapped.bytes();
    return parseUsdLayer({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name, limits);
}

} // namespace penumbra
