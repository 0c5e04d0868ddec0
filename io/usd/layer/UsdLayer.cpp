// Getting the text of a layer from the disk.
#include "io/usd/layer/UsdLayer.h"

#include "base/SystemError.h"

#include <cerrno>
#include <fstream>

namespace penumbra {

namespace {

[[noreturn]] void refuse(const std::string& file, const std::string& why) {
    throw SceneFileError({file, 0, 0}, why);
}

std::string readWholeFile(const std::filesystem::path& path, const std::string& name,
                          std::uintmax_t maxBytes) {
    namespace fs = std::filesystem;
    const std::string unreadable = whyUnreadable(name);
    if (!unreadable.empty()) refuse(name, "can't read: " + unreadable);
    std::error_code failed;
    if (!fs::is_regular_file(path, failed))
        refuse(name, "can't read: it is a device or a pipe (name a file)");
    const std::uintmax_t bytes = fs::file_size(path, failed);
    if (failed) refuse(name, "can't read: " + reasonOf(failed.value(), FileUse::read));
    if (bytes > maxBytes)
        refuse(name, "the file is too large: " + std::to_string(bytes) + " bytes (the limit is " +
                         std::to_string(maxBytes) + ")");
    errno = 0;
    std::ifstream in(path, std::ios::binary);
    std::string text(bytes, '\0');
    if (!in || !in.read(text.data(), std::streamsize(bytes)))
        refuse(name, "can't read: " + reasonOf(errno ? errno : EIO, FileUse::read));
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
