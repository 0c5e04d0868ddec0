#include "io/model/ImportedImages.h"

#include "io/model/PrimNames.h"
#include "io/usd/layer/UsdAssets.h"
#include "io/usd/layer/UsdText.h"

#include <assimp/scene.h>

#include <algorithm>
#include <cstring>

namespace penumbra {

namespace {

namespace fs = std::filesystem;

int hexDigit(char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

// A URI's `%20` as what it stands for (RFC 3986, section 2.1).
std::string withoutPercents(const std::string& text) {
    std::string plain;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool coded = text[i] == '%' && i + 2 < text.size() && hexDigit(text[i + 1]) >= 0 &&
                           hexDigit(text[i + 2]) >= 0;
        plain += coded ? char(16 * hexDigit(text[i + 1]) + hexDigit(text[i + 2])) : text[i];
        if (coded) i += 2;
    }
    return plain;
}

bool isFile(const fs::path& path) {
    std::error_code failed;
    return fs::is_regular_file(path, failed);
}

// An ending that is safe in a name: of the format Assimp found, else of the bytes themselves.
std::string endingOf(const aiTexture& texture) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(texture.pcData);
    if (texture.mWidth > 3 && bytes[0] == 0xff && bytes[1] == 0xd8) return ".jpg";
    if (texture.mWidth > 3 && std::memcmp(bytes, "\x89PNG", 4) == 0) return ".png";
    const std::string_view hint(texture.achFormatHint, strnlen(texture.achFormatHint, 8));
    return std::string(".").append(primName(hint, "bin"));
}

} // namespace

ImportedImages::ImportedImages(const aiScene& scene, fs::path model, fs::path layer,
                               Diagnostics& diagnostics)
    : scene_(scene), model_(std::move(model)), layer_(std::move(layer)), diagnostics_(diagnostics) {
}

std::optional<std::string> ImportedImages::find(const std::string& name) {
    const auto [entry, isNew] = known_.try_emplace(name);
    if (isNew) entry->second = search(name);
    return entry->second;
}

std::optional<std::string> ImportedImages::search(const std::string& name) {
    if (const aiTexture* texture = scene_.GetEmbeddedTexture(name.c_str()))
        return keep(*texture, name);
    std::string slashed = name;
    std::replace(slashed.begin(), slashed.end(), '\\', '/');
    const fs::path folder = model_.parent_path();
    for (const std::string& way : {name, slashed, withoutPercents(slashed)})
        for (const fs::path& file : {folder / way, folder / fs::path(way).filename()})
            if (!way.empty() && isFile(file)) return take(file, name);
    diagnostics_.warn({model_.string()},
                      "picture '" + cleanText(name) + "' is not there: its colour is used alone");
    return std::nullopt;
}

// A layer is UTF-8; names of files may be any bytes.
std::optional<std::string> ImportedImages::take(const fs::path& file, const std::string& name) {
    std::string path = relativeAsset(file, layer_.empty() ? model_ : layer_);
    if (firstBadUtf8(path) != std::string::npos) {
        diagnostics_.warn({model_.string()},
                          "picture '" + cleanText(name) +
                              "' left out: its path is not valid UTF-8 (rename it)");
        return std::nullopt;
    }
    files_.push_back(file);
    return path;
}

std::optional<std::string> ImportedImages::keep(const aiTexture& texture, const std::string& name) {
    const auto leaveOut = [&](const char* why) {
        diagnostics_.warn({model_.string()},
                          "picture '" + cleanText(name) + "' within the model left out: " + why);
        return std::nullopt;
    };
    if (texture.mHeight != 0 || texture.mWidth == 0 || !texture.pcData)
        return leaveOut("only PNG, JPEG and the like are taken");
    const fs::path holder = layer_.empty() ? model_.filename() : layer_.stem();
    if (firstBadUtf8(holder.string()) != std::string::npos)
        return leaveOut("the name of its file is not valid UTF-8 (rename it)");
    const auto* bytes = reinterpret_cast<const std::byte*>(texture.pcData);
    ImportedImage image;
    image.name = (layer_.empty() ? "" : holder.string() + "-") + "picture" +
                 std::to_string(images_.size() + 1) + endingOf(texture);
    image.bytes.assign(bytes, bytes + texture.mWidth);
    images_.push_back(std::move(image));
    const std::string& made = images_.back().name;
    return "./" + (layer_.empty() ? holder.string() + "[" + made + "]" : made);
}

} // namespace penumbra
