// Getting the text of a layer from the disk.
#include "io/usd/layer/UsdLayer.h"

#include <cerrno>
#include <cstring>
#include <fstream>

namespace penumbra {

namespace {

[[noreturn]] void refuse(const std::string& file, const std::string& why) {
    throw SceneFileError({file, 0, 0}, why);
}

std::string readWholeFile(const std::filesystem::path& path, const std::string& name,
                          std::uintmax_t maxBytes) {
    namespace fs = std::filesystem;
    std::error_code failed;
    const fs::file_status status = fs::status(path, failed);
    if (status.type() == fs::file_type::not_found) refuse(name, "there is no such file");
    if (failed) refuse(name, failed.message());
    if (fs::is_directory(status)) refuse(name, "this is a folder, not a scene file");
    if (!fs::is_regular_file(status)) refuse(name, "this is not a regular file");
    const std::uintmax_t bytes = fs::file_size(path, failed);
    if (failed) refuse(name, failed.message());
    if (bytes > maxBytes)
        refuse(name, "the file is too large: " + std::to_string(bytes) + " bytes (the limit is " +
                         std::to_string(maxBytes) + ")");
    errno = 0;
    std::ifstream in(path, std::ios::binary);
    std::string text(bytes, '\0');
    if (!in || !in.read(text.data(), std::streamsize(bytes)))
        refuse(name, std::string("can't be read: ") + std::strerror(errno ? errno : EIO));
    return text;
}

} // namespace

const UsdProperty* UsdPrimSpec::property(std::string_view propertyName) const {
    for (const UsdProperty& p : properties)
        if (p.name == propertyName) return &p;
    return nullptr;
}

UsdLayer readUsdLayer(const std::filesystem::path& file, const UsdLayerLimits& limits) {
    const std::string name = file.string();
    return parseUsdLayer(readWholeFile(file, name, limits.fileBytes), name, limits);
}

} // namespace penumbra
